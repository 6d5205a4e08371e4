// SPDX-License-Identifier: GPL-3.0-or-later
/// Formulas as a graph in which equal parts are one node: what symbolic differentiation is flattened to.
///
///     sum     = number + sum_k factor_k operand_k
///     product = prod_k operand_k ^ factor_k          (no number in it: c x is a sum of one term)
///     call    = function(operand_0 [, operand_1 [, operand_2]])
///
/// Of a sum inside a sum or to an integer power the number is positive, or without one the first factor:
/// c (a - b) and -c (b - a) are the same. Every node is made through the functions below, which bring it into
/// this form, combine like terms and like powers, and fold numbers. Operands are ordered by their structure
/// alone, before numbers are folded, so that equal formulas give equal graphs, to the last bit, whatever the
/// order they were made in: that of GiNaC depends on addresses. Of one shape they are ordered by their
/// symbols, so that the springs of a chain, or the terms of a sum over an index, have the same order and
/// signs everywhere in it (tape/tape_groups.hpp). A symbol is a number chosen by the caller.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/core/algebra/interpolant.hpp"

namespace extremal::typed {

enum class Function : std::uint8_t {
    sin,
    cos,
    tan,
    asin,
    acos,
    atan,
    atan2,
    sinh,
    cosh,
    tanh,
    exp,
    log,
    abs,
    sign,
    power,
    asinh,
    acosh,
    atanh,
    erf,
    erfc,
    floor,
    ceil,
    round,
    heaviside,
    hypot,
    max,
    min,
    less,
    lessOrEqual,
    equal,
    notEqual,
    choose,
    table
};
/// As it is named in an Expression; "power" is pow(a, b) with an exponent that is not a number; "if" is
/// choose, which is b where a is not 0, else c; "table" is a derivative of the interpolant of its node.
std::string_view name(Function function);
std::optional<Function> functionNamed(std::string_view name);

class Graph {
public:
    enum class Kind : std::uint8_t { number, symbol, sum, product, call };
    struct Operand {
        int node;
        double factor = 1;  ///< coefficient in a sum, exponent in a product
        bool operator==(const Operand&) const = default;
    };
    /// Where a node stands among the operands of another. The shape says nothing of symbols and coefficients.
    struct Rank {
        std::uint64_t shape = 0;
        int firstSymbol = std::numeric_limits<int>::max(), lastSymbol = -1;
        std::uint64_t hash = 0;
        auto operator<=>(const Rank&) const = default;
    };
    struct Node {
        Kind kind = Kind::number;
        double number = 0;  ///< number; the constant of a sum
        int symbol = -1;
        Function function = Function::sin;
        std::vector<Operand> operands;
        Rank rank;
        std::shared_ptr<const Interpolant> table;  ///< of the function `table`
        int order = 0;                             ///< of its derivative
    };

    int number(double value);
    int symbol(int index);
    int sum(double constant, const std::vector<Operand>& operands);
    int product(const std::vector<Operand>& operands);
    int call(Function function, int a, int b = -1, int c = -1);
    int lookUp(std::shared_ptr<const Interpolant> table, int order, int a);
    int scaled(int node, double factor) { return sum(0, {{node, factor}}); }

    const Node& at(int node) const { return nodes_[static_cast<std::size_t>(node)]; }
    int size() const { return static_cast<int>(nodes_.size()); }
    bool isNumber(int node) const { return at(node).kind == Kind::number; }
    bool isZero(int node) const { return isNumber(node) && at(node).number == 0; }

    /// Makes these nodes of another graph here, with numbers in place of the symbols that have one.
    /// `rename`: another number for each of the others; empty: they keep theirs.
    std::vector<int> adopt(const Graph& from, const std::vector<int>& roots,
                           const std::function<std::optional<double>(int symbol)>& valueOf,
                           const std::function<int(int symbol)>& rename = {});
    /// Makes them here with these nodes in place of the symbols.
    std::vector<int> insert(const Graph& from, const std::vector<int>& roots,
                            const std::function<int(int symbol)>& nodeOf);

    /// Whether any of the roots depends on a symbol that the predicate picks.
    bool dependsOn(const std::vector<int>& roots, const std::function<bool(int symbol)>& picks) const;

private:
    int intern(Node node);
    Rank rankOf(const Node& node) const;
    /// Of a sum: whether its number, or without one its first factor, is negative.
    static bool isNegative(const Node& node);
    int negative(int node);
    std::vector<Operand> ordered(std::vector<Operand> operands) const;

    std::vector<Node> nodes_;
    std::unordered_multimap<std::uint64_t, int> known_;
};

/// The nodes of a function and of its gradient in some variables.
struct GraphFunction {
    int value = 0;
    std::vector<int> gradient;
};

}  // namespace extremal::typed
