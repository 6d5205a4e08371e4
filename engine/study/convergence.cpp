#include "engine/study/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace extremal {
namespace {

struct Line {
    double slope = 0, constant = 0, r2 = 0, worst = 0;  ///< worst: largest distance, in log10
};

Line lineThrough(const std::vector<double>& x, const std::vector<double>& y, std::size_t first,
                 std::size_t last) {
    const double n = static_cast<double>(last - first);
    double mx = 0, my = 0, xx = 0, xy = 0, yy = 0;
    for (std::size_t i = first; i < last; ++i) mx += x[i] / n, my += y[i] / n;
    for (std::size_t i = first; i < last; ++i) {
        xx += (x[i] - mx) * (x[i] - mx);
        xy += (x[i] - mx) * (y[i] - my);
        yy += (y[i] - my) * (y[i] - my);
    }
    Line line;
    line.slope = xy / xx;
    line.constant = my - line.slope * mx;
    line.r2 = yy > 0 ? xy * xy / (xx * yy) : 0;
    for (std::size_t i = first; i < last; ++i)
        line.worst =
            std::max(line.worst, std::abs(y[i] - line.constant - line.slope * x[i]) / std::log(10.0));
    return line;
}

}  // namespace

double OrderFit::errorAt(double step) const { return std::exp(logConstant + order * std::log(step)); }

double floorOf(const ReferenceInfo& reference) {
    return std::isfinite(reference.estimatedError) ? 10 * reference.estimatedError : 0;
}

double roundOffOf(double scale, long long steps) { return 2.2e-15 * scale * static_cast<double>(steps); }

OrderFit fitOrder(std::span<const SweepRow> rows, double floor, double scale) {
    constexpr std::size_t fewest = 3;
    constexpr double tolerance = 0.1, leastR2 = 0.98;
    // Stretches of usable neighbours.
    std::vector<double> x, y, steps;
    std::vector<std::size_t> breaks{0};
    for (const SweepRow& row : rows) {
        const double error = row.result.error;
        const bool isUsable = row.result.isDone() && row.point.step > 0 && std::isfinite(error) &&
                              error > std::max(floor, roundOffOf(scale, row.result.steps));
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
    std::size_t most = 0;
    for (std::size_t b = 0; b + 1 < breaks.size(); ++b)
        for (std::size_t first = breaks[b]; first + fewest <= breaks[b + 1]; ++first)
            for (std::size_t last = first + fewest; last <= breaks[b + 1]; ++last) {
                const Line line = lineThrough(x, y, first, last);
                if (line.worst > tolerance || line.r2 < leastR2 || last - first < most) continue;
                most = last - first;
                best.order = line.slope;
                best.r2 = line.r2;
                best.logConstant = line.constant;
                best.from = steps[first];
                best.to = steps[last - 1];
            }
    return best;
}

}  // namespace extremal
