// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/leapfrog_kernel.hpp"

#include <algorithm>

#include "engine/core/algebra/instruction_set.hpp"

namespace extremal {
namespace {

/// v+ and u' of inner nodes [from, to).
inline void move(const double* __restrict u, const double* __restrict v, double* __restrict nextU,
                 double* __restrict nextV, std::size_t from, std::size_t to, const LeapfrogKernel* c) {
    const double h = c->h, half = h / 2, k = c->k, alpha = c->slope.linear, beta = c->slope.cubic;
    for (std::size_t i = from; i < to; ++i) {
        const double a = k * ((u[i - 1] - u[i]) + (u[i + 1] - u[i])) - u[i] * (alpha + beta * u[i] * u[i]);
        nextV[i] = v[i] + half * a;
        nextU[i] = u[i] + h * nextV[i];
    }
}

/// v' of inner nodes [from, to) from v+, in place.
inline void kick(const double* __restrict u, double* __restrict v, std::size_t from, std::size_t to,
                 const LeapfrogKernel* c) {
    const double half = c->h / 2, k = c->k, alpha = c->slope.linear, beta = c->slope.cubic;
    for (std::size_t i = from; i < to; ++i)
        v[i] += half * (k * ((u[i - 1] - u[i]) + (u[i + 1] - u[i])) - u[i] * (alpha + beta * u[i] * u[i]));
}

/// Adds 0 x of all values: NaN where one is not finite. Sums side by side do not wait for each other.
inline void addZeros(const double* __restrict x, std::size_t from, std::size_t to, double* __restrict sums) {
    constexpr std::size_t lanes = 16;
    std::size_t i = from;
    for (; i + lanes <= to; i += lanes)
        for (std::size_t l = 0; l < lanes; ++l) sums[l] += 0 * x[i + l];
    for (; i < to; ++i) sums[0] += 0 * x[i];
}

/// The velocity of an end after a kick: the neighbours of a free end are both the one that is there.
inline double kickedEnd(double v, double u, double left, double right, const LeapfrogKernel* c) {
    if (c->boundary == Boundary::dirichlet) return v;
    return v + c->h / 2 * (c->k * ((left - u) + (right - u)) - u * (c->slope.linear + c->slope.cubic * u * u));
}

void stepAll(const LeapfrogKernel* c, const double* u, const double* v, double* nextU, double* nextV,
             std::size_t n, double* sums) {
    constexpr std::size_t block = 512;
    const bool isPeriodic = c->boundary == Boundary::periodic, isFixed = c->boundary == Boundary::dirichlet;
    const std::size_t last = n - 1;
    const auto before = [&](const double* x) { return isPeriodic ? x[last] : x[1]; };
    const auto after = [&](const double* x) { return isPeriodic ? x[0] : x[last - 1]; };
    const auto moveEnd = [&](std::size_t i, double left, double right) {
        nextV[i] = kickedEnd(v[i], u[i], left, right, c);
        nextU[i] = isFixed ? u[i] : u[i] + c->h * nextV[i];
    };
    moveEnd(0, before(u), u[1]);
    std::size_t done = 1;  // inner nodes below are at the end of their step
    for (std::size_t from = 1; from < last; from += block) {
        const std::size_t to = std::min(last, from + block);
        move(u, v, nextU, nextV, from, to, c);
        kick(nextU, nextV, done, to - 1, c);
        addZeros(nextU, done, to - 1, sums);
        addZeros(nextV, done, to - 1, sums);
        done = to - 1;
    }
    moveEnd(last, u[last - 1], after(u));
    kick(nextU, nextV, done, last, c);
    nextV[0] = kickedEnd(nextV[0], nextU[0], before(nextU), nextU[1], c);
    nextV[last] = kickedEnd(nextV[last], nextU[last], nextU[last - 1], after(nextU), c);
    addZeros(nextU, done, n, sums);
    addZeros(nextV, done, n, sums);
    sums[0] += 0 * nextU[0] + 0 * nextV[0];
}

}  // namespace

bool LeapfrogKernel::step(const double* u, const double* v, double* nextU, double* nextV,
                          std::size_t n) const {
    static const auto call = ForThisMachine<stepAll>::call();
    double sums[16] = {};
    call(this, u, v, nextU, nextV, n, sums);
    double sum = 0;
    for (const double each : sums) sum += each;
    return sum == 0;
}

}  // namespace extremal
