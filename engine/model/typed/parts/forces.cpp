// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/parts/typed_parts.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/parts/part_formulas.hpp"

namespace extremal::typed {
namespace {

struct ForceModel {
    int d = 0;
    Tape value, first, derivatives;  ///< derivatives: those of `entries` alone
    struct Entry {
        int i, j;  ///< force i by q_j, or by v_(j - d)
        std::size_t output;
    };
    std::vector<Entry> entries;
    /// With the Lagrangian: L_q + F and L_v, and their derivatives, 2d x 2d; L_vv, d x d, behind the former.
    Tape gradients, hessians, gradientsAndMasses;
    std::vector<std::size_t> places;  ///< of each output of `hessians`
    std::vector<double> constants;    ///< the entries that have none
};
const ForceModel& forceModel(const void* p) { return *static_cast<const ForceModel*>(p); }

void force(const void* p, double t, const double* q, const double* v, double* f) {
    const ForceModel& m = forceModel(p);
    const Run r(m.value, m.d, t, q, v);
    for (int i = 0; i < m.d; ++i) f[i] = r[placeOf(i)];
}

void firstOfForce(const void* p, double t, const double* q, const double* v, double* f, double* derivatives) {
    const ForceModel& m = forceModel(p);
    const Run r(m.first, m.d, t, q, v);
    for (int i = 0; i < m.d; ++i) f[i] = r[placeOf(i)];
    std::fill_n(derivatives, 2 * m.d * m.d, 0.0);
    for (const ForceModel::Entry& e : m.entries) derivatives[e.i * 2 * m.d + e.j] = r[e.output];
}

void forceAtNodes(const void* p, const double* t, int nodes, const double* q, const double* v, double* f) {
    const ForceModel& m = forceModel(p);
    runNodes(m.value, m.d, t, nodes, q, v, [&](std::size_t k, const Lanes& value, int i) {
        storeEight(value, f + static_cast<int>(k) * nodes + i);
    });
}

void derivativesAtNodes(const void* p, const double* t, int nodes, const double* q, const double* v,
                        double* derivatives) {
    const ForceModel& m = forceModel(p);
    std::fill_n(derivatives, 2 * m.d * m.d * nodes, 0.0);
    runNodes(m.derivatives, m.d, t, nodes, q, v, [&](std::size_t k, const Lanes& value, int i) {
        const ForceModel::Entry& e = m.entries[k];
        storeEight(value, derivatives + (e.i * 2 * m.d + e.j) * nodes + i);
    });
}

void gradientsWithForce(const void* p, const double* t, int nodes, const double* q, const double* v,
                        double* gradients) {
    const ForceModel& m = forceModel(p);
    runNodes(m.gradients, m.d, t, nodes, q, v, [&](std::size_t k, const Lanes& value, int i) {
        storeEight(value, gradients + static_cast<int>(k) * nodes + i);
    });
}

void gradientsAndMassesWithForce(const void* p, const double* t, int nodes, const double* q, const double* v,
                                 double* gradients, double* masses) {
    const ForceModel& m = forceModel(p);
    const int first = 2 * m.d;
    runNodes(m.gradientsAndMasses, m.d, t, nodes, q, v, [&](std::size_t k, const Lanes& value, int i) {
        const int output = static_cast<int>(k);
        storeEight(value,
                   output < first ? gradients + output * nodes + i : masses + (output - first) * nodes + i);
    });
}

void hessiansWithForce(const void* p, const double* t, int nodes, const double* q, const double* v,
                       double* hessians) {
    const ForceModel& m = forceModel(p);
    const auto stride = static_cast<std::size_t>(nodes);
    for (std::size_t entry = 0; entry < m.constants.size(); ++entry)
        std::fill_n(hessians + entry * stride, stride, m.constants[entry]);
    runNodes(m.hessians, m.d, t, nodes, q, v, [&](std::size_t k, const Lanes& value, int i) {
        storeEight(value, hessians + m.places[k] * stride + static_cast<std::size_t>(i));
    });
}

void entriesOfForce(const void* p, double t, const double* q, const double* v, double* f, double* first) {
    const ForceModel& m = forceModel(p);
    const Run r(m.first, m.d, t, q, v);
    for (int i = 0; i < m.d; ++i) f[i] = r[placeOf(i)];
    for (std::size_t e = 0; e < m.entries.size(); ++e) first[e] = r[m.entries[e].output];
}

/// The force on each coordinate as a node of `roots`, with its derivatives.
struct ForceNodes {
    std::vector<int> value;                    ///< by coordinate
    std::vector<std::vector<int>> derivative;  ///< by q_0.., v_0.. of each
};

void addForces(const Settings& settings, const Formula& formula, Roots& roots, ForceNodes& all) {
    const int d = formula.dimension();
    Graph& graph = roots.graph();
    const auto add = [&](int& to, int node, double factor) { to = graph.sum(0, {{to, 1}, {node, factor}}); };
    for (const auto& [name, text] : formulasUnder(settings, "forces")) {
        const std::string pointer = "/forces/" + name;
        const auto found = std::find(formula.coordinates.begin(), formula.coordinates.end(), name);
        if (found == formula.coordinates.end())
            throw InvalidScene(pointer, "there is no coordinate \"" + name + "\" for a force to act on",
                               suggestName(name, formula.coordinates));
        const auto i = placeOf(static_cast<int>(found - formula.coordinates.begin()));
        const OwnFormula own(formula, text.asString());
        const int k = own.dimension();
        const auto symbolic = derivativesOf(own.formula, pointer);
        requireNoRateOfTime(own.formula, pointer);
        std::vector<int> nodes{symbolic->value};
        nodes.insert(nodes.end(), symbolic->gradient.begin(), symbolic->gradient.end());
        const std::vector<int> here = roots.adopt(own, symbolic->graph, nodes);
        add(all.value[i], here[0], 1);
        for (int j = 0; j < k; ++j) {
            const int c = own.coordinates[placeOf(j)];
            add(all.derivative[i][placeOf(c)], here[placeOf(1 + j)], 1);
            add(all.derivative[i][placeOf(d + c)], here[placeOf(1 + k + 1 + j)], 1);
        }
    }
    const Value* const dissipation = settings.find("dissipation");
    if (!dissipation || !dissipation->isString() || dissipation->asString().empty()) return;
    const OwnFormula own(formula, dissipation->asString());
    const int k = own.dimension();
    const auto symbolic = derivativesOf(own.formula, "/dissipation");
    requireNoRateOfTime(own.formula, "/dissipation");
    const auto second = [&](int i, int j) {
        return symbolic->hessian[placeOf(i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i)];
    };
    std::vector<int> nodes;
    for (int i = 0; i < k; ++i) {
        const int v = k + 1 + i;
        nodes.push_back(symbolic->gradient[placeOf(v)]);
        for (int j = 0; j < k; ++j) nodes.push_back(second(v, j));
        for (int j = 0; j < k; ++j) nodes.push_back(second(v, k + 1 + j));
    }
    const std::vector<int> here = roots.adopt(own, symbolic->graph, nodes);
    for (int i = 0, next = 0; i < k; ++i) {
        const auto c = placeOf(own.coordinates[placeOf(i)]);
        add(all.value[c], here[placeOf(next++)], -1);
        for (int j = 0; j < 2 * k; ++j, ++next) {
            const int by = own.coordinates[placeOf(j % k)] + (j < k ? 0 : d);
            add(all.derivative[c][placeOf(by)], here[placeOf(next)], -1);
        }
    }
}

/// The Lagrangian in the graph of the forces, so that what both have is computed once.
void joinLagrangian(const Formula& formula, Roots& roots, const ForceNodes& forces, ForceModel& model) {
    const int d = formula.dimension(), n = 2 * d;
    const auto symbolic = differentiate(formula);
    std::vector<int> nodes = symbolic->gradient;
    nodes.insert(nodes.end(), symbolic->hessian.begin(), symbolic->hessian.end());
    Graph& graph = roots.graph();
    const std::vector<int> here = graph.adopt(
        symbolic->graph, nodes,
        [&](int symbol) -> std::optional<double> {
            const int k = symbol - formula.firstParameter();
            return k < 0 ? std::nullopt : std::optional(formula.parameters[placeOf(k)].second);
        },
        [d](int symbol) { return symbol < d       ? symbol
                                 : symbol < 2 * d ? symbol + 1
                                                  : d; });
    const auto withForce = [&](int i, int node, int force) {
        return i < d ? graph.sum(0, {{node, 1}, {force, 1}}) : node;
    };
    std::vector<int> first, second;
    for (int i = 0; i < n; ++i)
        first.push_back(withForce(i, here[placeOf(i)], i < d ? forces.value[placeOf(i)] : 0));
    model.constants.assign(placeOf(n * n), 0);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const int row = std::max(i, j), column = std::min(i, j);
            const int node = withForce(i, here[placeOf(n + row * (row + 1) / 2 + column)],
                                       i < d ? forces.derivative[placeOf(i)][placeOf(j)] : 0);
            if (graph.isNumber(node)) {
                model.constants[placeOf(i * n + j)] = graph.at(node).number;
                continue;
            }
            model.places.push_back(placeOf(i * n + j));
            second.push_back(node);
        }
    model.gradients = roots.tape(first);
    for (int i = d; i < n; ++i)
        for (int j = d; j < n; ++j) {
            const int row = std::max(i, j), column = std::min(i, j);
            first.push_back(here[placeOf(n + row * (row + 1) / 2 + column)]);
        }
    model.gradientsAndMasses = roots.tape(first);
    model.hessians = roots.tape(second);
}

bool hasForces(const Settings& settings) {
    const Value* const dissipation = settings.find("dissipation");
    return !formulasUnder(settings, "forces").empty() ||
           (dissipation && dissipation->isString() && !dissipation->asString().empty());
}

/// Times of the tables with straight lines among the controls that a force uses.
std::vector<double> kinksOf(const Settings& settings, const Formula& formula) {
    std::string texts;
    for (const auto& [name, text] : formulasUnder(settings, "forces")) texts += text.asString() + " ";
    if (const Value* const D = settings.find("dissipation"); D && D->isString()) texts += D->asString();
    std::vector<double> kinks;
    for (const auto& [name, control] : formula.controls) {
        if (!occurs(name, texts)) continue;
        for (const Expression::Node& node : control.nodes)
            if (node.table && node.table->kind() == Interpolant::Kind::linear)
                kinks.insert(kinks.end(), node.table->abscissae().begin(), node.table->abscissae().end());
    }
    std::sort(kinks.begin(), kinks.end());
    kinks.erase(std::unique(kinks.begin(), kinks.end()), kinks.end());
    return kinks;
}

bool hasForceOn(const Settings& settings, const std::string& coordinate) {
    const Value::Object& forces = formulasUnder(settings, "forces");
    return std::any_of(forces.begin(), forces.end(),
                       [&](const auto& each) { return each.first == coordinate; });
}

/// The functions of velocities in some formulas at whose roots their values may jump.
std::vector<int> switchesOf(Graph& graph, int d) {
    std::vector<int> switches;
    for (int node = 0, end = graph.size(); node < end; ++node) {
        const Graph::Node at = graph.at(node);
        if (at.kind != Graph::Kind::call || at.operands.empty()) continue;
        const bool isCompared = at.function == Function::less || at.function == Function::lessOrEqual,
                   isSwitch = isCompared || at.function == Function::sign || at.function == Function::abs ||
                              at.function == Function::heaviside;
        if (!isSwitch) continue;
        const int first = at.operands[0].node;
        const int argument = isCompared ? graph.sum(0, {{first, 1}, {at.operands[1].node, -1}}) : first;
        if (graph.dependsOn({argument}, [d](int symbol) { return symbol > d; })) switches.push_back(argument);
    }
    return switches;
}

/// A force at some places and times, along lines of velocities.
class ForceAlongVelocities {
public:
    explicit ForceAlongVelocities(const ForceModel& model) : model_(model), d_(placeOf(model.d)) {
        std::mt19937 random(1785);
        const auto any = [&] { return 0.2 + static_cast<double>(random()) / 4294967296.0; };
        for (std::vector<double>* all : {&q_, &usual_, &v_, &before_, &after_}) all->resize(d_);
        for (double& x : q_) x = any();
        for (double& x : usual_) x = any();
        sizes_.assign(d_, 0);
        for (const double sign : {1.0, -1.0}) {
            const std::vector<double>& f = at(-1, sign, before_);
            for (std::size_t i = 0; i < d_; ++i) sizes_[i] = std::max(sizes_[i], std::abs(f[i]));
        }
    }

    /// With the velocity k at x, or for k < 0 all of them x times what they are.
    const std::vector<double>& at(int k, double x, std::vector<double>& f) {
        place(k, x);
        force(&model_, time, q_.data(), v_.data(), f.data());
        return f;
    }
    double ofTape(const Tape& tape, std::size_t output, int k, double x) {
        place(k, x);
        return Run(tape, model_.d, time, q_.data(), v_.data())[output];
    }
    /// The coordinate whose force jumps at x; -1: there is none.
    int jumpAt(int k, double x) {
        constexpr double beside = 1e-12, large = 1e-3;
        const double shift = beside * std::max(1.0, std::abs(x));
        at(k, x - shift, before_);
        at(k, x + shift, after_);
        for (std::size_t i = 0; i < d_; ++i)
            if (std::abs(after_[i] - before_[i]) > large * sizes_[i]) return static_cast<int>(i);
        return -1;
    }

private:
    static constexpr double time = 0.3;
    void place(int k, double x) {
        v_ = usual_;
        if (k >= 0)
            v_[placeOf(k)] = x;
        else
            for (double& v : v_) v *= x;
    }

    const ForceModel& model_;
    std::size_t d_;
    std::vector<double> q_, usual_, v_, before_, after_, sizes_;
};

/// Throws where a force jumps as a velocity passes a value, at which motion sticks: where it is 0, or all of
/// them are, and where something that is linear in it, as the speed on a belt, changes its sign.
void refuseDryFriction(const Settings& settings, const Formula& formula, Roots& roots,
                       const ForceModel& model) {
    constexpr int most = 64;
    const int d = formula.dimension();
    if (d > most) return;
    const std::vector<int> switches = switchesOf(roots.graph(), d);
    const Tape tape = roots.tape(switches);
    ForceAlongVelocities along(model);
    for (int line = 0; line <= d; ++line) {
        const int k = line < d ? line : -1;
        std::vector<double> places{0};
        for (std::size_t s = 0; s < switches.size(); ++s) {
            const double first = along.ofTape(tape, s, k, 0), slope = along.ofTape(tape, s, k, 1) - first;
            if (slope != 0 && std::isfinite(first / slope)) places.push_back(-first / slope);
        }
        for (const double place : places) {
            const int i = along.jumpAt(k, place);
            if (i < 0) continue;
            const std::string& name = formula.coordinates[placeOf(i)];
            const std::string where = k < 0 ? "the velocities are 0"
                                            : formula.coordinates[placeOf(k)] + "_t passes " +
                                                  formatNumber(std::abs(place) < 1e-12 ? 0 : place, 3);
            throw InvalidScene(hasForceOn(settings, name) ? "/forces/" + name : "/dissipation",
                               "jumps where " + where +
                                   ": forces that jump with a velocity, as dry friction does, whose bodies "
                                   "stick and slip, are not modelled",
                               "smoothed, tanh(v/eps) in place of the sign of v: it creeps at a rate of eps "
                               "in place of sticking, and wants steps below eps m / F");
        }
    }
}

}  // namespace

std::optional<Force> forceOf(const Settings& settings, const Formula& formula,
                             const Mechanics<double>& mechanics) {
    if (!hasForces(settings)) return {};
    const int d = formula.dimension();
    const Formula names = withTime(formula, "");
    Roots roots(names);
    const int zero = roots.graph().number(0);
    ForceNodes nodes{std::vector<int>(placeOf(d), zero),
                     std::vector<std::vector<int>>(placeOf(d), std::vector<int>(placeOf(2 * d), zero))};
    addForces(settings, formula, roots, nodes);
    auto model = std::make_shared<ForceModel>();
    model->d = d;
    std::vector<int> all = nodes.value;
    for (int i = 0; i < d; ++i)
        for (int j = 0; j < 2 * d; ++j) {
            const int node = nodes.derivative[placeOf(i)][placeOf(j)];
            if (roots.graph().isZero(node)) continue;
            model->entries.push_back({i, j, all.size()});
            all.push_back(node);
        }
    model->value = roots.tape(nodes.value);
    model->first = roots.tape(all);
    model->derivatives = roots.tape({all.begin() + d, all.end()});
    Force made;
    made.isTimeDependent = roots.graph().dependsOn(nodes.value, [d](int symbol) { return symbol == d; });
    made.kinks = kinksOf(settings, formula);
    refuseDryFriction(settings, formula, roots, *model);
    if (mechanics.gradients && mechanics.hessians) {
        joinLagrangian(formula, roots, nodes, *model);
        made.withLagrangian = std::make_shared<Force::WithLagrangian>(
            Force::WithLagrangian{mechanics.model.get(), ForThisMachine<&gradientsWithForce>::call(),
                                  ForThisMachine<&hessiansWithForce>::call(),
                                  ForThisMachine<&gradientsAndMassesWithForce>::call()});
    }
    auto entries = std::make_shared<Force::Entries>();
    for (const ForceModel::Entry& e : model->entries) entries->first.push_back({e.i, e.j});
    entries->values = entriesOfForce;
    made.entries = std::move(entries);
    made.model = std::move(model);
    made.value = force;
    made.first = firstOfForce;
    made.values = ForThisMachine<&forceAtNodes>::call();
    made.derivatives = ForThisMachine<&derivativesAtNodes>::call();
    return made;
}

}  // namespace extremal::typed
