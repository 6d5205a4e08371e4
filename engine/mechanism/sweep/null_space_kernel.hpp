// SPDX-License-Identifier: GPL-3.0-or-later
/// What a sweep of null_space_iteration.hpp does between the evaluations of constraints and Lagrangian, eight
/// nodes at a time in the instruction set of this machine.
///
/// Arrays of something at many nodes have the node fastest, in strides that are multiples of 8: `inside` for
/// the nodes of L, `places` for those of the constraints behind the start, e_1..e_m, and for the tests, one
/// of each e_0..e_{m-1}. Matrices over nodes are by columns. What is beyond the last place does not move.
///
/// Of the d coordinates n depend on the other f = d - n: with the constraints linearised, a motion of the
/// free ones has N along with it (Constraint::dependence).
#pragma once

#include <cstddef>

namespace extremal {

/// How the coordinates of a mechanism are shared out.
struct SharedCoordinates {
    using Index = std::ptrdiff_t;
    static constexpr int mostFree = 16;
    Index d = 0, n = 0;
    const int* dependent = nullptr;  ///< n
    const int* free = nullptr;       ///< d - n
    const double* masses = nullptr;  ///< L_vv: d x d, or its diagonal
    bool isDiagonal = false;

    Index freedoms() const { return d - n; }
    Index factors() const { return freedoms() * (freedoms() + 1) / 2; }
    /// A Cholesky factor row by row, row i at its column j.
    static Index factor(Index i, Index j) { return i * (i + 1) / 2 + j; }
};

struct NullSpaceSweep {
    using Index = SharedCoordinates::Index;
    SharedCoordinates shared;
    Index functions = 0, nodes = 0;  ///< m; nodes of L
    Index places = 0, inside = 0;    ///< strides
    bool isFirst = false;            ///< the masses along N are not known yet
    /// Of the nodes of L, by increments at places: values, and slopes over h.
    const double *value = nullptr, *slope = nullptr;
    /// The same numbers as tests by nodes of L, with those of l_0, which make all of them 1 and 0 together.
    const double *testValue = nullptr, *testSlope = nullptr;
    const double *weightOfValue = nullptr, *weightOfSlope = nullptr;  ///< inside: h b_i; b_i
    const double* inverse = nullptr;                                  ///< -h K^-1, places by tests
    const double *q = nullptr, *p = nullptr;                          ///< d, at the start
    const double* start = nullptr;        ///< d x places: p in the test at the start, 0 in the others
    double *U = nullptr, *P = nullptr;    ///< d x places: increments, and q + U
    double *Q = nullptr, *V = nullptr;    ///< d x inside
    double* gradient = nullptr;           ///< L_q + F and L_v, 2d x inside; then weighed
    const double* N = nullptr;            ///< n x f x places, and behind it
    const double* back = nullptr;         ///< n x places: what brings U onto the constraints
    const double* startN = nullptr;       ///< n x f
    double* factor = nullptr;             ///< inverse Cholesky factors of the masses along N, x places
    const double* startFactor = nullptr;  ///< of the start
    double *R = nullptr, *E = nullptr, *S = nullptr;       ///< d, f, f x places
    double* change = nullptr;                              ///< d x places
    const double *lastS = nullptr, *lastChange = nullptr;  ///< of the sweep before
    const double *perSize = nullptr, *least = nullptr;     ///< d: what a change counts, beyond the least one
};

/// Sums over the places of the sizes of changes and of increments.
struct ChangeSize {
    double change = 0, scale = 0;
};

struct NullSpaceKernel {
    using Call = void (*)(const NullSpaceSweep&);
    /// U of the next step from that of the last, by columns of G, and its places.
    void (*extrapolate)(const NullSpaceSweep&, const double* G, const double* last);
    /// Increments brought onto the constraints, and with these places and velocities at the nodes of L.
    Call move;
    /// The residuals R of the tests, and the change that takes away what they are along N, with its size:
    /// what it counts of each coordinate, the largest of all, and of this the sum over the places.
    void (*balance)(const NullSpaceSweep&, double* size);
    /// Takes from the change what two sweeps say of the next (Anderson's mixing of depth one).
    Call accelerate;
    /// Sizes of the change and of increments; d of them.
    void (*measure)(const NullSpaceSweep&, ChangeSize*);
    /// The change, and the places after it.
    Call apply;
    /// The sum of all tests and reactions, A of mechanism_step.hpp; to: d.
    void (*impulse)(const NullSpaceSweep&, double* to);
};

NullSpaceKernel nullSpaceKernel();

/// Of the masses along N at one place, or at several side by side, L L^T = N^T M N: the lower factor row by
/// row, with the inverses of its diagonal in place of that. `read(to, c, j)` gives N_cj, `root(v)` takes the
/// square root.
template <class T, class Read, class Root>
[[gnu::always_inline]] inline void factoriseMasses(const SharedCoordinates& s, const Read& read,
                                                   const Root& root, T* factor) {
    using Index = SharedCoordinates::Index;
    const auto mass = [&](Index k, Index l) { return s.masses[k * s.d + l]; };
    for (Index i = 0; i < s.freedoms(); ++i)
        for (Index j = 0; j <= i; ++j) {
            T sum{}, a, b;
            if (!s.isDiagonal)
                sum += mass(s.free[i], s.free[j]);
            else if (i == j)
                sum += s.masses[s.free[i]];
            for (Index c = 0; c < s.n; ++c) {
                read(a, c, i);
                read(b, c, j);
                if (s.isDiagonal) {
                    sum += s.masses[s.dependent[c]] * (a * b);
                    continue;
                }
                sum += mass(s.dependent[c], s.free[j]) * a + mass(s.free[i], s.dependent[c]) * b;
                for (Index e = 0; e < s.n; ++e) {
                    read(a, e, i);
                    sum += mass(s.dependent[e], s.dependent[c]) * (a * b);
                }
            }
            for (Index k = 0; k < j; ++k) sum -= factor[s.factor(i, k)] * factor[s.factor(j, k)];
            if (i == j) {
                root(sum);
                factor[s.factor(i, i)] = 1 / sum;
            } else {
                factor[s.factor(i, j)] = sum * factor[s.factor(j, j)];
            }
        }
}

}  // namespace extremal
