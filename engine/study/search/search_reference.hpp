// SPDX-License-Identifier: GPL-3.0-or-later
/// The reference of a search, whose steps are not known beforehand: a table that is read off at any time,
/// where one reproduces the reference, so that not every run integrates it again.
#pragma once

#include <memory>
#include <stop_token>
#include <vector>

#include "engine/run/reference/confirmation.hpp"
#include "engine/run/reference/reference.hpp"
#include "engine/run/reference/tabulated_solution.hpp"
#include "engine/study/search/metric.hpp"
#include "engine/study/search/point.hpp"

namespace extremal {

class SearchReference {
public:
    SearchReference() = default;
    /// The scene must outlive it. `metrics`: what is compared with it. Throws InvalidScene for a file that
    /// cannot be used.
    SearchReference(const ResolvedScene& scene, const std::vector<Metric>& metrics,
                    const std::stop_token& stop);

    const ReferenceInfo& info() const { return reference_.info; }
    /// For a run of a scheme of the scene; empty where there is none.
    ExactSolution of(const ResolvedScheme& scheme) const;
    /// For a run of a point of a study.
    ExactSolution of(const ResolvedScene& scene, const StudyPoint& point) const;
    /// Beside a method of another kind, in the metric; empty where there is no such method, or where the
    /// metric needs no reference.
    Confirmation confirmed(const Metric& metric) const;
    /// The metric with the sizes of what it measures, in this reference; without one, those at the start.
    Metric sized(const Metric& metric, const ResolvedScene& scene) const;

private:
    const ResolvedScene* scene_ = nullptr;
    Reference reference_;
    std::shared_ptr<const TabulatedSolution> table_;
};

}  // namespace extremal
