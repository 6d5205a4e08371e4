// SPDX-License-Identifier: GPL-3.0-or-later
/// The plot of a search over elements and steps together (study/search/mesh_fit.hpp).
#pragma once

#include <optional>

#include "engine/figure/figure.hpp"
#include "engine/study/sweep.hpp"

namespace extremal {

/// Errors over steps and elements as the fitted model has them, as colours; the runs that it is fitted to,
/// the line of the wish, faint lines of equal cost through the answer and at 4 and 1/4 times that. Of the
/// first scheme that has a model, the cheapest first; nothing where none has.
std::optional<Figure> meshFigure(const Sweep& sweep);

}  // namespace extremal
