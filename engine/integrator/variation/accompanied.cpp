// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/variation/accompanied.hpp"

#include <algorithm>
#include <limits>

namespace extremal {

Accompanied::Accompanied(std::unique_ptr<Integrator> scheme, std::size_t carried,
                         std::vector<std::string> said)
    : values_(said.size(), std::numeric_limits<double>::quiet_NaN()),
      scheme_(std::move(scheme)),
      carried_(carried),
      quantities_(scheme_->quantities().begin(), scheme_->quantities().end()) {
    for (std::string& name : said) quantities_.push_back({std::move(name), "", "", ""});
}

Accompanied::Accompanied(const Accompanied& other)
    : Integrator(other),
      values_(other.values_),
      scheme_(other.scheme_->clone()),
      carried_(other.carried_),
      inner_(other.inner_),
      quantities_(other.quantities_),
      state_(other.state_) {}

std::vector<MemoryPart> Accompanied::memoryParts() const {
    std::vector<MemoryPart> parts = scheme_->memoryParts();
    parts.push_back({"carried along", carried_});
    return parts;
}

void Accompanied::begin(State& state) {
    scheme_->begin(state);
    inner_ = state.memory.size();
    state.memory.resize(inner_ + carried_, 0);
    startCarrying(state, std::span(state.memory).subspan(inner_));
}

StepReport Accompanied::advance(State& state, double until) {
    if (state.memory.empty()) begin(state);
    inner_ = state.memory.size() - carried_;
    scheme_->setStop(stop());
    state_.t = state.t;
    state_.node = state.node;
    state_.x.assign(state.x.begin(), state.x.end());
    state_.memory.assign(state.memory.begin(), state.memory.begin() + static_cast<std::ptrdiff_t>(inner_));
    const StepReport report = scheme_->advance(state_, until);
    if (report.outcome != Outcome::converged) return report;
    carry(state, state_, report, std::span(state.memory).subspan(inner_));
    state.t = state_.t;
    state.node = state_.node;
    state.x.swap(state_.x);
    std::copy(state_.memory.begin(), state_.memory.end(), state.memory.begin());
    return report;
}

void Accompanied::measure(const State& state, double* values) const {
    const std::size_t own = quantities_.size() - values_.size();
    if (own > 0) {
        State inner = state;
        inner.memory.resize(inner_);
        scheme_->measure(inner, values);
    }
    std::copy(values_.begin(), values_.end(), values + own);
}

}  // namespace extremal
