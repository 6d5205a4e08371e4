// SPDX-License-Identifier: GPL-3.0-or-later
/// What runs of a scene are judged by: metrics with the sizes of what they measure, what is wished of each,
/// and the floors below which the reference tells nothing.
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "engine/study/search/search_reference.hpp"
#include "engine/study/stability/judgement.hpp"
#include "engine/study/wish.hpp"

namespace extremal {

/// The metrics of the wishes; of `metric` alone where there are none. Throws InvalidScene (pointer
/// "--metric" or "--wish").
std::vector<Metric> metricsOf(const std::vector<Wish>& wishes, const std::string& metric, bool isAtEnd,
                              const ResolvedScene& scene);

struct JudgedWishes {
    std::vector<Metric> metrics;
    std::vector<JudgedValue> values;  ///< without the values
    SearchReference reference;        ///< empty where no metric needs one

    /// Computes the reference. `wishes`: one per metric, or none; a value of 0 is a thousandth of the size
    /// (1e-3 where that is not known). The scene must outlive it.
    JudgedWishes(const ResolvedScene& scene, std::vector<Metric> metrics, const std::vector<Wish>& wishes,
                 const std::stop_token& stop);

    /// Of a run of this scheme; unknown of one that was stopped.
    Judgement of(RunStatus status, Outcome cause, const std::vector<double>& measured) const;
};

}  // namespace extremal
