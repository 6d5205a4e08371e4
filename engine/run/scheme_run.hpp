// SPDX-License-Identifier: GPL-3.0-or-later
/// One scheme of a scene, run from start to end: nodes, rows, extremes, outcome.
///
/// It is a march (run/march/march.hpp) whose sinks grow the extremes, over every node, and record rows,
/// frames and what is looked at inside steps.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/run/comparison.hpp"
#include "engine/run/reference/reference.hpp"

namespace extremal {

class ExactActions;
class SchemeCheckpoint;
struct Recording;

class SchemeRun {
public:
    /// Scheme `index` of the scene; scene and plan must outlive the run. With a `known` result there is
    /// nothing to do.
    SchemeRun(const ResolvedScene& scene, std::size_t index, const ProductPlan& plan,
              const std::shared_ptr<const SchemeResult>& known = nullptr);

    /// Keeps checkpoints of its marches, or goes on from them. The file must outlive the run.
    void setCheckpoint(SchemeCheckpoint* file) { checkpoint_ = file; }

    std::size_t index() const { return index_; }
    bool isKnown() const { return isKnown_; }

    /// Integrates; returns when done, failed or stopped. Never throws for numerical trouble. `exact`: null
    /// where no view compares actions.
    void run(const Reference& reference, ExactActions* exact, const std::stop_token& stop);

    /// What there is now; immutable.
    std::shared_ptr<const SchemeResult> latest() const;

private:
    Recording record(const Reference& reference, bool hasCompanion, long long stride, long long maxRows,
                     const std::stop_token& stop);
    void compute(const Reference& reference, ExactActions* exact, const std::stop_token& stop);
    void publish(const SchemeResult& result);
    void measureOrder(SchemeResult& result, const Reference& reference, const Reference& ofScene,
                      const std::stop_token& stop) const;

    const ResolvedScene& resolved_;
    const ResolvedScheme& scheme_;
    const Scene& scene_ = resolved_.scene;
    const SchemeSpec& spec_ = scheme_.spec;
    const ProductPlan& plan_;
    std::size_t index_;
    bool isKnown_;
    SchemeCheckpoint* checkpoint_ = nullptr;
    mutable std::mutex mutex_;
    std::shared_ptr<const SchemeResult> latest_;
};

}  // namespace extremal
