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

struct RollingModel {
    int d = 0, count = 0;
    Tape first, second;
    struct Entry {
        int condition, i, j;  ///< of d a_i / d q_j
        std::size_t output;
    };
    std::vector<Entry> entries;
};
const RollingModel& rollingModel(const void* p) { return *static_cast<const RollingModel*>(p); }

void firstOfRolling(const void* p, double t, const double* q, const double* v, double* r, double* byState,
                    double* byTime) {
    const RollingModel& m = rollingModel(p);
    const Run run(m.first, m.d, t, q, v);
    std::size_t next = 0;
    for (int k = 0; k < m.count; ++k) {
        r[k] = run[next++];
        for (int i = 0; i < 2 * m.d; ++i) byState[k * 2 * m.d + i] = run[next++];
        byTime[k] = run[next++];
    }
}

void addCurvatureOfRolling(const void* p, double t, const double* q, const double* mu, double* matrix) {
    const RollingModel& m = rollingModel(p);
    const Run run(m.second, m.d, t, q, nullptr);
    for (const RollingModel::Entry& e : m.entries) matrix[e.i * m.d + e.j] += mu[e.condition] * run[e.output];
}

bool hasVelocity(const Formula& own) {
    const ResolvedFormula resolved = resolve(own);
    const int d = own.dimension();
    return std::any_of(resolved.symbol.begin(), resolved.symbol.end(),
                       [d](int symbol) { return symbol >= d && symbol < 2 * d; });
}

/// Whether bodies at rest violate a condition at some place and time.
bool isDriven(const RollingModel& model) {
    const auto d = placeOf(model.d), n = placeOf(model.count);
    std::vector<double> q(d), v(d), r(n), byState(2 * n * d), byTime(n);
    for (int trial = 1; trial <= 4; ++trial) {
        for (std::size_t k = 0; k < d; ++k) q[k] = std::sin(1.3 * trial + 0.7 * static_cast<double>(k)) + 0.1;
        firstOfRolling(&model, 0.37 * trial, q.data(), v.data(), r.data(), byState.data(), byTime.data());
        for (const double b : r)
            if (b != 0 && std::isfinite(b)) return true;
    }
    return false;
}

}  // namespace

std::optional<Rolling> rollingOf(const Settings& settings, const Formula& formula) {
    const Value::Object& typed = formulasUnder(settings, "rolling");
    if (typed.empty()) return {};
    const int d = formula.dimension();
    const Formula names = withTime(formula, "");
    Roots roots(names);
    auto model = std::make_shared<RollingModel>();
    model->d = d;
    Rolling made;
    std::vector<int> values, seconds;
    for (const auto& [name, text] : typed) {
        const std::string pointer = "/rolling/" + name;
        if (const std::string problem = nameProblem(name); !problem.empty())
            throw InvalidScene(pointer, "the name \"" + name + "\" " + problem);
        const Formula own = withTime(formula, text.asString());
        const auto symbolic = derivativesOf(own, pointer);
        requireNoRateOfTime(own, pointer);
        if (!hasVelocity(own))
            throw InvalidScene(pointer, "has no velocity in it",
                               "a relation of places and time belongs under constraints");
        const auto second = [&](int i, int j) {
            return symbolic->hessian[placeOf(i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i)];
        };
        std::vector<int> nodes{symbolic->value};
        for (int i = 0; i < d; ++i) nodes.push_back(symbolic->gradient[placeOf(i)]);
        for (int i = 0; i < d; ++i) nodes.push_back(symbolic->gradient[placeOf(d + 1 + i)]);
        nodes.push_back(symbolic->gradient[placeOf(d)]);
        const std::vector<int> here = roots.adopt(symbolic->graph, nodes);
        values.insert(values.end(), here.begin(), here.end());
        for (int i = 0; i < d; ++i) {
            for (int j = 0; j <= i; ++j)
                if (!roots.graph().isZero(
                        roots.adopt(symbolic->graph, {second(d + 1 + i, d + 1 + j)}).front()))
                    throw InvalidScene(pointer, "is not linear in the velocities",
                                       "a(q) v - b: velocities times functions of places");
            for (int j = 0; j < d; ++j) {
                const int node = roots.adopt(symbolic->graph, {second(d + 1 + i, j)}).front();
                if (roots.graph().isZero(node)) continue;
                model->entries.push_back({model->count, i, j, seconds.size()});
                seconds.push_back(node);
            }
        }
        made.names.push_back(name);
        ++model->count;
    }
    model->first = roots.tape(values);
    model->second = roots.tape(seconds);
    made.isDriven = isDriven(*model);
    made.model = std::move(model);
    made.first = firstOfRolling;
    made.addCurvature = addCurvatureOfRolling;
    return made;
}

}  // namespace extremal::typed
