// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/typed_function.hpp"

#include <algorithm>
#include <optional>
#include <span>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/invalid_text.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/symbolic.hpp"
#include "engine/model/typed/tape/node_tape.hpp"
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

/// `tape`: the gradient, behind f where there are `values`.
void outputsOfNodes(const Tape& tape, int nodes, const double* y, double* values, double* gradients) {
    const int variables = static_cast<int>(tape.inputs());
    for (int i = 0; i < nodes; i += 8)
        runEight(
            tape,
            [&](Lanes* r) {
                for (int k = 0; k < variables; ++k) r[k] = Lanes::load(y + k * nodes + i);
            },
            [&](std::size_t output, const Lanes& value) {
                const int k = static_cast<int>(output) - (values ? 1 : 0);
                value.store((k < 0 ? values : gradients + k * nodes) + i);
            });
}

}  // namespace

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
    const auto symbolic = differentiate(formula);
    const int d = variables_;
    std::vector<int> roots{symbolic->value};
    roots.insert(roots.end(), symbolic->gradient.begin(), symbolic->gradient.begin() + d);
    roots.insert(roots.end(), symbolic->hessian.begin(), symbolic->hessian.begin() + d * (d + 1) / 2);
    Graph graph;
    const std::vector<int> here =
        graph.adopt(symbolic->graph, roots, [&](int symbol) -> std::optional<double> {
            const int k = symbol - formula.firstParameter();
            if (k < 0) return {};
            return formula.parameters[static_cast<std::size_t>(k)].second;
        });
    const std::span<const int> all(here);
    value_ = Tape::of(graph, all.first(1), d);
    gradient_ = Tape::of(graph, all.subspan(1, static_cast<std::size_t>(d)), d);
    slopes_ = Tape::of(graph, all.first(static_cast<std::size_t>(1 + d)), d);
    all_ = Tape::of(graph, all, d);
    isAffine_ =
        std::all_of(here.begin() + 1 + d, here.end(), [&](int second) { return graph.isZero(second); });
}

void TypedFunction::evaluate(const double* y, double* value, double* gradient, double* hessian) const {
    const Tape& tape = hessian ? all_ : gradient ? slopes_ : value_;
    const TapeRegisters r(tape, [&](double* front) { std::copy_n(y, variables_, front); });
    const auto d = static_cast<std::size_t>(variables_);
    *value = r[0];
    if (gradient)
        for (std::size_t i = 0; i < d; ++i) gradient[i] = r[1 + i];
    if (hessian)
        for (std::size_t i = 0; i < d * (d + 1) / 2; ++i) hessian[i] = r[1 + d + i];
}

void TypedFunction::evaluateNodes(int nodes, const double* y, double* values, double* gradients) const {
    static const auto call = ForThisMachine<&outputsOfNodes>::call();
    call(values ? slopes_ : gradient_, nodes, y, values, gradients);
}

}  // namespace extremal::typed
