// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a typed formula changes: the zeros of the sums inside its functions, such as x - 50 of
/// exp(-(x - 50)^2). A symmetry that is looked for at random states is tried near these places as well, since
/// elsewhere a formula may look as if a variable were not in it.
///
/// Inputs are those of its tapes, (q, v, t). Only sums below the outermost are landmarks; at most `most` of
/// them, those with a constant first.
#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "engine/model/mechanics.hpp"
#include "engine/model/typed/graph.hpp"
#include "engine/model/typed/tape/tape.hpp"

namespace extremal::typed {

class Landmarks {
public:
    static constexpr std::size_t most = 64;

    Landmarks() = default;
    /// Of the formula with this root, whose symbols are below `inputs`.
    Landmarks(const Graph& graph, int root, int inputs);

    std::size_t size() const { return symbols_.size(); }
    /// The inputs that a sum depends on, ascending.
    const std::vector<int>& symbols(std::size_t k) const { return symbols_[k]; }
    /// The value of a sum. Spends work.
    double value(std::size_t k, const double* inputs) const;

private:
    std::vector<Tape> tapes_;
    std::vector<std::vector<int>> symbols_;
};

/// Those of a typed Lagrangian; null where the Lagrangian is not typed.
const Landmarks* landmarksOf(const Mechanics<double>& mechanics);

/// A number near a zero of f, sought by Newton's method from `start`: off by a part of its size that is drawn
/// from 1e-4 to 3. Where there is no zero it is some other number.
template <class F>
double nearZero(const F& f, double start, std::mt19937& random) {
    constexpr int iterations = 40;
    double s = start;
    for (int i = 0; i < iterations; ++i) {
        const double delta = 1e-6 * (1 + std::abs(s));
        const double slope = (f(s + delta) - f(s - delta)) / (2 * delta), next = s - f(s) / slope;
        if (!std::isfinite(next)) break;
        const bool isFound = std::abs(next - s) <= 1e-14 * std::abs(s);
        s = next;
        if (isFound) break;
    }
    const auto uniform = [&] { return 2 * static_cast<double>(random()) / 4294967295.0 - 1; };
    const double width = std::pow(10.0, 2.25 * uniform() - 1.75);
    return s + width * std::max(1.0, std::abs(s)) * uniform();
}

}  // namespace extremal::typed
