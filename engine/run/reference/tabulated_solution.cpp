// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/tabulated_solution.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

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

}  // namespace

void TabulatedSolution::at(double t, double* x) const {
    const std::array<double, points>& s = chebyshevPoints();
    const double place = (t - start_) / length_ * static_cast<double>(intervals_);
    const double k = std::clamp(std::floor(place), 0.0, static_cast<double>(intervals_ - 1));
    const double at = place - k;
    const double* const states = states_.data() + static_cast<std::size_t>(k) * points * width_;
    std::fill_n(x, width_, 0.0);
    double sum = 0;
    for (std::size_t j = 0; j < points; ++j) {
        if (at == s[j]) {
            std::copy_n(states + j * width_, width_, x);
            return;
        }
        const bool isEnd = j == 0 || j + 1 == points;
        const double weight = (j % 2 == 0 ? 1 : -1) * (isEnd ? 0.5 : 1) / (at - s[j]);
        sum += weight;
        for (std::size_t i = 0; i < width_; ++i) x[i] += weight * states[j * width_ + i];
    }
    for (std::size_t i = 0; i < width_; ++i) x[i] /= sum;
}

std::shared_ptr<const TabulatedSolution> TabulatedSolution::of(const ExactSolution& solution, double start,
                                                               double end, std::size_t width,
                                                               std::size_t checked, double tolerance,
                                                               const std::stop_token& stop) {
    constexpr std::size_t fewest = 16, growth = 4, mostNumbers = 1'100'000;
    constexpr double relative = 1e-13;
    for (std::size_t intervals = fewest; intervals * points * width <= mostNumbers; intervals *= growth) {
        auto table = std::make_shared<TabulatedSolution>();
        table->start_ = start;
        table->length_ = end - start;
        table->intervals_ = intervals;
        table->width_ = width;
        table->states_.resize(intervals * points * width);
        std::vector<double> probed(probes.size() * width), read(width);
        std::vector<double> sizes(width, 0.0);
        bool isGood = true;
        for (std::size_t k = 0; k < intervals && isGood && !stop.stop_requested(); ++k) {
            const double from = static_cast<double>(k) / static_cast<double>(intervals);
            const auto timeAt = [&](double s) {
                return start + (end - start) * (from + s / static_cast<double>(intervals));
            };
            // In the order of time: a solution that is stepped along does not like to go back.
            std::size_t probe = 0;
            for (std::size_t j = 0; j < points; ++j) {
                const double s = chebyshevPoints()[j];
                for (; probe < probes.size() && probes[probe] < s; ++probe)
                    solution(timeAt(probes[probe]), std::span(probed).subspan(probe * width, width));
                solution(timeAt(s), std::span(table->states_).subspan((k * points + j) * width, width));
            }
            for (std::size_t p = 0; p < probes.size(); ++p) {
                table->at(timeAt(probes[p]), read.data());
                for (std::size_t i = 0; i < checked; ++i) {
                    const double off = std::abs(read[i] - probed[p * width + i]);
                    if (!std::isfinite(off)) return {};
                    sizes[i] = std::max(sizes[i], std::abs(read[i]));
                    isGood = isGood && off <= std::max(tolerance, relative * sizes[i]);
                }
            }
        }
        if (stop.stop_requested()) return {};
        if (isGood) return table;
    }
    return {};
}

ExactSolution TabulatedSolution::reader(std::shared_ptr<const TabulatedSolution> table) {
    return [table = std::move(table)](double t, std::span<double> x) { table->at(t, x.data()); };
}

}  // namespace extremal
