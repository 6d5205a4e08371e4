// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/impact/wall_gaps.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {

WallGaps::WallGaps(const Wall& wall, const Mechanics<double>& mechanics)
    : wall_(wall), mechanics_(mechanics) {
    const auto n = static_cast<std::size_t>(wall_.count()),
               d = static_cast<std::size_t>(mechanics_.dimension);
    gaps_.resize(n);
    byTime_.resize(n);
    byPlace_.resize(n * d);
    velocity_.resize(d);
}

std::optional<WallGaps::Speed> WallGaps::speed(int wall, const State& s) {
    const auto& L = mechanics_;
    if (!L.velocity(L.model.get(), s.t, s.x.data(), s.x.data() + L.dimension, velocity_.data())) return {};
    double value = byTime(wall), size = 0;
    for (int i = 0; i < L.dimension; ++i) {
        const double v = velocity_[static_cast<std::size_t>(i)];
        fastest = std::max(fastest, std::abs(v));
        value += normal(wall)[i] * v;
        size += std::abs(normal(wall)[i]);
    }
    return Speed{value, std::abs(value) < 1e-10 * size * fastest};
}

std::optional<WallCrossing> WallGaps::firstCrossing(const Integrator& step, const State& start, double h,
                                                    int places, const IsLeft& isLeft) {
    samples_.resize(static_cast<std::size_t>(count() * (places + 1)));
    at_.resize(start.x.size());
    const int n = count();
    std::optional<WallCrossing> first;
    find(start.t, start.x.data());
    std::copy(gaps_.begin(), gaps_.end(), samples_.begin());
    for (int i = 1; i <= places; ++i) {
        const double tau = static_cast<double>(i) / places;
        step.denseOutput(tau, at_);
        find(start.t + tau * h, at_.data());
        double* const row = samples_.data() + i * n;
        std::copy(gaps_.begin(), gaps_.end(), row);
        for (int k = 0; k < n; ++k) {
            if (first || isLeft(k, tau) || !(row[k] < -roundOff(k, at_.data()))) continue;
            first = WallCrossing{k, static_cast<double>(i - 1) / places, tau};
        }
        if (first) return earliestOf(*first, step, start, h, row, isLeft);
    }
    return first;
}
/// Of walls that close between the same two places the one whose gap a straight line closes first; the
/// lower end of the interval is moved to where the gap is still open.
WallCrossing WallGaps::earliestOf(WallCrossing found, const Integrator& step, const State& start, double h,
                                  const double* row, const IsLeft& isLeft) {
    const int n = count();
    double least = 2;
    WallCrossing best = found;
    for (int k = 0; k < n; ++k) {
        const double before = row[k - n], after = row[k];
        if (isLeft(k, best.to) || !(after < -roundOff(k, at_.data()))) continue;
        const double part = before > 0 ? before / (before - after) : 0;
        if (part < least) {
            least = part;
            best.wall = k;
        }
    }
    if (best.from > 0 && isLeft(best.wall, best.from)) return best;
    for (int halvings = 0; halvings < 60; ++halvings) {
        const double tau = halvings == 0 ? best.from : best.from + (best.to - best.from) / 2;
        if (tau > 0) {
            step.denseOutput(tau, at_);
            find(start.t + tau * h, at_.data());
            // What is left alone up to here was searched before, and the scheme's own steps stay outside
            // there.
            if (gaps_[static_cast<std::size_t>(best.wall)] > 0 || isLeft(best.wall, tau)) {
                best.from = tau;
                return best;
            }
            if (halvings > 0) best.to = tau;
        } else if (samples_[static_cast<std::size_t>(best.wall)] > roundOff(best.wall, start.x.data())) {
            return best;
        }
    }
    best.from = best.to;  // never open: it rests on the wall
    return best;
}

}  // namespace extremal
