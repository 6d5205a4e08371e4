// SPDX-License-Identifier: GPL-3.0-or-later
/// A scene whose numbers are varied: what they are called, what they change, and its system with the
/// parameters as coordinates.
///
/// A number may be anything that changes parameters of a formula or the start: a key of the model, a number
/// of an element of a mechanism, an initial value, or the factor 1 of a term that has a name. Other numbers
/// that are expressions in it change with it, as they do with --set.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/integrator/variation/with_sensitivities.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

/// At most so many.
inline constexpr std::size_t mostVariedNumbers = 32;

/// Gives the system the part VariedNumbers, where the scene observes "sensitivity": the numbers that it
/// lists, else all parameters of its formulas.
void nameVariedNumbers(System& system, const Scene& scene);

/// Why a scene has no number there that can be varied, for people; empty: it has.
std::string variedNumberProblem(const Scene& scene, const System& system, const std::string& pointer);

/// The numbers that can be varied, with their values: the parameters of formulas, and initial values that the
/// scene gives.
struct NumberOfScene {
    std::string pointer, name;
    double value = 0;
};
std::vector<NumberOfScene> numbersOf(const Scene& scene, const System& system);

/// A control that is a polynomial on each step of length h from t_0:
///     u(t) = sum_j c_j s^j,    s = (t - t_0) / h - 1/2.
struct ControlCurve {
    std::string name;
    int coefficients = 1;
    double step = 0;
};

/// What becomes a coordinate besides numbers. `integrand`, a formula in what the model's formulas know: with
/// L + u c or H - u c the momentum of u is the integral of c, by the quadrature of the scheme itself, and
/// with u = 0 the motion is as it was. Coefficients of a control, and then t_0, take the place of its
/// formula or table, and are 0.
struct VariedExtras {
    std::string integrand = {};
    std::vector<ControlCurve> controls = {};
    bool isEmpty() const { return integrand.empty() && controls.empty(); }
};

/// The constants that formulas of the model know, by their names.
std::map<std::string, double> formulaConstants(const Scene& scene, const System& system);

struct VariedScene {
    std::vector<SensitivityColumn> numbers;  ///< those that cannot be varied start with NaN
    /// Of the formulas, that change with any of the numbers; then those of VariedExtras.
    std::vector<double> parameters;
    std::vector<std::string> names;        ///< of parameters, in the formulas
    std::size_t integral = 0;              ///< place of u there
    std::vector<std::size_t> controls;     ///< places of the first coefficients there
    std::shared_ptr<const System> system;  ///< with them as coordinates; null where there are none of them
    std::string problem;                   ///< of the first number that cannot be varied; empty: all can
};

/// Derivatives of the start and of parameters by the numbers are differences of order 8 of what reading makes
/// of the scene (of order 6 where a number is as small as it may be), with relative errors of 1e-13. Throws
/// InvalidScene where nothing can be varied.
VariedScene variedScene(const ResolvedScene& scene, const VariedExtras& extras = {});

}  // namespace extremal
