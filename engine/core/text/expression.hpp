// SPDX-License-Identifier: GPL-3.0-or-later
/// Expressions as users type them: numbers, Lagrangians, potentials and profiles.
///
///     whole      = both { "||" both }
///     both       = comparison { "&&" comparison }
///     comparison = sum [ ("<" | "<=" | ">" | ">=" | "==" | "!=") sum ]
///     sum        = product { ("+" | "-") product }
///     product    = signed { ("*" | "/") signed }
///     signed     = ("+" | "-") signed | power
///     power      = atom [ "^" ("+" | "-")* power ]       right-associative, tighter than a sign before it
///     atom       = number | name | call | "(" whole ")"
///     call       = function "(" whole { "," whole } ")" | table "(" whole { ";" sum "," sum } ")"
///
/// Functions and what they mean: core/text/expression_functions.cpp. A comparison is 1 or 0, and not a number
/// where one of its sides is not. `pi` is a constant; names are [A-Za-z][A-Za-z0-9_]*, and a name before a
/// bracket is a function. dot(x), the velocity of x, is read as a call of "dot", and has a meaning in
/// Lagrangians only. Parsing is independent of meaning: the tree does not depend on which names exist.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/algebra/interpolant.hpp"

namespace extremal {

/// At most this many characters, and this many operators, functions and brackets nested in each other.
inline constexpr std::size_t maxExpressionLength = 10000;
inline constexpr int maxExpressionDepth = 200;

enum class Operator { number, name, negate, add, subtract, multiply, divide, power, call };

/// A function that expressions know: of one, two or three arguments, those that it does not have being 0.
struct ExpressionFunction {
    std::string_view name;
    int arguments;
    double (*value)(double a, double b, double c);
};

/// A parsed text: nodes in an order in which operands come before what uses them; the last node is the whole.
struct Expression {
    struct Node {
        Operator kind = Operator::number;
        double number = 0;  ///< number
        /// Name, the function called, or a number as it was written ("pi"). What is called may have another
        /// name than the text has: ln is log, a > b is "<" of b and a, piecewise is a chain of "if".
        std::string name;
        int left = -1, right = -1;                      ///< operands, as places in `nodes`; -1: it has fewer
        std::size_t position = 0;                       ///< byte in the text
        int third = -1;                                 ///< operand
        const ExpressionFunction* function = nullptr;   ///< of calls but dot and tables
        std::shared_ptr<const Interpolant> table = {};  ///< of a call of table or spline: what is looked up
    };
    std::string text;
    std::vector<Node> nodes;

    /// Names in order of appearance, each once, without pi.
    std::vector<std::string> names() const;
};

/// What is wrong with an expression, and at which byte.
class ExpressionError : public std::runtime_error {
public:
    ExpressionError(const std::string& message, std::size_t place, std::string remedy = {})
        : std::runtime_error(message), position(place), hint(std::move(remedy)) {}
    std::size_t position;
    std::string hint;  ///< may be empty
};

/// Throws ExpressionError.
Expression parseExpression(std::string_view text);

/// The value with these values of its names; a name without a value is an ExpressionError, a value that is
/// not finite is not.
double evaluate(const Expression& expression,
                const std::function<std::optional<double>(std::string_view)>& valueOf);

/// The value of a node that is not a name, given those of its operands (left, right, third).
double applyNode(const Expression::Node& node, double a, double b, double c);

/// Two lines: the text (so many bytes around the place if it is long), and a caret below the place.
std::string caretLines(std::string_view text, std::size_t position, std::size_t reach = 40,
                       std::string_view indent = "    ");

/// The text with every occurrence of a name replaced; what it is a part of stays, and so does a function of
/// this name, which a bracket follows. The text need not be valid.
std::string withNameReplaced(std::string_view text, std::string_view from, std::string_view to);

/// The names of all functions as users write them, without dot.
const std::vector<std::string>& expressionFunctions();

/// Some arguments that the function of this name accepts, with "@" where an expression may stand: "@, @".
std::string argumentsOf(std::string_view function);

/// The function of this internal name ("log", "<", "if"); null: there is no such function.
const ExpressionFunction* findFunction(std::string_view name);

/// Whether a name that has no meaning is that of a function: it lacks its brackets.
bool isFunctionName(std::string_view name);

/// Why a text cannot name a coordinate or a parameter: letters, digits and inner "_", a letter first, not
/// ending in "_t" (which makes velocities), no function of the first sixteen, not t, not pi. Later functions
/// may be names as well, so that scenes older than they are stay valid. Empty if it can.
std::string nameProblem(std::string_view name);

}  // namespace extremal
