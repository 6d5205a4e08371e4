// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace extremal {

std::vector<std::size_t> paretoFront(const std::vector<std::pair<double, double>>& points) {
    std::vector<std::size_t> front;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (std::isfinite(points[i].first) && std::isfinite(points[i].second)) front.push_back(i);
    std::sort(front.begin(), front.end(),
              [&](std::size_t a, std::size_t b) { return points[a] < points[b]; });
    double best = std::numeric_limits<double>::infinity();
    std::erase_if(front, [&](std::size_t i) {
        if (!(points[i].second < best)) return true;
        best = points[i].second;
        return false;
    });
    return front;
}

namespace {

template <class IsCounted>
std::vector<bool> frontAmong(const std::vector<SweepRow>& rows, const IsCounted& isCounted) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    std::vector<std::pair<double, double>> points;
    for (const SweepRow& row : rows)
        points.emplace_back(isCounted(row.result) ? row.result.cpuSeconds : unknown, row.result.error);
    std::vector<bool> isInFront(rows.size(), false);
    for (const std::size_t i : paretoFront(points)) isInFront[i] = true;
    return isInFront;
}

}  // namespace

std::vector<bool> paretoFront(const std::vector<SweepRow>& rows) {
    return frontAmong(rows, [](const PointResult& r) { return r.isDone(); });
}

std::vector<bool> paretoFront(const Sweep& sweep) {
    return frontAmong(sweep.rows(), [&](const PointResult& r) { return sweep.isJudged(r); });
}

}  // namespace extremal
