// SPDX-License-Identifier: GPL-3.0-or-later
/// How large h may be: the steps with which a scheme is right on a scene, and what ends them on either side.
///
/// These steps need not be all below one limit. An implicit step over many fast periods may be right, as may
/// one that resolves them, while Newton's method fails for those between. So a ladder of steps is scanned,
///
///     h = T/n,   n = 2, 3, 4, 5, 6, 8, ...   (n grows by 2^(1/3)),
///
/// from the longest down until they resolve the fastest frequency and are right for two octaves, and every
/// change of the judgement between neighbours is bisected until they are 1 % apart. Where the coefficients of
/// a scheme tell its intervals of instability (scene/outlook/scheme_stability.hpp), however narrow, the steps
/// within those that matter in the run are on the ladder as well.
///
/// Why a step is not usable:
///
///     stability    h omega is beyond the last edge of the linear step, for a frequency of the linearisation
///                  along the reference; or the run was lost
///     resonance    h omega is in a bounded interval of instability, and the growth there, in the mean along
///                  the motion, times the steps of the run is above 1
///     solver       a step had no solution; or the run of a scheme that is stable for long steps was lost,
///                  with another root of its equations
///     single step  the wishes hold at this number of steps alone: a happy accident
///     accuracy     anything else
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "engine/model/exact_solution.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/study/search/metric.hpp"
#include "engine/study/stability/judgement.hpp"

namespace extremal {

enum class StepLimit {
    none,
    longest,
    shortest,
    time,
    accuracy,
    stability,
    resonance,
    solver,
    refusal,
    floor,
    single
};
/// "longest tried", "shortest tried", "time of the search", "accuracy", ...; empty for none.
std::string_view name(StepLimit limit);
/// By its name; none for anything else.
StepLimit stepLimitOf(std::string_view name);

/// Steps of one judgement that are neighbours. Unknown, with `time` for its reason: no such step was run to
/// its end.
struct StepRange {
    double from = 0, to = 0;  ///< steps that were run
    Judgement judgement = Judgement::unknown;
    StepLimit reason = StepLimit::none;                           ///< why they are not usable; none: they are
    StepLimit below = StepLimit::none, above = StepLimit::none;   ///< what ends them towards shorter, longer
    double errorFrom = std::numeric_limits<double>::quiet_NaN();  ///< the first metric at either end
    double errorTo = errorFrom;
    bool isUsable() const { return judgement == Judgement::right && reason == StepLimit::none; }
    bool operator==(const StepRange&) const = default;
};

struct UsableSteps {
    std::vector<StepRange> ranges;  ///< ascending in h
    std::string reason;             ///< why there are none: the scheme has no step of its own
    int runs = 0;
};

/// Frequencies of the linearisation along a motion: of each place all that are known, ascending.
struct MotionFrequencies {
    std::vector<std::vector<double>> places;
    double low() const;   ///< the smallest; 0: none is known
    double high() const;  ///< the largest; 0: none is known
};
/// Along the solution; at the start alone where it is empty.
MotionFrequencies frequenciesAlong(const ResolvedScene& scene, const ExactSolution& solution);

struct StepSearch {
    std::span<const Metric> metrics;
    std::span<const JudgedValue> wishes;       ///< one per metric: the values are filled in
    std::function<ExactSolution()> reference;  ///< of one run; empty where there is none
    const MotionFrequencies& frequencies;
    double seconds = 2;  ///< of CPU
};

UsableSteps usableSteps(const ResolvedScene& scene, std::size_t scheme, const StepSearch& search,
                        const std::stop_token& stop);

}  // namespace extremal
