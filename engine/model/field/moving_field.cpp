// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/field/moving_field.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/model/field/exact_premise.hpp"
#include "engine/model/field/field_system.hpp"
#include "engine/model/field/moving_element.hpp"
#include "engine/model/field/profile.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {
namespace {

using SharedProblem = std::shared_ptr<const FieldProblem>;

std::size_t nodesOf(const SharedProblem& problem) { return static_cast<std::size_t>(problem->size()); }

FieldSampling movingSampling(const SharedProblem& problem) {
    FieldSampling f;
    f.x = problem->nodes.x;
    f.components = {"u", "u_t"};
    f.isGraph = true;
    f.hasMovingNodes = true;
    f.further = f.x.size();
    f.sample = [problem](const double* x, double* values) {
        const MovingNodes nodes(nodesOf(problem), x);
        const std::size_t n = nodes.n;
        std::copy_n(nodes.y, n, values);
        std::copy_n(nodes.X, n, values + 2 * n);
        std::vector<double> lengths(n, 0);
        double* u_t = values + n;
        std::fill_n(u_t, n, 0.0);
        for (std::size_t e = 0; e + 1 < n; ++e) {
            u_t[e] += nodes.size(e) * nodes.leftRate(e);
            u_t[e + 1] += nodes.size(e) * nodes.rightRate(e);
            lengths[e] += nodes.size(e);
            lengths[e + 1] += nodes.size(e);
        }
        for (std::size_t i = 0; i < n; ++i)
            u_t[i] = problem->isFixed(static_cast<int>(i)) ? 0 : u_t[i] / lengths[i];
    };
    return f;
}

EnergyFunction movingEnergy(const SharedProblem& problem) {
    return [problem, moments = PotentialMomentsOf(problem->potential, nodesOf(problem) - 1)](
               double, const double* x) mutable {
        const MovingNodes nodes(nodesOf(problem), x);
        moments.evaluate(nodes.y, false);
        double energy = 0;
        for (std::size_t e = 0; e + 1 < nodes.n; ++e) {
            const double z[4] = {nodes.y[e], nodes.X[e], nodes.y[e + 1], nodes.X[e + 1]},
                         v[4] = {nodes.yRate[e], nodes.XRate[e], nodes.yRate[e + 1], nodes.XRate[e + 1]};
            const ElementEnergy own = elementEnergy(z, v, problem->elastic.k, moments[e].W);
            energy += own.kinetic + own.potential;
        }
        return energy;
    };
}

double squareAt(const ExactSolution& exact, double t, double place, double value) {
    double u[2];
    exact.atPlaces()(t, {&place, 1}, u);
    return (value - u[0]) * (value - u[0]);
}

/// Half of the two neighbouring elements at every node.
double movingError(const MovingNodes& nodes, double t, const ExactSolution& exact) {
    double sum = 0, left = squareAt(exact, t, nodes.X[0], nodes.y[0]);
    for (std::size_t e = 0; e + 1 < nodes.n; ++e) {
        const double right = squareAt(exact, t, nodes.X[e + 1], nodes.y[e + 1]);
        sum += nodes.size(e) / 2 * (left + right);
        left = right;
    }
    return std::sqrt(sum);
}

/// Of the function, by four Gauss points in each element.
double movingFunctionError(const MovingNodes& nodes, double t, const ExactSolution& exact) {
    static const Rule<double> rule = gauss<double>(4);
    double sum = 0;
    for (std::size_t e = 0; e + 1 < nodes.n; ++e) {
        const double h = nodes.size(e);
        for (std::size_t q = 0; q < rule.c.size(); ++q) {
            const double xi = rule.c[q];
            sum += h * rule.b[q] *
                   squareAt(exact, t, nodes.X[e] + xi * h, (1 - xi) * nodes.y[e] + xi * nodes.y[e + 1]);
        }
    }
    return std::sqrt(sum);
}

/// -integral of u_t u_x.
double movingTranslation(const MovingNodes& nodes) {
    double sum = 0;
    for (std::size_t e = 0; e + 1 < nodes.n; ++e)
        sum -= (nodes.y[e + 1] - nodes.y[e]) * (nodes.leftRate(e) + nodes.rightRate(e)) / 2;
    return sum;
}

std::vector<Measure> movingMeasures(const SharedProblem& problem) {
    const std::size_t n = nodesOf(problem);
    return {{"translation-momentum", translationColumns(), 1,
             [n](const State& initial) {
                 const double start = movingTranslation({n, initial.x.data()});
                 return [n, start](double, const double* x, double* values) {
                     values[0] = movingTranslation({n, x});
                     values[1] = values[0] - start;
                 };
             }},
            {"h-min", {{"h_min", "", "min h", ""}}, -1, [n](const State&) {
                 return [n](double, const double* x, double* values) {
                     const MovingNodes nodes(n, x);
                     values[0] = nodes.size(0);
                     for (std::size_t e = 1; e + 1 < n; ++e) values[0] = std::min(values[0], nodes.size(e));
                 };
             }}};
}

/// Integral of u_t.
MomentumMap movingMomentum(const SharedProblem& problem) {
    return {"field", "∫u_t", "", [n = nodesOf(problem)](const double* x, const double*) {
                const MovingNodes nodes(n, x);
                double sum = 0;
                for (std::size_t e = 0; e + 1 < n; ++e)
                    sum += nodes.size(e) * (nodes.leftRate(e) + nodes.rightRate(e)) / 2;
                return sum;
            }};
}

}  // namespace

System makeMovingField(SharedProblem problem, double amplitude) {
    System s;
    s.parts.set(ScalarField{problem});
    s.parts.set(premiseCheckOf(problem));
    s.energy = movingEnergy(problem);
    s.error.columns = fieldErrorColumns();
    s.error.evaluate = [](const double*, const double*, double* values) {
        values[0] = std::nan("");  // nodes of two solutions are not at the same places
    };
    s.error.evaluateField = [n = nodesOf(problem)](double t, const double* x, const ExactSolution& exact,
                                                   double* values) {
        values[0] = movingError({n, x}, t, exact);
    };
    s.error.ofFunction = [n = nodesOf(problem)](double t, const double* x, const ExactSolution& exact) {
        return movingFunctionError({n, x}, t, exact);
    };
    s.field = movingSampling(problem);
    s.measures = movingMeasures(problem);
    if (problem->potential.kind() == FieldPotential::Kind::none &&
        problem->mesh.boundary != Boundary::dirichlet)
        s.momenta = {movingMomentum(problem)};
    s.start = [problem](const Settings& initial, double t) {
        const FieldProfile profile = fieldProfile(initial, *problem, t);
        std::vector<double> x = fieldState(profile, *problem, t);
        x.insert(x.end(), problem->nodes.x.begin(), problem->nodes.x.end());
        x.resize(4 * nodesOf(problem), 0);
        return x;
    };
    s.exactFrom = [problem](const Settings& initial, const State& start) -> ExactSolution {
        const FieldProfile profile = fieldProfile(initial, *problem, start.t);
        if (!profile.isExact) return {};
        ExactSolution exact = [](double, std::span<double> x) {
            std::fill(x.begin(), x.end(), std::nan(""));  // known at every place, not at its nodes
        };
        exact.setAtPlaces(atPlacesOf(profile));
        return exact;
    };
    const double unit = 0.25 * problem->mesh.length() / amplitude;
    s.draw = [problem, unit](const double* values, Drawing& drawing) {
        const std::size_t n = nodesOf(problem);
        drawField(*problem, {values + 2 * n, n}, unit, values, drawing);
    };
    return s;
}

}  // namespace extremal
