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
///
/// The same for a number of any scene, by its pointer: each case is then measured by the metrics of the
/// study against the reference of its own scene, and is right where the wishes hold.
///
/// Beside its class each case has a judgement (judgement.hpp), which knows the floor of the reference.
#pragma once

#include <limits>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/study/stability/judgement.hpp"
#include "engine/study/wish.hpp"

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
    // Of a scene of the user:
    std::string pointer = {};  ///< where the values go; empty: this is an axis of resources/extremes
    std::vector<std::pair<std::string, double>> fixed = {};  ///< other numbers that are changed
    std::string measured = "error";                          ///< the metric, where there are no wishes
    bool isAtEnd = false;
    std::vector<Wish> wishes = {};
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
/// Of axes that outlive them.
std::vector<ExtremeCase> extremeCases(const std::vector<ExtremeAxis>& axes, bool withLong);

struct ExtremeResult {
    std::string kind;  ///< the class; empty: not known yet
    double measure = std::numeric_limits<double>::quiet_NaN();
    double failedAt = measure;
    Judgement judgement = Judgement::unknown;
    double floor = measure;  ///< of the measure: below it the reference tells nothing
};
ExtremeResult runExtreme(const ExtremeCase& extreme, const std::stop_token& stop);
/// CPU seconds that the reference of a case of a scene takes, by computing it and by the first places at
/// which a run is compared with it; 0 of the other axes, whose references are known.
double secondsOfJudging(const ExtremeCase& extreme, const std::stop_token& stop);

}  // namespace extremal
