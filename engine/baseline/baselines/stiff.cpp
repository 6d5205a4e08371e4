// SPDX-License-Identifier: GPL-3.0-or-later
/// CVODE of SUNDIALS: backward differentiation formulas of order 1 to 5 with variable step, Newton's method
/// with a dense Jacobian by differences. For stiff problems with damping; in oscillations it wastes its
/// stability on small steps.
#include <algorithm>
#include <memory>

#include "engine/baseline/adaptive_method.hpp"

#if EXTREMAL_HAS_SUNDIALS
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#endif

namespace extremal::baselines {
namespace {

#if EXTREMAL_HAS_SUNDIALS
/// Owns an object of SUNDIALS.
template <class T, auto destroy>
class Owned {
public:
    explicit Owned(T value) : value_(value) {}
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;
    ~Owned() { destroy(value_); }
    operator T() const { return value_; }

private:
    T value_;
};

void freeContext(SUNContext context) { SUNContext_Free(&context); }
void freeVector(N_Vector v) { N_VDestroy(v); }
void freeMatrix(SUNMatrix m) { SUNMatDestroy(m); }
void freeSolver(SUNLinearSolver s) { SUNLinSolFree(s); }
void freeMemory(void* memory) { CVodeFree(&memory); }

SUNContext makeContext() {
    SUNContext context = nullptr;
    SUNContext_Create(nullptr, &context);
    return context;
}

class Stiff final : public AdaptiveMethod {
public:
    Stiff(const Mechanics<double>& mechanics, const BaselineOptions& options)
        : AdaptiveMethod(mechanics),
          mechanics_(mechanics),
          tolerance_(options.tolerance),
          context_(makeContext()),
          x_(N_VNew_Serial(static_cast<sunindextype>(size()), context_)),
          jacobian_(
              SUNDenseMatrix(static_cast<sunindextype>(size()), static_cast<sunindextype>(size()), context_)),
          solver_(SUNLinSol_Dense(x_, jacobian_, context_)),
          memory_(CVodeCreate(CV_BDF, context_)) {
        CVodeSetErrFile(memory_, nullptr);
        N_VConst(0, x_);
        CVodeInit(memory_, &Stiff::rate, options.start.t, x_);
        CVodeSStolerances(memory_, tolerance_, tolerance_);
        CVodeSetUserData(memory_, this);
        CVodeSetLinearSolver(memory_, solver_, jacobian_);
    }

    std::string tangentProblem() const override {
        return "its library goes on from several steps before, and gives no derivatives";
    }
    /// The library does not give its history away: a clone begins anew, with the step that was to be next.
    std::unique_ptr<Integrator> clone() const override {
        BaselineOptions options;
        options.tolerance = tolerance_;
        return std::make_unique<Stiff>(mechanics_, options);
    }

    bool checkpoint(Archive&) override { return false; }

    void denseOutput(double tau, std::span<double> x) const override {
        const Owned<N_Vector, freeVector> y(N_VNew_Serial(static_cast<sunindextype>(size()), context_));
        CVodeGetDky(memory_, startTime() + tau * (endTime() - startTime()), 0, y);
        std::copy_n(N_VGetArrayPointer(y), size(), x.begin());
    }

private:
    Outcome take(double& t, Vector& x, double& next, StepReport& report, bool isContinued) override {
        std::copy(x.begin(), x.end(), N_VGetArrayPointer(x_));
        if (!isContinued) {
            CVodeReInit(memory_, t, x_);
            CVodeSetInitStep(memory_, std::min(next, end() - t));
        }
        if (!isContinued || end() != stopTime_) CVodeSetStopTime(memory_, stopTime_ = end());
        report_ = &report;
        trouble_ = Outcome::converged;
        const Counters before = counters();
        const double start = t;
        const int status = CVode(memory_, end(), x_, &t, CV_ONE_STEP);
        const Counters after = counters();
        report.cost.rejected = after.refused - before.refused;
        report.cost.iterations = after.iterations - before.iterations;
        report.cost.linearSolves = report.cost.iterations + (after.factorisations - before.factorisations);
        if (trouble_ != Outcome::converged) return trouble_;
        if (status < 0 || !(t > start))
            return status == CV_CONV_FAILURE ? Outcome::diverged : Outcome::stepBudget;
        std::copy_n(N_VGetArrayPointer(x_), size(), x.begin());
        CVodeGetCurrentStep(memory_, &next);
        return Outcome::converged;
    }

    struct Counters {
        long refused = 0, iterations = 0, factorisations = 0;
    };
    Counters counters() const {
        Counters c;
        long diverged = 0;
        CVodeGetNumErrTestFails(memory_, &c.refused);
        CVodeGetNumStepSolveFails(memory_, &diverged);
        CVodeGetNumNonlinSolvIters(memory_, &c.iterations);
        CVodeGetNumLinSolvSetups(memory_, &c.factorisations);
        c.refused += diverged;
        return c;
    }
    /// Negative: CVODE gives up at once.
    static int rate(realtype t, N_Vector x, N_Vector dx, void* self) {
        auto& method = *static_cast<Stiff*>(self);
        ++method.report_->cost.evaluations;
        if (method.stop().stop_requested())
            method.trouble_ = Outcome::stopped;
        else if (!method.flow(t, N_VGetArrayPointer(x), N_VGetArrayPointer(dx)))
            method.trouble_ = Outcome::singular;
        return method.trouble_ == Outcome::converged ? 0 : -1;
    }

    Mechanics<double> mechanics_;
    double tolerance_, stopTime_ = 0;
    Owned<SUNContext, freeContext> context_;
    Owned<N_Vector, freeVector> x_;
    Owned<SUNMatrix, freeMatrix> jacobian_;
    Owned<SUNLinearSolver, freeSolver> solver_;
    Owned<void*, freeMemory> memory_;
    StepReport* report_ = nullptr;
    Outcome trouble_ = Outcome::converged;
};
#endif

}  // namespace

BaselineEntry stiff() {
    BaselineEntry e;
    e.item = {"stiff",
              "CVODE (BDF)",
              "SUNDIALS CVODE: implicit multistep formulas of variable order and step for stiff problems.",
              {},
              Claims{},
              "smooth forces"};
    e.grid = TimeGrid::landing;
    e.takes = flowProblems();
    e.make = []([[maybe_unused]] const System& system,
                [[maybe_unused]] const BaselineOptions& options) -> std::unique_ptr<Integrator> {
#if EXTREMAL_HAS_SUNDIALS
        return std::make_unique<Stiff>(flowOf(system), options);
#else
        refuseWithout("stiff", "SUNDIALS", "libsundials-dev");
#endif
    };
    return e;
}

}  // namespace extremal::baselines
