// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/parts/typed_parts.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/parts/part_formulas.hpp"

namespace extremal::typed {
namespace {

struct ForceModel {
    int d = 0;
    Tape value, first;
    struct Entry {
        int i, j;  ///< force i by q_j, or by v_(j - d)
        std::size_t output;
    };
    std::vector<Entry> entries;
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

}  // namespace

std::optional<Force> forceOf(const Settings& settings, const Formula& formula) {
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
    Force made;
    made.isTimeDependent = roots.graph().dependsOn(nodes.value, [d](int symbol) { return symbol == d; });
    made.kinks = kinksOf(settings, formula);
    auto entries = std::make_shared<Force::Entries>();
    for (const ForceModel::Entry& e : model->entries) entries->first.push_back({e.i, e.j});
    entries->values = entriesOfForce;
    made.entries = std::move(entries);
    made.model = std::move(model);
    made.value = force;
    made.first = firstOfForce;
    return made;
}

}  // namespace extremal::typed
