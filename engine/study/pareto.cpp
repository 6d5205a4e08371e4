#include "engine/study/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace extremal {

std::vector<bool> paretoFront(const std::vector<SweepRow>& rows) {
    std::vector<std::size_t> known;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].result.isDone() && std::isfinite(rows[i].result.error) &&
            std::isfinite(rows[i].result.cpuSeconds))
            known.push_back(i);
    std::sort(known.begin(), known.end(), [&](std::size_t a, std::size_t b) {
        const PointResult &x = rows[a].result, &y = rows[b].result;
        return x.cpuSeconds != y.cpuSeconds ? x.cpuSeconds < y.cpuSeconds : x.error < y.error;
    });
    std::vector<bool> front(rows.size(), false);
    double best = std::numeric_limits<double>::infinity();
    for (const std::size_t i : known)
        if (rows[i].result.error < best) {
            front[i] = true;
            best = rows[i].result.error;
        }
    return front;
}

std::vector<std::pair<double, double>> paretoFront(std::vector<std::pair<double, double>> points) {
    std::sort(points.begin(), points.end());
    double best = std::numeric_limits<double>::infinity();
    std::erase_if(points, [&](const auto& point) {
        if (!(point.second < best)) return true;
        best = point.second;
        return false;
    });
    return points;
}

}  // namespace extremal
