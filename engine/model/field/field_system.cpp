// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/field/field_system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/model/field/exact_premise.hpp"
#include "engine/model/field/profile.hpp"
#include "engine/model/field/spatial_form.hpp"
#include "engine/model/field/trigonometric_form.hpp"
#include "engine/model/parts/component_values.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {
namespace {

using Shared = std::shared_ptr<const FieldProblem>;

/// The values at their places, so that schemes on any mesh can start from them: a periodic field ends with the
/// value that it begins with.
Value initialAtPlaces(const FieldSampling& f, std::span<const double> values) {
    const std::size_t n = f.x.size();
    Value at = componentValues(f.components, values, n);
    Value::Array x(f.x.begin(), f.x.end());
    if (f.period > 0) x.emplace_back(f.x.front() + f.period);
    Value placed{Value::Object{{"x", std::move(x)}}};
    for (const auto& [name, own] : at.asObject()) {
        Value::Array all = own.asArray();
        if (f.period > 0) all.push_back(all.front());
        placed.set(name, std::move(all));
    }
    return Value(Value::Object{{"values", std::move(placed)}});
}

FieldSampling samplingOf(const Shared& problem) {
    FieldSampling f;
    f.x = problem->nodes.x;
    f.components = {"u", "u_t"};
    f.isGraph = true;
    f.period = problem->mesh.isPeriodic() ? problem->mesh.length() : 0;
    f.sample = [n = 2 * f.x.size()](const double* x, double* values) { std::copy_n(x, n, values); };
    f.isHeld = [problem](std::size_t i) { return problem->isFixed(static_cast<int>(i)); };
    f.initial = [f](std::span<const double> values) { return initialAtPlaces(f, values); };
    return f;
}

/// Of element e at xi, degree + 1 of them.
void functionsAt(const FieldProblem& problem, int e, double xi, double* value) {
    if (problem.functions) {
        value[1] = problem.functions->value(e, xi);
        value[0] = 1 - value[1];
        return;
    }
    double slope[FieldNodes::mostDegree + 1];
    problem.nodes.basis.at(xi, value, slope);
}

/// The L2 norm of u_h - u, by the Gauss rule of 4 nodes on each element.
class FunctionError {
public:
    explicit FunctionError(Shared problem) : problem_(std::move(problem)), rule_(gauss<double>(points)) {
        for (int e = 0; e < problem_->mesh.elements(); ++e)
            for (const double c : rule_.c)
                places_.push_back(problem_->mesh.x[static_cast<std::size_t>(e)] + problem_->mesh.size(e) * c);
    }

    double operator()(double t, const double* x, const ExactSolution& exact) const {
        std::vector<double> u(2 * places_.size());
        exact.atPlaces()(t, places_, u.data());
        const FieldNodes& nodes = problem_->nodes;
        double sum = 0, value[FieldNodes::mostDegree + 1];
        const double* place = u.data();
        for (int e = 0; e < nodes.elements; ++e)
            for (std::size_t q = 0; q < points; ++q) {
                functionsAt(*problem_, e, rule_.c[q], value);
                double difference = -*place++;
                for (int a = 0; a <= nodes.degree; ++a) difference += value[a] * x[nodes.node(e, a)];
                sum += rule_.b[q] * problem_->mesh.size(e) * difference * difference;
            }
        return std::sqrt(sum);
    }

private:
    static constexpr int points = 4;
    Shared problem_;
    Rule<double> rule_;
    std::vector<double> places_;
};

ErrorMeasure errorOf(const Shared& problem) {
    ErrorMeasure m;
    m.columns = fieldErrorColumns();
    m.evaluate = [weights = errorWeights(*problem)](const double* x, const double* reference,
                                                    double* values) {
        double sum = 0;
        for (std::size_t i = 0; i < weights.size(); ++i)
            sum += weights[i] * (x[i] - reference[i]) * (x[i] - reference[i]);
        values[0] = std::sqrt(sum);
    };
    m.ofFunction = [f = FunctionError(problem)](double t, const double* x, const ExactSolution& u) {
        return f(t, x, u);
    };
    return m;
}

/// sum_i m_i v_i = integral of u_t, kept where u -> u + constant is a symmetry.
MomentumMap fieldMomentum(const Shared& problem) {
    return {"field", "∫u_t", "", [problem](const double* x, const double*) {
                const double* v = x + problem->size();
                double sum = 0;
                for (std::size_t i = 0; i < problem->nodes.weight.size(); ++i)
                    sum += problem->nodes.weight[i] * v[i];
                return sum;
            }};
}

Measure translationMeasure(const Shared& problem) {
    return {"translation-momentum", translationColumns(), 1, [problem](const State& initial) {
                const double start = translationMomentum(*problem, initial.x.data());
                return [problem, start](double, const double* x, double* values) {
                    values[0] = translationMomentum(*problem, x);
                    values[1] = values[0] - start;
                };
            }};
}

/// Values at places in ascending order, by the polynomial through the nodes of the element and of its two
/// neighbours: between nodes it is as good as the nodes of elements of degree 3, whose own polynomials are
/// not.
void evaluateAt(const FieldProblem& problem, const double* x, std::span<const double> places,
                double* values) {
    constexpr int most = 3 * FieldNodes::mostDegree + 1;
    const FieldNodes& nodes = problem.nodes;
    const int n = nodes.size(), points = std::min(3 * nodes.degree + 1, n);
    double place[most], weight[most];
    std::size_t index[most];
    int e = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        while (e + 1 < nodes.elements && problem.mesh.x[static_cast<std::size_t>(e) + 1] < places[i]) ++e;
        int first = (e - 1) * nodes.degree;
        if (!nodes.isPeriodic) first = std::clamp(first, 0, n - points);
        for (int j = 0; j < points; ++j) {
            const int node = first + j, turns = node < 0 ? -1 : node / n;
            index[j] = static_cast<std::size_t>(node - turns * n);
            place[j] = nodes.x[index[j]] + turns * problem.mesh.length();
        }
        for (int j = 0; j < points; ++j) {
            weight[j] = 1;
            for (int k = 0; k < points; ++k)
                if (k != j) weight[j] *= (places[i] - place[k]) / (place[j] - place[k]);
        }
        for (const std::size_t part : {std::size_t{0}, std::size_t{1}}) {
            const double* from = x + part * nodes.x.size();
            double sum = 0;
            for (int j = 0; j < points; ++j) sum += weight[j] * from[index[j]];
            values[part * places.size() + i] = sum;
        }
    }
}

/// The Lobatto rule of the nodes; in a medium that elements may not resolve, many more.
Rule<double> energyRule(const FieldProblem& problem) {
    if (problem.coefficient && !problem.functions)
        return makeRule<double>({"gauss", {{"nodes", 2.0}, {"panels", 32.0}}, {}});
    return lobatto<double>(problem.nodes.degree + 1);
}

/// Of values at equal distances around a circle, whatever the functions between them are.
Measure fieldTailMeasure(const Shared& problem) {
    return {"spectrum-tail", {{"spectrum_tail", "", "tail", ""}}, -1, [problem](const State&) {
                return [form = TrigonometricForm(problem)](double, const double* x, double* values) {
                    values[0] = form.tail(x);
                };
            }};
}

/// What differs where the values stand for a trigonometric polynomial.
void useTrigonometricForm(System& s, const Shared& problem) {
    const auto form = std::make_shared<const TrigonometricForm>(problem);
    s.energy = [form](double, const double* x) { return form->energy(x); };
    s.error.ofFunction = [form](double t, const double* x, const ExactSolution& u) {
        return form->distance(t, x, u);
    };
    s.at = [form](const double* x, std::span<const double> places, double* values) {
        form->evaluateAt(x, places, values);
    };
    s.measures.push_back({"translation-momentum", translationColumns(), 1, [form](const State& initial) {
                              const double start = form->momentum(initial.x.data());
                              return [form, start](double, const double* x, double* values) {
                                  values[0] = form->momentum(x);
                                  values[1] = values[0] - start;
                              };
                          }});
    s.start = [problem, given = s.start](const Settings& initial, double t) {
        std::vector<double> x = given(initial, t);
        TrigonometricForm::withoutAlternation(x);
        return x;
    };
}

/// The smallest element: the same at all times.
Measure smallestElementMeasure(const Shared& problem) {
    return {"h-min", {{"h_min", "", "min h", ""}}, -1, [least = problem->mesh.smallest()](const State&) {
                return [least](double, const double*, double* values) { values[0] = least; };
            }};
}

}  // namespace

void drawField(const FieldProblem& problem, std::span<const double> x, double unit, const double* u,
               Drawing& drawing) {
    constexpr std::size_t mostPoints = 1000;
    const double left = problem.mesh.left(), right = left + problem.mesh.length();
    drawing.tracer = {left + problem.mesh.length() / 2, 0, 0};
    if (drawing.isTracerOnly) return;
    drawing.shapes.push_back(Segment{{left, 0, 0}, {right, 0, 0}, 1.2, ShapeRole::scenery});
    Curtain curtain;
    // Of many nodes the extremes of each group, so that no narrow wave is missed.
    const std::size_t group = (x.size() + mostPoints - 1) / mostPoints;
    for (std::size_t first = 0; first < x.size(); first += group) {
        const std::size_t last = std::min(x.size(), first + group);
        const auto [low, high] = std::minmax_element(u + first, u + last);
        const auto add = [&](const double* at) {
            curtain.top.push_back({x[static_cast<std::size_t>(at - u)], unit * *at, 0});
        };
        add(std::min(low, high));
        if (low != high) add(std::max(low, high));
    }
    if (problem.mesh.isPeriodic()) curtain.top.push_back({right, unit * u[0], 0});
    drawing.shapes.push_back(std::move(curtain));
}

std::vector<Quantity> translationColumns() {
    return {{"translation_momentum", "", "-∫u_t u_x", ""},
            {"translation_momentum_error", "", "change of -∫u_t u_x", ""}};
}

std::vector<Quantity> fieldErrorColumns() { return {{"error", "", "‖u - u_ref‖", ""}}; }

std::vector<double> errorWeights(const FieldProblem& problem) {
    const std::vector<double>& x = problem.nodes.x;
    const std::size_t n = x.size();
    if (problem.mesh.isUniform() && problem.nodes.degree == 1)
        return std::vector<double>(n, problem.mesh.length() / problem.mesh.elements());
    std::vector<double> weights(n, 0);
    for (std::size_t i = 0; i + 1 < n; ++i) {
        weights[i] += (x[i + 1] - x[i]) / 2;
        weights[i + 1] += (x[i + 1] - x[i]) / 2;
    }
    if (problem.mesh.isPeriodic()) {
        const double last = problem.mesh.left() + problem.mesh.length() - x.back();
        weights.front() += last / 2;
        weights.back() += last / 2;
    }
    return weights;
}

double translationMomentum(const FieldProblem& problem, const double* x) {
    const FieldNodes& nodes = problem.nodes;
    const int width = nodes.degree + 1;
    const Rule<double> rule = lobatto<double>(width);
    double value[FieldNodes::mostDegree + 1],
        slope[(FieldNodes::mostDegree + 1) * (FieldNodes::mostDegree + 1)];
    for (int q = 0; q < width; ++q)
        nodes.basis.at(rule.c[static_cast<std::size_t>(q)], value, slope + q * width);
    const double* v = x + problem.size();
    double sum = 0;
    for (int e = 0; e < nodes.elements; ++e)
        for (int q = 0; q < width; ++q) {
            double u_x = 0;  // times the size of the element
            for (int a = 0; a < width; ++a) u_x += slope[q * width + a] * x[nodes.node(e, a)];
            sum -= rule.b[static_cast<std::size_t>(q)] * v[nodes.node(e, q)] * u_x;
        }
    return sum;
}

System makeFieldSystem(Shared problem, double amplitude) {
    System s;
    s.parts.set(ScalarField{problem});
    const auto form = std::make_shared<const SpatialForm>(problem, energyRule(*problem));
    s.energy = [form](double, const double* x) {
        return form->kineticEnergy(x + form->size()) + form->energy(x);
    };
    s.parts.set(premiseCheckOf(problem));
    s.blocks.sizes.assign(2, static_cast<std::size_t>(problem->size()));
    s.error = errorOf(problem);
    s.field = samplingOf(problem);
    s.at = [problem](const double* x, std::span<const double> places, double* values) {
        evaluateAt(*problem, x, places, values);
    };
    s.measures = {smallestElementMeasure(problem)};
    if (!problem->coefficient && !problem->isTrigonometric) s.measures.push_back(translationMeasure(problem));
    if (problem->mesh.isPeriodic() && problem->mesh.isUniform() && problem->nodes.degree <= 2)
        s.measures.push_back(fieldTailMeasure(problem));
    if (problem->potential.kind() == FieldPotential::Kind::none &&
        problem->mesh.boundary != Boundary::dirichlet)
        s.momenta = {fieldMomentum(problem)};
    s.start = [problem](const Settings& initial, double t) {
        return fieldState(fieldProfile(initial, *problem, t), *problem, t);
    };
    s.exactFrom = [problem](const Settings& initial, const State& start) -> ExactSolution {
        const FieldProfile profile = fieldProfile(initial, *problem, start.t);
        if (!profile.isExact) return {};
        ExactSolution exact = [problem, profile](double t, std::span<double> x) {
            const std::size_t n = problem->nodes.x.size();
            for (std::size_t i = 0; i < n; ++i) profile.at(problem->nodes.x[i], t, &x[i], &x[n + i]);
        };
        exact.setAtPlaces(atPlacesOf(profile));
        return exact;
    };
    s.givesLevels = [problem](const Settings& initial) { return initial.find("exact") != nullptr; };
    const double unit = 0.25 * problem->mesh.length() / amplitude;
    s.draw = [problem, unit](const double* values, Drawing& drawing) {
        drawField(*problem, problem->nodes.x, unit, values, drawing);
    };
    if (problem->isTrigonometric) useTrigonometricForm(s, problem);
    return s;
}

}  // namespace extremal
