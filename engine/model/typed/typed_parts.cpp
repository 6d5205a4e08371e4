// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/typed_parts.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/symbolic.hpp"
#include "engine/model/typed/tape.hpp"
#include "engine/model/typed/tape_registers.hpp"

namespace extremal::typed {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// The names with time as one more coordinate, so that derivatives by it are found as those by the others.
/// Symbols: q_i: i,  t: d,  v_i: d + 1 + i,  the rate of t: 2d + 1.
Formula withTime(const Formula& formula, const std::string& text) {
    Formula own = formula;
    own.terms.clear();
    own.coordinates.push_back("t");
    own.text = text;
    return own;
}

/// Roots of several formulas in one graph, with numbers in place of parameters.
class Roots {
public:
    explicit Roots(const Formula& withTime) : formula_(withTime) {}

    /// The nodes of a graph here.
    std::vector<int> adopt(const Graph& from, const std::vector<int>& nodes) {
        return graph_.adopt(from, nodes, [&](int symbol) -> std::optional<double> {
            const int k = symbol - formula_.firstParameter();
            if (k < 0) return {};
            return formula_.parameters[at(k)].second;
        });
    }
    Graph& graph() { return graph_; }
    Tape tape(const std::vector<int>& roots) const {
        return Tape::of(graph_, roots, 2 * formula_.dimension());
    }

private:
    const Formula& formula_;
    Graph graph_;
};

/// One evaluation of a tape at (q, t, v); v may be null.
class Run : public TapeRegisters {
public:
    Run(const Tape& tape, int d, double t, const double* q, const double* v)
        : TapeRegisters(tape, [&](double* r) {
              std::copy_n(q, d, r);
              r[d] = t;
              if (v)
                  std::copy_n(v, d, r + d + 1);
              else
                  std::fill_n(r + d + 1, d, 0.0);
              r[2 * d + 1] = 1;
          }) {}
};

/// differentiate() with what is wrong as a problem of the scene.
std::shared_ptr<const SymbolicLagrangian> derivatives(const Formula& formula, const std::string& pointer) {
    try {
        return differentiate(formula);
    } catch (const ExpressionError& e) {
        throw InvalidScene(pointer, std::string(e.what()) + "\n" + caretLines(formula.text, e.position),
                           e.hint);
    }
}

/// The derivatives of constraints that are not 0 everywhere.
struct ConstraintModel {
    int d = 0, count = 0;
    Tape value, second;  ///< value: of each constraint g, g_t, and its entries of g_q
    struct First {
        int constraint, i;
        std::size_t output;
    };
    struct Second {
        int constraint, i, j;  ///< j <= i; d stands for time
        std::size_t output;
    };
    std::vector<First> first;
    std::vector<Second> entries;
    std::vector<std::size_t> values;  ///< where the outputs of each constraint begin
};
const ConstraintModel& constraintModel(const void* p) { return *static_cast<const ConstraintModel*>(p); }

void first(const void* p, double t, const double* q, double* g, double* byPlace, double* byTime) {
    const ConstraintModel& m = constraintModel(p);
    const Run r(m.value, m.d, t, q, nullptr);
    std::fill_n(byPlace, m.count * m.d, 0.0);
    for (int k = 0; k < m.count; ++k) {
        g[k] = r[m.values[at(k)]];
        byTime[k] = r[m.values[at(k)] + 1];
    }
    for (const ConstraintModel::First& e : m.first) byPlace[e.constraint * m.d + e.i] = r[e.output];
}
void firstEntries(const void* p, double t, const double* q, double* g, double* byPlace, double* byTime) {
    const ConstraintModel& m = constraintModel(p);
    const Run r(m.value, m.d, t, q, nullptr);
    for (int k = 0; k < m.count; ++k) {
        g[k] = r[m.values[at(k)]];
        byTime[k] = r[m.values[at(k)] + 1];
    }
    for (std::size_t e = 0; e < m.first.size(); ++e) byPlace[e] = r[m.first[e].output];
}
void secondEntries(const void* p, double t, const double* q, double* curvature) {
    const ConstraintModel& m = constraintModel(p);
    const Run r(m.second, m.d, t, q, nullptr);
    for (const ConstraintModel::Second& e : m.entries)
        if (e.i != m.d) *curvature++ = r[e.output];
}

void addCurvature(const void* p, double t, const double* q, const double* lambda, double* matrix) {
    const ConstraintModel& m = constraintModel(p);
    const Run r(m.second, m.d, t, q, nullptr);
    for (const ConstraintModel::Second& e : m.entries) {
        if (e.i == m.d) continue;
        const double value = lambda[e.constraint] * r[e.output];
        matrix[e.i * m.d + e.j] += value;
        if (e.i != e.j) matrix[e.j * m.d + e.i] += value;
    }
}

void rates(const void* p, double t, const double* q, const double* v, double* rates) {
    const ConstraintModel& m = constraintModel(p);
    const Run r(m.second, m.d, t, q, nullptr);
    std::fill_n(rates, m.count, 0.0);
    const auto speed = [&](int i) { return i == m.d ? 1.0 : v[i]; };
    for (const ConstraintModel::Second& e : m.entries)
        rates[e.constraint] += (e.i == e.j ? 1 : 2) * speed(e.i) * speed(e.j) * r[e.output];
}

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
    for (int i = 0; i < m.d; ++i) f[i] = r[at(i)];
}

void firstOfForce(const void* p, double t, const double* q, const double* v, double* f, double* derivatives) {
    const ForceModel& m = forceModel(p);
    const Run r(m.first, m.d, t, q, v);
    for (int i = 0; i < m.d; ++i) f[i] = r[at(i)];
    std::fill_n(derivatives, 2 * m.d * m.d, 0.0);
    for (const ForceModel::Entry& e : m.entries) derivatives[e.i * 2 * m.d + e.j] = r[e.output];
}

void entriesOfForce(const void* p, double t, const double* q, const double* v, double* f, double* first) {
    const ForceModel& m = forceModel(p);
    const Run r(m.first, m.d, t, q, v);
    for (int i = 0; i < m.d; ++i) f[i] = r[at(i)];
    for (std::size_t e = 0; e < m.entries.size(); ++e) first[e] = r[m.entries[e].output];
}

const Value::Object& objectOf(const Settings& settings, const char* key) {
    static const Value::Object empty;
    const Value* const value = settings.find(key);
    if (value && value->isString() && !value->asString().empty())
        throw InvalidScene(std::string("/") + key, "needs a name for each formula",
                           std::string("{\"") + (std::string_view(key) == "forces" ? "x" : "rod") + "\": \"" +
                               value->asString() + "\"}");
    return value && value->isObject() ? value->asObject() : empty;
}

/// Time has no rate among the names.
void requireNoRateOfTime(const Formula& own, const std::string& pointer) {
    const ResolvedFormula resolved = resolve(own);
    for (std::size_t n = 0; n < resolved.symbol.size(); ++n)
        if (resolved.symbol[n] == 2 * own.dimension() - 1)
            throw InvalidScene(pointer, "has an unknown name \"t_t\"\n" +
                                            caretLines(own.text, resolved.expression.nodes[n].position));
}

/// What is in the way of a formula that has velocities where none belong.
void requireNoVelocities(const Formula& own, const std::string& name, const std::string& pointer) {
    const ResolvedFormula resolved = resolve(own);
    for (std::size_t n = 0; n < resolved.symbol.size(); ++n) {
        const int symbol = resolved.symbol[n], d = own.dimension();
        if (symbol < d || symbol >= 2 * d) continue;
        throw InvalidScene(
            pointer, "has a velocity in it\n" + caretLines(own.text, resolved.expression.nodes[n].position),
            "write what " + name + " says of places and time; conditions on velocities belong under rolling");
    }
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
    for (const auto& [name, text] : objectOf(settings, "forces")) {
        const std::string pointer = "/forces/" + name;
        const auto found = std::find(formula.coordinates.begin(), formula.coordinates.end(), name);
        if (found == formula.coordinates.end())
            throw InvalidScene(pointer, "there is no coordinate \"" + name + "\" for a force to act on",
                               suggestName(name, formula.coordinates));
        const auto i = at(static_cast<int>(found - formula.coordinates.begin()));
        const Formula own = withTime(formula, text.asString());
        const auto symbolic = derivatives(own, pointer);
        requireNoRateOfTime(own, pointer);
        std::vector<int> nodes{symbolic->value};
        nodes.insert(nodes.end(), symbolic->gradient.begin(), symbolic->gradient.end());
        const std::vector<int> here = roots.adopt(symbolic->graph, nodes);
        add(all.value[i], here[0], 1);
        for (int j = 0; j < d; ++j) {
            add(all.derivative[i][at(j)], here[at(1 + j)], 1);
            add(all.derivative[i][at(d + j)], here[at(1 + d + 1 + j)], 1);
        }
    }
    const Value* const dissipation = settings.find("dissipation");
    if (!dissipation || !dissipation->isString() || dissipation->asString().empty()) return;
    const Formula own = withTime(formula, dissipation->asString());
    const auto symbolic = derivatives(own, "/dissipation");
    requireNoRateOfTime(own, "/dissipation");
    const auto second = [&](int i, int j) {
        return symbolic->hessian[at(i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i)];
    };
    for (int i = 0; i < d; ++i) {
        const int v = d + 1 + i;
        std::vector<int> nodes{symbolic->gradient[at(v)]};
        for (int j = 0; j < d; ++j) nodes.push_back(second(v, j));
        for (int j = 0; j < d; ++j) nodes.push_back(second(v, d + 1 + j));
        const std::vector<int> here = roots.adopt(symbolic->graph, nodes);
        add(all.value[at(i)], here[0], -1);
        for (int j = 0; j < 2 * d; ++j) add(all.derivative[at(i)][at(j)], here[at(1 + j)], -1);
    }
}

/// Relations of places and time by name, as one model.
class Relations {
public:
    /// `place`: where they are typed, in front of their names.
    Relations(const Formula& formula, std::string place)
        : formula_(formula), withTime_(withTime(formula, "")), roots_(withTime_), place_(std::move(place)) {
        model_->d = formula.dimension();
    }

    /// `pointer`: of the text.
    void add(const std::string& name, const std::string& text, const std::string& pointer) {
        const int d = formula_.dimension();
        if (const std::string problem = nameProblem(name); !problem.empty())
            throw InvalidScene(place_ + name, "the name \"" + name + "\" " + problem);
        const Formula own = withTime(formula_, text);
        const auto symbolic = derivatives(own, pointer);
        requireNoVelocities(own, name, pointer);
        std::vector<int> nodes{symbolic->value};
        nodes.insert(nodes.end(), symbolic->gradient.begin(), symbolic->gradient.begin() + d + 1);
        const std::vector<int> here = roots_.adopt(symbolic->graph, nodes);
        if (std::all_of(here.begin() + 1, here.begin() + 1 + d,
                        [&](int node) { return roots_.graph().isZero(node); }))
            throw InvalidScene(pointer, "no coordinate is in it, so that it constrains nothing");
        model_->values.push_back(values_.size());
        values_.push_back(here.front());
        values_.push_back(here.back());
        for (int i = 0; i < d; ++i) {
            if (roots_.graph().isZero(here[at(1 + i)])) continue;
            model_->first.push_back({model_->count, i, values_.size()});
            values_.push_back(here[at(1 + i)]);
        }
        const std::vector<int> hessian(symbolic->hessian.begin(),
                                       symbolic->hessian.begin() + (d + 1) * (d + 2) / 2);
        const std::vector<int> curved = roots_.adopt(symbolic->graph, hessian);
        std::size_t next = 0;
        for (int i = 0; i <= d; ++i)
            for (int j = 0; j <= i; ++j, ++next) {
                if (roots_.graph().isZero(curved[next])) continue;
                model_->entries.push_back({model_->count, i, j, seconds_.size()});
                seconds_.push_back(curved[next]);
            }
        isTimeDependent_ = isTimeDependent_ ||
                           roots_.graph().dependsOn({here.front()}, [d](int symbol) { return symbol == d; });
        names_.push_back(name);
        ++model_->count;
    }

    const std::vector<std::string>& names() const { return names_; }
    bool isTimeDependent() const { return isTimeDependent_; }
    std::shared_ptr<const ConstraintModel> model() {
        model_->value = roots_.tape(values_);
        model_->second = roots_.tape(seconds_);
        return model_;
    }

private:
    const Formula& formula_;
    Formula withTime_;
    Roots roots_;
    std::string place_;
    std::shared_ptr<ConstraintModel> model_ = std::make_shared<ConstraintModel>();
    std::vector<std::string> names_;
    std::vector<int> values_, seconds_;
    bool isTimeDependent_ = false;
};

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

/// A number, or a formula in parameters.
double numberOf(const Value& value, const Formula& formula, const std::string& pointer) {
    if (value.isNumber()) return value.asNumber();
    if (!value.isString()) throw InvalidScene(pointer, "must be a number or a formula in parameters");
    const Formula own = withTime(formula, value.asString());
    const auto symbolic = derivatives(own, pointer);
    Roots roots(own);
    const int node = roots.adopt(symbolic->graph, {symbolic->value}).front();
    if (!roots.graph().isNumber(node))
        throw InvalidScene(pointer, "must be a number or a formula in parameters",
                           "the same at all times and places");
    return roots.graph().at(node).number;
}

bool hasForces(const Settings& settings) {
    const Value* const dissipation = settings.find("dissipation");
    return !objectOf(settings, "forces").empty() ||
           (dissipation && dissipation->isString() && !dissipation->asString().empty());
}

/// Whether bodies at rest violate a condition at some place and time.
bool isDriven(const RollingModel& model) {
    const auto d = at(model.d), n = at(model.count);
    std::vector<double> q(d), v(d), r(n), byState(2 * n * d), byTime(n);
    for (int trial = 1; trial <= 4; ++trial) {
        for (std::size_t k = 0; k < d; ++k) q[k] = std::sin(1.3 * trial + 0.7 * static_cast<double>(k)) + 0.1;
        firstOfRolling(&model, 0.37 * trial, q.data(), v.data(), r.data(), byState.data(), byTime.data());
        for (const double b : r)
            if (b != 0 && std::isfinite(b)) return true;
    }
    return false;
}

/// Whether a coordinate or its velocity occurs in a formula.
bool moves(const Formula& own, int coordinate) {
    const ResolvedFormula resolved = resolve(own);
    return std::any_of(resolved.symbol.begin(), resolved.symbol.end(), [&](int symbol) {
        return symbol == coordinate || symbol == own.dimension() + coordinate;
    });
}

}  // namespace

std::optional<Constraint> constraintOf(const Settings& settings, const Formula& formula) {
    const Value::Object& typed = objectOf(settings, "constraints");
    if (typed.empty()) return {};
    Relations relations(formula, "/constraints/");
    for (const auto& [name, text] : typed) relations.add(name, text.asString(), "/constraints/" + name);
    Constraint made;
    made.names = relations.names();
    made.isTimeDependent = relations.isTimeDependent();
    const std::shared_ptr<const ConstraintModel> model = relations.model();
    auto entries = std::make_shared<Constraint::Entries>();
    for (const ConstraintModel::First& e : model->first) entries->byPlace.push_back({e.constraint, e.i});
    for (const ConstraintModel::Second& e : model->entries)
        if (e.i != model->d) entries->curvature.push_back({e.constraint, e.i, e.j});
    entries->first = firstEntries;
    entries->second = secondEntries;
    made.entries = std::move(entries);
    made.model = model;
    made.first = first;
    made.addCurvature = addCurvature;
    made.rates = rates;
    return made;
}

std::optional<Wall> wallOf(const Settings& settings, const Formula& formula) {
    const Value* const typed = settings.find("walls");
    if (!typed || typed->isNull() || (typed->isObject() && typed->asObject().empty())) return {};
    if (!typed->isObject())
        throw InvalidScene("/walls", "needs a name for each wall",
                           R"({"floor": {"gap": "y", "restitution": 0.8}})");
    Relations relations(formula, "/walls/");
    Wall made;
    for (const auto& [name, wall] : typed->asObject()) {
        const std::string pointer = "/walls/" + name;
        const Value* const gap = wall.isObject() ? wall.find("gap") : &wall;
        if (!gap || !gap->isString())
            throw InvalidScene(pointer, "needs its gap, a formula that is positive where motion is possible",
                               R"({"gap": "y", "restitution": 0.8}, or "y" for an elastic wall)");
        if (wall.isObject())
            for (const auto& [key, value] : wall.asObject())
                if (key != "gap" && key != "restitution")
                    throw InvalidScene(pointer + "/" + key, "unknown key \"" + key + "\"",
                                       suggestName(key, {"gap", "restitution"}));
        relations.add(name, gap->asString(), wall.isObject() ? pointer + "/gap" : pointer);
        const Value* const restitution = wall.isObject() ? wall.find("restitution") : nullptr;
        made.restitution.push_back(restitution ? numberOf(*restitution, formula, pointer + "/restitution")
                                               : 1);
        if (!(made.restitution.back() >= 0 && made.restitution.back() <= 1))
            throw InvalidScene(pointer + "/restitution",
                               "must be between 0 and 1, got " + formatNumber(made.restitution.back(), 6),
                               "1: elastic; 0: the body does not leave the wall");
    }
    made.names = relations.names();
    made.isTimeDependent = relations.isTimeDependent();
    made.model = relations.model();
    made.first = first;
    return made;
}

std::optional<Rolling> rollingOf(const Settings& settings, const Formula& formula) {
    const Value::Object& typed = objectOf(settings, "rolling");
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
        const auto symbolic = derivatives(own, pointer);
        requireNoRateOfTime(own, pointer);
        if (!hasVelocity(own))
            throw InvalidScene(pointer, "has no velocity in it",
                               "a relation of places and time belongs under constraints");
        const auto second = [&](int i, int j) {
            return symbolic->hessian[at(i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i)];
        };
        std::vector<int> nodes{symbolic->value};
        for (int i = 0; i < d; ++i) nodes.push_back(symbolic->gradient[at(i)]);
        for (int i = 0; i < d; ++i) nodes.push_back(symbolic->gradient[at(d + 1 + i)]);
        nodes.push_back(symbolic->gradient[at(d)]);
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

std::optional<Force> forceOf(const Settings& settings, const Formula& formula) {
    if (!hasForces(settings)) return {};
    const int d = formula.dimension();
    const Formula names = withTime(formula, "");
    Roots roots(names);
    const int zero = roots.graph().number(0);
    ForceNodes nodes{std::vector<int>(at(d), zero),
                     std::vector<std::vector<int>>(at(d), std::vector<int>(at(2 * d), zero))};
    addForces(settings, formula, roots, nodes);
    auto model = std::make_shared<ForceModel>();
    model->d = d;
    std::vector<int> all = nodes.value;
    for (int i = 0; i < d; ++i)
        for (int j = 0; j < 2 * d; ++j) {
            const int node = nodes.derivative[at(i)][at(j)];
            if (roots.graph().isZero(node)) continue;
            model->entries.push_back({i, j, all.size()});
            all.push_back(node);
        }
    model->value = roots.tape(nodes.value);
    model->first = roots.tape(all);
    Force made;
    made.isTimeDependent = roots.graph().dependsOn(nodes.value, [d](int symbol) { return symbol == d; });
    auto entries = std::make_shared<Force::Entries>();
    for (const ForceModel::Entry& e : model->entries) entries->first.push_back({e.i, e.j});
    entries->values = entriesOfForce;
    made.entries = std::move(entries);
    made.model = std::move(model);
    made.value = force;
    made.first = firstOfForce;
    return made;
}

bool isUntouched(const Settings& settings, const Formula& formula, int coordinate) {
    const std::string& name = formula.coordinates[at(coordinate)];
    const Value* const dissipation = settings.find("dissipation");
    std::vector<std::pair<std::string, bool>> texts;  // and whether a place in it is all that matters
    for (const auto& [key, text] : objectOf(settings, "constraints"))
        texts.push_back({text.asString(), true});
    for (const auto& [key, text] : objectOf(settings, "rolling")) {
        const Formula own = withTime(formula, text.asString());
        if (moves(own, coordinate)) return false;
    }
    if (const Value* const walls = settings.find("walls"); walls && walls->isObject())
        for (const auto& [key, wall] : walls->asObject()) {
            const Value* const gap = wall.isObject() ? wall.find("gap") : &wall;
            if (gap && gap->isString()) texts.push_back({gap->asString(), true});
        }
    if (dissipation && dissipation->isString()) texts.push_back({dissipation->asString(), false});
    for (const auto& [key, text] : objectOf(settings, "forces"))
        if (key == name) return false;
    for (const auto& [text, isOfPlaces] : texts) {
        if (text.empty()) continue;
        const Formula own = withTime(formula, text);
        const ResolvedFormula resolved = resolve(own);
        const int symbol = isOfPlaces ? coordinate : own.dimension() + coordinate;
        if (std::find(resolved.symbol.begin(), resolved.symbol.end(), symbol) != resolved.symbol.end())
            return false;
    }
    return true;
}

}  // namespace extremal::typed
