// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/cartesian/form_writer.hpp"

#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/core/text/indexed.hpp"
#include "engine/model/cartesian/point_formulas.hpp"

namespace extremal::cartesian {

void FormWriter::Texts::add(const std::string& name, const std::string& term) {
    for (auto& [known, text] : all_)
        if (known == name) {
            text = Value(sum(text.asString(), term));
            return;
        }
    all_.emplace_back(name, term);
}

FormWriter::FormWriter(const std::vector<std::pair<std::string, double>>& parameters) {
    for (const auto& [name, value] : parameters) {
        parameters_.emplace_back(name, value);
        taken_.insert(name);
    }
    form_.origins.emplace_back("/constraints", "");
    form_.origins.emplace_back("/lagrangian", "");
}

void FormWriter::addCoordinate(const std::string& name, double q, double v, const std::string& pointer) {
    if (taken_.contains(name))
        throw InvalidScene(pointer,
                           "has the coordinate " + name + ", which is the name of a parameter as well",
                           "rename one of them");
    taken_.insert(name);
    names_.emplace_back(name);
    form_.q.push_back(q);
    form_.v.push_back(v);
}

std::string FormWriter::amount(const Amount& given, const std::string& name, const std::string& pointer) {
    if (!given.formula.empty() || taken_.contains(name) || !nameProblem(name).empty()) return textOf(given);
    taken_.insert(name);
    parameters_.emplace_back(name, given.value);
    form_.origins.emplace_back("/parameters/" + name, pointer);
    return name;
}

void FormWriter::addTerm(const std::string& term) { terms_.push_back((terms_.empty() ? "" : " + ") + term); }
void FormWriter::subtractTerm(const std::string& term) { terms_.push_back(" - " + term); }

void FormWriter::addConstraint(const std::string& name, const std::string& formula,
                               const std::string& pointer) {
    constraints_.add(name, formula);
    form_.origins.emplace_back("/constraints/" + name, pointer);
}

void FormWriter::damp(const std::string& term) { dissipation_ += (dissipation_.empty() ? "" : " + ") + term; }

void FormWriter::force(const std::string& coordinate, const std::string& formula,
                       const std::string& pointer) {
    forces_.add(coordinate, formula);
    form_.origins.emplace_back("/forces/" + coordinate, pointer);
}

void FormWriter::addWall(const std::string& name, const std::string& gap, const Amount& restitution,
                         const std::string& pointer) {
    walls_.emplace_back(name, Value(Value::Object{{"gap", gap}, {"restitution", restitution.value}}));
    form_.origins.emplace_back("/walls/" + name, pointer);
}

Value FormWriter::lagrangian() const {
    std::string whole;
    for (const std::string& term : terms_) whole += term;
    if (whole.size() <= maxExpressionLength) return whole;
    Value::Object parts;
    std::string part;
    const auto close = [&] {
        if (!part.empty()) parts.emplace_back("part_" + std::to_string(parts.size() + 1), part);
        part.clear();
    };
    for (const std::string& term : terms_) {
        if (part.size() + term.size() > maxExpressionLength) close();
        // What a part begins with has no plus before it.
        part += part.empty() && term.starts_with(" + ") ? term.substr(3) : term;
    }
    close();
    return parts;
}

WrittenForm FormWriter::written() {
    std::size_t length = 0;
    for (const std::string& term : terms_) length += term.size();
    if (length > maxExpandedLength || dissipation_.size() > maxExpressionLength)
        throw InvalidScene("/points",
                           "make a formula of " + std::to_string(std::max(length, dissipation_.size())) +
                               " characters, which is too long",
                           "fewer elements; long chains are typed by index in a Lagrangian");
    Settings& s = form_.settings;
    s.type = "lagrangian";
    s.keys = {
        {"coordinates", Value(names_)}, {"parameters", Value(parameters_)}, {"lagrangian", lagrangian()}};
    if (!constraints_.isEmpty()) s.keys.emplace_back("constraints", constraints_.value());
    if (!forces_.isEmpty()) s.keys.emplace_back("forces", forces_.value());
    if (!dissipation_.empty()) s.keys.emplace_back("dissipation", dissipation_);
    if (!walls_.empty()) s.keys.emplace_back("walls", Value(walls_));
    return std::move(form_);
}

}  // namespace extremal::cartesian
