// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/plane_leapfrog.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/family/field/step_limit.hpp"
#include "engine/model/plane_field/problem.hpp"
#include "engine/step/field_march.hpp"
#include "engine/step/kick_drift_kick.hpp"

namespace extremal {
namespace {

class PlaneLeapfrog final : public KickDriftKick<FieldMarch> {
public:
    PlaneLeapfrog(std::shared_ptr<const PlaneFieldProblem> problem, double step)
        : KickDriftKick(problem->size(), step), problem_(std::move(problem)), slope_(n()) {
        const wave::Grid& grid = problem_->grid();
        const double dx = grid.x.length / grid.nx, dy = grid.y.length / grid.ny;
        perX_ = 1 / (dx * dx);
        perY_ = grid.dimension() > 1 ? 1 / (dy * dy) : 0;
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<PlaneLeapfrog>(*this); }

private:
    void accelerate(double /*t*/, const double* u, double* a, Cost& cost) override {
        problem_->potential().evaluate(u, nodes(), nodes(), nullptr, slope_.data(), nullptr);
        addDifferences(u, slope_.data(), a);
        cost.evaluations += static_cast<long long>(n());
    }
    std::size_t nodes() const { return problem_->nodes(); }
    /// f = c^2 (D_x + D_y) u - slope.
    void addDifferences(const double* u, const double* slope, double* f) const {
        for (std::size_t c = 0; c < problem_->components(); ++c)
            addDifferences(problem_->stiffness(c), u + c * nodes(), slope + c * nodes(), f + c * nodes());
    }
    void addDifferences(double stiffness, const double* u, const double* slope, double* f) const {
        const auto nx = static_cast<std::size_t>(problem_->grid().nx),
                   ny = static_cast<std::size_t>(problem_->grid().ny);
        const double perX = stiffness * perX_, perY = stiffness * perY_, both = 2 * (perX + perY);
        for (std::size_t j = 0; j < ny; ++j) {
            const double *const row = u + j * nx, *const below = u + (j == 0 ? ny - 1 : j - 1) * nx,
                                *const above = u + (j + 1 == ny ? 0 : j + 1) * nx, *const s = slope + j * nx;
            double* const to = f + j * nx;
            const auto at = [&](std::size_t i, double left, double right) {
                to[i] = perX * (left + right) + perY * (below[i] + above[i]) - both * row[i] - s[i];
            };
            at(0, row[nx - 1], row[1]);
            for (std::size_t i = 1; i + 1 < nx; ++i) at(i, row[i - 1], row[i + 1]);
            at(nx - 1, row[nx - 2], row[0]);
        }
    }

    void linearise(const double* start, const double* end) override {
        const std::size_t m = problem_->components();
        for (const auto& [u, curvature] : {std::pair{start, &atStart_}, {end, &atEnd_}}) {
            curvature->resize(m * (m + 1) / 2 * nodes());
            problem_->potential().evaluate(u, nodes(), nodes(), nullptr, nullptr, curvature->data());
        }
    }
    /// Momenta are dx dy v.
    double mass() const { return problem_->grid().measure() / static_cast<double>(nodes()); }
    void kick(End end, double scale, const double* du, double* dp) override {
        std::vector<double> slope(n(), 0), f(n());
        const double* W = (end == End::start ? atStart_ : atEnd_).data();
        for (std::size_t c = 0; c < problem_->components(); ++c)
            for (std::size_t d = 0; d <= c; ++d, W += nodes())
                for (std::size_t i = 0; i < nodes(); ++i) {
                    slope[c * nodes() + i] += W[i] * du[d * nodes() + i];
                    if (d < c) slope[d * nodes() + i] += W[i] * du[c * nodes() + i];
                }
        addDifferences(du, slope.data(), f.data());
        for (std::size_t i = 0; i < n(); ++i) dp[i] += scale * mass() * f[i];
    }
    void drift(double scale, const double* dp, double* du) override {
        for (std::size_t i = 0; i < n(); ++i) du[i] += scale * dp[i] / mass();
    }

    std::shared_ptr<const PlaneFieldProblem> problem_;
    double perX_ = 0, perY_ = 0;           ///< 1/dx^2, 1/dy^2; of a line 0
    std::vector<double> slope_;            ///< W'
    std::vector<double> atStart_, atEnd_;  ///< W'' at the ends of the last step
};

}  // namespace

std::unique_ptr<Integrator> makePlaneLeapfrog(const System& system, double step) {
    return std::make_unique<PlaneLeapfrog>(system.part<PlaneField>().problem, step);
}

double longestPlaneStep(const PlaneFieldProblem& problem, const double* u, int degree, double eigenvalue,
                        double limit) {
    if (std::isinf(limit)) return limit;
    const wave::Grid& grid = problem.grid();
    const double dx = degree * grid.x.length / grid.nx, dy = degree * grid.y.length / grid.ny;
    std::vector<double> low, high;
    double stiffness = 0;
    for (std::size_t c = 0; c < problem.components(); ++c) {
        const double* const first = u + c * problem.nodes();
        const auto [least, most] = std::minmax_element(first, first + problem.nodes());
        low.push_back(*least);
        high.push_back(*most);
        stiffness = std::max(stiffness, problem.stiffness(c));
    }
    const double curvature = std::max(0.0, problem.potential().largestCurvature(low, high)),
                 perY = grid.dimension() > 1 ? 1 / (dy * dy) : 0;
    return limit / std::sqrt(eigenvalue * stiffness * (1 / (dx * dx) + perY) + curvature);
}

double planeLeapfrogLimit(const PlaneFieldProblem& problem, const double* u) {
    return longestPlaneStep(problem, u, 1, 4, 2);
}

void checkPlaneStep(const PlaneFieldProblem& problem, double longest, const std::string& name,
                    const SchemeCase& scheme, Findings& findings) {
    const wave::Grid& grid = problem.grid();
    refuseLongerStep(longest,
                     name + " on this mesh of " + std::to_string(grid.nx) +
                         (grid.dimension() > 1 ? " x " + std::to_string(grid.ny) : std::string()) + " nodes",
                     scheme, findings);
}

}  // namespace extremal
