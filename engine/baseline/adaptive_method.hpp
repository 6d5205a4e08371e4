/// What the codes that choose their own steps share: one accepted step per advance(), the end hit exactly,
/// dense output.
///
/// They integrate x' = f(t, x): x = (q, p) and Hamilton's vector field, or any other. Both relative and
/// absolute tolerance are the scene's tolerance. Dense output is the code's own interpolant where
/// it has one, else a shorter step of the same formula: steps are so long here that a polynomial through both
/// ends would lose most digits.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/flow_jacobian.hpp"

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

protected:
    using Vector = std::vector<double>;

    /// Takes one accepted step: moves t and x, by no more than to end(). Counts refused steps in `report`.
    /// `next`: the step to try, 0 where none is known; then the one to try next. `isContinued`: t and x are
    /// where the last step left them.
    virtual Outcome take(double& t, Vector& x, double& next, StepReport& report, bool isContinued) = 0;

    bool flow(double t, const double* x, double* dx) const { return rate_(t, x, dx); }
    /// x' = f(t, x) and with it the variational equation w' = f'(t, x) w of columns w: y = (x, w, w, ...), of
    /// length `size`. A Runge-Kutta step of it, of the length that was chosen for x, is the step and its
    /// tangent map. Only for Hamilton's vector field.
    bool variationalFlow(double t, const double* y, double* dy, std::size_t size);
    bool isHamiltonian() const { return jacobian_.has_value(); }
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
    double end_ = 0, startTime_ = 0, endTime_ = 0;
    Vector before_, x_;
    bool hasStepped_ = false;
};

/// Says that the program was built without a library, and how to get it. Throws InvalidScene.
[[noreturn]] void refuseWithout(const std::string& baseline, const std::string& library,
                                const std::string& package);

}  // namespace extremal
