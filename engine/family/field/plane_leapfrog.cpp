// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/plane_leapfrog.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/family/field/plane_leapfrog_kernel.hpp"
#include "engine/family/field/step_limit.hpp"
#include "engine/model/plane_field/problem.hpp"
#include "engine/step/field_march.hpp"
#include "engine/step/kick_drift_kick.hpp"

namespace extremal {
namespace {

/// A row of nodes and the rows below and above it.
struct Row {
    const double *here, *below, *above;
    std::size_t n;
    double perX, perY;  ///< c^2/dx^2, c^2/dy^2
};

/// to = c^2 (D_x + D_y) u - slope.
void differencesOf(const Row& row, const double* slope, double* to) {
    const double both = 2 * (row.perX + row.perY);
    const auto at = [&](std::size_t i, double left, double right) {
        to[i] = row.perX * (left + right) + row.perY * (row.below[i] + row.above[i]) - both * row.here[i] -
                slope[i];
    };
    at(0, row.here[row.n - 1], row.here[1]);
    for (std::size_t i = 1; i + 1 < row.n; ++i) at(i, row.here[i - 1], row.here[i + 1]);
    at(row.n - 1, row.here[row.n - 2], row.here[0]);
}

/// Of one component with a cubic as its force the step is one pass through memory.
class PlaneLeapfrog final : public KickDriftKick<FieldMarch> {
public:
    PlaneLeapfrog(std::shared_ptr<const PlaneFieldProblem> problem, double step)
        : KickDriftKick(problem->size(), step), problem_(std::move(problem)) {
        const wave::Grid& grid = problem_->grid();
        const double dx = grid.x.length / grid.nx, dy = grid.y.length / grid.ny;
        perX_ = 1 / (dx * dx);
        perY_ = grid.dimension() > 1 ? 1 / (dy * dy) : 0;
        const auto slope = problem_->potential().cubicSlope();
        if (!slope || grid.ny < 3 || grid.nx < 2) return;
        setChecked();
        streamed_ = {static_cast<std::size_t>(grid.nx), static_cast<std::size_t>(grid.ny), h(),
                     problem_->stiffness() * perX_,     problem_->stiffness() * perY_,     *slope};
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<PlaneLeapfrog>(*this); }

private:
    void prepare() override {
        if (!streamed_) KickDriftKick::prepare();
    }
    Outcome step(const double* x, double* next, StepReport& report) override {
        if (!streamed_) return KickDriftKick::step(x, next, report);
        streamed_->h = h();
        report.cost.evaluations += static_cast<long long>(n());
        return streamed_->step(x, x + n(), next, next + n()) ? Outcome::converged : Outcome::notFinite;
    }
    Row rowOf(const double* u, std::size_t j, double stiffness) const {
        const auto nx = static_cast<std::size_t>(problem_->grid().nx),
                   ny = static_cast<std::size_t>(problem_->grid().ny);
        return {u + j * nx,
                u + (j == 0 ? ny - 1 : j - 1) * nx,
                u + (j + 1 == ny ? 0 : j + 1) * nx,
                nx,
                stiffness * perX_,
                stiffness * perY_};
    }
    void accelerate(double /*t*/, const double* u, double* a, Cost& cost) override {
        slope_.resize(n());
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
        for (std::size_t j = 0; j < ny; ++j) differences_(rowOf(u, j, stiffness), slope + j * nx, f + j * nx);
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
    std::optional<PlaneLeapfrogKernel> streamed_;
    ForThisMachine<& differencesOf>::Call differences_ = ForThisMachine<&differencesOf>::call();
    double perX_ = 0, perY_ = 0;           ///< 1/dx^2, 1/dy^2; of a line 0
    std::vector<double> slope_;            ///< W'
    std::vector<double> atStart_, atEnd_;  ///< W'' at the ends of the last step
};

}  // namespace

std::unique_ptr<Integrator> makePlaneLeapfrog(const System& system, double step) {
    return std::make_unique<PlaneLeapfrog>(system.part<PlaneField>().problem, step);
}

double longestPlaneStep(const PlaneFieldProblem& problem, const double* u, int degree,
                        const AxisEigenvalues& eigenvalues, double limit) {
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
    return limit / std::sqrt(stiffness * (eigenvalues.x / (dx * dx) + eigenvalues.y * perY) + curvature);
}

double planeLeapfrogLimit(const PlaneFieldProblem& problem, const double* u) {
    return longestPlaneStep(problem, u, 1, {4, 4}, 2);
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
