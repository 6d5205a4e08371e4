// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/studies/region_figure.hpp"

#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>

#include "engine/figure/build.hpp"

namespace extremal {
namespace {

constexpr int columns = LinearRegion::columns, rows = 2 * LinearRegion::rows - 1;
constexpr double unknown = LinearRegion::unknown;

const LinearRegion::Point& pointAt(const LinearRegion& region, int column, int row) {
    return region.at(column, std::abs(row - (LinearRegion::rows - 1)));
}
double imOf(int row) { return LinearRegion::im(row) - LinearRegion::im(LinearRegion::rows - 1); }

/// The level curve |r| = 1 by marching squares.
class Boundary {
public:
    explicit Boundary(const LinearRegion& region) : region_(region) {
        for (int column = 0; column + 1 < columns; ++column)
            for (int row = 0; row + 1 < rows; ++row) addCell(column, row);
    }

    /// Curves one after the other, with gaps between.
    void appendTo(std::vector<double>& x, std::vector<double>& y) {
        // Open curves first, from an end of theirs.
        for (const auto& [edge, ends] : next_)
            if (ends.size() == 1) follow(edge, x, y);
        for (const auto& [edge, ends] : next_) follow(edge, x, y);
    }

private:
    /// From a node to its neighbour to the right, or above.
    struct Edge {
        int column, row;
        bool isUpwards;
        auto operator<=>(const Edge&) const = default;
    };

    double level(int column, int row) const {
        const LinearRegion::Point& p = pointAt(region_, column, row);
        return p.isOnCut ? unknown : std::log(p.amplification);
    }

    /// The part of the edge, from its node, at which |r| passes 1.
    std::optional<double> crossing(const Edge& e) const {
        constexpr double roundOff = 1e-9;
        const double from = level(e.column, e.row),
                     to = e.isUpwards ? level(e.column, e.row + 1) : level(e.column + 1, e.row);
        if (std::isnan(from) || std::isnan(to) || (from <= roundOff) == (to <= roundOff)) return {};
        return std::min(1.0, std::max(0.0, from / (from - to)));
    }
    void addCell(int column, int row) {
        std::vector<Edge> passed;
        for (const Edge& e : {Edge{column, row, false}, Edge{column + 1, row, true},
                              Edge{column, row + 1, false}, Edge{column, row, true}})
            if (crossing(e)) passed.push_back(e);
        // Of a saddle the edges that meet in a corner.
        for (std::size_t i = 0; i + 1 < passed.size(); i += 2) {
            next_[passed[i]].push_back(passed[i + 1]);
            next_[passed[i + 1]].push_back(passed[i]);
        }
    }
    void follow(Edge edge, std::vector<double>& x, std::vector<double>& y) {
        if (seen_.contains(edge)) return;
        if (!x.empty()) {
            x.push_back(unknown);
            y.push_back(unknown);
        }
        const std::size_t first = x.size();
        for (bool goesOn = true; goesOn;) {
            seen_.insert(edge);
            const double part = *crossing(edge), width = LinearRegion::im(1);
            x.push_back(LinearRegion::re(edge.column) + (edge.isUpwards ? 0 : part * width));
            y.push_back(imOf(edge.row) + (edge.isUpwards ? part * width : 0));
            goesOn = false;
            for (const Edge& to : next_[edge])
                if (!seen_.contains(to)) {
                    edge = to;
                    goesOn = true;
                    break;
                }
        }
        // What is cut off beside a branch cut is not a curve.
        if (x.size() - first < 3) {
            x.resize(first > 0 ? first - 1 : 0);
            y.resize(x.size());
            return;
        }
        // A closed curve ends where it began.
        if (next_[edge].size() == 2) {
            x.push_back(x[first]);
            y.push_back(y[first]);
        }
    }

    const LinearRegion& region_;
    std::map<Edge, std::vector<Edge>> next_;
    std::set<Edge> seen_;
};

HeatMap heatOf(const LinearRegion& region) {
    HeatMap heat;
    const double half = LinearRegion::im(1) / 2;
    heat.left = LinearRegion::re(0) - half;
    heat.right = LinearRegion::re(columns - 1) + half;
    heat.bottom = imOf(0) - half;
    heat.top = imOf(rows - 1) + half;
    heat.columns = columns;
    heat.rows = rows;
    heat.low = 0.1;
    heat.high = 10;
    heat.scale = axisTitle("|r|", "");
    for (int column = 0; column < columns; ++column) heat.xs.push_back(LinearRegion::re(column));
    for (int row = 0; row < rows; ++row) heat.ys.push_back(imOf(row));
    for (int column = 0; column < columns; ++column)
        for (int row = 0; row < rows; ++row) {
            const double value = pointAt(region, column, row).amplification;
            heat.values.push_back(value);
            heat.faults.push_back(std::isfinite(value) ? "" : "no solution");
        }
    return heat;
}

}  // namespace

Figure regionFigure(const LinearStudy& linear) {
    Figure figure;
    figure.view = "linear-stability-region";
    figure.title = "Stability region";
    figure.aspect = Aspect::equal;
    figure.x.title = axisTitle("Re h λ", "");
    figure.y.title = axisTitle("Im h λ", "");
    figure.x.range = figure.y.range = {LinearRegion::re(0), LinearRegion::re(columns - 1)};
    const LinearStudy::Row* only = nullptr;
    int count = 0;
    for (const LinearStudy::Row& row : linear.rows()) {
        if (row.result.region.points.empty()) continue;
        only = &row;
        ++count;
        Series s;
        s.label = linear.scene().scene.schemes[row.scheme].label;
        s.style = styleOf(linear.scene().scene.schemes[row.scheme], row.scheme);
        s.kind = SeriesKind::curve;
        Boundary(row.result.region).appendTo(s.x, s.y);
        figure.add(std::move(s));
    }
    figure.subtitle = "where |r| ≤ 1: left of, or inside the boundaries";
    if (count == 1) {
        figure.series().front().style = exactStyle;  // to be seen on the colours
        figure.add(heatOf(only->result.region));
        figure.subtitle = "amplification |r| of one step, with the boundary |r| = 1";
    }
    if (count == 0) figure.message = "No scheme has a region";
    figure.summary = "Regions of stability of " + std::to_string(count) + " schemes.";
    return figure;
}

}  // namespace extremal
