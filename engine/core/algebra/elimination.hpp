// SPDX-License-Identifier: GPL-3.0-or-later
/// A x = b of few unknowns by Gaussian elimination with partial pivoting, on plain memory.
///
/// For what is solved once or twice per evaluation in many kinds of numbers: Eigen's LU of a fixed or bounded
/// size takes seconds to compile in every file and for every size, and this nothing to speak of.
#pragma once

#include <cmath>
#include <utility>

namespace extremal {

/// A is n x n, column by column, and is overwritten by its factors; b becomes x. Where A is singular x is not
/// finite.
template <class T>
void eliminate(int n, T* A, T* b) {
    using std::abs;
    const auto at = [A, n](int i, int j) -> T& { return A[j * n + i]; };
    for (int k = 0; k < n; ++k) {
        int pivot = k;
        for (int i = k + 1; i < n; ++i)
            if (abs(at(i, k)) > abs(at(pivot, k))) pivot = i;
        if (pivot != k) {
            for (int j = 0; j < n; ++j) std::swap(at(k, j), at(pivot, j));
            std::swap(b[k], b[pivot]);
        }
        for (int i = k + 1; i < n; ++i) at(i, k) /= at(k, k);
        for (int j = k + 1; j < n; ++j)
            for (int i = k + 1; i < n; ++i) at(i, j) -= at(i, k) * at(k, j);
    }
    const auto known = [&](int i, int from, int end) {
        T sum(0);
        for (int j = from; j < end; ++j) sum += at(i, j) * b[j];
        return sum;
    };
    for (int i = 1; i < n; ++i) b[i] -= known(i, 0, i);
    for (int i = n - 1; i >= 0; --i) b[i] = (b[i] - known(i, i + 1, n)) / at(i, i);
}

}  // namespace extremal
