// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs at the extremes: one number of a scene goes from what is usual to what no scheme can follow, over
/// systems and schemes of every family. Where does the domain of each scheme end, and does it say so?
///
/// Each case is a whole run of a scene, and belongs to one class:
///
///     right     it is done, and its measure is at most 0.1
///     coarse    it is done and bounded, with a larger measure: the step does not resolve the motion
///     refused   the scene, or the scheme at its start, says that it cannot be run
///     lost, diverged, not-finite, ...   it ended early, and says why
///
/// The measure is the largest error against the exact solution, relative to the size of the start, where the
/// axis has one; else the largest change of the energy, relative to the energies of the motion
/// (run/march/motion_check.hpp), or of the norm.
#pragma once

#include <limits>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/core/value.hpp"

namespace extremal {

/// One number that goes to its extremes: a file of resources/extremes. "$" in its scene and schemes stands
/// for the values; "$" alone is the value as a number.
struct ExtremeAxis {
    enum class Metric { error, energy, norm };
    std::string id;     ///< the file's: "stiffness"
    std::string title;  ///< "k of the spring pendulum over two units of time, h = 0.01"
    Value scene;        ///< without schemes
    Metric metric = Metric::energy;
    std::vector<std::string> values;
    std::size_t usual = 0;  ///< the first so many of them; runs of the others take minutes
    std::vector<Value> schemes;
    const std::string& label(std::size_t scheme) const { return schemes[scheme].find("label")->asString(); }
};
/// In alphabetical order.
const std::vector<ExtremeAxis>& extremeAxes();

struct ExtremeCase {
    const ExtremeAxis* axis = nullptr;
    std::size_t value = 0, scheme = 0;
    std::string text() const;  ///< of the scene
};
/// Axis by axis, scheme by scheme, value by value. `withLong`: those that take minutes as well.
std::vector<ExtremeCase> extremeCases(bool withLong = false);

struct ExtremeResult {
    std::string kind;  ///< the class; empty: not known yet
    double measure = std::numeric_limits<double>::quiet_NaN();
    double failedAt = measure;
};
ExtremeResult runExtreme(const ExtremeCase& extreme, const std::stop_token& stop);

}  // namespace extremal
