// SPDX-License-Identifier: GPL-3.0-or-later
/// Explicit codes of Boost.odeint under its own error control.
///
/// A step below round-off of t, or 500 refusals in a row, is Outcome::stepBudget.
#pragma once

#include <boost/numeric/odeint/stepper/generation/generation_controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_fehlberg78.hpp>
#include <boost/numeric/odeint/stepper/generation/make_controlled.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "engine/baseline/adaptive_method.hpp"

namespace extremal {

template <class Stepper>
class Adaptive final : public AdaptiveMethod {
public:
    Adaptive(const Mechanics<double>& mechanics, const BaselineOptions& options)
        : AdaptiveMethod(mechanics), stepper_(controlled(options)) {}
    Adaptive(Rate rate, std::size_t n, const BaselineOptions& options)
        : AdaptiveMethod(std::move(rate), n), stepper_(controlled(options)) {}

    void denseOutput(double tau, std::span<double> x) const override {
        Stepper shorter;
        Vector y(size());
        const auto rhs = [&](const Vector& at, Vector& dx, double time) { flow(time, at.data(), dx.data()); };
        shorter.do_step(rhs, before(), startTime(), y, tau * (endTime() - startTime()));
        std::copy(y.begin(), y.end(), x.begin());
    }

    std::size_t tangentSize() const override { return isHamiltonian() ? size() : 0; }
    std::string tangentProblem() const override {
        return "only the flow of a Lagrangian or a Hamiltonian alone is varied";
    }
    bool applyTangent(std::span<double> W) override {
        Stepper same;
        bool isKnown = true;
        const auto rhs = [&](const Vector& at, Vector& dx, double time) {
            isKnown = isKnown && variationalFlow(time, at.data(), dx.data(), at.size());
        };
        extended_ = before();
        extended_.insert(extended_.end(), W.begin(), W.end());
        same.do_step(rhs, extended_, startTime(), endTime() - startTime());
        std::copy(extended_.begin() + static_cast<std::ptrdiff_t>(size()), extended_.end(), W.begin());
        return isKnown;
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Adaptive>(*this); }
    /// What a formula keeps of its last step is the derivative at its end.
    bool checkpoint(Archive& archive) override {
        AdaptiveMethod::checkpoint(archive);
        if constexpr (requires { stepper_.reset(); })
            if (archive.isReading()) {
                const auto rhs = [&](const Vector& at, Vector& dx, double time) {
                    flow(time, at.data(), dx.data());
                };
                Vector x = after();
                double t = endTime(), h = 0;
                (void)stepper_.try_step(rhs, x, t, h);  // which takes its memory
                stepper_.initialize(rhs, after(), endTime());
            }
        return true;
    }

private:
    static auto controlled(const BaselineOptions& options) {
        return boost::numeric::odeint::make_controlled(options.tolerance, options.tolerance, Stepper());
    }

    Outcome take(double& t, Vector& x, double& next, StepReport& report, bool isContinued) override {
        // What a formula keeps of its last step belongs to that.
        if constexpr (requires { stepper_.reset(); })
            if (!isContinued) stepper_.reset();
        bool isSingular = false;
        auto rhs = [&](const Vector& at, Vector& dx, double time) {
            ++report.cost.evaluations;
            isSingular = isSingular || !flow(time, at.data(), dx.data());
        };
        if (next == 0) next = firstStep(t, x);
        for (int refused = 0; refused < 500; ++refused) {
            if (stop().stop_requested()) return Outcome::stopped;
            const double remaining = end() - t;
            const bool isLast = next >= remaining * (1 - 1e-12);
            double h = isLast ? remaining : next;
            if (h < 4e-16 * std::max(std::abs(t), 1e-300) && !isLast) return Outcome::stepBudget;
            const auto result = stepper_.try_step(rhs, x, t, h);
            if (isSingular) return Outcome::singular;
            const bool isDone = result == boost::numeric::odeint::success;
            // odeint proposes in h. A last step cut short says nothing against a larger one.
            next = isLast && isDone ? std::max(next, h) : h;
            if (isDone) {
                if (isLast) t = end();
                return Outcome::converged;
            }
            ++report.cost.rejected;
            if (!std::isfinite(h)) return Outcome::notFinite;
        }
        return Outcome::stepBudget;
    }

    decltype(boost::numeric::odeint::make_controlled(1.0, 1.0, Stepper())) stepper_;
    Vector extended_;  ///< x and columns of variations
};

}  // namespace extremal
