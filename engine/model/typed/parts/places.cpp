// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/parts/typed_parts.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/number_in.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/parts/dependence.hpp"
#include "engine/model/typed/parts/part_formulas.hpp"

namespace extremal::typed {
namespace {

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
    std::vector<int> entryOf;         ///< of (g, g_q), for each output of `value`; -1: g_t
    std::unique_ptr<const Dependence> dependence;
};
const ConstraintModel& constraintModel(const void* p) { return *static_cast<const ConstraintModel*>(p); }

void first(const void* p, double t, const double* q, double* g, double* byPlace, double* byTime) {
    const ConstraintModel& m = constraintModel(p);
    const Run r(m.value, m.d, t, q, nullptr);
    std::fill_n(byPlace, m.count * m.d, 0.0);
    for (int k = 0; k < m.count; ++k) {
        g[k] = r[m.values[placeOf(k)]];
        byTime[k] = r[m.values[placeOf(k)] + 1];
    }
    for (const ConstraintModel::First& e : m.first) byPlace[e.constraint * m.d + e.i] = r[e.output];
}
void firstAtNodes(const void* p, const double* t, int nodes, const double* q, double* firsts) {
    const ConstraintModel& m = constraintModel(p);
    std::fill_n(firsts, m.count * (1 + m.d) * nodes, 0.0);
    runNodes(m.value, m.d, t, nodes, q, nullptr, [&](std::size_t output, const Lanes& value, int i) {
        if (m.entryOf[output] >= 0) storeEight(value, firsts + m.entryOf[output] * nodes + i);
    });
}
void firstEntries(const void* p, double t, const double* q, double* g, double* byPlace, double* byTime) {
    const ConstraintModel& m = constraintModel(p);
    const Run r(m.value, m.d, t, q, nullptr);
    for (int k = 0; k < m.count; ++k) {
        g[k] = r[m.values[placeOf(k)]];
        byTime[k] = r[m.values[placeOf(k)] + 1];
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

Constraint::AtNodes dependence(const void* p, std::span<const int> order) {
    return constraintModel(p).dependence->inOrder(order);
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
        const OwnFormula own(formula_, text);
        const int k = own.dimension();
        const auto symbolic = derivativesOf(own.formula, pointer);
        requireNoVelocities(own.formula, name, pointer);
        std::vector<int> nodes{symbolic->value};
        nodes.insert(nodes.end(), symbolic->gradient.begin(), symbolic->gradient.begin() + k + 1);
        const std::vector<int> here = roots_.adopt(own, symbolic->graph, nodes);
        if (std::all_of(here.begin() + 1, here.begin() + 1 + k,
                        [&](int node) { return roots_.graph().isZero(node); }))
            throw InvalidScene(pointer, "no coordinate is in it, so that it constrains nothing");
        model_->values.push_back(values_.size());
        values_.push_back(here.front());
        values_.push_back(here.back());
        for (int i = 0; i < k; ++i) {
            if (roots_.graph().isZero(here[placeOf(1 + i)])) continue;
            model_->first.push_back({model_->count, own.coordinates[placeOf(i)], values_.size()});
            values_.push_back(here[placeOf(1 + i)]);
        }
        const std::vector<int> hessian(symbolic->hessian.begin(),
                                       symbolic->hessian.begin() + (k + 1) * (k + 2) / 2);
        const std::vector<int> curved = roots_.adopt(own, symbolic->graph, hessian);
        std::size_t next = 0;
        for (int i = 0; i <= k; ++i)
            for (int j = 0; j <= i; ++j, ++next) {
                if (roots_.graph().isZero(curved[next])) continue;
                model_->entries.push_back(
                    {model_->count, own.renamed(i, d), own.renamed(j, d), seconds_.size()});
                seconds_.push_back(curved[next]);
            }
        isTimeDependent_ = isTimeDependent_ ||
                           roots_.graph().dependsOn({here.front()}, [d](int symbol) { return symbol == d; });
        names_.push_back(name);
        ++model_->count;
    }

    const std::vector<std::string>& names() const { return names_; }
    bool isTimeDependent() const { return isTimeDependent_; }
    /// Lets the model tell how coordinates depend on each other; once all relations are there.
    bool addDependence() {
        const int n = model_->count, d = model_->d;
        if (n > Dependence::mostRows) return false;
        std::vector<int> values, byPlace(placeOf(n * d), roots_.graph().number(0));
        for (const std::size_t first : model_->values) values.push_back(values_[first]);
        for (const ConstraintModel::First& e : model_->first)
            byPlace[placeOf(e.constraint * d + e.i)] = values_[e.output];
        model_->dependence =
            std::make_unique<Dependence>(roots_.graph(), std::move(values), std::move(byPlace));
        return true;
    }
    std::shared_ptr<const ConstraintModel> model() {
        std::vector<int>& entryOf = model_->entryOf;
        entryOf.assign(values_.size(), -1);
        for (int k = 0; k < model_->count; ++k) entryOf[model_->values[placeOf(k)]] = k;
        for (const ConstraintModel::First& e : model_->first)
            entryOf[e.output] = model_->count + e.constraint * model_->d + e.i;
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

}  // namespace

std::optional<Constraint> constraintOf(const Settings& settings, const Formula& formula) {
    const Value::Object& typed = formulasUnder(settings, "constraints");
    if (typed.empty()) return {};
    Relations relations(formula, "/constraints/");
    for (const auto& [name, text] : typed) relations.add(name, text.asString(), "/constraints/" + name);
    Constraint made;
    made.names = relations.names();
    made.isTimeDependent = relations.isTimeDependent();
    if (relations.addDependence()) made.dependence = dependence;
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
    made.firsts = ForThisMachine<&firstAtNodes>::call();
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
        const Value* const gap = gapOf(wall);
        if (!gap)
            throw InvalidScene(pointer, "needs its gap, a formula that is positive where motion is possible",
                               R"({"gap": "y", "restitution": 0.8}, or "y" for an elastic wall)");
        if (wall.isObject())
            for (const auto& [key, value] : wall.asObject()) {
                if (key == "friction")
                    throw InvalidScene(pointer + "/friction",
                                       "is not modelled: bodies slide on walls, and neither stick nor roll",
                                       "a wall without friction; along a line that stays, a force that is "
                                       "smoothed by tanh(v/eps)");
                if (key != "gap" && key != "restitution")
                    throw InvalidScene(pointer + "/" + key, "unknown key \"" + key + "\"",
                                       suggestName(key, {"gap", "restitution"}));
            }
        relations.add(name, gap->asString(), wall.isObject() ? pointer + "/gap" : pointer);
        const Value* const restitution = wall.isObject() ? wall.find("restitution") : nullptr;
        made.restitution.push_back(
            restitution ? numberIn(*restitution, pointer + "/restitution", formula.parameters) : 1);
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

Wall wallOf(const std::vector<GapText>& gaps, const Formula& formula) {
    Relations relations(formula, "");
    Wall made;
    for (const GapText& each : gaps) {
        relations.add("gap_" + std::to_string(made.names.size() + 1), each.text, "");
        made.names.push_back(each.name);
        made.restitution.push_back(each.restitution);
    }
    made.isTimeDependent = relations.isTimeDependent();
    made.model = relations.model();
    made.first = first;
    return made;
}

WallContact contactWith(const Wall& wall) {
    Constraint gaps;
    gaps.names = wall.names;
    gaps.isTimeDependent = wall.isTimeDependent;
    gaps.model = wall.model;
    gaps.first = first;
    gaps.addCurvature = addCurvature;
    gaps.rates = rates;
    return {gaps};
}

}  // namespace extremal::typed
