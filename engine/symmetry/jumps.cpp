// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/symmetry/jumps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "engine/model/mechanisms.hpp"
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

/// The derivative of f by one entry, by central differences of order 8 at the step where those of two steps
/// agree best.
template <class F>
double slopeOf(const F& f, Place at, std::size_t entry) {
    constexpr std::array<double, 4> weights = {4. / 5, -1. / 5, 4. / 105, -1. / 280};
    const double here = at[entry];
    double best = 0, least = std::numeric_limits<double>::infinity(), last = NAN, step = 1;
    for (int k = 0; k < 16; ++k, step /= 2) {
        double sum = 0;
        for (std::size_t j = 0; j < weights.size(); ++j) {
            const double delta = static_cast<double>(j + 1) * step;
            at[entry] = here + delta;
            const double above = f(at);
            at[entry] = here - delta;
            sum += weights[j] * (above - f(at));
        }
        const double now = sum / step, change = std::abs(now - last);
        if (change < least) {
            least = change;
            best = now;
        }
        last = now;
    }
    return best;
}

template <class F>
Jump jumpAt(const Place& at, std::size_t d, const F& argument) {
    const auto begin = at.begin(), middle = begin + static_cast<std::ptrdiff_t>(d);
    Jump jump{at[2 * d], {begin, middle}, {middle, middle + static_cast<std::ptrdiff_t>(d)}, {}, 0};
    for (std::size_t i = 0; i < 2 * d; ++i) jump.gradient.push_back(slopeOf(argument, at, i));
    jump.st = slopeOf(argument, at, 2 * d);
    return jump;
}

}  // namespace

bool Jump::isMovedBy(const Symmetry& s) const {
    constexpr double share = 1e-9;
    const std::size_t d = q.size();
    double sum = 0, size = 0;
    const auto add = [&](double term) {
        sum += term;
        size += std::abs(term);
    };
    // A relation of many coordinates reads few of them.
    for (std::size_t i = 0; i < d; ++i) {
        if (gradient[i] != 0) {
            double xi = s.b[i] + s.c[i] * t;
            for (std::size_t j = 0; j < d; ++j) xi += s.A[i * d + j] * q[j];
            add(gradient[i] * xi);
        }
        if (gradient[d + i] == 0) continue;
        add(gradient[d + i] * (s.c[i] - s.tau1 * v[i]));
        for (std::size_t j = 0; j < d; ++j) add(gradient[d + i] * s.A[i * d + j] * v[j]);
    }
    add(st * (s.tau0 + s.tau1 * t));
    return !(std::abs(sum) <= share * size);
}

std::vector<Jump> jumpsOf(const Mechanical& mechanics) {
    constexpr int samples = 6;
    const auto branches = typed::branchesOf(mechanics);
    std::vector<Jump> found;
    if (!branches) return found;
    StateSampler sampler(mechanics, 1642);
    SampledState state;
    for (int sample = 0; sample < samples && sampler.next(state); ++sample) {
        Place start = state.q;
        start.insert(start.end(), state.v.begin(), state.v.end());
        start.push_back(state.t);
        typed::Branches::Cells cells(branches->size(), 1);
        for (std::size_t k = 0; k < branches->size(); ++k) {
            cells[k] = branches->cellOf(k, branches->argument(k, start.data(), cells));
            if (!branches->moves(k)) continue;
            const auto [low, high] = branches->limits(k, cells[k]);
            const double limit = std::isfinite(low) ? low : high;
            const auto distance = [&](const Place& at) {
                return branches->argument(k, at.data(), cells) - limit;
            };
            for (std::size_t entry = 0; entry < start.size(); ++entry)
                if (const auto at = onZero(start, entry, distance); at && jumps(mechanics, *at, entry))
                    found.push_back(jumpAt(*at, state.q.size(), distance));
        }
    }
    return found;
}

namespace {

template <class Relations>
void addRelations(const Relations& part, const Mechanical& mechanics, std::vector<Jump>& to) {
    const auto n = static_cast<std::size_t>(part.count()), d = static_cast<std::size_t>(mechanics.dimension);
    // More than there are displacements A q + b + c t, as any combination that a few of them keep would do;
    // of many coordinates, whose symmetries are not combined from samples but are candidates, a few tell.
    constexpr std::size_t most = 400, few = 16;
    const std::size_t samples = d > mostSampledCoordinates ? few : std::min(most, 2 * (d * d + 2 * d + 4));
    std::vector<double> value(n), byPlace(n * d), byTime(n);
    StateSampler sampler(mechanics, 1736);
    SampledState state;
    for (std::size_t sample = 0; sample < samples && sampler.next(state); ++sample) {
        part.first(part.model.get(), state.t, state.q.data(), value.data(), byPlace.data(), byTime.data());
        for (std::size_t k = 0; k < n; ++k) {
            Jump relation{state.t, state.q, state.v, std::vector<double>(2 * d), byTime[k]};
            std::copy_n(byPlace.data() + k * d, d, relation.gradient.data());
            const auto isFinite = [](double x) { return std::isfinite(x); };
            if (std::all_of(relation.gradient.begin(), relation.gradient.end(), isFinite))
                to.push_back(std::move(relation));
        }
    }
}

}  // namespace

std::vector<Jump> relationsOf(const System& system, bool areWallsKept) {
    std::vector<Jump> all;
    if (const Constraint* const part = system.parts.find<Constraint>())
        addRelations(*part, system.mechanics(), all);
    if (const Wall* const part = system.parts.find<Wall>(); part && areWallsKept)
        addRelations(*part, system.mechanics(), all);
    return all;
}

}  // namespace extremal
