// SPDX-License-Identifier: GPL-3.0-or-later
/// What the codes that choose their own steps share: one accepted step per advance(), the end hit exactly,
/// dense output.
///
/// They integrate x' = f(t, x): x = (q, p) and Hamilton's vector field, or any other. Both relative and
/// absolute tolerance are the scene's tolerance. Dense output is the code's own interpolant where
/// it has one, else a shorter step of the same formula: steps are so long here that a polynomial through both
/// ends would lose most digits. The codes go forwards in a time s of their own, s = t or, where a run goes
/// backwards, s = -t, in which x' = -f(-s, x).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/phase/flow_jacobian.hpp"

namespace extremal {

class AdaptiveMethod : public Integrator {
public:
    /// xdot = rate(t, x), both of length n; false where it is not defined.
    using Rate = std::function<bool(double t, const double* x, double* dx)>;

    explicit AdaptiveMethod(const Mechanics<double>& mechanics);
    AdaptiveMethod(Rate rate, std::size_t n);

    TimeGrid grid() const final { return TimeGrid::landing; }
    std::vector<MemoryPart> memoryParts() const final { return {{"next step", 1}}; }
    void begin(State& state) final;
    StepReport advance(State& state, double until) final;
    bool checkpoint(Archive& archive) override {
        archive(x_, ahead_, endTime_, hasStepped_);
        return true;
    }

protected:
    using Vector = std::vector<double>;

    /// Takes one accepted step: moves t (which is s) and x, by no more than to end(). Counts refused steps in
    /// `report`. `next`: the step to try, 0 where none is known; then the one to try next. `isContinued`: t
    /// and x are where the last step left them.
    virtual Outcome take(double& t, Vector& x, double& next, StepReport& report, bool isContinued) = 0;

    /// dx/ds.
    bool flow(double s, const double* x, double* dx) const {
        if (ahead_ > 0) return rate_(s, x, dx);
        if (!rate_(-s, x, dx)) return false;
        for (std::size_t i = 0; i < x_.size(); ++i) dx[i] = -dx[i];
        return true;
    }
    /// x' = f(t, x) and with it the variational equation w' = f'(t, x) w of columns w: y = (x, w, w, ...), of
    /// length `size`. A Runge-Kutta step of it, of the length that was chosen for x, is the step and its
    /// tangent map. Only for Hamilton's vector field.
    bool variationalFlow(double t, const double* y, double* dy, std::size_t size);
    bool isHamiltonian() const { return jacobian_.has_value(); }
    const Vector& after() const { return x_; }  ///< x at the end of the last step
    /// The first step: 1/1000 of the time scale |x| / |xdot|, at most a hundredth of what is left.
    double firstStep(double t, const Vector& x) const;

    std::size_t size() const { return x_.size(); }
    double end() const { return end_; }
    double startTime() const { return startTime_; }
    double endTime() const { return endTime_; }
    const Vector& before() const { return before_; }  ///< x at the start of the last step

private:
    Rate rate_;
    std::optional<FlowJacobian> jacobian_;
    double ahead_ = 1;  ///< ds/dt
    double end_ = 0, startTime_ = 0, endTime_ = 0;
    Vector before_, x_;
    Vector velocity_;  ///< of the Jacobian
    bool hasStepped_ = false;
};

/// Says that the program was built without a library, and how to get it. Throws InvalidScene.
[[noreturn]] void refuseWithout(const std::string& baseline, const std::string& library,
                                const std::string& package);

}  // namespace extremal
