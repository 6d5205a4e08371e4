// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/part_equations.hpp"

#include <algorithm>
#include <memory>
#include <string_view>

#include "engine/model/typed/symbolic.hpp"

namespace extremal::typed {
namespace {

constexpr std::size_t longestLine = 3000;

/// A formula beside the Lagrangian with its derivatives; time is one more coordinate.
struct PartFormula {
    Formula names;
    std::shared_ptr<const SymbolicLagrangian> symbolic;  ///< null where it cannot be read

    static PartFormula of(const Formula& lagrangian, const PartTexts& parts, const std::string& text) {
        PartFormula made;
        made.names = lagrangian;
        made.names.terms.clear();
        made.names.coordinates.push_back("t");
        for (const std::string& name : parts.controls) made.names.parameters.emplace_back(name, 1.0);
        made.names.text = text;
        try {
            made.symbolic = differentiate(made.names);
        } catch (const ExpressionError&) {
        }
        return made;
    }
    int byPlace(int i) const { return symbolic->gradient[static_cast<std::size_t>(i)]; }
    int byVelocity(int i) const {
        return symbolic->gradient[static_cast<std::size_t>(names.dimension() + i)];
    }
};

/// The right-hand side of an equation, term by term.
class RightSide {
public:
    explicit RightSide(TextForm form) : form_(form) {}

    /// Adds `factor` times a node; an empty factor is 1.
    void add(const std::string& factor, const PartFormula& from, int node, bool isNegative) {
        const Graph& graph = from.symbolic->graph;
        if (graph.isZero(node)) return;
        const Graph::Node& whole = graph.at(node);
        const bool isSum =
            whole.kind == Graph::Kind::sum && whole.operands.size() + (whole.number != 0 ? 1 : 0) > 1;
        std::string text = typeset(graph, node, from.names, form_);
        if (isSum && (isNegative || !factor.empty()))
            text = form_ == TextForm::tex ? "\\left(" + text + "\\right)" : "(" + text + ")";
        for (const std::string_view minus : {std::string_view("−"), std::string_view("-")})
            if (text.starts_with(minus)) {
                text.erase(0, minus.size());
                isNegative = !isNegative;
                break;
            }
        const std::string minus = form_ == TextForm::tex ? "-" : "−";
        if (text_.empty())
            text_ = isNegative ? minus : "";
        else
            text_ += isNegative ? " " + minus + " " : " + ";
        text_ += product(factor, text);
    }
    std::string text() const { return text_.empty() ? "0" : text_; }

private:
    /// A number stays in front: "2 λ x".
    static std::string product(const std::string& factor, const std::string& text) {
        if (factor.empty()) return text;
        if (text == "1") return factor;
        const std::size_t digits = std::min(text.find_first_not_of("0123456789."), text.size());
        if (digits == text.size()) return text + " " + factor;
        if (digits > 0 && text[digits] == ' ' && text.compare(digits, 3, " / ") != 0)
            return text.substr(0, digits) + " " + factor + text.substr(digits);
        return factor + " " + text;
    }

    TextForm form_;
    std::string text_;
};

/// "λ", or with the name of its relation where there are several.
std::string multiplier(bool isOfVelocities, const std::string& name, bool isAlone, TextForm form) {
    const std::string letter = isOfVelocities ? "μ" : "λ";
    if (form == TextForm::tex)
        return std::string(isOfVelocities ? "\\mu" : "\\lambda") +
               (isAlone ? "" : "_{\\mathrm{" + name + "}}");
    if (form == TextForm::rich) return "<i>" + letter + "</i>" + (isAlone ? "" : "<sub>" + name + "</sub>");
    return letter + (isAlone ? "" : "_" + name);
}

struct Relation {
    PartFormula formula;
    bool isOfVelocities;
    std::string multiplier;
};

}  // namespace

PartTexts partTextsOf(const Settings& model) {
    PartTexts parts;
    const auto formulas = [&](const char* key) {
        std::vector<std::pair<std::string, std::string>> all;
        if (const Value* const value = model.find(key); value && value->isObject())
            for (const auto& [name, text] : value->asObject())
                if (text.isString()) all.emplace_back(name, text.asString());
        return all;
    };
    parts.constraints = formulas("constraints");
    parts.rolling = formulas("rolling");
    parts.forces = formulas("forces");
    if (const Value* const value = model.find("dissipation"); value && value->isString())
        parts.dissipation = value->asString();
    if (const Value* const value = model.find("controls"); value && value->isObject())
        for (const auto& [name, text] : value->asObject()) parts.controls.push_back(name);
    return parts;
}

std::vector<std::string> equationLines(const Formula& formula, const PartTexts& parts, TextForm form) {
    if (parts.isEmpty()) return equationLines(formula, form);
    const auto symbolic = differentiate(formula);
    std::vector<Relation> relations;
    for (const bool isOfVelocities : {false, true}) {
        const auto& all = isOfVelocities ? parts.rolling : parts.constraints;
        for (const auto& [name, text] : all) {
            PartFormula read = PartFormula::of(formula, parts, text);
            if (read.symbolic)
                relations.push_back({std::move(read), isOfVelocities,
                                     multiplier(isOfVelocities, name, all.size() == 1, form)});
        }
    }
    std::vector<std::pair<std::string, PartFormula>> forces;
    for (const auto& [coordinate, text] : parts.forces)
        forces.emplace_back(coordinate, PartFormula::of(formula, parts, text));
    const PartFormula dissipation =
        parts.dissipation.empty() ? PartFormula() : PartFormula::of(formula, parts, parts.dissipation);
    std::vector<std::string> lines;
    const auto add = [&](const std::string& line) {
        lines.push_back(line.size() > longestLine ? "(too long to show)" : line);
    };
    for (std::size_t i = 0; i < symbolic->equations.size(); ++i) {
        const int k = static_cast<int>(i);
        RightSide right(form);
        for (const auto& [coordinate, force] : forces)
            if (coordinate == formula.coordinates[i] && force.symbolic)
                right.add({}, force, force.symbolic->value, false);
        if (dissipation.symbolic) right.add({}, dissipation, dissipation.byVelocity(k), true);
        for (const Relation& r : relations)
            right.add(r.multiplier, r.formula,
                      r.isOfVelocities ? r.formula.byVelocity(k) : r.formula.byPlace(k), false);
        add(typeset(symbolic->graph, symbolic->equations[i], formula, form) + " = " + right.text());
    }
    for (const Relation& r : relations)
        add(typeset(r.formula.symbolic->graph, r.formula.symbolic->value, r.formula.names, form) + " = 0");
    return lines;
}

std::string texOfEquations(const Formula& formula, const PartTexts& parts) {
    return alignedTex(equationLines(formula, parts, TextForm::tex));
}

std::string alignedTex(std::vector<std::string> lines) {
    if (lines.empty()) return {};
    std::string text = "\\begin{align*}\n";
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::string& line = lines[i];
        if (const auto equals = line.rfind(" = "); equals != std::string::npos) line.insert(equals + 1, "&");
        text += "  " + line + (i + 1 < lines.size() ? " \\\\\n" : "\n");
    }
    return text + "\\end{align*}\n";
}

}  // namespace extremal::typed
