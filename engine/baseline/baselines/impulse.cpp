// SPDX-License-Identifier: GPL-3.0-or-later
/// Impulse method with the exact oscillator: half a step of the slow forces, the fast oscillation exactly,
/// half a step of the slow forces (order 2; Garcia-Archilla, Sanz-Serna and Skeel 1999; Deuflhard 1979).
/// Higher orders are symmetric compositions of it: Suzuki's 5 stages (order 4), Kahan and Li's 9 (order 6)
/// and 17 stages (order 8) (Hairer, Lubich and Wanner, Geometric Numerical Integration, II.4, V.3.2). The
/// orders hold for steps that resolve the oscillation; beyond, the fast energy is kept well only away from
/// step * frequency = j pi.
#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/family/parts/conditions.hpp"

namespace extremal::baselines {
namespace {

/// Half of a palindrome, its middle last.
std::vector<double> stagesOf(int order) {
    if (order == 4) {
        const double outer = 1 / (4 - std::cbrt(4.0));
        return {outer, outer, 1 - 4 * outer};
    }
    if (order == 6)
        return {0.39216144400731413927925056, 0.33259913678935943859974864, -0.70624617255763935980996482,
                0.08221359629355080023149045, 0.79854399093482996339895035};
    if (order == 8)
        return {0.13020248308889008087881763, 0.56116298177510838456196441,  -0.38947496264484728640807860,
                0.15884190655515560089621075, -0.39590389413323757733623154, 0.18453964097831570709183254,
                0.25837438768632204729397911, 0.29501172360931029887096624,  -0.60550853383003451169892108};
    return {1};
}

class Impulse final : public Integrator {
public:
    Impulse(const System& system, double step, int order)
        : order_(order), fast_(system.fast), start_(2 * system.coordinates.size()), trial_(start_) {
        setStep(step);
    }

    double stepSize() const override { return h_; }
    void setStep(double h) override {
        h_ = h;
        parts_.clear();
        std::vector<double> stages = stagesOf(order_);
        for (std::size_t i = stages.size() - 1; i-- > 0;) stages.push_back(stages[i]);
        const std::size_t last = fast_.slowFlows.size() - 1;
        double before = 0;
        for (const double share : stages) {
            // The outermost halves of neighbouring stages are one flow.
            parts_.push_back(fast_.slowFlows[0]((before + share) / 2 * h_));
            for (std::size_t k = 1; k <= last; ++k) parts_.push_back(fast_.slowFlows[k](share / 2 * h_));
            parts_.push_back(fast_.fastFlow(share * h_));
            for (std::size_t k = last; k > 0; --k) parts_.push_back(fast_.slowFlows[k](share / 2 * h_));
            before = share;
        }
        parts_.push_back(fast_.slowFlows[0](before / 2 * h_));
        evaluations_ = static_cast<int>(stages.size()) + 1;
    }

    StepReport advance(State& state, double until) override {
        StepReport report;
        report.step = h_;
        start_ = trial_ = state.x;
        for (const FastMotion::Flow& part : parts_) part(trial_.data());
        report.cost.evaluations = evaluations_;
        for (const double x : trial_)
            if (!std::isfinite(x)) report.outcome = Outcome::notFinite;
        if (report.outcome != Outcome::converged) return report;
        state.x = trial_;
        state.t = until;
        ++state.node;
        return report;
    }
    std::size_t tangentSize() const override { return start_.size(); }
    /// By the step over dual numbers, column after column.
    bool applyTangent(std::span<double> W) override {
        const std::size_t n = start_.size();
        varied_.resize(n);
        for (double* w = W.data(); w != W.data() + W.size(); w += n) {
            for (std::size_t i = 0; i < n; ++i) {
                varied_[i] = FlowMap::Varied(start_[i]);
                varied_[i].g[0] = w[i];
            }
            for (const FastMotion::Flow& part : parts_) part(varied_.data());
            for (std::size_t i = 0; i < n; ++i) w[i] = varied_[i].g[0];
        }
        return true;
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Impulse>(*this); }
    /// A shorter step of order 2 from the nearer end: the oscillation is in it.
    void denseOutput(double tau, std::span<double> x) const override {
        const bool isLate = tau > 0.5;
        const double time = (isLate ? tau - 1 : tau) * h_;
        std::copy((isLate ? trial_ : start_).begin(), (isLate ? trial_ : start_).end(), x.begin());
        for (const auto& slow : fast_.slowFlows) slow(time / 2)(x.data());
        fast_.fastFlow(time)(x.data());
        for (auto slow = fast_.slowFlows.rbegin(); slow != fast_.slowFlows.rend(); ++slow)
            (*slow)(time / 2)(x.data());
    }

private:
    double h_ = 0;
    int order_;
    FastMotion fast_;
    std::vector<FastMotion::Flow> parts_;
    int evaluations_ = 0;
    std::vector<double> start_, trial_;
    std::vector<FlowMap::Varied> varied_;
};

}  // namespace

BaselineEntry impulse() {
    BaselineEntry e;
    e.item = {
        "impulse",
        "impulse method",
        "The fast oscillation exactly between impulses of the slow forces; orders 2, 4, 6, 8.",
        {integerChoice("order", {"2", "4", "6", "8"}, 2, "Order, by composition: 1, 5, 9 or 17 stages.")},
        Claims{2, true, true, {}},
        "a fast oscillation of its own, with its flow"};
    e.parts.set(SystemCondition{
        [](const System& system) { return system.fast.fastFlow && !system.fast.slowFlows.empty(); }});
    e.parts.set(ClaimsOfKeys{[](const Settings& settings) {
        return Claims{settings.integer("order"), true, true, {}};
    }});
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<Impulse>(system, options.step, options.settings.integer("order"));
    };
    return e;
}

}  // namespace extremal::baselines
