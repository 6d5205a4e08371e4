// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/sweep/velocity_kernel.hpp"

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes.hpp"

namespace extremal {
namespace {

using VelocityNodes = VelocitySweep<double>;

/// G f at the nodes i..i+7. Sums are written out, as the compiler takes accumulators that live through a loop
/// apart (node_kernel.cpp).
Lanes coupled(const double* G, const double* f, int stride, int i) {
    const auto term = [&](int j) { return Lanes::load(G + j * stride + i) * Lanes(f[j]); };
    double sum[8] = {};
    for (int j = 0; j < stride; j += 8) {
        const Lanes part = ((term(j) + term(j + 1)) + (term(j + 2) + term(j + 3))) +
                           ((term(j + 4) + term(j + 5)) + (term(j + 6) + term(j + 7)));
        (Lanes::load(sum) + part).store(sum);
    }
    return Lanes::load(sum);
}

void coupleNodes(const double* G, const double* f, int, int stride, double* to) {
    for (int i = 0; i < stride; i += 8) coupled(G, f, stride, i).store(to + i);
}

void invertMasses(const VelocityNodes& s) {
    for (int i = 0; i < s.stride; i += 8) {
        const auto entry = [&](int k, int l) { return s.inverse + (k * s.d + l) * s.stride + i; };
        for (int k = 0; k < s.d; ++k) {
            const Lanes pivot = Lanes(1) / Lanes::load(entry(k, k));
            pivot.store(entry(k, k));
            for (int l = 0; l < s.d; ++l)
                if (l != k) (Lanes::load(entry(k, l)) * pivot).store(entry(k, l));
            for (int r = 0; r < s.d; ++r) {
                if (r == k) continue;
                const Lanes factor = Lanes::load(entry(r, k));
                for (int l = 0; l < s.d; ++l)
                    if (l != k)
                        (Lanes::load(entry(r, l)) - factor * Lanes::load(entry(k, l))).store(entry(r, l));
                (-(factor * pivot)).store(entry(r, k));
            }
        }
    }
}

void weighNodes(const VelocityNodes& s, const double* rate, double* parts) {
    for (int j = 0; j < s.stride; j += 8)
        (Lanes::load(s.weight + j) * Lanes::load(rate + j)).store(parts + j);
}

/// The sum of eight numbers that are not negative; a NaN among them is one in the sum.
double sumOf(const Lanes& lanes) {
    double v[8];
    lanes.store(v);
    return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

void correctVelocities(const VelocityNodes& s, int k) {
    const auto magnitude = [](double v) { return __builtin_fabs(v); };
    double change = 0, scale = 0;
    for (int i = 0; i < s.stride; i += 8) {
        double sum[8] = {};
        for (int l = 0; l < s.d; ++l)
            (Lanes::load(sum) +
             Lanes::load(s.inverse + (k * s.d + l) * s.stride + i) * Lanes::load(s.P + l * s.stride + i))
                .store(sum);
        double* const V = s.V + k * s.stride + i;
        const Lanes by = Lanes::load(sum), v = Lanes::load(V) + by, weight = Lanes::load(s.weight + i);
        v.store(V);
        change += sumOf((weight * by).map(magnitude));
        scale += sumOf((weight * v).map(magnitude));
    }
    s.size[k] = {change, scale};
}

void kickNodes(const VelocityNodes& s) {
    for (int k = 0; k < s.d; ++k) {
        const int at = k * s.stride;
        weighNodes(s, s.gradient + at, s.impulse + at);
        for (int i = 0; i < s.stride; i += 8) {
            const Lanes momentum =
                Lanes(s.p[k]) + (Lanes(s.carryP[k]) + coupled(s.nu, s.impulse + at, s.stride, i));
            (momentum - Lanes::load(s.gradient + s.d * s.stride + at + i)).store(s.P + at + i);
        }
    }
    for (int k = 0; k < s.d; ++k) correctVelocities(s, k);
}

void driftNodes(const VelocityNodes& s) {
    for (int k = 0; k < s.d; ++k) {
        const int at = k * s.stride;
        weighNodes(s, s.V + at, s.drift + at);
        for (int i = 0; i < s.stride; i += 8)
            (Lanes(s.q[k]) + (Lanes(s.carryQ[k]) + coupled(s.mu, s.drift + at, s.stride, i)))
                .store(s.Q + at + i);
    }
}

}  // namespace

template <>
VelocityKernel<double> velocityKernel() {
    return {ForThisMachine<&coupleNodes>::call(), ForThisMachine<&invertMasses>::call(),
            ForThisMachine<&kickNodes>::call(), ForThisMachine<&driftNodes>::call()};
}

}  // namespace extremal
