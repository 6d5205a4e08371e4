/// Gaussian elimination with partial pivoting for the small dense systems of a step (up to some 50 unknowns): in place, with
/// no allocation after the constructor, and cheaper there than what is made for large ones.
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

    /// The i-th row of the matrix, to be set before factorise().
    T* row(int i) { return &a_[static_cast<std::size_t>(i) * size_]; }
    void setZero() { a_.assign(a_.size(), T(0)); }

    enum class Result { regular, singular, notFinite };
    /// Replaces the matrix by its factors. Singular: a pivot is exactly zero.
    Result factorise() {
        using std::abs;
        for (std::size_t k = 0; k < size_; ++k) {
            std::size_t best = k;
            T largest = abs(a_[k * size_ + k]);
            for (std::size_t i = k + 1; i < size_; ++i)
                if (const T candidate = abs(a_[i * size_ + k]); candidate > largest) {
                    largest = candidate;
                    best = i;
                }
            if (!(largest <= std::numeric_limits<T>::max())) return Result::notFinite;
            if (!(largest > T(0))) return Result::singular;
            row_[k] = best;
            T* pivot = &a_[k * size_];
            if (best != k) {
                T* other = &a_[best * size_];
                for (std::size_t j = 0; j < size_; ++j) std::swap(pivot[j], other[j]);
            }
            inverse_[k] = T(1) / pivot[k];
            for (std::size_t i = k + 1; i < size_; ++i) {
                T* below = &a_[i * size_];
                const T factor = below[k] * inverse_[k];
                below[k] = factor;
                for (std::size_t j = k + 1; j < size_; ++j) below[j] -= factor * pivot[j];
            }
        }
        return Result::regular;
    }
    /// Replaces the right-hand side by the solution.
    void solve(T* x) const {
        for (std::size_t k = 0; k < size_; ++k) {
            if (row_[k] != k) std::swap(x[k], x[row_[k]]);
            const T* left = &a_[k * size_];
            T sum = x[k];
            for (std::size_t j = 0; j < k; ++j) sum -= left[j] * x[j];
            x[k] = sum;
        }
        for (std::size_t k = size_; k-- > 0;) {
            const T* right = &a_[k * size_];
            T sum = x[k];
            for (std::size_t j = k + 1; j < size_; ++j) sum -= right[j] * x[j];
            x[k] = sum * inverse_[k];
        }
    }

private:
    std::size_t size_;
    std::vector<T> a_, inverse_;
    std::vector<std::size_t> row_;  ///< what row k was exchanged with
};

}  // namespace extremal
