// SPDX-License-Identifier: GPL-3.0-or-later
/// Method of lines for fields: second differences in space (the mass at the nodes), and the classical
/// Runge-Kutta method of order 4 in time.
#include <algorithm>
#include <array>
#include <utility>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/baseline/classical_table.hpp"
#include "engine/baseline/field_method.hpp"
#include "engine/family/field/field_step.hpp"
#include "engine/family/field/step_limit.hpp"

namespace extremal::baselines {
namespace {

class LinesRk4 final : public FieldMarch {
public:
    LinesRk4(std::shared_ptr<const SpatialForm> shape, double step) : FieldMarch(std::move(shape), step) {
        inverse_ = form().lumpedMass();
        for (int i = 0; i < form().size(); ++i) {
            double& m = inverse_[static_cast<std::size_t>(i)];
            m = form().problem().isFixed(i) ? 0 : 1 / m;
        }
        for (auto* v : {&at_, &rate_}) v->resize(2 * n());
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<LinesRk4>(*this); }

private:
    Outcome step(const double* x, double* next, StepReport& report) override {
        using classical::node, classical::weight;
        std::copy_n(x, 2 * n(), next);
        for (std::size_t stage = 0; stage < classical::stages; ++stage) {
            for (std::size_t i = 0; i < 2 * n(); ++i)
                at_[i] = stage == 0 ? x[i] : x[i] + node[stage] * h() * rate_[i];
            std::copy_n(at_.begin() + static_cast<std::ptrdiff_t>(n()), n(), rate_.begin());
            double* acceleration = rate_.data() + n();
            std::fill_n(acceleration, n(), 0.0);
            form().addForce(at_.data(), 1, acceleration);
            for (std::size_t i = 0; i < n(); ++i) acceleration[i] *= inverse_[i];
            for (std::size_t i = 0; i < 2 * n(); ++i) next[i] += weight[stage] * h() * rate_[i];
        }
        report.cost.evaluations = 4 * form().evaluations();
        return Outcome::converged;
    }

    /// The stages of the variational equation du' = M^{-1} dp, dp' = -H du.
    bool hasVariations() const override { return true; }
    bool linearise() override {
        std::vector<double> at(before()), acceleration(n());
        const double* const x = before().data();
        for (std::size_t stage = 0; stage < classical::stages; ++stage) {
            hessians_[stage] = hessianAt(at.data());
            std::fill(acceleration.begin(), acceleration.end(), 0.0);
            form().addForce(at.data(), 1, acceleration.data());
            const double ahead = stage < 2 ? h() / 2 : h();
            for (std::size_t i = 0; i < n(); ++i) {
                at[i] = x[i] + ahead * at[n() + i];
                at[n() + i] = x[n() + i] + ahead * acceleration[i] * inverse_[i];
            }
        }
        return true;
    }
    void vary(std::vector<double>& du, std::vector<double>& dp) override {
        using classical::weight;
        const std::vector<double> u = du, p = dp;
        std::vector<double> atU = du, atP = dp, force(n());
        for (std::size_t stage = 0; stage < classical::stages; ++stage) {
            std::fill(force.begin(), force.end(), 0.0);
            addForceChange(hessians_[stage], atU.data(), 1, force.data());
            const double ahead = stage < 2 ? h() / 2 : h();
            for (std::size_t i = 0; i < n(); ++i) {
                const double rate = inverse_[i] * atP[i], kick = inverse_[i] > 0 ? force[i] : 0;
                du[i] += weight[stage] * h() * rate;
                dp[i] += weight[stage] * h() * kick;
                atU[i] = u[i] + ahead * rate;
                atP[i] = p[i] + ahead * kick;
            }
        }
    }

    std::vector<double> inverse_, at_, rate_;
    std::array<std::vector<double>, 4> hessians_;
};

constexpr double limit = 2.8284271247461903;  // |R(iz)| <= 1 up to 2 sqrt 2

}  // namespace

BaselineEntry method_of_lines_rk4() {
    BaselineEntry e;
    e.item = {
        "method-of-lines-rk4",
        "method of lines, RK4",
        "Fields: second differences in space, the classical Runge-Kutta method of order 4 in time; energy is "
        "lost.",
        {},
        Claims{2, false, false, {"momentum"}},
        "a field"};
    e.takes = Takes::only<ScalarField>();
    e.parts.set(OscillatorLimit(limit));
    e.parts.set(StepCheck{[](const SchemeCase& scheme, Findings& findings) {
        checkFieldStep(*lumpedForm(scheme.system), limit, scheme, "method-of-lines-rk4", findings);
    }});
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<LinesRk4>(lumpedForm(system), options.step);
    };
    return e;
}

}  // namespace extremal::baselines
