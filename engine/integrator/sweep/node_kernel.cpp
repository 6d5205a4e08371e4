// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/sweep/node_kernel.hpp"

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes.hpp"
#include "engine/core/algebra/largest_lane.hpp"

namespace extremal {
namespace {

/// Column j of G times F_j, nodes i..i+7.
Lanes term(const Sweep<double>& s, const double* F, int i, int j) {
    return Lanes::load(s.G + j * s.stride + i) * Lanes(F[j]);
}

/// Sums are written out and go through memory every eight terms: the compiler keeps straight lines of Lanes
/// in vector registers, but takes accumulators that live through a loop apart.
void sweepLanes(const Sweep<double>& s) {
    for (int k = 0; k < s.d; ++k) {
        const double* F = s.F + k * s.stride;
        if (s.weight) {
            double* const impulse = s.impulse + k * s.stride;
            for (int j = 0; j < s.stride; j += 8)
                (Lanes::load(s.weight + j) * Lanes::load(F + j)).store(impulse + j);
            F = impulse;
        }
        double change = 0, scale = 0;
        for (int i = 0; i < s.stride; i += 8) {
            double* Z = s.Z + k * s.stride + i;
            double sum[8] = {}, moved[8], far[8];
            for (int j = 0; j < s.stride; j += 8) {
                const Lanes part = ((term(s, F, i, j) + term(s, F, i, j + 1)) +
                                    (term(s, F, i, j + 2) + term(s, F, i, j + 3))) +
                                   ((term(s, F, i, j + 4) + term(s, F, i, j + 5)) +
                                    (term(s, F, i, j + 6) + term(s, F, i, j + 7)));
                (Lanes::load(sum) + part).store(sum);
            }
            const Lanes z =
                Lanes::load(s.base + k * s.stride + i) + Lanes::load(sum) * Lanes(s.inverseMass[k]);
            if (s.size) {
                const auto magnitude = [](double v) { return __builtin_fabs(v); };
                (z - Lanes::load(Z)).map(magnitude).store(moved);
                z.map(magnitude).store(far);
                change = larger(change, largestLane(moved));
                scale = larger(scale, largestLane(far));
            }
            z.store(Z);
            (Lanes(s.q[k]) + z).store(s.Q + k * s.stride + i);
        }
        if (s.size) s.size[k] = {change, scale};
    }
}

}  // namespace

SweepCall nodeParallelSweep() { return ForThisMachine<&sweepLanes>::call(); }

}  // namespace extremal
