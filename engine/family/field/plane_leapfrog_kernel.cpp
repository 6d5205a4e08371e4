// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/plane_leapfrog_kernel.hpp"

#include <cstdint>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/registers.hpp"

namespace extremal {
namespace {

// Loops that the compiler is left to vectorise itself do not start where the stores are aligned.
using namespace registers;

/// A row of values and the rows beside it.
struct CellRow {
    const double *here, *below, *above;
};

/// a of the cells from i, whose neighbours start at `left` and `right`; `u` is set to their values.
template <class V>
[[gnu::always_inline]] inline void accelerateCells(const PlaneLeapfrogKernel& c, const CellRow& row,
                                                   std::size_t i, std::size_t left, std::size_t right, V& u,
                                                   V& a) {
    V l, r, below, above;
    load(u, row.here + i);
    load(l, row.here + left);
    load(r, row.here + right);
    load(below, row.below + i);
    load(above, row.above + i);
    a = c.perX * (l + r) + c.perY * (below + above) - 2 * (c.perX + c.perY) * u -
        u * (c.slope.cubic * u * u + c.slope.linear);
}

template <class V>
[[gnu::always_inline]] inline void moveCells(const PlaneLeapfrogKernel& c, const CellRow& row,
                                             const double* v, double* nextU, double* nextV, std::size_t i,
                                             std::size_t left, std::size_t right) {
    V u, a, velocity;
    accelerateCells(c, row, i, left, right, u, a);
    load(velocity, v + i);
    velocity += c.h / 2 * a;
    store(nextV + i, velocity);
    u += c.h * velocity;
    store(nextU + i, u);
}

/// Adds 0 v' to `zeros`: not a number where a velocity is not finite.
template <class V>
[[gnu::always_inline]] inline void kickCells(const PlaneLeapfrogKernel& c, const CellRow& row,
                                             double* velocities, std::size_t i, std::size_t left,
                                             std::size_t right, V& zeros) {
    V u, a, velocity;
    accelerateCells(c, row, i, left, right, u, a);
    load(velocity, velocities + i);
    velocity += c.h / 2 * a;
    store(velocities + i, velocity);
    zeros += 0 * velocity;
}

/// Calls one(i, left, right) or many(i, left, right) for every cell of a row: one by one at its ends and
/// until the stores are aligned.
template <class V, class One, class Many>
[[gnu::always_inline]] inline void forCells(std::size_t n, const double* stored, One&& one, Many&& many) {
    constexpr std::size_t lanes = sizeof(V) / sizeof(double);
    one(0, n - 1, 1);
    std::size_t i = 1;
    for (; i + 1 < n && reinterpret_cast<std::uintptr_t>(stored + i) % sizeof(V) != 0; ++i)
        one(i, i - 1, i + 1);
    for (; i + lanes < n; i += lanes) many(i, i - 1, i + 1);
    for (; i + 1 < n; ++i) one(i, i - 1, i + 1);
    one(n - 1, n - 2, 0);
}

template <class V>
[[gnu::always_inline]] inline void moveRow(const PlaneLeapfrogKernel& c, const CellRow& row, const double* v,
                                           double* nextU, double* nextV) {
    forCells<V>(
        c.nx, nextV,
        [&](std::size_t i, std::size_t left, std::size_t right) {
            moveCells<double>(c, row, v, nextU, nextV, i, left, right);
        },
        [&](std::size_t i, std::size_t left, std::size_t right) {
            moveCells<V>(c, row, v, nextU, nextV, i, left, right);
        });
}

template <class V>
[[gnu::always_inline]] inline double kickRow(const PlaneLeapfrogKernel& c, const CellRow& row,
                                             double* velocities) {
    V zeros = {};
    double rest = 0;
    forCells<V>(
        c.nx, velocities,
        [&](std::size_t i, std::size_t left, std::size_t right) {
            kickCells<double>(c, row, velocities, i, left, right, rest);
        },
        [&](std::size_t i, std::size_t left, std::size_t right) {
            kickCells<V>(c, row, velocities, i, left, right, zeros);
        });
    for (std::size_t lane = 0; lane < sizeof(V) / sizeof(double); ++lane) rest += zeros[lane];
    return rest;
}

template <class V>
void stepRows(const PlaneLeapfrogKernel* kernel, const double* u, const double* v, double* nextU,
              double* nextV, double* zeros) {
    const PlaneLeapfrogKernel& c = *kernel;
    const std::size_t nx = c.nx, ny = c.ny;
    const auto rowOf = [&](const double* values, std::size_t j) {
        return CellRow{values + j * nx, values + (j == 0 ? ny - 1 : j - 1) * nx,
                       values + (j + 1 == ny ? 0 : j + 1) * nx};
    };
    const auto move = [&](std::size_t j) {
        moveRow<V>(c, rowOf(u, j), v + j * nx, nextU + j * nx, nextV + j * nx);
    };
    const auto kick = [&](std::size_t j) { *zeros += kickRow<V>(c, rowOf(nextU, j), nextV + j * nx); };
    move(0);
    move(1);
    for (std::size_t j = 2; j < ny; ++j) {
        move(j);
        kick(j - 1);
    }
    kick(ny - 1);
    kick(0);
}

}  // namespace

bool PlaneLeapfrogKernel::step(const double* u, const double* v, double* nextU, double* nextV) const {
    static const auto call = ForThisMachine<&stepRows<Eight>, &stepRows<Four>, &stepRows<Two>>::call();
    double zeros = 0;
    call(this, u, v, nextU, nextV, &zeros);
    return zeros == 0;
}

}  // namespace extremal
