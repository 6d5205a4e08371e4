// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reversed_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/observe/catalog.hpp"
#include "engine/run/march/march.hpp"

namespace extremal {

bool wantsWayBack(const std::vector<std::string>& observe) {
    return std::any_of(observe.begin(), observe.end(), [](const std::string& id) {
        const ObservableEntry* entry = findObservable(id);
        return entry && entry->needsWayBack;
    });
}

void addWayBack(SchemeResult& result, Integrator& back, const State& end, const std::stop_token& stop) {
    const std::string name = "reversibility";
    Trajectory& rows = result.trajectory;
    const auto column = std::find_if(rows.columns.begin(), rows.columns.end(),
                                     [&](const Column& c) { return c.name == name; });
    if (column == rows.columns.end() || rows.rows() == 0) return;
    const auto extreme = std::find_if(result.summary.extremes.begin(), result.summary.extremes.end(),
                                      [&](const auto& e) { return e.column == name; });
    const bool isFixed = back.grid() == TimeGrid::fixed;
    // Rows are in the order of their nodes; the way back meets the last of them first.
    std::size_t left = rows.rows();
    const auto see = [&](const Stretch& stretch) {
        for (std::size_t i = 0; i < stretch.nodes.size() && left > 0; ++i) {
            const auto node = static_cast<double>(end.node - stretch.nodes.node(i));
            while (left > 0 && rows.nodes[left - 1] > node) --left;  // between nodes
            if (left == 0 || rows.nodes[left - 1] != node) continue;
            const double* const x = stretch.nodes.x(i);
            const double late = isFixed ? 0 : stretch.nodes.t(i) - rows.columns[0].values[left - 1];
            double sum = late * late;
            for (std::size_t k = 0; k < stretch.nodes.width(); ++k) {
                const double off = x[k] - rows.columns[k + 1].values[left - 1];
                sum += off * off;
            }
            column->values[--left] = std::sqrt(sum);
            if (extreme != result.summary.extremes.end() && !(std::sqrt(sum) <= extreme->value))
                extreme->value = std::sqrt(sum);
        }
        return left > 0;
    };
    const MarchSink sink{see};
    // Where steps follow the state, what they began with goes with the run.
    State state{end.t, 0, end.x, isFixed ? std::vector<double>{} : end.memory};
    MarchGrid grid{Clock{end.t, back.stepSize()}, end.node, 0};
    if (!isFixed) {
        grid.isBackwards = true;
        grid.end = -std::numeric_limits<double>::infinity();
        grid.budget = end.node;
    }
    (void)march(back, state, grid, {&sink, 1}, stop);
}

void turnToForwards(SchemeResult& result) {
    const auto turn = [](Trajectory& trajectory) {
        for (Column& c : trajectory.columns) std::reverse(c.values.begin(), c.values.end());
        std::reverse(trajectory.nodes.begin(), trajectory.nodes.end());
    };
    turn(result.trajectory);
    if (result.products.find<DenseOutput>()) turn(result.products.make<DenseOutput>().points);
    if (result.products.find<FieldFrames>()) {
        auto& frames = result.products.make<FieldFrames>().all;
        std::reverse(frames.begin(), frames.end());
    }
}

}  // namespace extremal
