/// Adaptive explicit codes of Boost.odeint under error control, on (q, p) or on any system of first order: the library
/// answer to "just integrate it".
///
/// advance() takes one accepted step; the last one lands on the end. Both relative and absolute tolerance are the
/// scene's tolerance. A step below round-off of t, or 500 refusals in a row, is Outcome::stepBudget.
#pragma once

#include <boost/numeric/odeint.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "engine/baseline/catalog.hpp"

namespace extremal {

template <class Stepper>
class Adaptive final : public Integrator {
    using Vector = std::vector<double>;

public:
    /// xdot = rate(t, x); false where it is not defined.
    using Rate = std::function<bool(double t, const double* x, double* dx)>;

    Adaptive(const Mechanics<double>& m, const BaselineOptions& options)
        : Adaptive(
              [m](double t, const double* x, double* dx) {
                  return m.flow(m.model.get(), t, x, x + m.dimension, dx, dx + m.dimension);
              },
              static_cast<std::size_t>(2 * m.dimension), options) {}

    Adaptive(Rate rate, std::size_t n, const BaselineOptions& options)
        : rate_(std::move(rate)),
          end_(options.end),
          stepper_(boost::numeric::odeint::make_controlled(options.tolerance, options.tolerance, Stepper())) {
        for (Vector* v : {&x_, &before_, &slopeBefore_, &slopeAfter_}) v->assign(n, 0);
    }

    StepReport advance(State& state) override {
        StepReport report;
        x_ = before_ = state.x;
        startTime_ = state.t;
        auto rhs = [&](const Vector& x, Vector& dx, double t) {
            ++report.evaluations;
            isSingular_ = isSingular_ || !flow(t, x, dx);
        };
        if (step_ == 0) step_ = firstStep(state);
        double t = state.t;
        for (int refused = 0; refused < 500; ++refused) {
            if (stop().stop_requested()) return give(report, Outcome::stopped);
            const double remaining = end_ - t;
            const bool isLast = step_ >= remaining * (1 - 1e-12);
            double h = isLast ? remaining : step_;
            if (h < 4e-16 * std::max(std::abs(t), 1e-300) && !isLast) return give(report, Outcome::stepBudget);
            const double tried = h;
            const auto result = stepper_.try_step(rhs, x_, t, h);
            if (isSingular_) return give(report, Outcome::singular);
            // odeint proposes in h. A last step cut short says nothing against a larger one.
            step_ = isLast && result == boost::numeric::odeint::success ? std::max(step_, h) : h;
            if (result == boost::numeric::odeint::success) {
                if (!std::all_of(x_.begin(), x_.end(), [](double v) { return std::isfinite(v); }))
                    return give(report, Outcome::notFinite);
                state.x = x_;
                endTime_ = state.t = isLast ? end_ : t;
                ++state.node;
                report.step = tried;
                return report;
            }
            ++report.rejected;
            if (!std::isfinite(h)) return give(report, Outcome::notFinite);
        }
        return give(report, Outcome::stepBudget);
    }

    /// Cubic Hermite interpolant of the step.
    void curve(double tau, std::span<double> x) const override {
        const double h = endTime_ - startTime_;
        flow(startTime_, before_, slopeBefore_);
        flow(endTime_, x_, slopeAfter_);
        const double a = (1 + 2 * tau) * (1 - tau) * (1 - tau), b = tau * (1 - tau) * (1 - tau) * h;
        const double c = tau * tau * (3 - 2 * tau), e = tau * tau * (tau - 1) * h;
        for (std::size_t i = 0; i < x_.size(); ++i)
            x[i] = a * before_[i] + b * slopeBefore_[i] + c * x_[i] + e * slopeAfter_[i];
    }

private:
    static StepReport give(StepReport report, Outcome outcome) {
        report.outcome = outcome;
        return report;
    }
    bool flow(double t, const Vector& x, Vector& dx) const { return rate_(t, x.data(), dx.data()); }
    /// A cautious first step: 1/1000 of the time scale |x| / |xdot|, at most a hundredth of what is left.
    double firstStep(const State& state) const {
        Vector dx(state.x.size());
        flow(state.t, state.x, dx);
        double size = 0, rate = 0;
        for (std::size_t i = 0; i < dx.size(); ++i) {
            size = std::max(size, std::abs(state.x[i]));
            rate = std::max(rate, std::abs(dx[i]));
        }
        const double cap = (end_ - state.t) / 100;
        return rate > 0 && size > 0 && std::isfinite(rate) ? std::min(cap, 1e-3 * size / rate) : cap * 1e-3;
    }

    Rate rate_;
    double end_, step_ = 0, startTime_ = 0, endTime_ = 0;
    bool isSingular_ = false;
    decltype(boost::numeric::odeint::make_controlled(1.0, 1.0, Stepper())) stepper_;
    Vector x_, before_;
    mutable Vector slopeBefore_, slopeAfter_;
};

}  // namespace extremal
