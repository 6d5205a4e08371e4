// SPDX-License-Identifier: GPL-3.0-or-later
/// Formulas for people: Greek letters, subscripts, powers, primes for time derivatives.
///
/// Three forms: rich text (a subset of HTML: sup, sub, i) for the window, plain Unicode for the command line,
/// and TeX, with dots for time derivatives, for documents.
#pragma once

#include <string>
#include <vector>

#include "engine/model/typed/formula.hpp"
#include "engine/model/typed/symbolic.hpp"

namespace extremal::typed {

/// "theta1" -> "θ₁", "omega_0" -> "ω₀", "x" -> "x": plain Unicode, for axes and legends.
std::string symbolOf(const std::string& name);

enum class TextForm { plain, rich, tex };

/// A node of the graph as a formula.
std::string typeset(const Graph& graph, int node, const Formula& formula, TextForm form);

/// "m x″ + k x = 0", one line per coordinate; empty for formulas that would fill pages.
std::vector<std::string> equationLines(const Formula& formula, TextForm form);

}  // namespace extremal::typed
