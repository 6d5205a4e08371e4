// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/symmetry/moved_jump.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/model/typed/branches.hpp"
#include "engine/symmetry/sample.hpp"

namespace extremal {
namespace {

/// A place in (q, v, t).
using Place = std::vector<double>;

double lagrangianAt(const Mechanical& mechanics, const Place& at) {
    const auto d = static_cast<std::size_t>(mechanics.dimension);
    std::vector<double> gradient(2 * d), hessian(4 * d * d);
    double L = 0;
    mechanics.jet(mechanics.model.get(), at[2 * d], at.data(), at.data() + d, &L, gradient.data(),
                  hessian.data());
    return L;
}

/// The place with one entry changed so that f is zero, by Newton's method; empty where that does not help.
template <class F>
std::optional<Place> onZero(Place at, std::size_t entry, const F& f) {
    for (int iteration = 0; iteration < 60; ++iteration) {
        const double here = at[entry], delta = 1e-6 * std::max(1.0, std::abs(here)), value = f(at);
        at[entry] = here + delta;
        const double above = f(at);
        at[entry] = here - delta;
        const double slope = (above - f(at)) / (2 * delta), change = -value / slope;
        at[entry] = here + change;
        if (!std::isfinite(at[entry])) return {};
        if (std::abs(change) <= 1e-14 * std::max(1.0, std::abs(here))) return at;
    }
    return {};
}

/// Whether L jumps across the place along one entry: its difference does not shrink with the distance.
bool jumps(const Mechanical& mechanics, const Place& at, std::size_t entry) {
    const auto difference = [&](double distance) {
        Place above = at, below = at;
        const double delta = distance * std::max(1.0, std::abs(at[entry]));
        above[entry] += delta;
        below[entry] -= delta;
        return std::abs(lagrangianAt(mechanics, above) - lagrangianAt(mechanics, below));
    };
    const double far = difference(1e-5), near = difference(1e-9);
    return near > 0 && near > far / 10;
}

/// (xi, A v + c - tau1 v, tau).
Place directionOf(const Symmetry& s, const Place& at) {
    const auto d = static_cast<std::size_t>(s.dimension);
    Place direction(2 * d + 1);
    s.displacement(at[2 * d], at.data(), direction.data());
    for (std::size_t i = 0; i < d; ++i) {
        direction[d + i] = s.c[i] - s.tau1 * at[d + i];
        for (std::size_t j = 0; j < d; ++j) direction[d + i] += s.A[i * d + j] * at[d + j];
    }
    direction[2 * d] = s.tau0 + s.tau1 * at[2 * d];
    return direction;
}

/// Whether f changes along a direction, and not by rounding alone.
template <class F>
bool changesAlong(const F& f, const Place& at, const Place& direction) {
    constexpr double part = 1e-6, share = 1e-6;
    double sum = 0, size = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
        Place moved = at;
        const double delta = part * std::max(1.0, std::abs(at[i]));
        moved[i] = at[i] + delta;
        const double above = f(moved);
        moved[i] = at[i] - delta;
        const double term = (above - f(moved)) / (2 * delta) * direction[i];
        sum += term;
        size += std::abs(term);
    }
    return std::abs(sum) > share * size;
}

}  // namespace

bool movesJump(const Mechanical& mechanics, const Symmetry& symmetry) {
    constexpr int samples = 6;
    const auto branches = typed::branchesOf(mechanics);
    if (!branches) return false;
    StateSampler sampler(mechanics, 1642);
    SampledState state;
    for (int sample = 0; sample < samples && sampler.next(state); ++sample) {
        Place start = state.q;
        start.insert(start.end(), state.v.begin(), state.v.end());
        start.push_back(state.t);
        typed::Branches::Cells cells(branches->size(), 1);
        for (std::size_t k = 0; k < branches->size(); ++k) {
            cells[k] = branches->cellOf(k, branches->argument(k, start.data(), cells));
            const auto [low, high] = branches->limits(k, cells[k]);
            const double limit = std::isfinite(low) ? low : high;
            const auto distance = [&](const Place& at) {
                return branches->argument(k, at.data(), cells) - limit;
            };
            for (std::size_t entry = 0; entry < start.size(); ++entry)
                if (const auto at = onZero(start, entry, distance);
                    at && jumps(mechanics, *at, entry) &&
                    changesAlong(distance, *at, directionOf(symmetry, *at)))
                    return true;
        }
    }
    return false;
}

}  // namespace extremal
