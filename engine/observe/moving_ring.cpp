// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/observe/moving_ring.hpp"

#include <cmath>
#include <numbers>

namespace extremal {

MovingRing::Plane MovingRing::planeOf(const System& system) {
    const OneForm* const form = system.parts.find<OneForm>();
    if (!form) return {0, static_cast<std::size_t>(system.dimension())};
    if (!form->hasPlane()) return {0, 1};
    return {static_cast<std::size_t>(form->places[0]), static_cast<std::size_t>(form->free[0])};
}

MovingRing::MovingRing(const ObserveContext& context)
    : clock_{context.initial.t, context.step},
      dimension_(context.system.dimension()),
      plane_(planeOf(context.system)) {
    constexpr double part = 0.05;
    if (const OneForm* const form = context.system.parts.find<OneForm>()) form_ = *form;
    std::array<double, 2> radius{};
    for (std::size_t k = 0; k < 2; ++k) {
        const double at = std::abs(context.initial.x[plane_[k]]);
        radius[k] = part * (at > 0 ? at : 1);
    }
    for (int j = 0; j < size; ++j) {
        const double angle = 2 * std::numbers::pi * j / size;
        State& state = states_[static_cast<std::size_t>(j)];
        state = context.initial;
        state.memory.clear();
        state.x[plane_[0]] += radius[0] * std::cos(angle);
        state.x[plane_[1]] += radius[1] * std::sin(angle);
        auto scheme = context.integrator->clone();
        scheme->begin(state);
        schemes_.push_back(std::move(scheme));
    }
}

MovingRing::MovingRing(const MovingRing& other)
    : clock_(other.clock_),
      dimension_(other.dimension_),
      form_(other.form_),
      plane_(other.plane_),
      states_(other.states_),
      isLost_(other.isLost_) {
    for (const auto& scheme : other.schemes_) schemes_.push_back(scheme->clone());
}

bool MovingRing::moveTo(long long node) {
    for (std::size_t j = 0; j < states_.size() && !isLost_; ++j) {
        State& state = states_[j];
        while (state.node < node && !isLost_)
            isLost_ = schemes_[j]->advance(state, clock_.at(state.node + 1)).outcome != Outcome::converged;
    }
    return !isLost_ && states_.front().node == node;
}

/// sum_j theta(x_j) . x'(s_j) ds, x' of the trigonometric polynomial through the points.
double MovingRing::integral() const {
    constexpr double pi = std::numbers::pi;
    const std::size_t n = states_.front().x.size();
    std::vector<double> theta(n);
    double sum = 0;
    for (int j = 0; j < size; ++j) {
        const std::vector<double>& x = states_[static_cast<std::size_t>(j)].x;
        coefficients(x, theta);
        for (int k = 1; k < size; ++k) {
            const std::vector<double>& other = states_[static_cast<std::size_t>((j + k) % size)].x;
            const double weight = (k % 2 == 0 ? -0.5 : 0.5) / std::tan(pi * k / size);
            for (std::size_t i = 0; i < n; ++i) sum += weight * theta[i] * (other[i] - x[i]);
        }
    }
    return sum * 2 * pi / size;
}

void MovingRing::coefficients(const std::vector<double>& x, std::vector<double>& theta) const {
    if (form_) return form_->form(form_->model.get(), x.data(), theta.data(), nullptr, nullptr);
    const auto d = static_cast<std::size_t>(dimension_);
    for (std::size_t i = 0; i < d; ++i) {
        theta[i] = x[d + i];
        theta[d + i] = 0;
    }
}

std::vector<double> MovingRing::points() const {
    std::vector<double> all;
    for (const std::size_t entry : plane_)
        for (const State& state : states_) all.push_back(state.x[entry]);
    return all;
}

void MovingRing::checkpoint(Archive& archive) {
    archive(isLost_);
    for (std::size_t j = 0; j < states_.size(); ++j) {
        State& state = states_[j];
        archive(state.t, state.node, state.x, state.memory);
        (void)schemes_[j]->checkpoint(archive);
    }
}

}  // namespace extremal
