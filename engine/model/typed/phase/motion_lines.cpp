// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/phase/motion_lines.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "engine/model/typed/part_equations.hpp"
#include "engine/model/typed/phase/typed_hamiltonian.hpp"
#include "engine/model/typed/phase/typed_poisson.hpp"
#include "engine/model/typed/phase/typed_variables.hpp"
#include "engine/model/typed/symbolic.hpp"
#include "engine/model/typed/typed_model.hpp"
#include "engine/model/typed/written_out.hpp"

namespace extremal::typed {
namespace {

constexpr std::size_t longestSide = 3000;
constexpr int mostVariables = 24;

/// A graph of several formulas in the same names, whose rates are the velocities of typed/formula.hpp.
class Equations {
public:
    Equations(Formula variables, TextForm form) : names_(std::move(variables)), form_(form) {}

    int dimension() const { return names_.dimension(); }
    /// The derivatives of a formula by its variables, and behind them its value.
    std::vector<int> read(const std::string& text) {
        Formula formula = names_;
        formula.text = text;
        const auto symbolic = differentiate(formula);
        std::vector<int> roots(symbolic->gradient.begin(), symbolic->gradient.begin() + dimension());
        roots.push_back(symbolic->value);
        return graph_.adopt(symbolic->graph, roots, [](int) { return std::optional<double>(); });
    }
    Graph& graph() { return graph_; }
    int rate(int i) { return graph_.symbol(dimension() + i); }
    int difference(int a, int b) { return graph_.sum(0, {{a, 1}, {b, -1}}); }
    int product(int a, int b) { return graph_.product({{a, 1}, {b, 1}}); }

    void add(int left, int right) {
        std::string text = side(left);
        if (text.starts_with("-") || text.starts_with("−")) {
            text = side(graph_.scaled(left, -1));
            right = graph_.scaled(right, -1);
        }
        lines_.push_back(text + " = " + side(right));
    }
    std::vector<std::string> lines() && { return std::move(lines_); }

private:
    std::string side(int node) const {
        std::string text = typeset(graph_, node, names_, form_);
        return text.size() > longestSide ? "(too long to show)" : text;
    }

    Formula names_;
    TextForm form_;
    Graph graph_;
    std::vector<std::string> lines_;
};

std::vector<std::string> hamiltonLines(const Settings& model, TextForm form) {
    const Formula formula = phaseFormulaOf(model);
    Equations equations(formula, form);
    const int n = equations.dimension(), d = n / 2;
    if (n > mostVariables) return {};
    const std::vector<int> slopes = equations.read(formula.text);
    for (int k = 0; k < n; ++k) {
        const int slope = slopes[static_cast<std::size_t>(k < d ? d + k : k - d)];
        equations.add(equations.rate(k), k < d ? slope : equations.graph().scaled(slope, -1));
    }
    return std::move(equations).lines();
}

/// Names and parameters of a model in typed variables.
Formula variableNames(const Settings& model) {
    Formula made;
    made.coordinates = variablesOf(model);
    made.parameters = parametersOf(model);
    return made;
}

std::vector<std::string> oneFormLines(const Settings& model, TextForm form) {
    Equations equations(variableNames(model), form);
    const int n = equations.dimension();
    if (n > mostVariables) return {};
    const Value* const forms = model.find("one_form");
    std::vector<std::vector<int>> slopes;  // (j, i): of theta_j by x_i
    for (const std::string& name : variablesOf(model)) {
        const Value* const text = forms && forms->isObject() ? forms->find(name) : nullptr;
        slopes.push_back(equations.read(text ? text->asString() : "0"));
    }
    const std::vector<int> energy = equations.read(energyTextOf(model));
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    for (int i = 0; i < n; ++i) {
        std::vector<Graph::Operand> row;
        for (int j = 0; j < n; ++j) {
            const int Om = equations.difference(slopes[at(j)][at(i)], slopes[at(i)][at(j)]);
            if (!equations.graph().isZero(Om)) row.push_back({equations.product(Om, equations.rate(j)), 1});
        }
        equations.add(equations.graph().sum(0, row), energy[at(i)]);
    }
    return std::move(equations).lines();
}

std::vector<std::string> bracketLines(const Settings& model, TextForm form) {
    Equations equations(variableNames(model), form);
    const int n = equations.dimension();
    if (n > mostVariables) return {};
    const std::vector<int> energy = equations.read(energyTextOf(model));
    std::vector<std::vector<Graph::Operand>> rates(static_cast<std::size_t>(n));
    for (const BracketText& entry : bracketTextsOf(model)) {
        const int J = equations.read(entry.text).back();
        rates[entry.i].push_back({equations.product(J, energy[entry.j]), 1});
        rates[entry.j].push_back({equations.product(J, energy[entry.i]), -1});
    }
    for (int i = 0; i < n; ++i)
        equations.add(equations.rate(i), equations.graph().sum(0, rates[static_cast<std::size_t>(i)]));
    return std::move(equations).lines();
}

}  // namespace

bool hasMotionLines(const Settings& model) {
    constexpr const char* types[] = {"lagrangian", "hamiltonian", "phase-space", "poisson"};
    return std::find(std::begin(types), std::end(types), model.type) != std::end(types);
}

std::vector<std::string> motionLines(const Settings& model, TextForm form) {
    if (model.type == "lagrangian")
        return equationLines(formulaOf(model), partTextsOf(writtenOut(model)), form);
    if (model.type == "hamiltonian") return hamiltonLines(model, form);
    if (model.type == "phase-space") return oneFormLines(model, form);
    if (model.type == "poisson") return bracketLines(model, form);
    return {};
}

std::string texOfMotion(const Settings& model) { return alignedTex(motionLines(model, TextForm::tex)); }

}  // namespace extremal::typed
