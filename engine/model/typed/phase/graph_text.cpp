// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/phase/graph_text.hpp"

#include "engine/core/text/expression.hpp"
#include "engine/core/text/text.hpp"

namespace extremal::typed {
namespace {

constexpr std::size_t longestText = 1000000;

std::string written(double value) {
    return value < 0 ? "(" + formatNumber(value) + ")" : formatNumber(value);
}

class GraphText {
public:
    GraphText(const Graph& graph, const std::vector<std::string>& symbols)
        : graph_(graph), symbols_(symbols) {}

    std::string text(int node) {
        const Graph::Node& here = graph_.at(node);
        std::string result;
        switch (here.kind) {
            case Graph::Kind::number:
                return written(here.number);
            case Graph::Kind::symbol:
                return symbols_.at(static_cast<std::size_t>(here.symbol));
            case Graph::Kind::sum:
                result = "(" + written(here.number);
                for (const Graph::Operand& each : here.operands)
                    result += "+" + (each.factor == 1 ? "" : written(each.factor) + "*") + text(each.node);
                return limited(result + ")");
            case Graph::Kind::product:
                for (const Graph::Operand& each : here.operands)
                    result += (result.empty() ? "(" : "*") + text(each.node) +
                              (each.factor == 1 ? "" : "^" + written(each.factor));
                return limited(result + ")");
            case Graph::Kind::call:
                break;
        }
        if (here.table) throw ExpressionError("has a table, whose integral is not known", 0, "a formula");
        const std::string called(here.function == Function::power ? "^" : name(here.function));
        if (const bool isOperator = called.find_first_of("^<=!") == 0; isOperator)
            return limited("((" + text(here.operands[0].node) + ")" + called + "(" +
                           text(here.operands[1].node) + "))");
        for (const Graph::Operand& each : here.operands)
            result += (result.empty() ? "" : ",") + text(each.node);
        return limited(called + "(" + result + ")");
    }

private:
    static std::string limited(std::string text) {
        if (text.size() > longestText)
            throw ExpressionError("has too long a derivative", 0, "a shorter formula");
        return text;
    }

    const Graph& graph_;
    const std::vector<std::string>& symbols_;
};

}  // namespace

std::string textOf(const Graph& graph, int node, const std::vector<std::string>& symbols) {
    return GraphText(graph, symbols).text(node);
}

}  // namespace extremal::typed
