// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/switching.hpp"

#include <algorithm>
#include <string_view>

#include "engine/core/text/indexed.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

bool isIn(std::string_view name, std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Writes parts of an expression.
class Writer {
public:
    Writer(const Expression& expression, const TextOfNode& replacement)
        : expression_(expression), replacement_(replacement) {}

    std::string write(int n) const {
        if (replacement_)
            if (const auto text = replacement_(n, [this](int part) { return write(part); }))
                return "(" + *text + ")";
        const Expression::Node& node = expression_.nodes[static_cast<std::size_t>(n)];
        switch (node.kind) {
            case Operator::number:
                return node.name.empty() ? formatNumber(node.number) : node.name;
            case Operator::name:
                return node.name;
            case Operator::negate:
                return "-" + operand(node.left);
            case Operator::add:
                return write(node.left) + " + " + operand(node.right);
            case Operator::subtract:
                return write(node.left) + " - " + operand(node.right);
            case Operator::multiply:
                return operand(node.left) + "*" + operand(node.right);
            case Operator::divide:
                return operand(node.left) + "/" + operand(node.right);
            case Operator::power:
                return operand(node.left) + "^" + operand(node.right);
            case Operator::call:
                return call(node);
        }
        return {};
    }
    /// In brackets unless it is a number, a name or a call.
    std::string operand(int n) const {
        const Expression::Node& node = expression_.nodes[static_cast<std::size_t>(n)];
        const bool isAtom = node.kind == Operator::number || node.kind == Operator::name ||
                            (node.kind == Operator::call && infix(node).empty());
        return isAtom ? write(n) : "(" + write(n) + ")";
    }

private:
    static std::string_view infix(const Expression::Node& node) {
        if (isIn(node.name, {"<", "<=", "==", "!="})) return node.name;
        return node.name == "and" ? "&&" : node.name == "or" ? "||" : "";
    }
    std::string call(const Expression::Node& node) const {
        if (const std::string_view sign = infix(node); !sign.empty())
            return operand(node.left) + " " + std::string(sign) + " " + operand(node.right);
        std::string text = node.name + "(" + write(node.left);
        if (node.table)
            for (const double x : node.table->abscissae())
                text += "; " + formatNumber(x) + ", " + formatNumber(node.table->at(x));
        for (const int n : {node.right, node.third})
            if (n >= 0) text += ", " + write(n);
        return text + ")";
    }

    const Expression& expression_;
    const TextOfNode& replacement_;
};

}  // namespace

std::string writtenPart(const Expression& expression, int node, const TextOfNode& replacement) {
    return Writer(expression, replacement).write(node);
}

std::vector<SwitchingFunction> switchingFunctions(const Expression& expression) {
    std::vector<SwitchingFunction> found;
    const TextOfNode asItIs;
    const Writer writer(expression, asItIs);
    const auto add = [&](const std::string& text, bool mayJump) {
        const auto same = std::find_if(found.begin(), found.end(),
                                       [&](const SwitchingFunction& s) { return s.function.text == text; });
        if (same != found.end())
            same->mayJump = same->mayJump || mayJump;
        else if (Expression function = parseWrittenOut(text); !function.names().empty())
            found.push_back({std::move(function), mayJump});
    };
    for (const Expression::Node& node : expression.nodes) {
        if (node.kind != Operator::call) continue;
        const auto isZero = [&](int n) {
            const Expression::Node& side = expression.nodes[static_cast<std::size_t>(n)];
            return side.kind == Operator::number && side.number == 0;
        };
        const auto difference = [&] {
            if (isZero(node.right)) return writer.write(node.left);
            if (isZero(node.left)) return writer.write(node.right);
            return writer.write(node.left) + " - " + writer.operand(node.right);
        };
        if (node.name == "abs")
            add(writer.write(node.left), false);
        else if (isIn(node.name, {"sign", "heaviside"}))
            add(writer.write(node.left), true);
        else if (isIn(node.name, {"max", "min"}))
            add(difference(), false);
        else if (isIn(node.name, {"<", "<=", "==", "!="}))
            add(difference(), true);
        else if (isIn(node.name, {"floor", "ceil"}))
            add("sin(pi*" + writer.operand(node.left) + ")", true);
        else if (node.name == "round")
            add("cos(pi*" + writer.operand(node.left) + ")", true);
        else if (node.name == "mod")
            add("sin(pi*" + writer.operand(node.left) + "/" + writer.operand(node.right) + ")", true);
        else if (node.table && node.table->kind() == Interpolant::Kind::linear)
            for (const double x : node.table->abscissae())
                add(x == 0 ? writer.write(node.left)
                           : writer.write(node.left) + (x < 0 ? " + " : " - ") + formatNumber(x < 0 ? -x : x),
                    false);
    }
    return found;
}

}  // namespace extremal
