// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/stability/linear_region.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "engine/core/problem.hpp"
#include "engine/model/complex_oscillator.hpp"
#include "engine/study/search/one_step.hpp"

namespace extremal {
namespace {

using Complex = std::complex<double>;

/// Of (q, p), at h = 1.
struct ComplexStep {
    Complex a, b, c, d;  ///< by rows
};

/// None where a step has no solution.
std::optional<ComplexStep> stepOn(const ResolvedScheme& scheme, Complex lambda) {
    const System system = complexOscillator(-lambda * lambda);
    State start;
    start.x = {1, 0, 0, 0};
    OneStep step(scheme, system, 1, start);
    Complex M[2][2];
    for (const std::size_t column : {0UL, 1UL}) {
        State state = start;
        state.x = {column == 0 ? 1.0 : 0.0, 0, column == 1 ? 1.0 : 0.0, 0};
        step.begin(state);
        if (scheme.isFixed() && !state.memory.empty())
            throw InvalidScene("", "its steps depend on more than the state");
        if (!step.take(state)) return {};
        M[0][column] = {state.x[0], state.x[1]};
        M[1][column] = {state.x[2], -state.x[3]};
    }
    return ComplexStep{M[0][0], M[0][1], M[1][0], M[1][1]};
}

struct Root {
    Complex r = 1;
    bool isOnCut = false;
};

/// The eigenvalue that stands for exp(lambda).
Root rootOf(const ComplexStep& M, Complex lambda) {
    if (lambda == 0.0) return {};
    const Complex half = (M.a + M.d) / 2.0, apart = std::sqrt((M.a - M.d) * (M.a - M.d) / 4.0 + M.b * M.c);
    const Complex r[2] = {half + apart, half - apart};
    // Re(s / lambda), s = p/q of the eigenvector, from the row that is better scaled.
    const auto likeness = [&](Complex root) {
        const Complex s = std::abs(M.b) > 0 ? (root - M.a) / M.b : M.c / (root - M.d);
        return (s / lambda).real() / std::abs(s / lambda);
    };
    const double first = likeness(r[0]), second = likeness(r[1]);
    constexpr double clear = 1e-6;
    if (!(std::abs(first - second) > clear)) return {std::abs(r[0]) > std::abs(r[1]) ? r[0] : r[1], true};
    return {first > second ? r[0] : r[1], false};
}

}  // namespace

LinearRegion linearRegion(const ResolvedScheme& scheme, const std::stop_token& stop) {
    if (!scheme.fits(complexOscillator(1)))
        throw InvalidScene("", "its lambda is imaginary: the interval is all");
    LinearRegion region;
    for (int column = 0; column < LinearRegion::columns; ++column)
        for (int row = 0; row < LinearRegion::rows && !stop.stop_requested(); ++row) {
            const Complex z{LinearRegion::re(column), LinearRegion::im(row)};
            LinearRegion::Point point;
            if (const std::optional<ComplexStep> M = stepOn(scheme, z)) {
                const auto [r, isOnCut] = rootOf(*M, z);
                constexpr double turn = 2 * std::numbers::pi;
                const double phase = std::arg(r);
                point.isOnCut = isOnCut;
                point.amplification = std::abs(r);
                point.phaseError =
                    z == 0.0
                        ? 0
                        : (phase + turn * std::round((z.imag() - phase) / turn) - z.imag()) / std::abs(z);
            }
            region.points.push_back(point);
        }
    return region;
}

}  // namespace extremal
