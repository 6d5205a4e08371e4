// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/density/density_system.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/density/cell_sum.hpp"
#include "engine/model/density/places.hpp"
#include "engine/model/density/start.hpp"
#include "engine/model/field/field_system.hpp"
#include "engine/model/parts/component_values.hpp"
#include "engine/model/parts/named_start.hpp"
#include "engine/model/parts/refused_because.hpp"
#include "engine/model/plane_picture.hpp"

namespace extremal {
namespace {

using SharedDensity = std::shared_ptr<const DensityProblem>;

/// The mean of the values of a component around each node; of one whose values are at nodes, these.
void sampleAtNodes(const DensityProblem& problem, FieldPlace place, const double* u, double* values) {
    const int nx = problem.nodesX(), ny = problem.nodesY();
    const int backX = isConstantAlong(place, 0) ? 1 : 0, backY = isConstantAlong(place, 1) ? 1 : 0;
    const auto at = [&](int i, int j) { return u[(i + nx) % nx + (j + ny) % ny * nx]; };
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
            *values++ = (at(i, j) + at(i - backX, j) + at(i, j - backY) + at(i - backX, j - backY)) / 4;
}

/// b_x - a_y of a on the edges along x and b on those along y, in each cell: the magnetic field where (a, b)
/// is the potential.
std::vector<double> curlOf(const DensityProblem& problem, const EdgePair& pair, const double* u) {
    const int nx = problem.nodesX(), ny = problem.nodesY();
    const double *const a = u + pair.alongX * problem.nodes(), *const b = u + pair.alongY * problem.nodes();
    std::vector<double> curl(problem.nodes());
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const int here = i + j * nx, right = (i + 1) % nx + j * nx, above = i + (j + 1) % ny * nx;
            curl[static_cast<std::size_t>(here)] =
                (b[right] - b[here]) / problem.dx() - (a[above] - a[here]) / problem.dy();
        }
    return curl;
}

/// u and u_t of every component at the nodes; of a pair on edges its curl besides.
FieldSampling densitySampling(const SharedDensity& problem) {
    FieldSampling f;
    f.x = problem->x();
    f.along = {problem->along.left, problem->along.length};
    if (problem->isPlane()) {
        f.y = problem->y();
        f.across = {problem->across.left, problem->across.length};
    } else if (problem->isPeriodic()) {
        f.period = problem->along.length;
    }
    f.isGraph = !problem->isPlane() && problem->components() == 1;
    for (const char* suffix : {"", "_t"})
        for (const std::string& name : problem->names) f.components.push_back(name + suffix);
    if (edgePairOf(*problem)) f.components.emplace_back("curl");
    if (problem->isNodal()) {
        f.sample = [n = 2 * problem->size()](const double* x, double* values) { std::copy_n(x, n, values); };
        f.isHeld = [problem](std::size_t i) { return problem->isFixed(i); };
        f.initial = [names = f.components, n = problem->nodes()](std::span<const double> values) {
            return componentValues(names, values, n);
        };
        return f;
    }
    f.sample = [problem, pair = edgePairOf(*problem)](const double* x, double* values) {
        for (std::size_t c = 0; c < 2 * problem->components(); ++c)
            sampleAtNodes(*problem, problem->place(c % problem->components()), x + c * problem->nodes(),
                          values + c * problem->nodes());
        if (pair)
            sampleAtNodes(*problem, FieldPlace::cells, curlOf(*problem, *pair, x).data(),
                          values + 2 * problem->size());
    };
    return f;
}

/// The L2 norm of u over the nodes; as of other fields, the cell of every node is a whole one.
ErrorMeasure densityError(const SharedDensity& problem) {
    ErrorMeasure m;
    m.columns = fieldErrorColumns();
    m.evaluate = [n = problem->size(), cell = problem->dx() * problem->dy()](
                     const double* x, const double* reference, double* values) {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += (x[i] - reference[i]) * (x[i] - reference[i]);
        values[0] = std::sqrt(cell * sum);
    };
    return m;
}

Measure densityTranslation(const SharedDensity& problem, const std::shared_ptr<const CellSum>& sum) {
    const bool isPlane = problem->isPlane();
    std::vector<Quantity> columns = translationColumns();
    if (isPlane)
        columns = {{"momentum_x", "", "-∫∂L/∂u_t u_x", ""},
                   {"momentum_y", "", "-∫∂L/∂u_t u_y", ""},
                   {"translation_momentum_error", "", "change of the momentum", ""}};
    else
        columns[0].symbol = "-∫∂L/∂u_t u_x";
    const int last = static_cast<int>(columns.size()) - 1;
    return {"translation-momentum", std::move(columns), last, [problem, sum, isPlane](const State& initial) {
                const auto at = [problem, sum](double t, const double* x, int direction) {
                    return sum->momentum(t, x, x + problem->size(), direction);
                };
                const double X = at(initial.t, initial.x.data(), 0),
                             Y = isPlane ? at(initial.t, initial.x.data(), 1) : 0;
                return [at, X, Y, isPlane](double t, const double* x, double* values) {
                    const double now = at(t, x, 0), across = isPlane ? at(t, x, 1) : 0;
                    *values++ = now;
                    if (isPlane) *values++ = across;
                    *values = isPlane ? std::hypot(now - X, across - Y) : now - X;
                };
            }};
}

/// Of components that L does not depend on, where nothing holds the ends: sum of dL_h/du_t.
std::vector<MomentumMap> densityMomenta(const SharedDensity& problem,
                                        const std::shared_ptr<const CellSum>& sum) {
    std::vector<MomentumMap> all;
    if (problem->boundary == Boundary::dirichlet || problem->density.isMomentumTimeDependent()) return all;
    for (std::size_t c = 0; c < problem->components(); ++c) {
        if (!problem->density.isCyclic(static_cast<int>(c))) continue;
        const std::string& name = problem->names[c];
        all.push_back({problem->components() == 1 ? "field" : name, "∫∂L/∂" + name + "_t", "",
                       [problem, sum, c](const double* x, const double*) {
                           std::vector<double> p(problem->size(), 0);
                           sum->addGradient(0, x, x + problem->size(), CellSum::By::second, p.data());
                           double total = 0;
                           for (std::size_t i = 0; i < problem->nodes(); ++i)
                               total += p[c * problem->nodes() + i];
                           return total;
                       }});
    }
    return all;
}

/// Of a pair on edges, by the masses at the edges (the trapezoidal rule): the divergence of dL/du_t at the
/// nodes, which is the charge that the gauge symmetry (a, b) -> (a + f_x, b + f_y) conserves at each of them.
Measure densityDivergence(const SharedDensity& problem, const EdgePair& pair) {
    std::vector<Quantity> columns = {{"div_e", "", "largest |div ∂L/∂u_t|", ""},
                                     {"div_e_error", "", "largest change of div ∂L/∂u_t", ""}};
    const auto sum = std::make_shared<const CellSum>(CellSum::ofInstant(problem, trapezoid<double>(1)));
    const auto divergence = [problem, pair, sum](double t, const double* x) {
        const int nx = problem->nodesX(), ny = problem->nodesY();
        std::vector<double> p(problem->size(), 0.0), all(problem->nodes());
        sum->addGradient(t, x, x + problem->size(), CellSum::By::second, p.data());
        const double *const a = p.data() + pair.alongX * problem->nodes(), *const b =
                                                                               p.data() +
                                                                               pair.alongY * problem->nodes();
        const double cell = problem->dx() * problem->dy();
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) {
                const int here = i + j * nx, left = (i + nx - 1) % nx + j * nx,
                          below = i + (j + ny - 1) % ny * nx;
                all[static_cast<std::size_t>(here)] =
                    ((a[here] - a[left]) / problem->dx() + (b[here] - b[below]) / problem->dy()) / cell;
            }
        return all;
    };
    return {"div-e", std::move(columns), 1, [divergence](const State& initial) {
                return [divergence, before = divergence(initial.t, initial.x.data())](
                           double t, const double* x, double* values) {
                    const std::vector<double> now = divergence(t, x);
                    values[0] = values[1] = 0;
                    for (std::size_t i = 0; i < now.size(); ++i) {
                        values[0] = std::max(values[0], std::abs(now[i]));
                        values[1] = std::max(values[1], std::abs(now[i] - before[i]));
                    }
                };
            }};
}

/// What stands beside what: a tenth of the width between two pictures.
constexpr double gapBeside = 1.1;

void drawDensityOnLine(const DensityProblem& problem, const double* u, Drawing& drawing) {
    const std::vector<double> x = problem.x();
    const double length = problem.along.length, unit = 0.25 * length;
    drawing.tracer = {problem.along.left + length / 2, 0, 0};
    if (drawing.isTracerOnly) return;
    for (std::size_t c = 0; c < problem.components(); ++c) {
        const double shift = gapBeside * length * static_cast<double>(c), left = problem.along.left + shift;
        drawing.shapes.push_back(Segment{{left, 0, 0}, {left + length, 0, 0}, 1.2, ShapeRole::scenery});
        if (problem.components() > 1)
            drawing.shapes.push_back(Word{{left + length / 2, -0.1 * unit, 0}, problem.names[c]});
        Curtain curtain;
        for (std::size_t j = 0; j < x.size(); ++j)
            curtain.top.push_back({shift + x[j], unit * u[c * x.size() + j], 0});
        if (problem.isPeriodic()) curtain.top.push_back({left + length, unit * u[c * x.size()], 0});
        drawing.shapes.push_back(std::move(curtain));
    }
}

/// |u| as how strong a colour is, its sign as the hue; a picture for each component, one scale for all, and
/// one of the curl of a pair on edges with a scale of its own.
void drawDensityOnRectangle(const DensityProblem& problem, const double* sample, Drawing& drawing) {
    wave::Grid grid{problem.along, problem.nodesX(), problem.across, problem.nodesY()};
    drawing.tracer = {grid.x.left + grid.x.length / 2, grid.y.left + grid.y.length / 2, 0};
    if (drawing.isTracerOnly) return;
    const auto unitOf = [](const double* values, std::size_t count) {
        double largest = 0;
        for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, std::abs(values[i]));
        return largest > 0 ? 1 / largest : 0;
    };
    const auto draw = [&](const double* values, double unit, const std::string& name) {
        constexpr double positive = 0.6, negative = 0.07;  // blue and orange, as in plots
        drawing.shapes.push_back(rasterOf(grid, [&](Raster& r, std::size_t j) {
            r.strengths.push_back(unit * std::abs(values[j]));
            r.hues.push_back(values[j] < 0 ? negative : positive);
        }));
        addFrame(grid, drawing);
        if (problem.components() > 1)
            drawing.shapes.push_back(
                Word{{grid.x.left + grid.x.length / 2, grid.y.left + 1.08 * grid.y.length, 0}, name});
        grid.x.left += gapBeside * grid.x.length;
    };
    const double unit = unitOf(sample, problem.size());
    for (std::size_t c = 0; c < problem.components(); ++c)
        draw(sample + c * problem.nodes(), unit, problem.names[c]);
    if (!edgePairOf(problem)) return;
    const double* const curl = sample + 2 * problem.size();
    draw(curl, unitOf(curl, problem.nodes()), "curl");
}

}  // namespace

System makeDensitySystem(SharedDensity problem) {
    System s;
    s.parts.set(DensityField{problem});
    s.parts.set(RefusedBecause{
        problem->density.usual()
            ? "its components are not periodic, and implicit cells and leapfrog alone have such"
            : "its Lagrangian density is not u_t²/2 - c² |grad u|²/2 - W(u): " + problem->density.unusual()});
    const auto sum = std::make_shared<const CellSum>(CellSum::ofInstant(problem, gauss<double>(2)));
    s.energy = [problem, sum](double t, const double* x) { return sum->energy(t, x, x + problem->size()); };
    s.blocks.sizes.assign(2, problem->size());
    s.error = densityError(problem);
    s.field = densitySampling(problem);
    if (problem->isPeriodic() && problem->isNodal()) s.measures.push_back(densityTranslation(problem, sum));
    if (const auto pair = edgePairOf(*problem)) s.measures.push_back(densityDivergence(problem, *pair));
    s.momenta = densityMomenta(problem, sum);
    s.parts.set(
        NamedStart{densityStartFields(*problem), [](const Settings&) { return std::vector<Problem>(); }});
    s.parts.set(densityPremise(problem));
    s.start = [problem](const Settings& initial, double t) { return densityStart(*problem, initial, t); };
    s.exactFrom = [problem](const Settings& initial, const State&) { return densityExact(problem, initial); };
    s.draw = [problem](const double* values, Drawing& drawing) {
        if (problem->isPlane())
            drawDensityOnRectangle(*problem, values, drawing);
        else
            drawDensityOnLine(*problem, values, drawing);
    };
    return s;
}

void refuseKeysBesideDensity(const Settings& model) {
    const auto refuse = [&](const char* key, const Value& usual) {
        const Value* const given = model.find(key);
        if (!given || given->isNull() || *given == usual) return;
        throw InvalidScene(std::string("/") + key,
                           std::string("stands beside lagrangian, which says ") +
                               (std::string(key) == "potential" ? "W" : "it") + " already",
                           "a term of the lagrangian, with a number of /parameters");
    };
    refuse("potential", Value("none"));
    refuse("wave_speed", Value(1.0));
    refuse("wave_speeds", Value());
    refuse("mass", Value(1.0));
    refuse("a", Value("1"));
}

void checkDensityStart(const DensityProblem& problem, const State& initial) {
    const FieldDensity& density = problem.density;
    const auto m = static_cast<std::size_t>(density.components());
    const int nx = problem.nodesX(), ny = problem.nodesY();
    std::vector<double> at(static_cast<std::size_t>(density.inputs())), slope(at.size()),
        second(at.size() * (at.size() + 1) / 2);
    const auto fail = [&](int i, const std::string& what, const char* remedy) {
        throw InvalidScene("/lagrangian",
                           what + " at the start, at x = " + formatNumber(problem.placeX(i), 6), remedy);
    };
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const auto node = [&](int a, int b) {
                return static_cast<std::size_t>((a + nx) % nx + (b + ny) % ny * nx);
            };
            const bool hasLeft = problem.isPeriodic() || i > 0, hasRight = problem.isPeriodic() || i + 1 < nx;
            for (std::size_t c = 0; c < m; ++c) {
                const double* const u = initial.x.data() + c * problem.nodes();
                at[c] = u[node(i, j)];
                at[m + c] = u[problem.size() + node(i, j)];
                at[2 * m + c] = (u[node(hasRight ? i + 1 : i, j)] - u[node(hasLeft ? i - 1 : i, j)]) /
                                ((hasRight + hasLeft) * problem.dx());
                if (problem.isPlane())
                    at[3 * m + c] = (u[node(i, j + 1)] - u[node(i, j - 1)]) / (2 * problem.dy());
            }
            auto last = static_cast<std::size_t>(density.arguments());
            at[last++] = problem.placeX(i);
            if (problem.isPlane()) at[last++] = problem.placeY(j);
            at[last] = initial.t;
            const double L = density.jet(at.data(), slope.data(), second.data());
            Eigen::MatrixXd mass(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(m));
            for (std::size_t c = 0; c < m; ++c)
                for (std::size_t d = 0; d <= c; ++d)
                    mass(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(d)) =
                        mass(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(c)) =
                            second[(m + c) * (m + c + 1) / 2 + m + d];
            if (!std::isfinite(L) || !mass.allFinite())
                fail(i, "is not finite", "initial data for which the density is defined");
            if (!mass.fullPivLu().isInvertible())
                fail(i,
                     "does not determine the velocity by its momentum (the second derivatives by the "
                     "velocities are singular)",
                     "a kinetic term such as u_t^2/2 for each component");
        }
}

}  // namespace extremal
