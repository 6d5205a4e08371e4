// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/lie/quaternion_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/algebra/instruction_set.hpp"

namespace extremal {
namespace {

using Four [[gnu::vector_size(32)]] = double;

[[gnu::always_inline]] inline void load(Four& to, const double* from) {
    __builtin_memcpy(&to, from, sizeof(Four));
}
[[gnu::always_inline]] inline void store(double* to, const Four& from) {
    __builtin_memcpy(to, &from, sizeof(Four));
}

/// F at Q, for four stages; returns the squares of what changed.
[[gnu::always_inline]] inline Four rates(const QuaternionStages& s, const Four (&Q)[4], double* F) {
    const Four &w = Q[0], &x = Q[1], &y = Q[2], &z = Q[3];
    const double p1 = s.momentum[0], p2 = s.momentum[1], p3 = s.momentum[2];
    const Four ww = w * w, xx = x * x, yy = y * y, zz = z * z, xy = x * y, wz = w * z, xz = x * z, wy = w * y,
               yz = y * z, wx = w * x;
    // Half of I^-1 vec(Q^* pi Q).
    const Four r1 = s.halfRate[0] * (p1 * ((ww - zz) + (xx - yy)) + 2 * (p2 * (xy + wz) + p3 * (xz - wy)));
    const Four r2 = s.halfRate[1] * (p2 * ((ww - zz) - (xx - yy)) + 2 * (p1 * (xy - wz) + p3 * (yz + wx)));
    const Four r3 = s.halfRate[2] * (p3 * ((ww + zz) - (xx + yy)) + 2 * (p1 * (xz + wy) + p2 * (yz - wx)));
    const Four now[4] = {-(x * r1 + y * r2 + z * r3), w * r1 + (y * r3 - z * r2), w * r2 + (z * r1 - x * r3),
                         w * r3 + (x * r2 - y * r1)};
    Four square = {};
    for (int c = 0; c < 4; ++c) {
        double* const to = F + c * QuaternionStages::most;
        Four last;
        load(last, to);
        const Four change = now[c] - last;
        square += change * change;
        store(to, now[c]);
    }
    return square;
}

/// Vectors: of four stages each, 1 or 2.
template <int vectors>
void sweep(QuaternionStages& s) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon(),
                     most = std::numeric_limits<double>::max();
    double scale = 0;
    for (int c = 0; c < 4; ++c) scale += s.F[c][0] * s.F[c][0];
    const double goal = 0.25 * std::max(s.tolerance, epsilon);
    double last = 1;
    s.isSolved = false;
    for (s.sweeps = 0; s.sweeps < s.maxSweeps && !s.isSolved;) {
        Four Q[vectors][4];
        for (int u = 0; u < vectors; ++u)
            for (int c = 0; c < 4; ++c) Q[u][c] = Four{} + s.start[c];
        for (int j = 0; j < s.stages; ++j)
            for (int u = 0; u < vectors; ++u) {
                Four column;
                load(column, s.a[j] + 4 * u);
                for (int c = 0; c < 4; ++c) Q[u][c] += column * s.F[c][j];
            }
        Four square = {};
        for (int u = 0; u < vectors; ++u) square += rates(s, Q[u], s.F[0] + 4 * u);
        ++s.sweeps;
        const double changed = (square[0] + square[1]) + (square[2] + square[3]);
        if (!(changed <= most)) return;
        s.change = scale > 0 ? std::sqrt(changed / scale) : std::sqrt(changed);
        // What the next one would change, if it contracts as this one did; or round-off.
        s.isSolved = s.change * std::min(1.0, s.change / last) <= goal ||
                     (s.change < 16 * epsilon && s.change >= 0.25 * last);
        last = s.change;
    }
}

}  // namespace

QuaternionSweeps quaternionSweeps(int stages) {
    return stages <= 4 ? ForThisMachine<&sweep<1>>::call() : ForThisMachine<&sweep<2>>::call();
}

}  // namespace extremal
