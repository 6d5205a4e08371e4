// SPDX-License-Identifier: GPL-3.0-or-later
/// The symplectic Euler method with a drag c, or without one:
///     p_1 = p_0 + h (L_q(q_0, v_0) - c v_0),   q_1 = q_0 + h v(q_0, p_1),   v_0 = v(q_0, p_0).
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "tests/examples/drag.hpp"

namespace extremal::baselines {
namespace {

class DampedEuler final : public Integrator {
public:
    DampedEuler(const System& system, double step) : m_(system.mechanics()), h_(step) {
        if (const Drag* const drag = system.parts.find<Drag>()) c_ = drag->coefficient;
    }

    double stepSize() const override { return h_; }
    void setStep(double step) override { h_ = step; }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<DampedEuler>(*this); }

    StepReport advance(State& state, double until) override {
        const auto d = static_cast<std::size_t>(m_.dimension);
        start_ = state.x;
        double* const q = state.x.data();
        double* const p = q + d;
        std::vector<double> v(d), gradient(2 * d);
        StepReport report;
        report.step = h_;
        bool isRegular = m_.velocity(m_.model.get(), state.t, q, p, v.data());
        m_.gradient(m_.model.get(), state.t, q, v.data(), gradient.data());
        ++report.cost.evaluations;
        for (std::size_t i = 0; i < d; ++i) p[i] += h_ * (gradient[i] - c_ * v[i]);
        isRegular = isRegular && m_.velocity(m_.model.get(), state.t, q, p, v.data());
        for (std::size_t i = 0; i < d; ++i) q[i] += h_ * v[i];
        if (!isRegular) {
            report.outcome = Outcome::singular;
            return report;
        }
        end_ = state.x;
        state.t = until;
        ++state.node;
        return report;
    }

    void denseOutput(double tau, std::span<double> x) const override {
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = (1 - tau) * start_[i] + tau * end_[i];
    }

private:
    Mechanical m_;
    double h_, c_ = 0;
    std::vector<double> start_, end_;
};

}  // namespace

BaselineEntry damped_euler() {
    BaselineEntry e;
    e.item = {"damped-euler", "damped Euler", "Symplectic Euler, with a drag if there is one.", {},
              Claims{1},      "coordinates"};
    e.takes = Takes::only<Mechanical, Drag>();  // what is not in this list is refused
    e.make = [](const System& system, const BaselineOptions& options) {
        return std::make_unique<DampedEuler>(system, options.step);
    };
    return e;
}

}  // namespace extremal::baselines
