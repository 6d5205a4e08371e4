// SPDX-License-Identifier: GPL-3.0-or-later
/// Several cases of a scene that one setting of a scheme has to serve: starts, or values of any other number.
///
///     --over POINTER=a,b,c      or POINTER=FROM:TO:N[:log]
///     --of worst                the largest error of all cases (default)
///     --of median               that of the middle one: half of them may be worse
///
/// Each case has a reference and sizes of its own. The cost of a setting is the mean over the cases.
#pragma once

#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/study/search/metric.hpp"
#include "engine/study/search/point.hpp"
#include "engine/study/search/search_reference.hpp"

namespace extremal {

struct OverCases {
    std::string pointer;  ///< empty: the scene alone
    std::vector<double> values;
    bool isMedian = false;
    bool isGiven() const { return !pointer.empty(); }
    bool operator==(const OverCases&) const = default;
};

/// Throws InvalidScene ("--over", "--of"). Empty texts: the scene alone.
OverCases parseCases(const std::string& over, const std::string& of);
/// What --over says.
std::string textOf(const OverCases& cases);

/// One of them.
struct SearchCase {
    std::shared_ptr<const ResolvedScene> scene;
    std::vector<Metric> metrics;  ///< with its sizes
    SearchReference reference;
    Confirmation confirmation;  ///< of the first metric
};

/// The scenes of the cases, with the schemes of `scene`, candidates among them. Throws InvalidScene where the
/// number is not one of the scene, or changes nothing.
std::vector<std::shared_ptr<const ResolvedScene>> scenesOf(const ResolvedScene& scene,
                                                           const OverCases& cases);

/// One result of those of all cases, each with as many errors: the largest or the middle ones, the mean of
/// the costs. One that failed is larger than any error.
PointResult combined(const std::vector<PointResult>& results, bool isMedian);

}  // namespace extremal
