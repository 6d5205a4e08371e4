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

namespace extremal {

template <class T>
class SmallLu {
public:
    explicit SmallLu(int size = 0)
        : size_(static_cast<std::size_t>(size)), a_(size_ * size_), inverse_(size_), row_(size_) {}

    /// The j-th column of the matrix, to be set before factorise().
    T* column(int j) { return &a_[static_cast<std::size_t>(j) * size_]; }

    enum class Result { regular, singular, notFinite };
    /// Replaces the matrix by its factors. Singular: a pivot is exactly zero.
    Result factorise() {
        using std::abs;
        for (std::size_t k = 0; k < size_; ++k) {
            T* left = &a_[k * size_];
            std::size_t best = k;
            T largest = abs(left[k]);
            for (std::size_t i = k + 1; i < size_; ++i)
                if (const T candidate = abs(left[i]); candidate > largest) {
                    largest = candidate;
                    best = i;
                }
            if (!(largest <= std::numeric_limits<T>::max())) return Result::notFinite;
            if (!(largest > T(0))) return Result::singular;
            row_[k] = best;
            if (best != k)
                for (std::size_t j = 0; j < size_; ++j) std::swap(a_[j * size_ + k], a_[j * size_ + best]);
            inverse_[k] = T(1) / left[k];
            for (std::size_t i = k + 1; i < size_; ++i) left[i] *= inverse_[k];
            for (std::size_t j = k + 1; j < size_; ++j) {
                T* column = &a_[j * size_];
                const T factor = column[k];
                for (std::size_t i = k + 1; i < size_; ++i) column[i] -= factor * left[i];
            }
        }
        return Result::regular;
    }
    /// Replaces the right-hand side by the solution, column by column: sums along rows would wait for each
    /// other.
    void solve(T* x) const {
        for (std::size_t k = 0; k < size_; ++k)
            if (row_[k] != k) std::swap(x[k], x[row_[k]]);
        for (std::size_t k = 0; k < size_; ++k) {
            const T* column = &a_[k * size_];
            const T factor = x[k];
            for (std::size_t i = k + 1; i < size_; ++i) x[i] -= factor * column[i];
        }
        for (std::size_t k = size_; k-- > 0;) {
            const T* column = &a_[k * size_];
            const T factor = x[k] *= inverse_[k];
            for (std::size_t i = 0; i < k; ++i) x[i] -= factor * column[i];
        }
    }

private:
    std::size_t size_;
    std::vector<T> a_, inverse_;    ///< a_: column after column; inverse_: of the pivots
    std::vector<std::size_t> row_;  ///< what row k was exchanged with
};

}  // namespace extremal
