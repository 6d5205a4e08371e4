// SPDX-License-Identifier: GPL-3.0-or-later
/// Where an expression has kinks and jumps: its switching functions.
///
/// Each is a function s of the names of the expression whose sign changes where the expression stops being
/// smooth, and nowhere else: abs(a): a; max(a, b) and a < b: a - b; floor(a): sin(pi a); a table of straight
/// lines: x - x_k for each of its points. Poles and the edges of domains (1/x, sqrt(x)) are not among them,
/// nor are the points of splines, which have two continuous derivatives.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/text/expression.hpp"

namespace extremal {

struct SwitchingFunction {
    Expression function;  ///< its text is written anew
    bool mayJump;         ///< of the expression: its value, else its slope only
};

/// In the order of the expression, each once.
std::vector<SwitchingFunction> switchingFunctions(const Expression& expression);

/// What is written in place of a node, if anything is; `write` writes its operands in the same way.
using WritePart = std::function<std::string(int node)>;
using TextOfNode = std::function<std::optional<std::string>(int node, const WritePart& write)>;

/// A part of an expression as it could be typed, with the names that functions have inside ("log" for ln).
std::string writtenPart(const Expression& expression, int node, const TextOfNode& replacement = {});

}  // namespace extremal
