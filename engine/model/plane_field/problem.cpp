// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/plane_field/problem.hpp"

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

}  // namespace

PlaneFieldProblem::PlaneFieldProblem(const wave::Grid& grid, double speed, FieldPotential potential)
    : grid_(grid),
      speed_(speed),
      potential_(std::move(potential)),
      x_(nodesAlong(grid.x, grid.nx)),
      y_(nodesAlong(grid.y, grid.ny)) {}

template <class F>
void PlaneFieldProblem::forModes(const double* u, const double* v, F&& f) const {
    SpectralGrid ways(grid_.nx, grid_.ny, grid_.nx, grid_.ny);
    std::vector<double> U(2 * ways.modes()), V(2 * ways.modes());
    ways.toModes(u, U.data());
    ways.toModes(v, V.data());
    const int width = grid_.nx / 2 + 1;
    for (int l = 0; l < grid_.ny; ++l)
        for (int k = 0; k < width; ++k) {
            const auto i = static_cast<std::size_t>(2 * (k + l * width));
            f(k, 2 * l > grid_.ny ? l - grid_.ny : l, std::complex<double>(U[i], U[i + 1]),
              std::complex<double>(V[i], V[i + 1]), k == 0 || 2 * k == grid_.nx ? 1 : 2);
        }
}

double PlaneFieldProblem::energy(const double* state) const {
    const double turn = 2 * std::numbers::pi;
    double quadratic = 0;
    forModes(state, state + size(), [&](int k, int l, auto u, auto v, int weight) {
        const double K = turn * k / grid_.x.length, L = turn * l / grid_.y.length;
        quadratic += weight * (std::norm(v) + stiffness() * (K * K + L * L) * std::norm(u)) / 2;
    });
    SpectralGrid fine(grid_.nx, grid_.ny, 2 * grid_.nx, 2 * grid_.ny);
    std::vector<double> U(2 * fine.modes()), u(fine.points()), W(fine.points());
    fine.toModes(state, U.data());
    fine.toPoints(U.data(), u.data());
    potential_.evaluate(u.data(), u.size(), W.data(), nullptr, nullptr);
    double sum = 0;
    for (const double each : W) sum += each;
    return grid_.measure() * (quadratic + sum / static_cast<double>(W.size()));
}

std::array<double, 2> PlaneFieldProblem::momentum(const double* state) const {
    const double turn = 2 * std::numbers::pi;
    std::array<double, 2> sum{};
    forModes(state, state + size(), [&](int k, int l, auto u, auto v, int weight) {
        if (2 * k == grid_.nx || 2 * l == grid_.ny) return;
        const double both = weight * std::imag(u * std::conj(v));
        sum[0] += turn * k / grid_.x.length * both;
        sum[1] += turn * l / grid_.y.length * both;
    });
    return {grid_.measure() * sum[0], grid_.measure() * sum[1]};
}

double PlaneFieldProblem::tail(const double* state) const {
    double upper = 0, all = 0;
    forModes(state, state, [&](int k, int l, auto u, auto, int weight) {
        const double share = weight * std::norm(u);
        all += share;
        if (16 * k >= 7 * grid_.nx || 16 * std::abs(l) >= 7 * grid_.ny) upper += share;
    });
    return all > 0 ? std::sqrt(upper / all) : 0;
}

void PlaneFieldProblem::removeAlternation(std::vector<double>& state) const {
    SpectralGrid ways(grid_.nx, grid_.ny, grid_.nx, grid_.ny);
    std::vector<double> row(2 * ways.modes()), values(size());
    for (const std::size_t first : {std::size_t{0}, size()}) {
        ways.toModes(state.data() + first, row.data());
        ways.toPoints(row.data(), values.data());
        for (std::size_t i = 0; i < size(); ++i) state[first + i] = values[i];
    }
}

}  // namespace extremal
