// SPDX-License-Identifier: GPL-3.0-or-later
/// H(q, p) as a formula, of systems that are typed: what is made of it and of other formulas is one formula,
/// in which parts that they have in common are computed once.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/model/parts.hpp"
#include "engine/model/typed/graph.hpp"

namespace extremal {

struct EnergyFormula {
    static constexpr PartInfo part{"energy-formula", "the energy as a formula", false};

    /// The model of the mechanics or Hamiltonian that it is of: where another has taken its place, it is the
    /// energy of another motion.
    std::shared_ptr<const void> of;
    /// Adds H and its gradient to a graph, where it can be written down; `variables` are the nodes of q, then
    /// of p. Of an H without t.
    std::function<std::optional<typed::GraphFunction>(typed::Graph& to, const std::vector<int>& variables)>
        addTo;
};

}  // namespace extremal
