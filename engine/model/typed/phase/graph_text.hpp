// SPDX-License-Identifier: GPL-3.0-or-later
/// A node of a graph as an expression that can be typed.
#pragma once

#include <string>
#include <vector>

#include "engine/model/typed/graph.hpp"

namespace extremal::typed {

/// `symbols`: a text for each, in parentheses where it is more than a name. Common parts are written out as
/// often as they occur. Throws ExpressionError for a table, which has no text, and for more than a million
/// characters.
std::string textOf(const Graph& graph, int node, const std::vector<std::string>& symbols);

}  // namespace extremal::typed
