// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/algebra/line_fit.hpp"
#include "engine/run/reference/error_floor.hpp"

namespace extremal {

double OrderFit::errorAt(double step) const { return std::exp(logConstant + order * std::log(step)); }

OrderFit fitOrder(std::span<const SweepRow> rows, double floor, double scale, double most) {
    constexpr std::size_t fewest = 3;
    const double tolerance = 0.1 * std::log(10.0), leastR2 = 0.98, leastFall = std::log(2.0);
    // Stretches of usable neighbours.
    std::vector<double> x, y, steps;
    std::vector<std::size_t> breaks{0};
    for (const SweepRow& row : rows) {
        const double error = row.result.error;
        const bool isUsable = row.result.isDone() && row.point.step > 0 && std::isfinite(error) &&
                              error < most && error > std::max(floor, roundOffFloor(scale, row.result.steps));
        if (isUsable) {
            x.push_back(std::log(row.point.step));
            y.push_back(std::log(error));
            steps.push_back(row.point.step);
        } else if (breaks.back() != x.size()) {
            breaks.push_back(x.size());
        }
    }
    if (breaks.back() != x.size()) breaks.push_back(x.size());
    OrderFit best;
    std::size_t longest = 0;
    for (std::size_t b = 0; b + 1 < breaks.size(); ++b)
        for (std::size_t first = breaks[b]; first + fewest <= breaks[b + 1]; ++first)
            for (std::size_t last = first + fewest; last <= breaks[b + 1]; ++last) {
                const LineFit line = lineThrough(std::span(x).subspan(first, last - first),
                                                 std::span(y).subspan(first, last - first));
                if (line.worst > tolerance || line.r2 < leastR2 || last - first < longest) continue;
                // A plateau may lie on a line as well, to its last digits.
                if (line.slope * (x[first] - x[last - 1]) < leastFall) continue;
                longest = last - first;
                best.order = line.slope;
                best.r2 = line.r2;
                best.logConstant = line.constant;
                best.from = steps[first];
                best.to = steps[last - 1];
            }
    return best;
}

std::vector<OrderFit> fitOrders(const Sweep& sweep) {
    const double floor = referenceFloor(sweep.reference()), scale = largestEntry(sweep.scene().initial);
    std::vector<OrderFit> all;
    for (const SchemeRows& scheme : bySchemes(sweep))
        all.push_back(fitOrder(scheme.rows, floor, scale, sweep.judgedErrors().most));
    return all;
}

}  // namespace extremal
