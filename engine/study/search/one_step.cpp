// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/one_step.hpp"

#include <cmath>
#include <utility>

#include "engine/core/problem.hpp"

namespace extremal {
namespace {

ResolvedScheme withoutControl(ResolvedScheme scheme) {
    if (scheme.isAdaptive() && scheme.claims.order <= 0)
        throw InvalidScene("", "its order and its steps follow from its errors");
    if (!scheme.isAdaptive() && !scheme.isFixed()) throw InvalidScene("", "it chooses its own steps");
    if (scheme.isAdaptive()) scheme.spec.tolerance = 1e300;
    return scheme;
}

}  // namespace

OneStep::OneStep(ResolvedScheme scheme, const System& system, double step, const State& start)
    : scheme_(withoutControl(std::move(scheme))),
      step_(step),
      integrator_(scheme_.make(system, step, start)) {}

void OneStep::setStep(double step) {
    step_ = step;
    if (scheme_.isFixed()) integrator_->setStep(step);
}

void OneStep::begin(State& state) { integrator_->begin(state); }

bool OneStep::take(State& state) {
    if (scheme_.isFixed()) return advance(*integrator_, state).outcome == Outcome::converged;
    const double end = state.t + step_;
    state.memory = {step_};  // what it tries next
    return integrator_->advance(state, end).outcome == Outcome::converged && state.t == end;
}

}  // namespace extremal
