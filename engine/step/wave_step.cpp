// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/step/wave_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace extremal {
namespace {

/// to <- e^{i angle} from, n complex numbers.
void rotatePhases(const double* from, double angle, double* to, std::size_t n) {
    const double cosine = std::cos(angle), sine = std::sin(angle);
    for (std::size_t i = 0; i < 2 * n; i += 2) {
        const double re = from[i], im = from[i + 1];
        to[i] = cosine * re - sine * im;
        to[i + 1] = cosine * im + sine * re;
    }
}

}  // namespace

double meanEnergy(const Hamiltonian& hamiltonian, const State& state) {
    if (state.x.empty()) return std::numeric_limits<double>::quiet_NaN();
    return hamiltonian.energy(state.t, coefficients(state.x.data()));
}

WaveStep::WaveStep(std::shared_ptr<const Hamiltonian> hamiltonian, double step, double shift)
    : hamiltonian_(std::move(hamiltonian)), h_(step), shift_(shift) {
    const auto size = static_cast<std::size_t>(hamiltonian_->size());
    v_.resize(size);
    before_.resize(size);
    handedOut_.resize(2 * size);
}

void WaveStep::setStep(double h) {
    h_ = h;
    isPrepared_ = hasState_ = false;
}

void WaveStep::estimateShift(const State& state) {
    if (std::isnan(shift_)) shift_ = shiftFrom(state);
}

double WaveStep::shiftFrom(const State& state) const { return meanEnergy(*hamiltonian_, state); }

void WaveStep::begin(State& state) {
    estimateShift(state);
    remember(state);
    resume(state);
}

/// v from c, in the gauge of the state.
void WaveStep::resume(const State& state) {
    estimateShift(state);
    const Gauge gauge = gaugeOf(state);
    if (gauge.shift != shift_) {
        shift_ = gauge.shift;
        isPrepared_ = false;
    }
    if (!isPrepared_) prepare();
    isPrepared_ = hasState_ = !stop().stop_requested();  // preparing ends early where it is stopped
    origin_ = gauge.origin;
    endTime_ = state.t;
    memorySize_ = state.memory.size();
    std::copy(state.x.begin(), state.x.end(), handedOut_.begin());
    double* v = reinterpret_cast<double*>(v_.data());
    if (origin_ == state.t)
        std::copy(state.x.begin(), state.x.end(), v);
    else
        rotatePhases(state.x.data(), shift_ * (state.t - origin_) / hamiltonian_->hbar(), v, v_.size());
    forget();
}

StepReport WaveStep::advance(State& state, double until) {
    StepReport report;
    report.step = h_;
    const std::size_t bytes = handedOut_.size() * sizeof(double);
    if (!hasState_ || state.t != endTime_ || state.memory.size() != memorySize_ ||
        std::memcmp(state.x.data(), handedOut_.data(), bytes) != 0) {
        if (state.memory.empty())
            begin(state);
        else
            resume(state);
        if (!hasState_) {
            report.outcome = Outcome::stopped;
            return report;
        }
    }
    std::copy(v_.begin(), v_.end(), before_.begin());
    startTime_ = state.t;
    step(state.t, v_.data(), state.memory, report);
    if (report.outcome != Outcome::converged) {
        std::copy(before_.begin(), before_.end(), v_.begin());
        forget();
        return report;
    }
    ++state.node;
    handOut(state, until);
    return report;
}

void WaveStep::handOut(State& state, double until) {
    rotatePhases(reinterpret_cast<const double*>(v_.data()),
                 -shift_ * (until - origin_) / hamiltonian_->hbar(), handedOut_.data(), v_.size());
    std::copy(handedOut_.begin(), handedOut_.end(), state.x.begin());
    state.t = endTime_ = until;
}

/// The first step makes v of the state, the last one leaves what can be asked of it.
StepReport WaveStep::advanceOver(State& state, long long count, const Clock& clock) {
    if (count < 3 || !memoryParts().empty()) return advanceByNodes(*this, state, count, clock);
    const StepReport first = advance(state, clock.at(state.node + 1));
    if (first.outcome != Outcome::converged) return first;
    std::copy(v_.begin(), v_.end(), before_.begin());
    StepReport report;
    stepOver(state.t, v_.data(), count - 2, state.memory, report);
    Cost cost = first.cost;
    cost += report.cost;
    if (report.outcome == Outcome::converged) {
        state.node += count - 2;
        handOut(state, clock.at(state.node));
        report = advance(state, clock.at(state.node + 1));
        cost += report.cost;
    } else {
        std::copy(before_.begin(), before_.end(), v_.begin());
        forget();
    }
    report.cost = cost;
    return report;
}

void WaveStep::stepOver(double t, Complex* v, long long count, std::vector<double>& memory,
                        StepReport& report) {
    Cost cost;
    for (long long i = 0; i < count && report.outcome == Outcome::converged; ++i) {
        report = {};
        step(t + static_cast<double>(i) * h_, v, memory, report);
        cost += report.cost;
    }
    report.cost = cost;
}

bool WaveStep::checkpoint(Archive& archive) {
    archive(shift_, hasState_, origin_, endTime_, memorySize_, v_, handedOut_);
    if (archive.isReading() && hasState_) {
        prepare();
        isPrepared_ = true;
    }
    return true;
}

bool WaveStep::applyTangent(std::span<double> W) {
    const std::size_t n = v_.size();
    if (!twin_.step) twin_.step = clone();
    if (twin_.step->stepSize() != h_) twin_.step->setStep(h_);
    State& variation = twin_.state;
    variation.x.resize(2 * n);
    for (std::size_t column = 0; column + 2 * n <= W.size(); column += 2 * n) {
        double* const w = W.data() + column;
        for (std::size_t i = 0; i < n; ++i) {
            variation.x[2 * i] = w[i];
            variation.x[2 * i + 1] = w[n + i];
        }
        variation.t = startTime_;
        if (twin_.step->advance(variation, endTime_).outcome != Outcome::converged) return false;
        for (std::size_t i = 0; i < n; ++i) {
            w[i] = variation.x[2 * i];
            w[n + i] = variation.x[2 * i + 1];
        }
    }
    return true;
}

void WaveStep::denseOutput(double tau, std::span<double> x) const {
    State state;
    state.t = startTime_;
    state.x.resize(x.size());
    const double angle = -shift_ * (startTime_ - origin_) / hamiltonian_->hbar();
    for (std::size_t i = 0; i < before_.size(); ++i)
        coefficients(state.x.data())[i] = before_[i] * std::polar(1.0, angle);
    if (tau > 0) {
        const auto shorter = inside();
        shorter->setStep(tau * h_);
        advanceForDenseOutput(*shorter, state, startTime_ + tau * h_);
    }
    std::copy(state.x.begin(), state.x.end(), x.begin());
}

}  // namespace extremal
