// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/sweep/coordinate_sharing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace extremal {
namespace {

std::size_t placeOfEntry(int i) { return static_cast<std::size_t>(i); }

/// Makes the column of a row 1, and 0 in all others.
void clearColumn(Mechanism::Rows& G, int row, int column) {
    double* const own = G.row(row).data();
    const double inverse = 1 / own[column];
    for (int k = 0; k < G.cols(); ++k) own[k] *= inverse;
    for (int r = 0; r < G.rows(); ++r) {
        if (r == row) continue;
        double* const other = G.row(r).data();
        const double factor = other[column];
        for (int k = 0; k < G.cols(); ++k) other[k] -= factor * own[k];
    }
}

}  // namespace

CoordinateSharing::CoordinateSharing(const Mechanics<double>& mechanics, const Constraint& constraint)
    : mechanics_(mechanics), constraint_(constraint), d_(mechanics.dimension), n_(constraint.count()) {
    const int f = freedoms();
    order_.assign(placeOfEntry(n_ + d_), 0);
    N_.assign(placeOfEntry(n_ * f), 0.0);
    factor_.assign(placeOfEntry(f * (f + 1) / 2), 0.0);
    G_[0] = G_[1] = Rows::Zero(n_, d_);
    g_ = byTime_ = Vector::Zero(n_);
    if (mechanics_.isSeparable)
        masses_.assign(mechanics_.masses, mechanics_.masses + d_);
    else
        masses_.assign(placeOfEntry(d_ * d_), 0.0);
}

void CoordinateSharing::takeMasses(double t, const double* q, const double* v) {
    if (mechanics_.isSeparable) return;
    double value = 0;
    Vector gradient(2 * d_), hessian(4 * d_ * d_);
    mechanics_.jet(mechanics_.model.get(), t, q, v, &value, gradient.data(), hessian.data());
    for (int k = 0; k < d_; ++k)
        for (int l = 0; l < d_; ++l) masses_[placeOfEntry(k * d_ + l)] = hessian((d_ + k) * 2 * d_ + d_ + l);
}

/// Elimination with complete pivoting, of columns in the metric of the masses, by what a pivot is at the
/// start and at the end of the curve, whichever is less: a coordinate that comes to rest in between would be
/// a poor one to tell the others by.
bool CoordinateSharing::share(double t, const double* q, const double* end) {
    int* const rows = order_.data();
    int* const columns = rows + n_;
    std::iota(rows, columns, 0);
    std::iota(columns, columns + d_, 0);
    for (const bool isEnd : {false, true})
        constraint_.first(constraint_.model.get(), t, isEnd ? end : q, g_.data(), G_[isEnd].data(),
                          byTime_.data());
    const auto size = [&](int row, int column) {
        const double m = mass(columns[column]), atStart = G_[0](rows[row], columns[column]),
                     atEnd = G_[1](rows[row], columns[column]),
                     least = std::min(atStart * atStart, atEnd * atEnd);
        return m > 0 ? least / m : least;
    };
    for (int c = 0; c < n_; ++c) {
        double largest = 0;
        int row = c, column = c;
        for (int r = c; r < n_; ++r)
            for (int k = c; k < d_; ++k)
                if (const double own = size(r, k); own > largest) {
                    largest = own;
                    row = r;
                    column = k;
                }
        if (!(largest > 0 && largest <= std::numeric_limits<double>::max())) return false;
        std::swap(rows[c], rows[row]);
        std::swap(columns[c], columns[column]);
        for (Rows& G : G_) clearColumn(G, rows[c], columns[c]);
    }
    for (int c = 0; c < n_; ++c)
        for (int j = 0; j < freedoms(); ++j)
            N_[placeOfEntry(c * freedoms() + j)] = -G_[0](rows[c], columns[n_ + j]);
    takeOrder();
    return true;
}

void CoordinateSharing::takeOrder() { dependence_ = constraint_.dependence(constraint_.model.get(), order_); }

double CoordinateSharing::largest() const {
    const SharedCoordinates by = shared();
    double largest = 0;
    for (int c = 0; c < n_; ++c)
        for (int j = 0; j < freedoms(); ++j) {
            const double own = mass(by.free[j]), other = mass(by.dependent[c]),
                         N = N_[placeOfEntry(c * freedoms() + j)];
            largest = std::max(largest, own > 0 && other > 0 ? N * N * other / own : N * N);
        }
    return std::sqrt(largest);
}

void CoordinateSharing::moveTo(const double* N, int stride) {
    for (int e = 0; e < n_ * freedoms(); ++e) N_[placeOfEntry(e)] = N[e * stride];
    factorise();
}

void CoordinateSharing::factorise() {
    factoriseMasses(
        shared(),
        [&](double& to, std::ptrdiff_t c, std::ptrdiff_t j) {
            to = N_[static_cast<std::size_t>(c * freedoms() + j)];
        },
        [](double& v) { v = std::sqrt(v); }, factor_.data());
}

void CoordinateSharing::project(const Vector& p, Vector& impulse) const {
    const SharedCoordinates by = shared();
    const int f = freedoms();
    const auto N = [&](int c, int j) { return N_[placeOfEntry(c * f + j)]; };
    const auto factor = [&](int i, int j) { return factor_[static_cast<std::size_t>(by.factor(i, j))]; };
    double s[SharedCoordinates::mostFree];
    for (int j = 0; j < f; ++j) {
        s[j] = p(by.free[j]);
        for (int c = 0; c < n_; ++c) s[j] += N(c, j) * p(by.dependent[c]);
        for (int k = 0; k < j; ++k) s[j] -= factor(j, k) * s[k];
        s[j] *= factor(j, j);
    }
    for (int j = f - 1; j >= 0; --j) {
        for (int k = j + 1; k < f; ++k) s[j] -= factor(k, j) * s[k];
        s[j] *= factor(j, j);
    }
    for (int j = 0; j < f; ++j) impulse(by.free[j]) = 0;
    for (int c = 0; c < n_; ++c) {
        const int k = by.dependent[c];
        double v = 0;
        for (int j = 0; j < f; ++j) v += N(c, j) * s[j];
        impulse(k) = mass(k) * v - p(k);
        for (int j = 0; j < f; ++j) impulse(by.free[j]) -= N(c, j) * impulse(k);
    }
}

void CoordinateSharing::checkpoint(Archive& archive) {
    archive(order_, N_, factor_, masses_);
    const auto isKnown = std::any_of(order_.begin(), order_.end(), [](int entry) { return entry != 0; });
    if (archive.isReading() && isKnown) takeOrder();
}

}  // namespace extremal
