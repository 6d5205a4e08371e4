#include "engine/family/field/field_step.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace extremal {
namespace {

/// A sum of 0 x is NaN where any x is not finite; four sums do not wait for each other.
bool isFiniteAll(const std::vector<double>& x) {
    double sum[4] = {0, 0, 0, 0};
    std::size_t i = 0;
    for (; i + 4 <= x.size(); i += 4)
        for (std::size_t k = 0; k < 4; ++k) sum[k] += 0 * x[i + k];
    for (; i < x.size(); ++i) sum[0] += 0 * x[i];
    return sum[0] + sum[1] + sum[2] + sum[3] == 0;
}

}  // namespace

FieldMarch::FieldMarch(std::shared_ptr<const SpatialForm> form, double step)
    : form_(std::move(form)), n_(static_cast<std::size_t>(form_->size())), h_(step), other_(2 * n_) {}

void FieldMarch::setStep(double h) {
    h_ = h;
    isPrepared_ = false;
}

StepReport FieldMarch::advance(State& state, double until) {
    StepReport report;
    report.step = h_;
    if (!isPrepared_) prepare();
    isPrepared_ = true;
    report.outcome = step(state.x.data(), other_.data(), report);
    if (report.outcome == Outcome::converged && !isChecked_ && !isFiniteAll(other_))
        report.outcome = Outcome::notFinite;
    if (report.outcome != Outcome::converged) return report;
    state.x.swap(other_);
    state.t = until;
    ++state.node;
    return report;
}

std::span<const Quantity> FieldStep::quantities() const {
    static const std::array<Quantity, 1> all{{{"discrete_energy", "discrete energy", "E_d", ""}}};
    return all;
}

void FieldMarch::denseOutput(double tau, std::span<double> x) const {
    State state;
    state.x = other_;
    if (tau > 0) {
        const auto shorter = clone();
        shorter->setStep(tau * h_);
        (void)shorter->advance(state, 0);
    }
    std::copy(state.x.begin(), state.x.end(), x.begin());
}

}  // namespace extremal
