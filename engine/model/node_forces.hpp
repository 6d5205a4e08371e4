// SPDX-License-Identifier: GPL-3.0-or-later
/// The forces of a separable model at many nodes together, in the instruction set of this machine.
///
/// A model opts in by `static constexpr bool isNodeParallel = true`; its `potential` (and `force`) must then
/// be generic in Lanes, too: plain arithmetic and sqrt are worth it, other functions run lane by lane.
#pragma once

#include <array>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/jet.hpp"
#include "engine/core/algebra/lanes.hpp"
#include "engine/core/algebra/lanes_trigonometry.hpp"

namespace extremal {

template <class M>
concept NodeParallelModel = requires {
    requires M::isNodeParallel;
};

template <class M>
struct NodeForces {
    using Call = void (*)(const void*, const double* t, int nodes, const double* q, double* f);

    /// For the model at the start of what `model` points to.
    static Call call() { return ForThisMachine<&lanes>::call(); }

private:
    static constexpr std::size_t d = static_cast<std::size_t>(M::dimension);

    static void lanes(const void* model, const double* t, int nodes, const double* q, double* f) {
        const M& m = *static_cast<const M*>(model);
        for (int i = 0; i < nodes; i += 8) {
            std::array<Lanes, d> force;
            const auto at = [&](std::size_t k) { return static_cast<int>(k) * nodes + i; };
            if constexpr (requires(const Lanes* x, Lanes* y) { m.force(x[0], x, y); }) {
                std::array<Lanes, d> Q;
                for (std::size_t k = 0; k < d; ++k) Q[k] = Lanes::load(q + at(k));
                m.force(Lanes::load(t + i), Q.data(), force.data());
            } else {
                using S = Dual<Lanes, M::dimension>;
                std::array<S, d> Q;
                for (std::size_t k = 0; k < d; ++k)
                    Q[k] = S::variable(Lanes::load(q + at(k)), static_cast<int>(k));
                const S U = m.potential(Lanes::load(t + i), Q);
                for (std::size_t k = 0; k < d; ++k) force[k] = -U.g[k];
            }
            for (std::size_t k = 0; k < d; ++k) force[k].store(f + at(k));
        }
    }
};

}  // namespace extremal
