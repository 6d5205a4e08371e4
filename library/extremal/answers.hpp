// SPDX-License-Identifier: GPL-3.0-or-later
/// Answers that the tangent maps of steps give: periodic orbits, numbers from measurements, gradients,
/// and controls. The handbook's page "Orbits, fits and controls" says what is computed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "extremal/scene.hpp"

namespace extremal::api {

/// The options of `extremal orbit`, by the same names.
struct OrbitOptions {
    std::string scheme = {};  ///< a label; empty: the first enabled one
    std::string period = {};  ///< a number or an expression
    std::optional<double> energy = {};
    std::string hold = {};    ///< "energy" or "period"
    std::string follow = {};  ///< "energy=VALUE", "POINTER=VALUE"
    int points = 0;           ///< of a family; 0: 20
};

/// The document of orbit.json: found, period, energy, start, multipliers, ..; besides `orbits`, the rows of
/// orbits.csv, and `scene`, the document of the orbit as a scene. Where found is false problem and remedy say
/// why. Throws InvalidScene, whose pointers are the options of the command line ("--period").
EXTREMAL_API Value orbit(const Scene& scene, const OrbitOptions& options = {});

/// The options of `extremal fit`, by the same names.
struct FitOptions {
    std::vector<std::string> free = {};     ///< pointers to the numbers
    std::string scheme = {};                ///< a label; empty: the first enabled one
    std::vector<std::string> columns = {};  ///< of the measurements; empty: all
    bool measuresBias = true;
};

/// The document of fit.json: found, parameters, directions, notes, ..; besides `residuals`, the rows of
/// residuals.csv, and `scene`, the scene with the numbers in place. `csv`: the text of the measurements.
EXTREMAL_API Value fit(const Scene& scene, const std::string& csv, const FitOptions& options);

/// The options of `extremal gradient`, by the same names.
struct GradientOptions {
    std::string of = {};                 ///< a formula at the end
    std::string over = {};               ///< a formula integrated over the run
    std::vector<std::string> with = {};  ///< pointers to numbers and to controls
    std::string scheme = {};             ///< a label; empty: the first enabled one
};

/// The document of gradient.json: found, value, at_end, integral, gradient, ... Where found is false problem
/// and remedy say why.
EXTREMAL_API Value gradient(const Scene& scene, const GradientOptions& options);

/// The options of `extremal steer`, by the same names.
struct SteerOptions {
    std::string over = {};                     ///< the cost that is integrated over the run
    std::string of = {};                       ///< the cost at the end
    std::vector<std::string> conditions = {};  ///< formulas that are to be 0 at the end
    std::vector<std::string> controls = {};    ///< names; empty: all of the model
    std::vector<std::string> bounds = {};      ///< "u=-1:1"
    std::string scheme = {};                   ///< a label; empty: the first enabled one
};

/// The document of steer.json: found, cost, multipliers, ...; besides `controls` and `states`, the rows of
/// controls.csv and states.csv, and `scene`, the scene with the controls as tables. Where found is false
/// problem and remedy say why.
EXTREMAL_API Value steer(const Scene& scene, const SteerOptions& options);

}  // namespace extremal::api
