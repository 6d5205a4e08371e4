// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/plane_field/plane_field_system.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/plane_picture.hpp"
#include "engine/model/typed/typed_function.hpp"

namespace extremal {
namespace {

using SharedPlane = std::shared_ptr<const PlaneFieldProblem>;

/// u or u_t at the nodes, from its key.
void fillFrom(const Settings& initial, const char* key, const PlaneFieldProblem& problem, double* values) {
    const std::size_t n = problem.size();
    const Value* const given = initial.find(key);
    const std::string pointer = std::string("/") + key;
    if (!given) return;
    if (given->isArray()) {
        if (given->asArray().size() != n)
            throw InvalidScene(pointer,
                               "must have " + std::to_string(n) + " numbers, one per node, got " +
                                   std::to_string(given->asArray().size()),
                               "the number of nodes is /model/cells times /model/cells_y, x first");
        for (std::size_t i = 0; i < n; ++i) {
            const Value& number = given->asArray()[i];
            if (!number.isNumber() || !std::isfinite(number.asNumber()))
                throw InvalidScene(pointer + "/" + std::to_string(i), "must be a finite number", "0");
            values[i] = number.asNumber();
        }
        return;
    }
    if (!given->isString() && !given->isNumber())
        throw InvalidScene(pointer, "must be an expression in x and y, or a list of values at the nodes",
                           "exp(-x^2 - y^2)");
    const typed::TypedFunction f(given->isString() ? given->asString() : formatNumber(given->asNumber(), 17),
                                 pointer, {"x", "y", "r", "phi"}, {});
    for (std::size_t j = 0, i = 0; j < problem.y().size(); ++j)
        for (const double x : problem.x()) {
            const double y = problem.y()[j], place[] = {x, y, std::hypot(x, y), std::atan2(y, x)};
            values[i] = f(place);
            if (!std::isfinite(values[i++]))
                throw InvalidScene(
                    pointer, "is not finite at x = " + formatNumber(x, 6) + ", y = " + formatNumber(y, 6),
                    "an expression that is finite on the whole rectangle");
        }
}

/// Of a linear field each mode turns by itself: u'' = -w^2 u.
ExactSolution linearMotion(const SharedPlane& problem, const State& initial) {
    const wave::Grid& grid = problem->grid();
    const std::size_t n = problem->size();
    SpectralGrid ways(grid.nx, grid.ny, grid.nx, grid.ny);
    std::vector<double> U(2 * ways.modes()), V(2 * ways.modes()), frequencies;
    ways.toModes(initial.x.data(), U.data());
    ways.toModes(initial.x.data() + n, V.data());
    const double turn = 2 * std::numbers::pi;
    double curvature = 0;
    const double zero = 0;
    problem->potential().evaluate(&zero, 1, nullptr, nullptr, &curvature);
    for (int l = 0; l < grid.ny; ++l)
        for (int k = 0; k <= grid.nx / 2; ++k) {
            const double K = turn * k / grid.x.length,
                         L = turn * (2 * l > grid.ny ? l - grid.ny : l) / grid.y.length;
            frequencies.push_back(std::sqrt(problem->stiffness() * (K * K + L * L) + curvature));
        }
    return [ways, U, V, frequencies, n, begin = initial.t](double t, std::span<double> x) mutable {
        std::vector<double> u(U.size()), v(U.size());
        for (std::size_t i = 0; i < U.size(); ++i) {
            const double w = frequencies[i / 2], c = std::cos(w * (t - begin)),
                         s = w > 0 ? std::sin(w * (t - begin)) / w : t - begin;
            u[i] = c * U[i] + s * V[i];
            v[i] = c * V[i] - w * w * s * U[i];
        }
        ways.toNodes(u.data(), x.data());
        ways.toNodes(v.data(), x.data() + n);
    };
}

FieldSampling samplingOf(const SharedPlane& problem) {
    const wave::Grid& grid = problem->grid();
    FieldSampling f;
    f.x = problem->x();
    f.y = problem->y();
    f.along = {grid.x.left, grid.x.length};
    f.across = {grid.y.left, grid.y.length};
    f.components = {"u", "u_t"};
    f.sample = [n = 2 * problem->size()](const double* x, double* values) { std::copy_n(x, n, values); };
    return f;
}

ErrorMeasure errorOf(const SharedPlane& problem) {
    ErrorMeasure m;
    m.columns = {{"error", "", "‖u - u_ref‖", ""}};
    m.evaluate = [n = problem->size(),
                  cell = problem->grid().measure() / static_cast<double>(problem->size())](
                     const double* x, const double* reference, double* values) {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += (x[i] - reference[i]) * (x[i] - reference[i]);
        values[0] = std::sqrt(cell * sum);
    };
    return m;
}

std::vector<Measure> measuresOf(const SharedPlane& problem) {
    Measure momentum{"translation-momentum",
                     {{"momentum_x", "", "-∫u_t u_x", ""},
                      {"momentum_y", "", "-∫u_t u_y", ""},
                      {"translation_momentum_error", "", "change of the momentum", ""}},
                     2,
                     [problem](const State& initial) {
                         const auto start = problem->momentum(initial.x.data());
                         return [problem, start](double, const double* x, double* values) {
                             const auto is = problem->momentum(x);
                             values[0] = is[0];
                             values[1] = is[1];
                             values[2] = std::hypot(is[0] - start[0], is[1] - start[1]);
                         };
                     }};
    Measure tail{"spectrum-tail", {{"spectrum_tail", "", "tail", ""}}, -1, [problem](const State&) {
                     return
                         [problem](double, const double* x, double* values) { values[0] = problem->tail(x); };
                 }};
    return {std::move(momentum), std::move(tail)};
}

/// |u| as how strong a colour is, its sign as the hue.
void drawPlaneField(const PlaneFieldProblem& problem, const double* u, Drawing& drawing) {
    const wave::Grid& grid = problem.grid();
    drawing.tracer = {grid.x.left + grid.x.length / 2, grid.y.left + grid.y.length / 2, 0};
    if (drawing.isTracerOnly) return;
    constexpr double positive = 0.6, negative = 0.07;  // blue and orange, as in plots
    double largest = 0;
    for (std::size_t i = 0; i < problem.size(); ++i) largest = std::max(largest, std::abs(u[i]));
    const double unit = largest > 0 ? 1 / largest : 0;
    drawing.shapes.push_back(rasterOf(grid, [&](Raster& r, std::size_t j) {
        r.strengths.push_back(unit * std::abs(u[j]));
        r.hues.push_back(u[j] < 0 ? negative : positive);
    }));
    addFrame(grid, drawing);
}

}  // namespace

System makePlaneFieldSystem(SharedPlane problem) {
    System s;
    s.parts.set(PlaneField{problem});
    s.energy = [problem](double, const double* x) { return problem->energy(x); };
    s.blocks.sizes.assign(2, problem->size());
    s.error = errorOf(problem);
    s.field = samplingOf(problem);
    s.measures = measuresOf(problem);
    if (problem->potential().kind() == FieldPotential::Kind::none)
        s.momenta = {{"field", "∫u_t", "", [problem](const double* x, const double*) {
                          double sum = 0;
                          for (std::size_t i = 0; i < problem->size(); ++i) sum += x[problem->size() + i];
                          return sum * problem->grid().measure() / static_cast<double>(problem->size());
                      }}};
    s.caution = [problem](const double* x) -> std::string {
        const double tail = problem->tail(x);
        if (!(tail > 1e-3)) return {};
        return "under-resolved: " + formatNumber(tail, 2) + " of u is in the upper eighth of its " +
               std::to_string(problem->grid().nx) + " x " + std::to_string(problem->grid().ny) + " modes";
    };
    s.start = [problem](const Settings& initial, double) {
        std::vector<double> x(2 * problem->size(), 0);
        fillFrom(initial, "u", *problem, x.data());
        fillFrom(initial, "u_t", *problem, x.data() + problem->size());
        problem->removeAlternation(x);
        return x;
    };
    // How good it is, is found out entry by entry: of many the time would be a run's.
    if (constexpr std::size_t most = 512; problem->potential().isLinear() && problem->size() <= most)
        s.exact = [problem](const State& initial) { return linearMotion(problem, initial); };
    s.draw = [problem](const double* values, Drawing& drawing) { drawPlaneField(*problem, values, drawing); };
    return s;
}

std::vector<FieldInfo> planeFieldStartFields() {
    return {optionalJsonField("u", "u",
                              "u at the start: an expression in x, y, r and phi, or values at the "
                              "nodes, x first; default 0."),
            optionalJsonField("u_t", "u_t", "u_t at the start, likewise.")};
}

}  // namespace extremal
