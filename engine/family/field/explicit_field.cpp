// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <utility>

#include "engine/family/field/field_step.hpp"
#include "engine/family/field/leapfrog_kernel.hpp"
#include "engine/family/field/mass_matrix.hpp"
#include "engine/step/kick_drift_kick.hpp"

namespace extremal {
namespace {

/// By the form of the elements. Of a uniform mesh with a diagonal mass and a force that costs less than
/// keeping it the step is one pass through memory.
class ExplicitField final : public KickDriftKick<FieldStep> {
public:
    ExplicitField(std::shared_ptr<const SpatialForm> shape, double step)
        : KickDriftKick(std::move(shape), step), mass_(form()) {
        const FieldProblem& problem = form().problem();
        const auto slope = problem.potential.cubicSlope();
        isStreamed_ = slope && form().isLumped() && form().width() == 2 && problem.elastic.isLinear() &&
                      !problem.coefficient && problem.mesh.isUniform() && n() >= 3;
        if (isStreamed_) {
            setChecked();
            const double dx = problem.mesh.length() / problem.mesh.elements();
            kernel_.boundary = problem.mesh.boundary;
            kernel_.k = problem.elastic.k / (dx * dx);
            kernel_.slope = *slope;
        }
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<ExplicitField>(*this); }

private:
    void prepare() override {
        if (!isStreamed_) KickDriftKick::prepare();
    }
    Outcome step(const double* x, double* next, StepReport& report) override {
        const std::size_t size = n();
        report.cost.evaluations = form().evaluations();
        if (!isStreamed_) return KickDriftKick::step(x, next, report);
        kernel_.h = h();
        return kernel_.step(x, x + size, next, next + size, size) ? Outcome::converged : Outcome::notFinite;
    }
    void accelerate(double /*t*/, const double* u, double* a, Cost& cost) override {
        std::fill_n(a, n(), 0.0);
        form().addForce(u, 1, a);
        mass_.solve(a);
        if (!form().isLumped()) ++cost.linearSolves;
    }
    void linearise(const double* start, const double* end) override {
        atStart_ = hessianAt(start);
        atEnd_ = hessianAt(end);
    }
    void kick(End end, double scale, const double* du, double* dp) override {
        addForceChange(end == End::start ? atStart_ : atEnd_, du, scale, dp);
    }
    void drift(double scale, const double* dp, double* du) override {
        rate_.assign(dp, dp + n());
        mass_.solve(rate_.data());
        for (std::size_t i = 0; i < n(); ++i) du[i] += scale * rate_[i];
    }
    double slabEnergy(const double* x, const double* next) const override {
        std::vector<double> velocity(n());
        for (std::size_t i = 0; i < n(); ++i) velocity[i] = (next[i] - x[i]) / h();
        return form().kineticEnergy(velocity.data()) + (form().energy(x) + form().energy(next)) / 2;
    }

    MassMatrix mass_;
    bool isStreamed_ = false;
    LeapfrogKernel kernel_;
    std::vector<double> atStart_, atEnd_, rate_;  ///< of the tangent map
};

}  // namespace

std::unique_ptr<Integrator> makeExplicitField(std::shared_ptr<const SpatialForm> form, double step) {
    return std::make_unique<ExplicitField>(std::move(form), step);
}

}  // namespace extremal
