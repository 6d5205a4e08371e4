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
#include "engine/model/parts/component_values.hpp"
#include "engine/model/parts/named_start.hpp"
#include "engine/model/plane_field/start.hpp"
#include "engine/model/plane_picture.hpp"

namespace extremal {
namespace {

using SharedPlane = std::shared_ptr<const PlaneFieldProblem>;

/// Of a linear field each mode turns by itself: u'' = -w^2 u.
ExactSolution linearMotion(const SharedPlane& problem, const State& initial) {
    const wave::Grid& grid = problem->grid();
    const std::size_t m = problem->components(), n = problem->nodes(), size = problem->size();
    SpectralGrid ways(grid.nx, grid.ny, grid.nx, grid.ny);
    const std::size_t width = 2 * ways.modes();
    std::vector<double> U(m * width), V(m * width), frequencies, zero(m, 0), curvature(m * (m + 1) / 2);
    const double turn = 2 * std::numbers::pi;
    problem->potential().evaluate(zero.data(), 1, 1, nullptr, nullptr, curvature.data());
    for (std::size_t c = 0; c < m; ++c) {
        ways.toModes(initial.x.data() + c * n, U.data() + c * width);
        ways.toModes(initial.x.data() + size + c * n, V.data() + c * width);
        for (int l = 0; l < grid.ny; ++l)
            for (int k = 0; k <= grid.nx / 2; ++k) {
                const double K = turn * k / grid.x.length,
                             L = turn * (2 * l > grid.ny ? l - grid.ny : l) / grid.y.length;
                frequencies.push_back(
                    std::sqrt(problem->stiffness(c) * (K * K + L * L) + curvature[c * (c + 1) / 2 + c]));
            }
    }
    return [ways, U, V, frequencies, m, n, size, width, begin = initial.t](double t,
                                                                           std::span<double> x) mutable {
        std::vector<double> u(U.size()), v(U.size());
        for (std::size_t i = 0; i < U.size(); ++i) {
            const double w = frequencies[i / 2], c = std::cos(w * (t - begin)),
                         s = w > 0 ? std::sin(w * (t - begin)) / w : t - begin;
            u[i] = c * U[i] + s * V[i];
            v[i] = c * V[i] - w * w * s * U[i];
        }
        for (std::size_t c = 0; c < m; ++c) {
            ways.toNodes(u.data() + c * width, x.data() + c * n);
            ways.toNodes(v.data() + c * width, x.data() + size + c * n);
        }
    };
}

FieldSampling samplingOf(const SharedPlane& problem) {
    const wave::Grid& grid = problem->grid();
    FieldSampling f;
    f.x = problem->x();
    f.along = {grid.x.left, grid.x.length};
    if (grid.dimension() > 1) {
        f.y = problem->y();
        f.across = {grid.y.left, grid.y.length};
    } else {
        f.period = grid.x.length;
    }
    for (const char* suffix : {"", "_t"})
        for (std::size_t c = 0; c < problem->components(); ++c)
            f.components.push_back(problem->name(c) + suffix);
    f.isComplex = problem->isComplex();
    f.sample = [n = 2 * problem->size()](const double* x, double* values) { std::copy_n(x, n, values); };
    f.initial = [names = f.components, n = problem->nodes()](std::span<const double> values) {
        return componentValues(names, values, n);
    };
    return f;
}

ErrorMeasure errorOf(const SharedPlane& problem) {
    ErrorMeasure m;
    m.columns = {{"error", "", "‖u - u_ref‖", ""}};
    m.evaluate = [n = problem->size(),
                  cell = problem->grid().measure() / static_cast<double>(problem->nodes())](
                     const double* x, const double* reference, double* values) {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += (x[i] - reference[i]) * (x[i] - reference[i]);
        values[0] = std::sqrt(cell * sum);
    };
    return m;
}

Measure momentumMeasure(const SharedPlane& problem) {
    const bool isLine = problem->grid().dimension() == 1;
    std::vector<Quantity> columns{{"momentum_x", "", "-∫u_t u_x", ""},
                                  {"momentum_y", "", "-∫u_t u_y", ""},
                                  {"translation_momentum_error", "", "change of the momentum", ""}};
    if (isLine) columns.erase(columns.begin() + 1);
    const int last = static_cast<int>(columns.size()) - 1;
    return {"translation-momentum", std::move(columns), last, [problem, isLine](const State& initial) {
                const auto start = problem->momentum(initial.x.data());
                return [problem, start, isLine](double, const double* x, double* values) {
                    const auto is = problem->momentum(x);
                    *values++ = is[0];
                    if (!isLine) *values++ = is[1];
                    *values = std::hypot(is[0] - start[0], is[1] - start[1]);
                };
            }};
}

Measure angularMeasure(const SharedPlane& problem) {
    return {"angular-momentum",
            {{"angular_momentum", "", "-∫u_t (x u_y - y u_x)", ""}},
            -1,
            [problem](const State&) {
                return [problem](double, const double* x, double* values) {
                    values[0] = problem->angularMomentum(x);
                };
            }};
}

/// One column for each pair of components that turn into each other, and the change of all.
Measure chargeMeasure(const SharedPlane& problem) {
    std::vector<Quantity> columns;
    for (const auto& [a, b] : problem->turns()) {
        const std::string &u = problem->name(a), &v = problem->name(b);
        columns.push_back({problem->turns().size() == 1 ? "charge" : "charge." + u + "." + v, "",
                           "∫(" + u + " " + v + "_t - " + v + " " + u + "_t)", ""});
    }
    columns.push_back({"charge_error", "", "change of the charge", ""});
    const int last = static_cast<int>(columns.size()) - 1;
    return {"charge", std::move(columns), last, [problem](const State& initial) {
                return [problem, start = problem->charges(initial.x.data())](double, const double* x,
                                                                             double* values) {
                    double change = 0;
                    const std::vector<double> is = problem->charges(x);
                    for (std::size_t i = 0; i < is.size(); ++i) {
                        *values++ = is[i];
                        change = std::hypot(change, is[i] - start[i]);
                    }
                    *values = change;
                };
            }};
}

std::vector<Measure> measuresOf(const SharedPlane& problem) {
    std::vector<Measure> all{
        momentumMeasure(problem),
        {"spectrum-tail", {{"spectrum_tail", "", "tail", ""}}, -1, [problem](const State&) {
             return [problem](double, const double* x, double* values) { values[0] = problem->tail(x); };
         }}};
    if (problem->grid().dimension() > 1) all.push_back(angularMeasure(problem));
    if (!problem->turns().empty()) all.push_back(chargeMeasure(problem));
    return all;
}

/// What stands beside what: a tenth of the width between two pictures.
constexpr double gap = 1.1;

/// |u| as how strong a colour is: its sign as the hue, of two components that turn into each other their
/// phase; of others a picture each, side by side, one scale for all.
void drawOnRectangle(const PlaneFieldProblem& problem, const double* u, Drawing& drawing) {
    wave::Grid grid = problem.grid();
    const std::size_t n = problem.nodes(), pictures = problem.isComplex() ? 1 : problem.components();
    drawing.tracer = {grid.x.left + grid.x.length / 2, grid.y.left + grid.y.length / 2, 0};
    if (drawing.isTracerOnly) return;
    constexpr double positive = 0.6, negative = 0.07;  // blue and orange, as in plots
    const auto sizeAt = [&](std::size_t c, std::size_t j) {
        return problem.isComplex() ? std::hypot(u[j], u[n + j]) : std::abs(u[c * n + j]);
    };
    double largest = 0;
    for (std::size_t c = 0; c < pictures; ++c)
        for (std::size_t j = 0; j < n; ++j) largest = std::max(largest, sizeAt(c, j));
    const double unit = largest > 0 ? 1 / largest : 0;
    for (std::size_t c = 0; c < pictures; ++c) {
        drawing.shapes.push_back(rasterOf(grid, [&](Raster& r, std::size_t j) {
            r.strengths.push_back(unit * sizeAt(c, j));
            if (problem.isComplex()) {
                // a hue needs no more than single precision
                const float angle = std::atan2(static_cast<float>(u[n + j]), static_cast<float>(u[j]));
                r.hues.push_back(static_cast<double>(angle) / (2 * std::numbers::pi));
            } else {
                r.hues.push_back(u[c * n + j] < 0 ? negative : positive);
            }
        }));
        addFrame(grid, drawing);
        if (pictures > 1)
            drawing.shapes.push_back(Word{
                {grid.x.left + grid.x.length / 2, grid.y.left + 1.08 * grid.y.length, 0}, problem.name(c)});
        grid.x.left += gap * grid.x.length;
    }
}

/// The components over a line, as curtains: the size with the phase as its colour, or one beside the other.
void drawOnLine(const PlaneFieldProblem& problem, const double* u, Drawing& drawing) {
    const wave::Grid& grid = problem.grid();
    const std::size_t n = problem.nodes(), pictures = problem.isComplex() ? 1 : problem.components();
    drawing.tracer = {grid.x.left + grid.x.length / 2, 0, 0};
    if (drawing.isTracerOnly) return;
    const double unit = 0.25 * grid.x.length;
    for (std::size_t c = 0; c < pictures; ++c) {
        const double shift = gap * grid.x.length * static_cast<double>(c);
        const auto place = [&](std::size_t j) {
            return shift + (j < n ? problem.x()[j] : grid.x.left + grid.x.length);
        };
        drawing.shapes.push_back(Segment{{place(0), 0, 0}, {place(n), 0, 0}, 1.2, ShapeRole::scenery});
        if (pictures > 1)
            drawing.shapes.push_back(Word{{(place(0) + place(n)) / 2, -0.1 * unit, 0}, problem.name(c)});
        Curtain curtain;
        for (std::size_t j = 0; j <= n; ++j) {
            const double a = u[c * n + j % n], b = problem.isComplex() ? u[n + j % n] : 0;
            curtain.top.push_back({place(j), unit * (problem.isComplex() ? std::hypot(a, b) : a), 0});
            if (problem.isComplex()) curtain.hues.push_back(std::atan2(b, a) / (2 * std::numbers::pi));
        }
        drawing.shapes.push_back(std::move(curtain));
    }
}

/// Integral of u_t, component by component, where W does not depend on u.
std::vector<MomentumMap> meanMomenta(const SharedPlane& problem) {
    std::vector<MomentumMap> all;
    if (!problem->potential().isZero()) return all;
    for (std::size_t c = 0; c < problem->components(); ++c)
        all.push_back({problem->components() == 1 ? "field" : problem->name(c), "∫" + problem->name(c) + "_t",
                       "", [problem, c](const double* x, const double*) {
                           const double* const v = x + problem->size() + c * problem->nodes();
                           double sum = 0;
                           for (std::size_t i = 0; i < problem->nodes(); ++i) sum += v[i];
                           return sum * problem->grid().measure() / static_cast<double>(problem->nodes());
                       }});
    return all;
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
    s.momenta = meanMomenta(problem);
    s.caution = [problem](const double* x) -> std::string {
        const double tail = problem->tail(x);
        if (!(tail > 1e-3)) return {};
        const wave::Grid& grid = problem->grid();
        return "under-resolved: " + formatNumber(tail, 2) + " of u is in the upper eighth of its " +
               std::to_string(grid.nx) + (grid.dimension() > 1 ? " x " + std::to_string(grid.ny) : "") +
               " modes";
    };
    std::vector<std::string> names;
    for (std::size_t c = 0; c < problem->components(); ++c) names.push_back(problem->name(c));
    s.parts.set(
        NamedStart{planeFieldStartFields(names), [](const Settings&) { return std::vector<Problem>(); }});
    s.start = [problem](const Settings& initial, double t) { return planeFieldStart(*problem, initial, t); };
    // How good it is, is found out entry by entry: of many the time would be a run's.
    constexpr std::size_t most = 512;
    const bool isMovedByModes = problem->potential().isLinear() && problem->size() <= most;
    if (isMovedByModes) s.exact = [problem](const State& initial) { return linearMotion(problem, initial); };
    s.exactFrom = [problem, isMovedByModes](const Settings& initial, const State& start) {
        ExactSolution exact = planeFieldExact(problem, initial);
        return exact || !isMovedByModes ? exact : linearMotion(problem, start);
    };
    s.draw = [problem](const double* values, Drawing& drawing) {
        if (problem->grid().dimension() > 1)
            drawOnRectangle(*problem, values, drawing);
        else
            drawOnLine(*problem, values, drawing);
    };
    return s;
}

}  // namespace extremal
