// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/solve/null_space_lu.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/algebra/lanes.hpp"

namespace extremal {

NullSpaceLu::NullSpaceLu(int m, int d, int n) : m_(m), d_(d), n_(n), lu_(m * (d - n)) {
    const int rows = inWholeLanes(m * d);
    matrix_ = Matrix::Zero(rows, m * d);
    ofFree_ = Matrix::Zero(rows, m * (d - n));
    const auto nodes = static_cast<std::size_t>(m + 1);
    given_.assign(nodes * static_cast<std::size_t>(n * d), 0);
    eliminated_.assign(nodes * static_cast<std::size_t>(n * (d + n)), 0);
    order_.assign(nodes * static_cast<std::size_t>(d), 0);
    free_ = Vector::Zero(m * (d - n));
    curve_ = rest_ = Vector::Zero(rows);
}

/// [G | 1] by Gauss and Jordan until the columns of the dependent coordinates are those of 1.
bool NullSpaceLu::eliminate(int node) {
    const int width = d_ + n_;
    const double* const G = constraints(node);
    double* const rows = &eliminated_[static_cast<std::size_t>(node * n_ * width)];
    int* const order = &order_[static_cast<std::size_t>(node * d_)];
    for (int k = 0; k < d_; ++k) order[k] = k;
    for (int i = 0; i < n_; ++i) {
        double* const own = std::copy_n(G + i * d_, d_, rows + i * width);
        std::fill_n(own, n_, 0.0);
        own[i] = 1;
    }
    for (int i = 0; i < n_; ++i) {
        double largest = 0;
        int row = i, place = i;
        for (int r = i; r < n_; ++r)
            for (int k = i; k < d_; ++k)
                if (const double size = std::abs(rows[r * width + order[k]]); size > largest) {
                    largest = size;
                    row = r;
                    place = k;
                }
        if (!(largest > 0 && largest <= std::numeric_limits<double>::max())) return false;
        std::swap(order[i], order[place]);
        double* const pivot = rows + i * width;
        if (row != i) std::swap_ranges(pivot, pivot + width, rows + row * width);
        const double scale = 1 / pivot[order[i]];
        for (int k = 0; k < width; ++k) pivot[k] *= scale;
        for (int r = 0; r < n_; ++r) {
            if (r == i) continue;
            double* const other = rows + r * width;
            const double factor = other[order[i]];
            for (int k = 0; k < width; ++k) other[k] -= factor * pivot[k];
        }
    }
    return true;
}

Outcome NullSpaceLu::factorise() {
    for (int node = 0; node <= m_; ++node)
        if (!eliminate(node)) return Outcome::singular;
    const int free = d_ - n_;
    for (int f = 0; f < free; ++f)
        for (int j = 0; j < m_; ++j) {
            auto own = ofFree_.col(f * m_ + j);
            own = matrix_.col(order(j + 1)[n_ + f] * m_ + j);
            for (int i = 0; i < n_; ++i)
                own -= dependence(j + 1, i, f) * matrix_.col(order(j + 1)[i] * m_ + j);
            restrict(0, own.data(), lu_.column(f * m_ + j));
        }
    return lu_.factorise();
}

/// The coordinates that constraints determine, with the free ones at 0.
void NullSpaceLu::placeDependent(int first, const double* multipliers, double* curve) const {
    std::fill_n(curve, m_ * d_, 0.0);
    for (int j = 0; j < m_; ++j)
        for (int i = 0; i < n_; ++i) {
            double sum = 0;
            for (int c = 0; c < n_; ++c) sum += inverse(first + j, i, c) * multipliers[j * n_ + c];
            curve[order(first + j)[i] * m_ + j] = sum;
        }
}

void NullSpaceLu::addFree(int first, const double* free, double* curve) const {
    for (int f = 0; f < d_ - n_; ++f)
        for (int j = 0; j < m_; ++j) {
            const double x = free[f * m_ + j];
            const int* const own = order(first + j);
            curve[own[n_ + f] * m_ + j] += x;
            for (int i = 0; i < n_; ++i) curve[own[i] * m_ + j] -= dependence(first + j, i, f) * x;
        }
}

void NullSpaceLu::restrict(int first, const double* curve, double* free) const {
    for (int f = 0; f < d_ - n_; ++f)
        for (int j = 0; j < m_; ++j) {
            const int* const own = order(first + j);
            double sum = curve[own[n_ + f] * m_ + j];
            for (int i = 0; i < n_; ++i) sum -= dependence(first + j, i, f) * curve[own[i] * m_ + j];
            free[f * m_ + j] = sum;
        }
}

void NullSpaceLu::multipliersOf(int first, const double* curve, double* multipliers) const {
    for (int j = 0; j < m_; ++j)
        for (int c = 0; c < n_; ++c) {
            double sum = 0;
            for (int i = 0; i < n_; ++i)
                sum += inverse(first + j, i, c) * curve[order(first + j)[i] * m_ + j];
            multipliers[j * n_ + c] = sum;
        }
}

void NullSpaceLu::solve(double* curve, double* multipliers) {
    const int size = m_ * d_, rows = static_cast<int>(matrix_.rows()), free = m_ * (d_ - n_);
    const auto product = [&](const Matrix& A, const double* x, int depth) {
        rest_.setZero();
        sums_.product({A.data(), rows, x, depth, rest_.data(), rows, rows, 1, depth});
        for (int k = 0; k < size; ++k) curve[k] -= rest_(k);
    };
    placeDependent(1, multipliers, curve_.data());
    product(matrix_, curve_.data(), size);
    restrict(0, curve, free_.data());
    lu_.solve(free_.data());
    addFree(1, free_.data(), curve_.data());
    product(ofFree_, free_.data(), free);
    multipliersOf(0, curve, multipliers);
    std::copy_n(curve_.data(), size, curve);
}

void NullSpaceLu::solveTransposed(double* curve, double* multipliers) {
    const int size = m_ * d_;
    Eigen::Map<Vector> right(curve, size);
    const auto M = matrix_.topRows(size);
    placeDependent(0, multipliers, curve_.data());
    rest_.head(size).noalias() = M.transpose() * curve_.head(size);
    rest_.head(size) = right - rest_.head(size);
    restrict(1, rest_.data(), free_.data());
    lu_.solveTransposed(free_.data());
    addFree(0, free_.data(), curve_.data());
    rest_.head(size).noalias() = M.transpose() * curve_.head(size);
    right -= rest_.head(size);
    multipliersOf(1, curve, multipliers);
    std::copy_n(curve_.data(), size, curve);
}

}  // namespace extremal
