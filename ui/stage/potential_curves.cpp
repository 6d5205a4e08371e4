// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/potential_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "engine/model/parts/constraint.hpp"

namespace extremal {
namespace {

constexpr double faint = 0.3, clear = 0.75;  // strengths of lines

/// V(q), or nothing where there is none to be seen.
std::function<double(const double* q)> potentialOf(const System& system, const State& start, double end) {
    // Where something else does work, the energy at the start bounds nothing.
    if (!system.hasCoordinates() || !isTaken(Takes::only<Mechanical, Constraint>(), system.parts)) return {};
    const EnergyFunction energy = energyOf(system);
    if (!energy) return {};
    const auto d = static_cast<std::size_t>(system.dimension());
    const auto at = [=](double t, const double* q) {
        std::vector<double> x(2 * d, 0.0);
        std::copy(q, q + d, x.begin());
        return energy(t, x.data());
    };
    // With a field that acts on velocities, as a magnetic one does, it is no potential that is left at rest.
    std::vector<double> back = start.x;
    for (std::size_t i = d; i < 2 * d; ++i) back[i] = -back[i];
    const double there = energy(start.t, start.x.data());
    if (!(std::abs(energy(start.t, back.data()) - there) <= 1e-9 * (1 + std::abs(there)))) return {};
    // One that changes in time has no picture that stays.
    const double now = at(start.t, start.x.data());
    for (const double part : {0.31, 0.57}) {
        const double then = at(start.t + part * (end - start.t), start.x.data());
        if (!(std::abs(then - now) <= 1e-9 * (1 + std::abs(now)))) return {};
    }
    return [at, t = start.t](const double* q) { return at(t, q); };
}

Point tracerOf(const System& system, const std::vector<double>& x) {
    Drawing drawing;
    drawing.isTracerOnly = true;
    system.draw(x.data(), drawing);
    return drawing.tracer;
}

/// Whether the picture shows the body at its coordinates: r = q.
bool showsCoordinates(const System& system, const State& start, const Bounds& seen) {
    const auto d = static_cast<std::size_t>(system.dimension());
    constexpr std::array<std::array<double, 2>, 4> places{{{0.2, 0.3}, {0.7, 0.1}, {0.4, 0.9}, {0.9, 0.6}}};
    return std::all_of(places.begin(), places.end(), [&](const auto& place) {
        std::vector<double> x = start.x;
        Point expected{};
        for (std::size_t i = 0; i < d; ++i)
            x[i] = expected[i] =
                seen.low[i] + place[i] * (seen.high[i] - seen.low[i]) + 1e-3 * static_cast<double>(i + 1);
        const Point r = tracerOf(system, x);
        const double size = 1e-9 * (1 + seen.diagonal());
        return std::abs(r[0] - expected[0]) <= size && std::abs(r[1] - expected[1]) <= size &&
               std::abs(r[2]) <= size;
    });
}

/// The graph of V over the places of the motion, with E at y = 0.
PotentialCurves graphOf(const std::function<double(const double*)>& potential, double energy,
                        const Bounds& seen) {
    constexpr int points = 240;
    constexpr double beyond = 0.12, depth = 0.3, above = 0.12;  // of the length of the motion
    const double length = seen.high[0] - seen.low[0];
    const double from = seen.low[0] - beyond * length, to = seen.high[0] + beyond * length;
    std::vector<double> x, v;
    double least = energy;
    for (int i = 0; i <= points; ++i) {
        x.push_back(from + (to - from) * i / points);
        v.push_back(potential(&x.back()));
        if (std::isfinite(v.back()) && x.back() >= seen.low[0] && x.back() <= seen.high[0])
            least = std::min(least, v.back());
    }
    PotentialCurves found;
    const double unit = depth * length / (energy - least);
    if (!(length > 0) || !std::isfinite(unit) || unit <= 0) return found;
    Curve line;
    line.width = 1.5;
    line.strength = clear;
    const auto end = [&] {
        if (line.points.size() > 1) found.curves.push_back(line);
        line.points.clear();
    };
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double y = unit * (v[i] - energy);
        if (!std::isfinite(y) || y > above * length || y < -1.5 * depth * length)
            end();
        else
            line.points.push_back({x[i], y, 0});
    }
    end();
    found.curves.push_back({{{from, 0, 0}, {to, 0, 0}}, 1, faint});
    for (const Curve& curve : found.curves)
        for (const Point& p : curve.points) found.bounds.add(p);
    return found;
}

/// Values on a grid, and the lines along which they are the same.
struct Grid {
    static constexpr int columns = 96, rows = 64;
    Point low{}, high{};
    std::vector<double> values;

    double at(int i, int j) const { return values[static_cast<std::size_t>(j * (columns + 1) + i)]; }
    double x(double i) const { return low[0] + (high[0] - low[0]) * i / columns; }
    double y(double j) const { return low[1] + (high[1] - low[1]) * j / rows; }
};

/// An edge of the grid: its left or lower corner, and whether it goes up.
using Edge = std::pair<int, bool>;

/// Where the level is met on an edge.
std::optional<Point> crossing(const Grid& grid, Edge edge, double level) {
    const int i = edge.first % (Grid::columns + 1), j = edge.first / (Grid::columns + 1);
    const int i2 = edge.second ? i : i + 1, j2 = edge.second ? j + 1 : j;
    const double a = grid.at(i, j) - level, b = grid.at(i2, j2) - level;
    if (!std::isfinite(a) || !std::isfinite(b) || (a < 0) == (b < 0)) return {};
    const double s = a / (a - b);
    return Point{grid.x(i + s * (i2 - i)), grid.y(j + s * (j2 - j)), 0};
}

/// Marching squares: the two or four crossings of each cell are joined, and the pieces to lines.
std::vector<std::vector<Point>> levelLines(const Grid& grid, double level) {
    std::map<Edge, std::vector<Edge>> joined;
    for (int j = 0; j < Grid::rows; ++j)
        for (int i = 0; i < Grid::columns; ++i) {
            const int corner = j * (Grid::columns + 1) + i;
            const std::array<Edge, 4> around{
                {{corner, false}, {corner + 1, true}, {corner + Grid::columns + 1, false}, {corner, true}}};
            std::vector<Edge> met;
            for (const Edge& edge : around)
                if (crossing(grid, edge, level)) met.push_back(edge);
            for (std::size_t k = 0; k + 1 < met.size(); k += 2) {
                joined[met[k]].push_back(met[k + 1]);
                joined[met[k + 1]].push_back(met[k]);
            }
        }
    std::vector<std::vector<Point>> lines;
    const auto follow = [&](Edge from) {
        std::vector<Point> line{*crossing(grid, from, level)};
        for (auto here = joined.find(from); here != joined.end() && !here->second.empty();) {
            const Edge next = here->second.back();
            here->second.pop_back();
            auto& back = joined[next];
            back.erase(std::find(back.begin(), back.end(), here->first));
            line.push_back(*crossing(grid, next, level));
            here = joined.find(next);
        }
        if (line.size() > 1) lines.push_back(std::move(line));
    };
    for (auto& [edge, others] : joined)
        if (others.size() == 1) follow(edge);  // open lines from their ends
    for (auto& [edge, others] : joined)
        while (!others.empty()) follow(edge);
    return lines;
}

/// A place that is as wide as a card, with some room around the motion.
Grid gridAround(const Bounds& seen) {
    constexpr double room = 0.3, widest = 2.8;
    Grid grid;
    const double width = seen.high[0] - seen.low[0], height = seen.high[1] - seen.low[1],
                 size = std::max(width, height);
    const double tall = std::max(height, 0.2 * size) * (1 + 2 * room),
                 wide = std::max(width * (1 + 2 * room), widest * tall);
    for (std::size_t i = 0; i < 2; ++i) {
        const double half = (i == 0 ? wide : tall) / 2, middle = seen.low[i] / 2 + seen.high[i] / 2;
        grid.low[i] = middle - half;
        grid.high[i] = middle + half;
    }
    return grid;
}

PotentialCurves linesOf(const std::function<double(const double*)>& potential, double energy,
                        const Bounds& seen) {
    constexpr int levels = 9;  // below twice the energy above the floor
    Grid grid = gridAround(seen);
    for (int j = 0; j <= Grid::rows; ++j)
        for (int i = 0; i <= Grid::columns; ++i) {
            const double q[2] = {grid.x(i), grid.y(j)};
            grid.values.push_back(potential(q));
        }
    std::vector<double> sorted;
    for (const double v : grid.values)
        if (std::isfinite(v)) sorted.push_back(v);
    PotentialCurves found;
    if (sorted.size() < 16) return found;
    std::sort(sorted.begin(), sorted.end());
    const double floor = sorted[sorted.size() / 50], reach = energy - floor;  // a pole has no floor
    if (!(reach > 1e-9 * (std::abs(energy) + std::abs(sorted.back() - sorted.front())))) return found;
    for (int k = 1; k <= 2 * levels; ++k) {
        const double level = floor + reach * k / levels;
        const bool isEnergy = k == levels;
        for (std::vector<Point>& line : levelLines(grid, level))
            found.curves.push_back({std::move(line), isEnergy ? 1.4 : 1.0, isEnergy ? clear : faint});
    }
    return found;
}

}  // namespace

PotentialCurves potentialCurves(const System& system, const State& start, double end, const Bounds& seen) {
    if (!system.draw || system.isSpatial || seen.isEmpty || system.field) return {};
    const int d = system.hasCoordinates() ? system.dimension() : 0;
    if (d < 1 || d > 2 || !showsCoordinates(system, start, seen)) return {};
    const auto potential = potentialOf(system, start, end);
    if (!potential) return {};
    const double energy = energyOf(system)(start.t, start.x.data());
    return d == 1 ? graphOf(potential, energy, seen) : linesOf(potential, energy, seen);
}

}  // namespace extremal
