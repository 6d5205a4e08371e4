// SPDX-License-Identifier: GPL-3.0-or-later
/// H(t, q, p) at many nodes together, of systems that offer it.
#pragma once

#include <memory>

#include "engine/model/parts.hpp"

namespace extremal {

struct NodeEnergies {
    static constexpr PartInfo part{"node-energies", "energies at many nodes together", false};

    /// The model of the mechanics or Hamiltonian that they are of: where another has taken its place, they
    /// are those of another motion.
    std::shared_ptr<const void> of;
    std::shared_ptr<const void> model;  ///< first argument of the call
    /// Entry k of node i at k * nodes + i in q and p; `nodes` is a multiple of 8.
    void (*energies)(const void*, const double* t, int nodes, const double* q, const double* p,
                     double* values) = nullptr;
};

}  // namespace extremal
