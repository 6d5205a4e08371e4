// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "engine/family/field/field_step.hpp"
#include "engine/family/field/leapfrog_kernel.hpp"
#include "engine/family/field/mass_matrix.hpp"

namespace extremal {
namespace {

/// v+ = v + h/2 a(u), u' = u + h v+, v' = v+ + h/2 a(u'), a = M^{-1} (-dU/du).
///
/// The acceleration at the end of a step is that at the start of the next, as long as the values are the ones
/// that were handed out. Of a uniform mesh with a diagonal mass and a force that costs less than keeping it
/// the step is one pass through memory.
class ExplicitField final : public FieldStep {
public:
    ExplicitField(std::shared_ptr<const SpatialForm> shape, double step)
        : FieldStep(std::move(shape), step), mass_(form()) {
        const FieldProblem& problem = form().problem();
        const auto kind = problem.potential.kind();
        const bool isCubic = kind != FieldPotential::Kind::sineGordon && kind != FieldPotential::Kind::typed;
        isStreamed_ = isCubic && form().isLumped() && form().width() == 2 && problem.elastic.isLinear() &&
                      !problem.coefficient && problem.mesh.isUniform() && n() >= 3;
        if (isStreamed_) {
            setChecked();
            const double dx = problem.mesh.length() / problem.mesh.elements(), m = problem.potential.mass();
            kernel_.boundary = problem.mesh.boundary;
            kernel_.k = problem.elastic.k / (dx * dx);
            if (kind == FieldPotential::Kind::kleinGordon) kernel_.alpha = m * m;
            if (kind == FieldPotential::Kind::phi4) kernel_.alpha = -1, kernel_.beta = 1;
            return;
        }
        acceleration_.resize(n());
        of_.resize(n());
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<ExplicitField>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(isKnown_, of_, acceleration_);
        return FieldStep::checkpoint(archive);
    }

private:
    Outcome step(const double* x, double* next, StepReport& report) override {
        const std::size_t size = n();
        const double* v = x + size;
        double* nextV = next + size;
        report.cost.evaluations = form().evaluations();
        if (isStreamed_) {
            kernel_.h = h();
            if (!kernel_.step(x, v, next, nextV, size)) return Outcome::notFinite;
        } else {
            if (!isKnown_ || std::memcmp(of_.data(), x, size * sizeof(double)) != 0)
                accelerate(x, report.cost);
            const double half = h() / 2;
            for (std::size_t i = 0; i < size; ++i) {
                nextV[i] = v[i] + half * acceleration_[i];
                next[i] = x[i] + h() * nextV[i];
            }
            accelerate(next, report.cost);
            for (std::size_t i = 0; i < size; ++i) nextV[i] += half * acceleration_[i];
        }
        return Outcome::converged;
    }
    void accelerate(const double* u, Cost& cost) {
        std::fill(acceleration_.begin(), acceleration_.end(), 0.0);
        form().addForce(u, 1, acceleration_.data());
        mass_.solve(acceleration_.data());
        if (!form().isLumped()) ++cost.linearSolves;
        std::copy_n(u, n(), of_.begin());
        isKnown_ = true;
    }
    bool hasVariations() const override { return true; }
    bool linearise() override {
        const std::size_t size = n();
        const double* const u = before().data();
        std::vector<double> a(size, 0.0), next(size);
        form().addForce(u, 1, a.data());
        mass_.solve(a.data());
        for (std::size_t i = 0; i < size; ++i) next[i] = u[i] + h() * (u[size + i] + h() / 2 * a[i]);
        atStart_ = hessianAt(u);
        atEnd_ = hessianAt(next.data());
        return true;
    }
    /// Kick, drift, kick: dp += h/2 df, du += h M^{-1} dp.
    void vary(std::vector<double>& du, std::vector<double>& dp) override {
        addForceChange(atStart_, du.data(), h() / 2, dp.data());
        rate_ = dp;
        mass_.solve(rate_.data());
        for (std::size_t i = 0; i < n(); ++i) du[i] += h() * rate_[i];
        addForceChange(atEnd_, du.data(), h() / 2, dp.data());
    }
    double slabEnergy(const double* x, const double* next) const override {
        std::vector<double> velocity(n());
        for (std::size_t i = 0; i < n(); ++i) velocity[i] = (next[i] - x[i]) / h();
        return form().kineticEnergy(velocity.data()) + (form().energy(x) + form().energy(next)) / 2;
    }

    MassMatrix mass_;
    bool isStreamed_ = false, isKnown_ = false;
    LeapfrogKernel kernel_;
    std::vector<double> atStart_, atEnd_, rate_;  ///< of the tangent map
    std::vector<double> acceleration_, of_;       ///< a, and the values it belongs to
};

}  // namespace

std::unique_ptr<Integrator> makeExplicitField(std::shared_ptr<const SpatialForm> form, double step) {
    return std::make_unique<ExplicitField>(std::move(form), step);
}

}  // namespace extremal
