// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/tabulated_solution.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

namespace extremal {
namespace {

constexpr std::size_t points = 16;

/// In [0, 1], ascending.
const std::array<double, points>& chebyshevPoints() {
    static const std::array<double, points> all = [] {
        std::array<double, points> s{};
        for (std::size_t j = 0; j < points; ++j)
            s[j] = (1 - std::cos(std::numbers::pi * static_cast<double>(j) / (points - 1))) / 2;
        return s;
    }();
    return all;
}

/// Two places of an interval that are far from its points.
constexpr std::array<double, 2> probes{0.4477, 0.9731};

constexpr std::size_t mostNumbers = 1'100'000;

/// By the barycentric formula, at s in [0, 1].
void interpolate(const double* states, double at, std::size_t width, double* x) {
    const std::array<double, points>& s = chebyshevPoints();
    std::fill_n(x, width, 0.0);
    double sum = 0;
    for (std::size_t j = 0; j < points; ++j) {
        if (at == s[j]) {
            std::copy_n(states + j * width, width, x);
            return;
        }
        const bool isEnd = j == 0 || j + 1 == points;
        const double weight = (j % 2 == 0 ? 1 : -1) * (isEnd ? 0.5 : 1) / (at - s[j]);
        sum += weight;
        for (std::size_t i = 0; i < width; ++i) x[i] += weight * states[j * width + i];
    }
    for (std::size_t i = 0; i < width; ++i) x[i] /= sum;
}

/// What a table has to reproduce.
struct Wanted {
    std::size_t width, checked;
    double tolerance;
};

/// Samples [from, to]. Whether it is reproduced; nothing where it is not known.
std::optional<bool> sample(const ExactSolution& solution, double from, double to, const Wanted& wanted,
                           double* states, std::vector<double>& sizes) {
    constexpr double relative = 1e-13;
    const std::size_t width = wanted.width;
    std::vector<double> probed(probes.size() * width), read(width);
    const auto timeAt = [&](double s) { return s == 1 ? to : from + (to - from) * s; };
    // In the order of time: a solution that is stepped along does not like to go back.
    std::size_t probe = 0;
    for (std::size_t j = 0; j < points; ++j) {
        const double s = chebyshevPoints()[j];
        for (; probe < probes.size() && probes[probe] < s; ++probe)
            solution(timeAt(probes[probe]), std::span(probed).subspan(probe * width, width));
        solution(timeAt(s), std::span(states + j * width, width));
    }
    bool isGood = true;
    for (std::size_t p = 0; p < probes.size(); ++p) {
        interpolate(states, probes[p], width, read.data());
        for (std::size_t i = 0; i < wanted.checked; ++i) {
            const double off = std::abs(read[i] - probed[p * width + i]);
            if (!std::isfinite(off)) return {};
            sizes[i] = std::max(sizes[i], std::abs(read[i]));
            isGood = isGood && off <= std::max(wanted.tolerance, relative * sizes[i]);
        }
    }
    return isGood;
}

/// Pieces of a solution that is stepped along: its steps, halved where one is not reproduced.
class Pieces {
public:
    std::vector<double> bounds, states;  ///< ends of the pieces, the start first; piece after piece

    Pieces(const ExactSolution& solution, const Wanted& wanted, double start, double end)
        : bounds{start}, solution_(solution), wanted_(wanted), end_(end), least_(1e-13 * (end - start)) {}

    /// False: the solution ends early, or there are too many numbers.
    bool add(const std::stop_token& stop) {
        while (bounds.back() < end_) {
            const double from = bounds.back(),
                         to = std::min(end_, solution_.stepAt()(std::nextafter(from, end_)).second);
            if (stop.stop_requested() || !(to > from) || !addPiece(from, to)) return false;
        }
        return true;
    }

private:
    bool addPiece(double from, double to) {
        const std::size_t size = states.size(), own = points * wanted_.width;
        if (size + own > mostNumbers) return false;
        states.resize(size + own);
        const std::optional<bool> isGood = sample(solution_, from, to, wanted_, states.data() + size, sizes_);
        if (!isGood) return false;
        if (*isGood || to - from <= least_) {
            bounds.push_back(to);
            return true;
        }
        states.resize(size);
        const double middle = from + (to - from) / 2;
        return addPiece(from, middle) && addPiece(middle, to);
    }

    const ExactSolution& solution_;
    Wanted wanted_;
    double end_, least_;
    std::vector<double> sizes_ = std::vector<double>(wanted_.width, 0.0);
};

}  // namespace

void TabulatedSolution::at(double t, double* x) const {
    if (!bounds_.empty()) {
        const auto next = std::upper_bound(bounds_.begin() + 1, bounds_.end() - 1, t);
        const double from = *(next - 1), place = (t - from) / (*next - from);
        const auto k = static_cast<std::size_t>(next - bounds_.begin()) - 1;
        interpolate(states_.data() + k * points * width_, place, width_, x);
        return;
    }
    const double place = (t - start_) / length_ * static_cast<double>(intervals_);
    const double k = std::clamp(std::floor(place), 0.0, static_cast<double>(intervals_ - 1));
    interpolate(states_.data() + static_cast<std::size_t>(k) * points * width_, place - k, width_, x);
}

std::shared_ptr<const TabulatedSolution> TabulatedSolution::of(const ExactSolution& solution, double start,
                                                               double end, std::size_t width,
                                                               std::size_t checked, double tolerance,
                                                               const std::stop_token& stop) {
    constexpr std::size_t fewest = 16, growth = 4;
    const Wanted wanted{width, checked, tolerance};
    for (std::size_t intervals = fewest; intervals * points * width <= mostNumbers; intervals *= growth) {
        auto table = std::make_shared<TabulatedSolution>();
        table->start_ = start;
        table->length_ = end - start;
        table->intervals_ = intervals;
        table->width_ = width;
        table->states_.resize(intervals * points * width);
        std::vector<double> sizes(width, 0.0);
        bool isGood = true;
        for (std::size_t k = 0; k < intervals && isGood && !stop.stop_requested(); ++k) {
            const auto timeAt = [&](std::size_t i) {
                return start + (end - start) * (static_cast<double>(i) / static_cast<double>(intervals));
            };
            const std::optional<bool> isReproduced =
                sample(solution, timeAt(k), timeAt(k + 1), wanted, table->states_.data() + k * points * width,
                       sizes);
            if (!isReproduced) return {};
            isGood = *isReproduced;
        }
        if (stop.stop_requested()) return {};
        if (isGood) return table;
    }
    if (!solution.stepAt() || !(end > start)) return {};
    Pieces pieces(solution, wanted, start, end);
    if (!pieces.add(stop)) return {};
    auto table = std::make_shared<TabulatedSolution>();
    table->width_ = width;
    table->bounds_ = std::move(pieces.bounds);
    table->states_ = std::move(pieces.states);
    return table;
}

ExactSolution TabulatedSolution::reader(std::shared_ptr<const TabulatedSolution> table) {
    return [table = std::move(table)](double t, std::span<double> x) { table->at(t, x.data()); };
}

}  // namespace extremal
