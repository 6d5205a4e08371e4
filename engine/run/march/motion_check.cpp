// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/march/motion_check.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <vector>

#include "engine/model/conservative.hpp"
#include "engine/run/march/state_values.hpp"

namespace extremal {
namespace {

/// Numbers for states to try: the same in every run.
class Trials {
public:
    /// In [0, 1).
    double next() {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<double>(state_ >> 11) * 0x1p-53;
    }
    double sign() { return next() < 0.5 ? -1 : 1; }
    /// From a hundredth to a hundred.
    double size() { return std::pow(10, 4 * next() - 2); }

private:
    unsigned long long state_ = 1;
};

/// Puts other numbers in place of x: all of one size, or each of its own. Entries that are 0 take the size of
/// the largest.
void scatter(std::span<const double> from, std::span<double> x, bool isEven, Trials& trials) {
    double largest = 0;
    for (const double each : from) largest = std::max(largest, std::abs(each));
    const double common = trials.size();
    for (std::size_t k = 0; k < x.size(); ++k) {
        const double own = from[k] != 0 ? std::abs(from[k]) : largest > 0 ? largest : 1;
        x[k] = trials.sign() * own * (isEven ? common : trials.size());
    }
}

/// Whether H of some finite state is not a number; motion.hpp says which are tried.
bool hasStatesWithoutEnergy(const System& system, const State& start, const EnergyFunction& energy,
                            const std::function<bool(double, const double*)>& hasVelocity) {
    if (system.field && system.field.hasMovingNodes) return true;
    const StateBlocks blocks = blocksOf(system);
    if (blocks.sizes.empty()) return false;
    constexpr std::size_t most = 32, least = 4, numbers = 1 << 14;
    const std::size_t fixed = blocks.attitude, size = start.x.size();
    std::vector<double> x(start.x);
    Trials trials;
    const std::size_t count = std::clamp(numbers / std::max<std::size_t>(1, size), least, most);
    for (std::size_t i = 0; i < count; ++i) {
        const std::span<const double> from(start.x);
        std::size_t first = fixed;
        for (const std::size_t part : blocks.sizes) {
            scatter(from.subspan(first, part), std::span(x).subspan(first, part), i % 2 == 0, trials);
            first += part;
        }
        double length = 0;
        for (std::size_t k = 0; k < fixed; ++k) length = std::hypot(length, x[k] = trials.next() - 0.5);
        for (std::size_t k = 0; k < fixed; ++k) x[k] /= length;
        const double t = start.t + (i % 4 < 2 ? 0 : trials.sign() * trials.size());
        if (std::isnan(energy(t, x.data())) && (!hasVelocity || hasVelocity(t, x.data()))) return true;
    }
    return false;
}

}  // namespace

/// By the number of the node alone, as the sizes of blocks follow the clock.
bool MotionCheck::looksAt(long long node) const {
    constexpr long long often = 64, apart = 37;  // no common factor
    if (gains_ > 0 || shifted_ > 0 || isResolved_) return true;
    if (node <= often) return std::has_single_bit(static_cast<unsigned long long>(node));
    return node % often == node / often * apart % often;
}

MotionCheck::MotionCheck(const System& system, const State& start, double step, bool isEnergySeen)
    : isEnergySeen_(isEnergySeen) {
    if (const auto* const limit = system.parts.find<ValidityLimit>()) isResolved_ = limit->from(start);
    energy_ = energyOf(system);
    const double atStart = energy_ ? energy_(start.t, start.x.data()) : 0;
    if (!std::isfinite(atStart)) energy_ = {};
    hasVelocity_ = velocityTestOf(system);
    hasEdge_ = energy_ && !isEnergySeen && hasStatesWithoutEnergy(system, start, energy_, hasVelocity_);
    if (system.isUnitary) {
        const std::size_t size = start.x.size();
        conserved_ = [size](double, const double* x) {
            double sum = 0;
            for (std::size_t k = 0; k < size; ++k) sum += x[k] * x[k];
            return sum;
        };
    } else if (conservesEnergy(system)) {
        conserved_ = energyOf(system);
        isConservedEnergy_ = true;
        kinetic_ = kineticEnergyOf(system);
    }
    if (!conserved_) return;
    start_ = isConservedEnergy_ ? atStart : conserved_(start.t, start.x.data());
    startTime_ = lastTime_ = gainTime_ = start.t;
    scale_ = std::abs(start_);
    if (kinetic_) {
        constexpr double rest = 1e-30;
        const double own = kinetic_(start.t, start.x.data()),
                     gained = gainedKineticEnergy(system, start, step);
        scale_ = std::max({scale_, own, own <= rest * gained ? gained : 0});
    }
    // Without the parts of the energy its zero cannot be told from a small one.
    if (!std::isfinite(start_) || (!kinetic_ && !(scale_ > 0))) conserved_ = {};
}

bool MotionCheck::isDefined(double t, const double* x, double energy) {
    hasLeftDomain_ = !std::isfinite(energy) && (!hasVelocity_ || hasVelocity_(t, x));
    return !hasLeftDomain_;
}

bool MotionCheck::isSound(double t, const double* x) {
    const double H = energy_ ? energy_(t, x) : 0;
    if (!isDefined(t, x, H)) return false;
    isUnresolved_ = isResolved_ && !isResolved_(H, x);
    if (isUnresolved_) return false;
    if (!conserved_) return true;
    const double change = (isConservedEnergy_ ? H : conserved_(t, x)) - start_;
    if (kinetic_) {
        const double kinetic = kinetic_(t, x);
        if (std::abs(change) <= kinetic / 2) scale_ = std::max(scale_, kinetic);
        noteGain(t, change, kinetic);
        if (!isEnergySeen_) noteShift(t, change);
    }
    return !(scale_ > 0 && std::abs(change) > band * scale_);
}

void MotionCheck::noteGain(double t, double change, double kinetic) {
    constexpr double ofMean = 0.5, ofScale = 0.1;
    work_ += kinetic * std::abs(t - lastTime_);
    lastTime_ = t;
    const double mean = work_ / std::abs(t - startTime_);
    if (change > ofMean * mean && change > ofScale * scale_) {
        ++gains_;
    } else {
        gains_ = 0;
        gainTime_ = t;
    }
}

void MotionCheck::noteShift(double t, double change) {
    constexpr double ofScale = 0.5, spread = 1.25;
    constexpr int fewest = 8;
    if (!(change > ofScale * scale_)) {
        shifted_ = 0;
        return;
    }
    if (shifted_ == 0 || std::max(change, mostShift_) > spread * std::min(change, leastShift_)) {
        shifted_ = 0;
        shiftTime_ = t;
        leastShift_ = mostShift_ = change;
    }
    leastShift_ = std::min(leastShift_, change);
    mostShift_ = std::max(mostShift_, change);
    if (++shifted_ >= fewest) longestShift_ = std::max(longestShift_, std::abs(t - shiftTime_));
}

bool MotionCheck::hasShifted() const {
    return longestShift_ > 0 && longestShift_ >= std::abs(lastTime_ - startTime_) / 32;
}

bool MotionCheck::hasGained() const {
    constexpr int fewest = 3;
    const double time = std::abs(lastTime_ - startTime_);
    if (hasShifted()) return true;
    return gains_ >= fewest && std::abs(lastTime_ - gainTime_) >= time / 2;
}

/// Of one explicit step from the start; 0 where it is not known.
double MotionCheck::gainedKineticEnergy(const System& system, const State& start, double step) const {
    std::vector<double> x(start.x), rate(x.size());
    if (!rateOf(system, start.t, x.data(), rate.data())) return 0;
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += step * rate[k];
    const double gained = kinetic_(start.t, x.data());
    return std::isfinite(gained) ? gained : 0;
}

std::size_t MotionCheck::soundNodes(const NodeBlock& nodes, bool isLast) {
    if (!conserved_ && !energy_) return nodes.size();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const bool isEnd = isLast && i + 1 == nodes.size();
        const double t = nodes.t(i);
        const double* const x = nodes.x(i);
        if (isEnd || looksAt(nodes.node(i))) {
            if (!isSound(t, x) || (isEnd && hasGained())) return i;
        } else if (hasEdge_ && !isDefined(t, x, energy_(t, x))) {
            return i;
        }
    }
    return nodes.size();
}

}  // namespace extremal
