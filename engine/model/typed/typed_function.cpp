// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/typed_function.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>

#include "engine/core/problem.hpp"
#include "engine/core/text/invalid_text.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/symbolic.hpp"
#include "engine/model/typed/tape/tape_registers.hpp"

namespace extremal::typed {
namespace {

/// Names that formulas know and functions of place do not.
void checkNames(const std::string& text, const Formula& formula) {
    std::vector<std::string> known = formula.coordinates;
    for (const auto& [name, value] : formula.parameters) known.push_back(name);
    known.push_back("pi");
    const Expression expression = parseExpression(text);
    for (const Expression::Node& node : expression.nodes) {
        const bool isName = node.kind == Operator::name,
                   isVelocity = node.kind == Operator::call && node.name == "dot";
        if (isVelocity || (isName && std::find(known.begin(), known.end(), node.name) == known.end()))
            throw ExpressionError("has an unknown name \"" + node.name + "\"", node.position,
                                  "it may use " + joinNames(known));
    }
}

}  // namespace

/// With parameters as symbols, and the tapes that were asked for with their values in place.
struct TypedFunction::Derivatives {
    std::shared_ptr<const SymbolicLagrangian> symbolic;
    int variables = 0, firstParameter = 0;
    std::vector<double> parameters;
    std::mutex guard;
    std::array<Tape, 3> tapes;
    std::array<std::atomic<bool>, 3> isMade{};

    /// f, its gradient, the lower triangle of its Hessian.
    std::vector<int> insertIn(Graph& to, Extent extent, const std::function<int(int)>& variableOf) const {
        std::vector<int> roots{symbolic->value};
        const auto add = [&](const std::vector<int>& from, int count) {
            roots.insert(roots.end(), from.begin(), from.begin() + count);
        };
        if (extent != Extent::value) add(symbolic->gradient, variables);
        if (extent == Extent::hessian) add(symbolic->hessian, variables * (variables + 1) / 2);
        return to.insert(symbolic->graph, roots, [&](int symbol) {
            const int k = symbol - firstParameter;
            return k < 0 ? variableOf(symbol) : to.number(parameters[static_cast<std::size_t>(k)]);
        });
    }
};

TypedFunction::TypedFunction(const std::string& text, const std::string& pointer,
                             std::vector<std::string> variables,
                             std::vector<std::pair<std::string, double>> parameters)
    : variables_(static_cast<int>(variables.size())) {
    Formula formula;
    formula.coordinates = std::move(variables);
    formula.parameters = std::move(parameters);
    formula.text = text;
    try {
        checkNames(text, formula);
        compile(formula);
    } catch (const ExpressionError& e) {
        throw invalidText(pointer, text, e, "the expression ");
    }
}

TypedFunction::TypedFunction(const Formula& formula) : variables_(formula.dimension()) { compile(formula); }

void TypedFunction::compile(const Formula& formula) {
    made_ = std::make_shared<Derivatives>();
    made_->symbolic = differentiate(formula);
    made_->variables = variables_;
    made_->firstParameter = formula.firstParameter();
    for (const auto& [name, value] : formula.parameters) made_->parameters.push_back(value);
}

const Tape& TypedFunction::tape(Extent extent) const {
    const auto k = static_cast<std::size_t>(extent);
    Derivatives& made = *made_;
    if (made.isMade[k].load(std::memory_order_acquire)) return made.tapes[k];
    const std::scoped_lock lock(made.guard);
    if (!made.isMade[k].load(std::memory_order_relaxed)) {
        Graph graph;
        const std::vector<int> roots =
            made.insertIn(graph, extent, [&](int symbol) { return graph.symbol(symbol); });
        made.tapes[k] = Tape::of(graph, roots, variables_);
        made.isMade[k].store(true, std::memory_order_release);
    }
    return made.tapes[k];
}

bool TypedFunction::isAffine() const {
    Graph graph;
    const std::vector<int> all =
        made_->insertIn(graph, Extent::hessian, [&](int symbol) { return graph.symbol(symbol); });
    return std::all_of(all.begin() + 1 + variables_, all.end(),
                       [&](int second) { return graph.isZero(second); });
}

GraphFunction TypedFunction::addTo(Graph& to, const std::vector<int>& variables) const {
    const std::vector<int> all = made_->insertIn(
        to, Extent::gradient, [&](int symbol) { return variables[static_cast<std::size_t>(symbol)]; });
    return {all.front(), {all.begin() + 1, all.end()}};
}

void TypedFunction::evaluate(const double* y, double* value, double* gradient, double* hessian) const {
    const Tape& all = tape(hessian ? Extent::hessian : gradient ? Extent::gradient : Extent::value);
    const TapeRegisters r(all, [&](double* front) { std::copy_n(y, variables_, front); });
    const auto d = static_cast<std::size_t>(variables_);
    *value = r[0];
    if (gradient)
        for (std::size_t i = 0; i < d; ++i) gradient[i] = r[1 + i];
    if (hessian)
        for (std::size_t i = 0; i < d * (d + 1) / 2; ++i) hessian[i] = r[1 + d + i];
}

}  // namespace extremal::typed
