// SPDX-License-Identifier: GPL-3.0-or-later
/// The products made inside the steps of a run, on the dense output of its scheme: points for plots, their
/// distance from the reference, and the events of sections. Where a view shows a part of the time axis its
/// steps have more points. In runs of more than 500 steps only those steps have points inside in which the
/// motion is curved; runs of more than 4000 steps have none.
///
/// A section is the set of states where one column passes zero upwards (integrator/crossing.hpp).
#pragma once

#include <vector>

#include "engine/integrator/crossing.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/run/comparison.hpp"

namespace extremal {

/// t and the state, as columns without values.
std::vector<Column> leadingColumns(const System& system);

/// Appends t and the first `width` entries of a state to these columns, with which those of the trajectory
/// begin.
void appendState(Trajectory& trajectory, double t, const std::vector<double>& x, std::size_t width);

class InsideStep {
public:
    /// Writes the products of the plan into `result`. `steps`: planned, or `isUnplanned`. `error`: may be
    /// empty; with it every step has points inside.
    InsideStep(SchemeResult& result, const Scene& scene, const ProductPlan& plan, const System& system,
               bool isUnplanned, long long steps, Observer error);

    bool isWanted() const { return points_ > 0 || !sections_.empty(); }
    void start(const State& state);
    void look(const Integrator& integrator, const State& before, const State& after,
              const StepReport& report);
    void checkpoint(Archive& archive) { archive(points_, at_.x, low_, high_); }

private:
    bool isCurved(const Integrator& integrator, const State& before, const State& after);
    int pointsIn(double start, double end, double periods, double least) const;
    void keep(const State& at, const StepReport& report);
    void cross(const Integrator& integrator, const State& before, const State& after);

    struct Section {
        std::size_t column, index;  ///< of the state; of the product
    };
    SchemeResult& result_;
    Observer error_;
    long long steps_;  ///< planned
    int points_ = 0;
    bool isSelective_ = false;                      ///< points inside curved steps alone
    std::vector<double> low_, high_;                ///< of each entry of the state so far
    std::vector<std::pair<double, double>> parts_;  ///< of the time axis that views show
    std::size_t width_ = 0;
    std::vector<Section> sections_;
    StepSamples samples_;
    CrossingFinder finder_;
    State at_;
    std::vector<double> errorValues_;
};

}  // namespace extremal
