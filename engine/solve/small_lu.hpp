// SPDX-License-Identifier: GPL-3.0-or-later
/// Gaussian elimination with partial pivoting for the small dense systems of a step (up to some 50 unknowns):
/// in place, with no allocation after the constructor, and cheaper there than what is made for large ones.
///
/// T: any real scalar.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "engine/core/algebra/lanes.hpp"
#include "engine/core/outcome.hpp"

namespace extremal {

namespace lu {

/// Replaces n columns of n entries by their factors, with the inverses of the pivots and the row that each
/// one was exchanged with. Outcome: converged, singular (a pivot is exactly zero) or notFinite.
template <class T>
Outcome factorise(T* a, std::size_t n, T* inverse, std::size_t* row) {
    using std::abs;
    for (std::size_t k = 0; k < n; ++k) {
        T* left = a + k * n;
        std::size_t best = k;
        T largest = abs(left[k]);
        for (std::size_t i = k + 1; i < n; ++i)
            if (const T candidate = abs(left[i]); candidate > largest) {
                largest = candidate;
                best = i;
            }
        if (!(largest <= std::numeric_limits<T>::max())) return Outcome::notFinite;
        if (!(largest > T(0))) return Outcome::singular;
        row[k] = best;
        if (best != k)
            for (std::size_t j = 0; j < n; ++j) std::swap(a[j * n + k], a[j * n + best]);
        inverse[k] = T(1) / left[k];
        for (std::size_t i = k + 1; i < n; ++i) left[i] *= inverse[k];
        for (std::size_t j = k + 1; j < n; ++j) {
            T* column = a + j * n;
            const T factor = column[k];
            for (std::size_t i = k + 1; i < n; ++i) column[i] -= factor * left[i];
        }
    }
    return Outcome::converged;
}

/// Replaces the right-hand side by the solution, column by column: sums along rows would wait for each other.
template <class T>
void solve(const T* a, std::size_t n, const T* inverse, const std::size_t* row, T* x) {
    for (std::size_t k = 0; k < n; ++k)
        if (row[k] != k) std::swap(x[k], x[row[k]]);
    for (std::size_t k = 0; k < n; ++k) {
        const T* column = a + k * n;
        const T factor = x[k];
        for (std::size_t i = k + 1; i < n; ++i) x[i] -= factor * column[i];
    }
    for (std::size_t k = n; k-- > 0;) {
        const T* column = a + k * n;
        const T factor = x[k] *= inverse[k];
        for (std::size_t i = 0; i < k; ++i) x[i] -= factor * column[i];
    }
}

/// The same of the transposed matrix.
template <class T>
void solveTransposed(const T* a, std::size_t n, const T* inverse, const std::size_t* row, T* x) {
    for (std::size_t k = 0; k < n; ++k) {
        const T* column = a + k * n;
        T sum = x[k];
        for (std::size_t i = 0; i < k; ++i) sum -= column[i] * x[i];
        x[k] = sum * inverse[k];
    }
    for (std::size_t k = n; k-- > 0;) {
        const T* column = a + k * n;
        T sum = x[k];
        for (std::size_t i = k + 1; i < n; ++i) sum -= column[i] * x[i];
        x[k] = sum;
    }
    for (std::size_t k = n; k-- > 0;)
        if (row[k] != k) std::swap(x[k], x[row[k]]);
}

}  // namespace lu

template <class T>
class SmallLu {
public:
    explicit SmallLu(int size = 0)
        : size_(static_cast<std::size_t>(size)), a_(size_ * size_), inverse_(size_), row_(size_) {}

    /// The j-th column of the matrix, to be set before factorise().
    T* column(int j) { return &a_[static_cast<std::size_t>(j) * size_]; }

    /// Replaces the matrix by its factors.
    Outcome factorise() { return lu::factorise(a_.data(), size_, inverse_.data(), row_.data()); }
    /// Replaces the right-hand side by the solution.
    void solve(T* x) const { lu::solve(a_.data(), size_, inverse_.data(), row_.data(), x); }
    void solveTransposed(T* x) const {
        lu::solveTransposed(a_.data(), size_, inverse_.data(), row_.data(), x);
    }

private:
    std::size_t size_;
    std::vector<T> a_, inverse_;    ///< a_: column after column; inverse_: of the pivots
    std::vector<std::size_t> row_;  ///< what row k was exchanged with
};

/// In vector registers of this machine, for up to eight of them to a column: with the bits of the functions
/// above, at a half of their time from 16 unknowns on. Rows stay where they are until the end, and pivots are
/// looked for among those that still wait.
template <>
class SmallLu<double> {
public:
    explicit SmallLu(int size = 0);

    void clear();
    double* column(int j) { return matrix() + static_cast<std::size_t>(j) * size_; }

    Outcome factorise();
    void solve(double* x) const;
    void solveTransposed(double* x) const;

private:
    double* matrix() { return a_.data()->lane.data(); }
    const double* matrix() const { return a_.data()->lane.data(); }

    std::size_t size_;
    std::vector<Lanes> a_;     ///< column after column; its factors have columns of whole registers
    std::vector<Lanes> work_;  ///< empty: columns have too many registers
    std::vector<double> inverse_;
    std::vector<std::size_t> row_;  ///< the row of pivot k, or what row k was exchanged with
};

}  // namespace extremal
