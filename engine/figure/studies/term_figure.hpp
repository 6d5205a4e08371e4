// SPDX-License-Identifier: GPL-3.0-or-later
/// The plot of what each term of a Lagrangian costs to leave out (study/search/term_costs.hpp).
#pragma once

#include <string>
#include <vector>

#include "engine/figure/figure.hpp"
#include "engine/study/search/term_costs.hpp"

namespace extremal {

/// A bar up to the first order of each term, from the cheapest up, with a dot where it was measured without
/// the term. `error`: title of the errors.
Figure termFigure(const std::vector<TermCost>& costs, const std::string& error);

}  // namespace extremal
