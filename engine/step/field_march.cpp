// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/step/field_march.hpp"

#include <algorithm>
#include <utility>

namespace extremal {

FieldMarch::FieldMarch(std::shared_ptr<const SpatialForm> form, double step)
    : form_(std::move(form)), n_(static_cast<std::size_t>(form_->size())), h_(step), other_(2 * n_) {}

FieldMarch::FieldMarch(std::size_t n, double step) : n_(n), h_(step), other_(2 * n_) {}

/// A sum of 0 x is NaN where any x is not finite; four sums do not wait for each other.
bool FieldMarch::isFinite(const std::vector<double>& x) {
    double sum[4] = {0, 0, 0, 0};
    std::size_t i = 0;
    for (; i + 4 <= x.size(); i += 4)
        for (std::size_t k = 0; k < 4; ++k) sum[k] += 0 * x[i + k];
    for (; i < x.size(); ++i) sum[0] += 0 * x[i];
    return sum[0] + sum[1] + sum[2] + sum[3] == 0;
}

void FieldMarch::setStep(double h) {
    h_ = h;
    isPrepared_ = false;
}

StepReport FieldMarch::advance(State& state, double until) {
    StepReport report;
    report.step = h_;
    if (!isPrepared_) prepare();
    isPrepared_ = true;
    begin_ = state.t;
    report.outcome = step(state.x.data(), other_.data(), report);
    if (report.outcome == Outcome::converged && !isChecked_ && !isFinite(other_))
        report.outcome = Outcome::notFinite;
    if (report.outcome != Outcome::converged) return report;
    state.x.swap(other_);
    state.t = until;
    ++state.node;
    return report;
}

bool FieldMarch::checkpoint(Archive& archive) {
    if (archive.isReading() && !isPrepared_) {
        prepare();
        isPrepared_ = true;
    }
    return true;
}

bool FieldMarch::isHeld(std::size_t i) const {
    return form_ && form_->problem().isFixed(static_cast<int>(i));
}

const std::vector<std::size_t>& FieldMarch::freeNodes() const {
    if (freeNodes_.empty())
        for (std::size_t i = 0; i < n_; ++i)
            if (!isHeld(i)) freeNodes_.push_back(i);
    return freeNodes_;
}

bool FieldMarch::applyTangent(std::span<double> W) {
    const std::vector<std::size_t>& places = freeNodes();
    const std::size_t half = places.size();
    if (!linearise()) return false;
    for (std::size_t column = 0; column + 2 * half <= W.size(); column += 2 * half) {
        double* const w = W.data() + column;
        du_.assign(n_, 0);
        dp_.assign(n_, 0);
        for (std::size_t i = 0; i < half; ++i) {
            du_[places[i]] = w[i];
            dp_[places[i]] = w[half + i];
        }
        vary(du_, dp_);
        for (std::size_t i = 0; i < half; ++i) {
            w[i] = du_[places[i]];
            w[half + i] = dp_[places[i]];
        }
    }
    return true;
}

std::vector<double> FieldMarch::hessianAt(const double* u) const {
    const auto width = static_cast<std::size_t>(form().width());
    std::vector<double> H(static_cast<std::size_t>(form().problem().mesh.elements()) * width * width);
    form().hessians(u, H.data());
    return H;
}

void FieldMarch::addForceChange(const std::vector<double>& hessian, const double* du, double scale,
                                double* df) const {
    const int width = form().width();
    const FieldNodes& nodes = form().problem().nodes;
    for (int e = 0; e < nodes.elements; ++e)
        for (int a = 0; a < width; ++a)
            for (int b = 0; b < width; ++b)
                df[nodes.node(e, a)] -= scale *
                                        hessian[static_cast<std::size_t>((e * width + a) * width + b)] *
                                        du[nodes.node(e, b)];
}

void FieldMarch::denseOutput(double tau, std::span<double> x) const {
    State state;
    state.x = other_;
    state.t = begin_;
    if (tau > 0) {
        const auto shorter = clone();
        shorter->setStep(tau * h_);
        advanceForDenseOutput(*shorter, state, 0);
    }
    std::copy(state.x.begin(), state.x.end(), x.begin());
}

}  // namespace extremal
