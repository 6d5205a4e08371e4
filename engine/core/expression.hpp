/// Expressions as users type them: numbers, Lagrangians, potentials and profiles.
///
///     sum     = product { ("+" | "-") product }
///     product = signed { ("*" | "/") signed }
///     signed  = ("+" | "-") signed | power
///     power   = atom [ "^" ("+" | "-")* power ]           right-associative, tighter than a sign before it
///     atom    = number | name | function "(" sum { "," sum } ")" | "(" sum ")"
///
/// Functions: sin cos tan asin acos atan atan2 sinh cosh tanh exp log sqrt abs sign stumpff. `pi` is a
/// constant; names are [A-Za-z][A-Za-z0-9_]*. dot(x), the velocity of x, is read as a call of "dot", and has
/// a meaning in Lagrangians only. Parsing is independent of meaning: the tree does not depend on which names
/// exist.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace extremal {

/// At most this many characters, and this many operators, functions and brackets nested in each other.
inline constexpr std::size_t maxExpressionLength = 10000;
inline constexpr int maxExpressionDepth = 200;

enum class Operator { number, name, negate, add, subtract, multiply, divide, power, call };

/// A parsed text: nodes in an order in which operands come before what uses them; the last node is the whole.
struct Expression {
    struct Node {
        Operator kind = Operator::number;
        double number = 0;          ///< number
        std::string name;           ///< name, the function called, or a number as it was written ("pi")
        int left = -1, right = -1;  ///< operands, as places in `nodes`; -1: none
        std::size_t position = 0;   ///< byte in the text
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

/// Two lines: the text (so many bytes around the place if it is long), and a caret below the place.
std::string caretLines(std::string_view text, std::size_t position, std::size_t reach = 40,
                       std::string_view indent = "    ");

/// The text with every occurrence of a name replaced; what it is a part of stays. The text need not be valid.
std::string withNameReplaced(std::string_view text, std::string_view from, std::string_view to);

/// All functions that expressions know, without dot.
const std::vector<std::string>& expressionFunctions();

/// The value of a function at a (and b: atan2 and stumpff).
double applyFunction(std::string_view function, double a, double b);

/// Why a text cannot name a coordinate or a parameter: letters, digits and inner "_", a letter first, not
/// ending in "_t" (which makes velocities), no function, not t, not pi. Empty if it can.
std::string nameProblem(std::string_view name);

}  // namespace extremal
