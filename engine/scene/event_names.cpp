// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/event_names.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <utility>

#include "engine/mechanism/mechanism.hpp"
#include "engine/model/mechanisms.hpp"

namespace extremal {
namespace {

constexpr double unknownValue = std::numeric_limits<double>::quiet_NaN();

std::string withUnderscores(std::string name) {
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
}

/// Whether the parts of a system are those of a mechanism, whose velocities are known.
bool hasVelocities(const System& system) {
    return system.hasCoordinates() && isTaken(mechanisms(), system.parts);
}

bool isPartOfName(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Where the bracket at `open` closes; npos: it does not.
std::size_t closingOf(const std::string& text, std::size_t open) {
    int depth = 0;
    for (std::size_t i = open; i < text.size(); ++i) {
        depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
        if (depth == 0) return i;
    }
    return std::string::npos;
}

constexpr std::string_view integralWord = "integral";

/// The next "integral (" from a place on, and where its bracket is.
std::pair<std::size_t, std::size_t> nextIntegral(const std::string& text, std::size_t from) {
    for (std::size_t at = text.find(integralWord, from); at != std::string::npos;
         at = text.find(integralWord, at + 1)) {
        if (at > 0 && isPartOfName(text[at - 1])) continue;
        std::size_t open = at + integralWord.size();
        while (open < text.size() && text[open] == ' ') ++open;
        if (open < text.size() && text[open] == '(') return {at, open};
    }
    return {std::string::npos, std::string::npos};
}

}  // namespace

EventText EventText::of(const std::string& text) {
    constexpr std::size_t most = 9;
    EventText made{text, {}};
    for (auto [at, open] = nextIntegral(text, 0); at != std::string::npos;) {
        const std::size_t close = closingOf(text, open);
        if (close == std::string::npos) break;  // what is wrong is said of the whole
        const std::string inner = text.substr(open + 1, close - open - 1);
        if (nextIntegral(inner, 0).first != std::string::npos)
            throw ExpressionError("has an integral within an integral", at, "one integral over time each");
        if (made.integrands.size() == most)
            throw ExpressionError("has more than nine integrals", at, "fewer, or several events");
        made.integrands.push_back(inner);
        std::string name = made.integralNames().back();
        name.resize(close + 1 - at, ' ');
        made.outer.replace(at, name.size(), name);
        std::tie(at, open) = nextIntegral(text, close);
    }
    return made;
}

std::vector<std::string> EventText::integralNames() const {
    std::vector<std::string> names;
    for (std::size_t k = 1; k <= integrands.size(); ++k) names.push_back("integral_" + std::to_string(k));
    return names;
}

std::vector<StateName> stateNames(const System& system, const std::vector<std::string>& parameters) {
    using Kind = StateName::Kind;
    std::vector<StateName> names{{"t", Kind::time, 0}};
    const std::vector<Quantity> columns = stateColumns(system);
    const auto isFree = [&](const std::string& name) {
        return std::none_of(names.begin(), names.end(), [&](const StateName& n) { return n.name == name; });
    };
    const auto isParameter = [&](const std::string& name) {
        return std::find(parameters.begin(), parameters.end(), name) != parameters.end();
    };
    for (std::size_t i = 0; i < columns.size(); ++i)
        names.push_back({withUnderscores(columns[i].name), Kind::column, static_cast<int>(i)});
    for (std::size_t i = 0; i < system.coordinates.size(); ++i) {
        const std::string name = withUnderscores(system.coordinates[i].name);
        if (nameProblem(name).empty() && !isParameter(name) && isFree(name))
            names.push_back({name, Kind::column, static_cast<int>(i)});
    }
    const auto add = [&](const std::string& name, Kind kind, int index) {
        if (!isParameter(name) && isFree(name)) names.push_back({name, kind, index});
    };
    if (hasVelocities(system)) {
        for (int i = 0; i < system.dimension(); ++i)
            add(withUnderscores(system.coordinates[static_cast<std::size_t>(i)].name) + "_t", Kind::velocity,
                i);
        int row = 0;
        const auto addReactions = [&](const auto* part) {
            if (!part) return;
            for (const std::string& name : part->names) add("reaction_" + name, Kind::reaction, row++);
        };
        addReactions(system.parts.find<Constraint>());
        addReactions(system.parts.find<Rolling>());
    }
    if (!columns.empty() && energyOf(system)) add("energy", Kind::energy, 0);
    return names;
}

EventFunction::EventFunction(const EventSpec& event, const System& system)
    : EventFunction(event.expression, event, system) {}
EventFunction::EventFunction(const EventFunction& other)
    : expression_(other.expression_),
      places_(other.places_),
      integrands_(other.integrands_),
      values_(other.values_),
      energy_(other.energy_),
      mechanism_(other.mechanism_ ? std::make_unique<Mechanism>(*other.mechanism_) : nullptr),
      hasReactions_(other.hasReactions_),
      velocity_(other.velocity_),
      reactions_(other.reactions_) {}
EventFunction::EventFunction(EventFunction&&) noexcept = default;
EventFunction& EventFunction::operator=(EventFunction&&) noexcept = default;
EventFunction::~EventFunction() = default;

EventFunction::EventFunction(const std::string& whole, const EventSpec& event, const System& system) {
    using Kind = StateName::Kind;
    const EventText text = EventText::of(whole);
    expression_ = parseExpression(text.outer);
    for (const std::string& each : text.integrands) integrands_.push_back(EventFunction(each, event, system));
    std::vector<std::string> parameters;
    for (const auto& each : event.values) parameters.push_back(each.first);
    std::vector<StateName> known = stateNames(system, parameters);
    for (const std::string& name : text.integralNames())
        known.push_back({name, Kind::integral, static_cast<int>(known.size())});
    for (std::size_t k = 0; k < text.integrands.size(); ++k)
        known[known.size() - text.integrands.size() + k].index = static_cast<int>(k);
    bool needsMotion = false;
    for (const Expression::Node& node : expression_.nodes) {
        Place place;
        const auto same = [&](const auto& each) { return each.name == node.name; };
        const auto parameter = std::find_if(event.values.begin(), event.values.end(),
                                            [&](const auto& each) { return each.first == node.name; });
        if (node.kind == Operator::number) {
            place = {Place::Kind::number, Kind::time, 0, node.number};
        } else if (node.kind == Operator::name && parameter != event.values.end()) {
            place = {Place::Kind::number, Kind::time, 0, parameter->second};
        } else if (node.kind == Operator::name) {
            const auto found = std::find_if(known.begin(), known.end(), same);
            if (found == known.end())
                throw ExpressionError("has an unknown name \"" + node.name + "\"", node.position);
            place = {Place::Kind::name, found->kind, found->index, 0};
            hasReactions_ = hasReactions_ || found->kind == Kind::reaction;
            needsMotion = needsMotion || found->kind == Kind::velocity || found->kind == Kind::reaction;
            if (found->kind == Kind::energy) energy_ = energyOf(system);
        }
        places_.push_back(place);
    }
    values_.resize(places_.size());
    if (needsMotion) {
        mechanism_ = std::make_unique<Mechanism>(system.parts);
        velocity_.resize(static_cast<std::size_t>(system.dimension()));
        reactions_.resize(static_cast<std::size_t>(mechanism_->constraints()));
    }
    measureTruth(static_cast<int>(places_.size()) - 1);
}

void EventFunction::measureTruth(int node) {
    Expression::Node& here = expression_.nodes[static_cast<std::size_t>(node)];
    if (here.kind != Operator::call) return;
    if (here.name == "<" || here.name == "<=" || here.name == "==" || here.name == "!=") {
        here.kind = Operator::subtract;
        if (here.name.front() == '<') std::swap(here.left, here.right);
    } else if (here.name == "and" || here.name == "or") {
        here.function = findFunction(here.name == "and" ? "min" : "max");
        measureTruth(here.left);
        measureTruth(here.right);
    }
}

void EventFunction::findMotion(double t, const double* x) const {
    const auto& L = mechanism_->mechanics();
    std::fill(reactions_.begin(), reactions_.end(), unknownValue);
    if (!L.velocity(L.model.get(), t, x, x + L.dimension, velocity_.data()))
        return std::fill(velocity_.begin(), velocity_.end(), unknownValue);
    if (!hasReactions_) return;
    Eigen::VectorXd acceleration, multipliers;
    if (mechanism_->accelerate(t, x, velocity_.data(), acceleration, multipliers))
        std::copy(multipliers.begin(), multipliers.end(), reactions_.begin());
}

double EventFunction::valueOf(const Place& place, double t, const double* x,
                              std::span<const double> integrals) const {
    const auto index = static_cast<std::size_t>(place.index);
    switch (place.kind) {
        case StateName::Kind::time:
            return t;
        case StateName::Kind::column:
            return x[index];
        case StateName::Kind::velocity:
            return velocity_[index];
        case StateName::Kind::energy:
            return energy_(t, x);
        case StateName::Kind::reaction:
            return reactions_[index];
        case StateName::Kind::integral:
            return index < integrals.size() ? integrals[index] : unknownValue;
    }
    return unknownValue;
}

double EventFunction::operator()(double t, const double* x, std::span<const double> integrals) const {
    const auto operand = [&](int n) { return n < 0 ? 0.0 : values_[static_cast<std::size_t>(n)]; };
    if (mechanism_) findMotion(t, x);
    for (std::size_t n = 0; n < places_.size(); ++n) {
        const Place& place = places_[n];
        const Expression::Node& node = expression_.nodes[n];
        values_[n] = place.what == Place::Kind::name ? valueOf(place, t, x, integrals)
                     : place.what == Place::Kind::number
                         ? place.value
                         : applyNode(node, operand(node.left), operand(node.right), operand(node.third));
    }
    return values_.back();
}

}  // namespace extremal
