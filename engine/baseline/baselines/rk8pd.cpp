// SPDX-License-Identifier: GPL-3.0-or-later
/// Prince and Dormand's Runge-Kutta pair 8(9) of the GNU Scientific Library, under its standard step control.
#include <algorithm>
#include <limits>
#include <memory>
#include <stop_token>

#include "engine/baseline/adaptive_method.hpp"
#include "engine/model/spins/spins.hpp"

#if EXTREMAL_HAS_GSL
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#endif

namespace extremal::baselines {
namespace {

#if EXTREMAL_HAS_GSL
template <auto destroy>
struct Freed {
    template <class T>
    void operator()(T* p) const {
        destroy(p);
    }
};

using Step = std::unique_ptr<gsl_odeiv2_step, Freed<gsl_odeiv2_step_free>>;

class Rk8pd final : public AdaptiveMethod {
public:
    Rk8pd(const Mechanics<double>& mechanics, const BaselineOptions& options)
        : AdaptiveMethod(mechanics),
          tolerance_(options.tolerance),
          step_(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, size())),
          control_(gsl_odeiv2_control_y_new(options.tolerance, options.tolerance)),
          evolve_(gsl_odeiv2_evolve_alloc(size())) {}
    /// The library's own memory is that of the derivative at the state, which is computed anew.
    Rk8pd(const Rk8pd& other)
        : AdaptiveMethod(other),
          tolerance_(other.tolerance_),
          step_(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, size())),
          control_(gsl_odeiv2_control_y_new(tolerance_, tolerance_)),
          evolve_(gsl_odeiv2_evolve_alloc(size())) {}
    Rk8pd& operator=(const Rk8pd&) = delete;

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Rk8pd>(*this); }
    bool checkpoint(Archive& archive) override {
        AdaptiveMethod::checkpoint(archive);
        archive(evolve_->last_step, evolve_->count, evolve_->failed_steps);
        for (double* const rates : {evolve_->dydt_in, evolve_->dydt_out})
            for (std::size_t i = 0; i < size(); ++i) archive(rates[i]);
        return true;
    }

    void denseOutput(double tau, std::span<double> x) const override {
        const Step shorter(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, size()));
        Watch watch{*this, {}, {}, Outcome::converged};  // no stop token: it is needed whole
        const gsl_odeiv2_system system{&Rk8pd::rate, nullptr, size(), &watch};
        Vector y = before(), error(size());
        const int status = gsl_odeiv2_step_apply(shorter.get(), startTime(), tau * (endTime() - startTime()),
                                                 y.data(), error.data(), nullptr, nullptr, &system);
        if (status != GSL_SUCCESS) std::fill(y.begin(), y.end(), std::numeric_limits<double>::quiet_NaN());
        std::copy(y.begin(), y.end(), x.begin());
    }

    std::size_t tangentSize() const override { return size(); }
    bool applyTangent(std::span<double> W) override {
        Vector y = before();
        y.insert(y.end(), W.begin(), W.end());
        Vector error(y.size());
        const Step same(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, y.size()));
        Variation variation{*this, y.size()};
        const gsl_odeiv2_system system{&Rk8pd::variationalRate, nullptr, y.size(), &variation};
        const int status = gsl_odeiv2_step_apply(same.get(), startTime(), endTime() - startTime(), y.data(),
                                                 error.data(), nullptr, nullptr, &system);
        std::copy(y.begin() + static_cast<std::ptrdiff_t>(size()), y.end(), W.begin());
        return status == GSL_SUCCESS;
    }

private:
    struct Variation {
        Rk8pd& method;
        std::size_t size;
    };
    static int variationalRate(double t, const double* y, double* dy, void* given) {
        const auto& variation = *static_cast<Variation*>(given);
        return variation.method.variationalFlow(t, y, dy, variation.size) ? GSL_SUCCESS : GSL_EBADFUNC;
    }
    /// What the right-hand side is given, and what it saw.
    struct Watch {
        const Rk8pd& method;
        std::stop_token stop;
        StepReport report;
        Outcome trouble;
    };

    Outcome take(double& t, Vector& x, double& next, StepReport& report, bool isContinued) override {
        if (!isContinued) {
            gsl_odeiv2_evolve_reset(evolve_.get());
            gsl_odeiv2_step_reset(step_.get());
        }
        if (next == 0) next = std::min(firstStep(t, x), end() - t);
        Watch watch{*this, stop(), report, Outcome::converged};
        const gsl_odeiv2_system system{&Rk8pd::rate, nullptr, size(), &watch};
        const double start = t;
        const unsigned long refused = evolve_->failed_steps;
        const int status = gsl_odeiv2_evolve_apply(evolve_.get(), control_.get(), step_.get(), &system, &t,
                                                   end(), &next, x.data());
        report = watch.report;
        report.cost.rejected = static_cast<long long>(evolve_->failed_steps - refused);
        if (watch.trouble != Outcome::converged) return watch.trouble;
        return status == GSL_SUCCESS && t > start ? Outcome::converged : Outcome::stepBudget;
    }
    static int rate(double t, const double* x, double* dx, void* given) {
        auto& watch = *static_cast<Watch*>(given);
        ++watch.report.cost.evaluations;
        if (watch.stop.stop_requested())
            watch.trouble = Outcome::stopped;
        else if (!watch.method.flow(t, x, dx))
            watch.trouble = Outcome::singular;
        return watch.trouble == Outcome::converged ? GSL_SUCCESS : GSL_EBADFUNC;
    }

    double tolerance_;
    Step step_;
    std::unique_ptr<gsl_odeiv2_control, Freed<gsl_odeiv2_control_free>> control_;
    std::unique_ptr<gsl_odeiv2_evolve, Freed<gsl_odeiv2_evolve_free>> evolve_;
};
#endif

}  // namespace

BaselineEntry rk8pd() {
    BaselineEntry e;
    e.item = {"rk8pd",
              "Prince-Dormand 8(9)",
              "The GNU Scientific Library's explicit Runge-Kutta pair of order 8 under error control.",
              {},
              Claims{8, false, false, {}},
              "smooth forces"};
    e.grid = TimeGrid::landing;
    e.takes = flowProblems().with<Spins>();
    e.make = []([[maybe_unused]] const System& system,
                [[maybe_unused]] const BaselineOptions& options) -> std::unique_ptr<Integrator> {
#if EXTREMAL_HAS_GSL
        return std::make_unique<Rk8pd>(flowOf(system), options);
#else
        refuseWithout("rk8pd", "the GNU Scientific Library", "libgsl-dev");
#endif
    };
    return e;
}

}  // namespace extremal::baselines
