// SPDX-License-Identifier: GPL-3.0-or-later
/// The extrapolation code of Boost.odeint: modified midpoint rules of 2, 6, 10, ... substeps extrapolated to
/// substeps of length zero, with step and number of rules chosen by work per unit of time, and its own
/// interpolant. Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.9.
#include <boost/numeric/odeint/stepper/bulirsch_stoer_dense_out.hpp>

#include <algorithm>
#include <cmath>
#include <exception>

#include "engine/baseline/adaptive_method.hpp"

namespace extremal::baselines {
namespace {

class BulirschStoer final : public AdaptiveMethod {
public:
    BulirschStoer(const Mechanics<double>& mechanics, const BaselineOptions& options)
        : AdaptiveMethod(mechanics), stepper_(options.tolerance, options.tolerance) {}

    void denseOutput(double tau, std::span<double> x) const override {
        Vector y(size());
        stepper_.calc_state(startTime() + tau * (endTime() - startTime()), y);
        std::copy(y.begin(), y.end(), x.begin());
    }

    std::string tangentProblem() const override {
        return "its library extrapolates with an order that depends on the state, and gives no derivatives";
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<BulirschStoer>(*this); }
    /// The orders and steps that it has in mind are private to the library.
    bool checkpoint(Archive&) override { return false; }

private:
    /// Thrown out of the right-hand side, the only way to end a step of odeint early.
    struct Trouble {
        Outcome outcome;
    };

    Outcome take(double& t, Vector& x, double& next, StepReport& report, bool isContinued) override {
        const double start = t, remaining = end() - t;
        if (!isContinued) stepper_.initialize(x, t, std::min(next > 0 ? next : firstStep(t, x), remaining));
        if (stepper_.current_time_step() >= remaining * (1 - 1e-12)) stepper_.initialize(x, t, remaining);
        double tried = stepper_.current_time_step();
        auto rhs = [&](const Vector& at, Vector& dx, double time) {
            ++report.cost.evaluations;
            if (stop().stop_requested()) throw Trouble{Outcome::stopped};
            if (!flow(time, at.data(), dx.data())) throw Trouble{Outcome::singular};
            // A refusal shows only in the step of the next try.
            report.cost.rejected += stepper_.current_time_step() != tried;
            tried = stepper_.current_time_step();
        };
        try {
            t = stepper_.do_step(rhs).second;
        } catch (const Trouble& trouble) {
            return trouble.outcome;
        } catch (const std::exception&) {
            return Outcome::stepBudget;  // 500 refusals
        }
        if (end() - t <= 1e-9 * remaining) t = end();
        x = stepper_.current_state();
        next = stepper_.current_time_step();
        return t > start ? Outcome::converged : Outcome::stepBudget;
    }

    boost::numeric::odeint::bulirsch_stoer_dense_out<Vector> stepper_;
};

}  // namespace

BaselineEntry bulirsch_stoer() {
    BaselineEntry e;
    e.item = {"bulirsch-stoer",
              "Bulirsch-Stoer",
              "Boost.odeint's extrapolation of midpoint rules: long steps of high, variable order.",
              {},
              Claims{},
              "smooth forces"};
    e.grid = TimeGrid::landing;
    e.takes = flowProblems();
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<BulirschStoer>(flowOf(system), options);
    };
    return e;
}

}  // namespace extremal::baselines
