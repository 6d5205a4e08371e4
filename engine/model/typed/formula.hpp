// SPDX-License-Identifier: GPL-3.0-or-later
/// A Lagrangian as a user types it, with every name in it understood.
///
/// Names are the coordinates, their velocities (x_t or dot(x)), the parameters, controls and t. Symbols are
/// numbered
///     q_i: i,   v_i: d + i,   t: 2d,   acceleration of q_i: 2d + 1 + i,   parameter k: 3d + 1 + k.
/// Errors: ExpressionError with the place in the text; an unknown name comes with the nearest known one.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/text/expression.hpp"

namespace extremal::typed {

/// At most this many coordinates.
inline constexpr std::size_t maxCoordinates = 2000;
/// Up to here each is differentiated by each, and what is done for a state has room on the stack.
inline constexpr std::size_t fewCoordinates = 64;

struct Formula {
    std::vector<std::string> coordinates;
    std::vector<std::pair<std::string, double>> parameters;
    std::string text;  ///< of the whole Lagrangian
    /// Its terms, by name, where it is typed in terms; their sum is the text.
    std::vector<std::pair<std::string, std::string>> terms = {};
    /// Functions of t by name (controls.hpp), which formulas may use.
    std::vector<std::pair<std::string, Expression>> controls = {};
    /// Its texts were written out from sums and names by index (core/text/indexed.hpp), and may be long.
    bool isExpanded = false;

    int dimension() const { return static_cast<int>(coordinates.size()); }
    int time() const { return 2 * dimension(); }
    int acceleration(int i) const { return 2 * dimension() + 1 + i; }
    int firstParameter() const { return 3 * dimension() + 1; }
};

/// The parsed text; symbol[n] is the symbol that node n stands for, or -1; constant[n] is its value where it
/// has no symbol at all, or, inside exponents, none but parameters: x^n is differentiated with n in place.
struct ResolvedFormula {
    Expression expression;
    std::vector<int> symbol;
    std::vector<std::optional<double>> constant;
    std::vector<double> exponents;  ///< the values of parameters that were put in place, in order
};
ResolvedFormula resolve(const Formula& formula);

}  // namespace extremal::typed
