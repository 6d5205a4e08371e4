// SPDX-License-Identifier: GPL-3.0-or-later
/// The plot of what each term of a Lagrangian costs to leave out (study/search/term_costs.hpp).
#pragma once

#include <string>
#include <vector>

#include "engine/figure/figure.hpp"
#include "engine/study/search/term_costs.hpp"

namespace extremal {

/// A bar up to the first order of each term, from the cheapest up, with a dot where it was measured without
/// the term. `error`: title of the errors; `wishes`: lines, of which a term may go left of those that are
/// TermCost::safety times its bar.
Figure termFigure(const std::vector<TermCost>& costs, const std::string& error,
                  const std::vector<double>& wishes);

}  // namespace extremal
