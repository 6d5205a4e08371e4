// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/solve/band_lu.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace extremal {

BandLu::BandLu(int size, int reach)
    : n_(size),
      reach_(std::min(reach, size - 1)),
      width_(3 * reach_ + 1),
      band_(static_cast<std::size_t>(size) * static_cast<std::size_t>(width_)),
      pivot_(static_cast<std::size_t>(size)) {}

void BandLu::clear() { std::fill(band_.begin(), band_.end(), 0.0); }

void BandLu::fix(int i) {
    for (int j = std::max(0, i - reach_); j <= std::min(n_ - 1, i + reach_); ++j) entry(i, j) = i == j;
}

bool BandLu::factorise() {
    for (int k = 0; k < n_; ++k) {
        const int lastRow = std::min(n_ - 1, k + reach_), lastColumn = std::min(n_ - 1, k + 2 * reach_);
        int best = k;
        for (int i = k + 1; i <= lastRow; ++i)
            if (std::abs(entry(i, k)) > std::abs(entry(best, k))) best = i;
        pivot_[static_cast<std::size_t>(k)] = best;
        const double pivot = entry(best, k);
        if (!(std::abs(pivot) > 0) || !std::isfinite(pivot)) return false;
        if (best != k)
            for (int j = k; j <= lastColumn; ++j) std::swap(entry(k, j), entry(best, j));
        const double reciprocal = 1 / pivot;
        for (int i = k + 1; i <= lastRow; ++i) {
            const double factor = entry(i, k) * reciprocal;
            entry(i, k) = factor;
            if (factor == 0) continue;
            for (int j = k + 1; j <= lastColumn; ++j) entry(i, j) -= factor * entry(k, j);
        }
    }
    return true;
}

double BandLu::pivotRatio() const {
    double least = std::abs(entry(0, 0)), most = least;
    for (int k = 1; k < n_; ++k) {
        least = std::min(least, std::abs(entry(k, k)));
        most = std::max(most, std::abs(entry(k, k)));
    }
    return least / most;
}

void BandLu::solve(double* b) const {
    for (int k = 0; k < n_; ++k) {
        const int best = pivot_[static_cast<std::size_t>(k)];
        if (best != k) std::swap(b[k], b[best]);
        const int last = std::min(n_ - 1, k + reach_);
        for (int i = k + 1; i <= last; ++i) b[i] -= entry(i, k) * b[k];
    }
    for (int k = n_ - 1; k >= 0; --k) {
        double sum = b[k];
        const int last = std::min(n_ - 1, k + 2 * reach_);
        for (int j = k + 1; j <= last; ++j) sum -= entry(k, j) * b[j];
        b[k] = sum / entry(k, k);
    }
}

std::vector<int> lineOrder(int n) {
    std::vector<int> place(static_cast<std::size_t>(n));
    std::iota(place.begin(), place.end(), 0);
    return place;
}

std::vector<int> foldedOrder(int n) {
    std::vector<int> place(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) place[static_cast<std::size_t>(i)] = 2 * i < n ? 2 * i : 2 * (n - 1 - i) + 1;
    return place;
}

}  // namespace extremal
