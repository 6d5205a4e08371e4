#include "engine/family/wave/wave_slabs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace extremal {
namespace {

class Slabs final : public Integrator {
public:
    using Make = std::function<std::unique_ptr<Integrator>(const Clock&)>;

    Slabs(Make make, const Clock& clock, int slabs)
        : make_(std::move(make)),
          clock_(clock),
          slabs_(slabs),
          slab_(make_({clock.start, clock.step / slabs})) {}

    StepReport advance(State& state) override {
        slab_->setStop(stop());
        StepReport report;
        if (inner_.x != state.x || inner_.t != state.t) inner_ = {state.t, state.node * slabs_, state.x};
        start_ = inner_;
        for (int k = 0; k < slabs_; ++k) {
            const StepReport one = slab_->advance(inner_);
            report.outcome = one.outcome;
            report.cost += one.cost;
            if (one.outcome != Outcome::converged) {
                inner_ = start_;
                return report;
            }
        }
        report.step = clock_.step;
        std::copy(inner_.x.begin(), inner_.x.end(), state.x.begin());
        inner_.t = state.t = clock_.at(++state.node);
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        // Once more from the start, as far as the slab that tau is in.
        const auto again = make_({clock_.start, clock_.step / slabs_});
        const int last = std::clamp(static_cast<int>(tau * slabs_), 0, slabs_ - 1);
        State state = start_;
        for (int k = 0; k <= last; ++k) (void)again->advance(state);
        again->denseOutput(tau * slabs_ - last, x);
    }
    std::string about() const override { return slab_->about(); }

private:
    Make make_;
    Clock clock_;
    int slabs_;
    std::unique_ptr<Integrator> slab_;
    State start_, inner_;
};

}  // namespace

std::unique_ptr<Integrator> makeSlabs(std::function<std::unique_ptr<Integrator>(const Clock&)> make,
                                      const Clock& clock, int slabs) {
    return std::make_unique<Slabs>(std::move(make), clock, slabs);
}

Rule<double> chebyshevRoots(int n) {
    Rule<double> rule;
    for (int j = 1; j <= n; ++j) {
        rule.c.push_back(0.5 * (1 - std::cos(std::numbers::pi * (j - 0.5) / n)));
        rule.b.push_back(1.0 / n);
    }
    return rule;
}

}  // namespace extremal
