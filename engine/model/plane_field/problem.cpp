// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/plane_field/problem.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace extremal {
namespace {

std::vector<double> nodesAlong(const wave::Domain& domain, int n) {
    std::vector<double> nodes;
    for (int j = 0; j < n; ++j) nodes.push_back(domain.left + domain.length * j / n);
    return nodes;
}

using Complex = std::complex<double>;

/// What multiplies mode k >= 0 where the places move by so many cells.
std::vector<Complex> turnsOf(int n, double cells) {
    std::vector<Complex> turns;
    for (int k = 0; 2 * k <= n; ++k) turns.push_back(std::polar(1.0, 2 * std::numbers::pi * cells * k / n));
    return turns;
}

}  // namespace

PlaneFieldProblem::PlaneFieldProblem(const wave::Grid& grid, std::vector<FieldComponent> components,
                                     JointPotential potential)
    : grid_(grid),
      components_(std::move(components)),
      potential_(std::move(potential)),
      x_(nodesAlong(grid.x, grid.nx)),
      y_(nodesAlong(grid.y, grid.ny)) {
    for (std::size_t b = 1; b < this->components(); ++b)
        for (std::size_t a = 0; a < b; ++a)
            if (speed(a) == speed(b) && potential_.turns(a, b)) turns_.emplace_back(a, b);
}

std::vector<double> PlaneFieldProblem::modesOf(const double* u, SpectralGrid& ways) const {
    std::vector<double> U(components() * 2 * ways.modes());
    for (std::size_t c = 0; c < components(); ++c)
        ways.toModes(u + c * nodes(), U.data() + c * 2 * ways.modes());
    return U;
}

template <class F>
void PlaneFieldProblem::forModes(const std::vector<double>& U, const std::vector<double>& V, F&& f) const {
    const int width = grid_.nx / 2 + 1;
    std::size_t i = 0;
    for (std::size_t c = 0; c < components(); ++c)
        for (int l = 0; l < grid_.ny; ++l)
            for (int k = 0; k < width; ++k, i += 2)
                f(c, k, 2 * l > grid_.ny ? l - grid_.ny : l, Complex(U[i], U[i + 1]), Complex(V[i], V[i + 1]),
                  k == 0 || 2 * k == grid_.nx ? 1 : 2);
}

double PlaneFieldProblem::meanPotential(const std::vector<double>& U, SpectralGrid& ways) const {
    if (potential_.isZero()) return 0;
    std::vector<double> moved(2 * ways.modes()), u(size()), W(nodes());
    const auto at = [&](double cellsX, double cellsY) {
        const std::vector<Complex> turnX = turnsOf(grid_.nx, cellsX), turnY = turnsOf(grid_.ny, cellsY);
        std::size_t i = 0;
        forModes(U, U, [&](std::size_t c, int k, int l, auto mode, auto, int) {
            const bool isAlternating = 2 * k == grid_.nx || (grid_.ny > 1 && 2 * l == grid_.ny);
            const Complex across = turnY[static_cast<std::size_t>(std::abs(l))];
            const Complex value = isAlternating ? 0.0
                                                : mode * turnX[static_cast<std::size_t>(k)] *
                                                      (l < 0 ? std::conj(across) : across);
            moved[i] = value.real();
            moved[i + 1] = value.imag();
            i += 2;
            if (i < moved.size()) return;
            ways.toNodes(moved.data(), u.data() + c * nodes());
            i = 0;
        });
        potential_.evaluate(u.data(), nodes(), nodes(), W.data(), nullptr, nullptr);
        double sum = 0;
        for (const double each : W) sum += each;
        return sum / static_cast<double>(nodes());
    };
    const double atRows = (at(0, 0) + at(0.5, 0)) / 2;
    return grid_.ny > 1 ? (atRows + (at(0, 0.5) + at(0.5, 0.5)) / 2) / 2 : atRows;
}

double PlaneFieldProblem::energy(const double* state) const {
    const double turn = 2 * std::numbers::pi;
    SpectralGrid ways(grid_.nx, grid_.ny, grid_.nx, grid_.ny);
    const std::vector<double> U = modesOf(state, ways);
    double quadratic = 0;
    forModes(U, modesOf(state + size(), ways), [&](std::size_t c, int k, int l, auto u, auto v, int weight) {
        const double K = turn * k / grid_.x.length, L = turn * l / grid_.y.length;
        quadratic += weight * (std::norm(v) + stiffness(c) * (K * K + L * L) * std::norm(u)) / 2;
    });
    return grid_.measure() * (quadratic + meanPotential(U, ways));
}

std::array<double, 2> PlaneFieldProblem::momentum(const double* state) const {
    const double turn = 2 * std::numbers::pi;
    std::array<double, 2> sum{};
    SpectralGrid ways(grid_.nx, grid_.ny, grid_.nx, grid_.ny);
    forModes(modesOf(state, ways), modesOf(state + size(), ways),
             [&](std::size_t, int k, int l, auto u, auto v, int weight) {
                 if (2 * k == grid_.nx || 2 * l == grid_.ny) return;
                 const double both = weight * std::imag(u * std::conj(v));
                 sum[0] += turn * k / grid_.x.length * both;
                 sum[1] += turn * l / grid_.y.length * both;
             });
    return {grid_.measure() * sum[0], grid_.measure() * sum[1]};
}

double PlaneFieldProblem::angularMomentum(const double* state) const {
    const double turn = 2 * std::numbers::pi, middleX = grid_.x.left + grid_.x.length / 2,
                 middleY = grid_.y.left + grid_.y.length / 2;
    SpectralGrid ways(grid_.nx, grid_.ny, grid_.nx, grid_.ny);
    std::vector<double> U(2 * ways.modes()), slope(U.size()), along(nodes()), across(nodes());
    const auto derivative = [&](bool isAlongX, std::vector<double>& values) {
        const int width = grid_.nx / 2 + 1;
        for (int l = 0; l < grid_.ny; ++l)
            for (int k = 0; k < width; ++k) {
                const auto i = static_cast<std::size_t>(2 * (k + l * width));
                const bool isAlternating = 2 * k == grid_.nx || 2 * l == grid_.ny;
                const double K = isAlternating ? 0
                                 : isAlongX    ? turn * k / grid_.x.length
                                            : turn * (2 * l > grid_.ny ? l - grid_.ny : l) / grid_.y.length;
                slope[i] = -K * U[i + 1];
                slope[i + 1] = K * U[i];
            }
        ways.toNodes(slope.data(), values.data());
    };
    double sum = 0;
    for (std::size_t c = 0; c < components(); ++c) {
        ways.toModes(state + c * nodes(), U.data());
        derivative(true, along);
        derivative(false, across);
        const double* v = state + size() + c * nodes();
        for (std::size_t j = 0, i = 0; j < y_.size(); ++j)
            for (const double x : x_) {
                sum -= v[i] * ((x - middleX) * across[i] - (y_[j] - middleY) * along[i]);
                ++i;
            }
    }
    return sum * grid_.measure() / static_cast<double>(nodes());
}

std::vector<double> PlaneFieldProblem::charges(const double* state) const {
    std::vector<double> all;
    for (const auto& [a, b] : turns_) {
        const double *const u = state + a * nodes(), *const v = state + b * nodes();
        double sum = 0;
        for (std::size_t i = 0; i < nodes(); ++i) sum += u[i] * v[i + size()] - v[i] * u[i + size()];
        all.push_back(sum * grid_.measure() / static_cast<double>(nodes()));
    }
    return all;
}

double PlaneFieldProblem::tail(const double* state) const {
    double upper = 0, all = 0;
    SpectralGrid ways(grid_.nx, grid_.ny, grid_.nx, grid_.ny);
    const std::vector<double> U = modesOf(state, ways);
    forModes(U, U, [&](std::size_t, int k, int l, auto u, auto, int weight) {
        const double share = weight * std::norm(u);
        all += share;
        if (16 * k >= 7 * grid_.nx || (grid_.ny > 1 && 16 * std::abs(l) >= 7 * grid_.ny)) upper += share;
    });
    return all > 0 ? std::sqrt(upper / all) : 0;
}

void PlaneFieldProblem::removeAlternation(std::vector<double>& state) const {
    SpectralGrid ways(grid_.nx, grid_.ny, grid_.nx, grid_.ny);
    std::vector<double> row(2 * ways.modes()), values(nodes());
    for (std::size_t first = 0; first < state.size(); first += nodes()) {
        ways.toModes(state.data() + first, row.data());
        ways.toPoints(row.data(), values.data());
        for (std::size_t i = 0; i < nodes(); ++i) state[first + i] = values[i];
    }
}

}  // namespace extremal
