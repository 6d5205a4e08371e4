// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/density_leapfrog.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/family/field/field_step.hpp"
#include "engine/model/density/cell_sum.hpp"
#include "engine/step/kick_drift_kick.hpp"

namespace extremal {
namespace {

using By = CellSum::By;

class DensityLeapfrog final : public KickDriftKick<FieldStep> {
public:
    DensityLeapfrog(std::shared_ptr<const DensityProblem> problem, double step)
        : KickDriftKick(problem->size(), step),
          problem_(problem),
          sum_(CellSum::ofInstant(problem, trapezoid<double>(1))),
          mass_(n(), 0.0),
          rest_(n(), 0.0) {
        sum_.addMass(mass_.data());
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<DensityLeapfrog>(*this); }

private:
    bool isHeld(std::size_t i) const override { return problem_->isFixed(i); }
    bool isTimeDependent() const override { return problem_->density.isTimeDependent(); }
    void accelerate(double t, const double* u, double* a, Cost& cost) override {
        std::fill_n(a, n(), 0.0);
        sum_.addGradient(t, u, rest_.data(), By::first, a);
        for (std::size_t i = 0; i < n(); ++i) a[i] = isHeld(i) ? 0 : a[i] / mass_[i];
        cost.evaluations += sum_.evaluations();
    }
    void linearise(const double* start, const double* end) override {
        for (const auto& [u, t, entries] :
             {std::tuple{start, begin(), &atStart_}, {end, begin() + h(), &atEnd_}}) {
            entries->clear();
            sum_.addHessian(t, u, rest_.data(), By::first, By::first,
                            [to = entries](std::size_t i, std::size_t j, double value) {
                                to->push_back({i, j, value});
                            });
        }
    }
    /// The Hessian is that of L, -d2U.
    void kick(End end, double scale, const double* du, double* dp) override {
        for (const Entry& e : end == End::start ? atStart_ : atEnd_)
            if (!isHeld(e.i)) dp[e.i] += scale * e.value * du[e.j];
    }
    void drift(double scale, const double* dp, double* du) override {
        for (std::size_t i = 0; i < n(); ++i) du[i] += scale * dp[i] / mass_[i];
    }
    double slabEnergy(const double* before, const double* after) const override {
        double kinetic = 0;
        for (std::size_t i = 0; i < n(); ++i) {
            const double v = (after[i] - before[i]) / h();
            kinetic += mass_[i] * v * v / 2;
        }
        return kinetic -
               (sum_.value(begin(), before, rest_.data()) + sum_.value(begin() + h(), after, rest_.data())) /
                   2;
    }

    struct Entry {
        std::size_t i, j;
        double value;
    };
    std::shared_ptr<const DensityProblem> problem_;
    CellSum sum_;
    std::vector<double> mass_, rest_;  ///< M, and velocities of 0
    std::vector<Entry> atStart_, atEnd_;
};

}  // namespace

std::unique_ptr<Integrator> makeDensityLeapfrog(std::shared_ptr<const DensityProblem> problem, double step) {
    return std::make_unique<DensityLeapfrog>(std::move(problem), step);
}

double densityLeapfrogLimit(const std::shared_ptr<const DensityProblem>& problem, double t, const double* u) {
    const CellSum sum = CellSum::ofInstant(problem, trapezoid<double>(1));
    double largest = 0;
    const bool isKnown =
        sum.forElements(t, u, [&](const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& mass) {
            const Eigen::VectorXd root = mass.cwiseSqrt().cwiseInverse();
            const Eigen::MatrixXd scaled = root.asDiagonal() * stiffness * root.asDiagonal();
            largest = std::max(largest,
                               Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
                                   .eigenvalues()
                                   .maxCoeff());
        });
    if (!isKnown) return std::numeric_limits<double>::quiet_NaN();
    return largest > 0 ? 2 / std::sqrt(largest) : std::numeric_limits<double>::infinity();
}

}  // namespace extremal
