// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/crossing.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace extremal {
namespace {

constexpr double samplesPerPeriod = 16;
constexpr std::size_t fewestParts = 4;
/// Of the range of the samples: what a parabola may miss them by.
constexpr double smooth = 0.05;
/// Of the range: where |g| is larger than this everywhere, no zero can be hidden.
constexpr double farAway = 3;
constexpr double roundOff = std::numeric_limits<double>::epsilon();

bool passesUpwards(double first, double last) { return first < 0 && last >= 0; }
bool passesDownwards(double first, double last) { return first > 0 && last <= 0; }

/// The parabola through three points at x.
double parabola(double x, double x0, double y0, double x1, double y1, double x2, double y2) {
    const double d01 = (y1 - y0) / (x1 - x0), d12 = (y2 - y1) / (x2 - x1);
    return y0 + (x - x0) * (d01 + (x - x1) * (d12 - d01) / (x2 - x0));
}
double vertex(double x0, double y0, double x1, double y1, double x2, double y2) {
    const double d01 = (y1 - y0) / (x1 - x0), d12 = (y2 - y1) / (x2 - x1);
    return (x0 + x1) / 2 - d01 * (x2 - x0) / (2 * (d12 - d01));
}

using Function = CrossingFinder::Function;
using Sample = CrossingFinder::Sample;

/// Whether the curve may turn back towards zero, and where, between sample i and the next: by the parabolas
/// with a sample on either side.
bool mayTurn(const std::vector<Sample>& samples, double range, std::size_t i, double& tau) {
    const Sample &a = samples[i], &b = samples[i + 1];
    if (!(a.value * b.value > 0) || !std::isfinite(a.value) || !std::isfinite(b.value)) return false;
    const double nearest = std::min(std::abs(a.value), std::abs(b.value));
    // Half as far from zero, or so near that what a parabola misses could reach it: worth a look.
    double best = std::max(nearest / 2, 2 * smooth * range);
    bool mayTurn = false;
    for (const std::size_t k : {i - 1, i + 2}) {
        if (k >= samples.size()) continue;
        const Sample& c = samples[k];
        const double place = vertex(a.tau, a.value, b.tau, b.value, c.tau, c.value);
        if (!(place > a.tau && place < b.tau)) continue;
        const double there = parabola(place, a.tau, a.value, b.tau, b.value, c.tau, c.value);
        const double distance = a.value > 0 ? there : -there;
        if (!(distance < best)) continue;
        best = distance;
        tau = place;
        mayTurn = true;
    }
    return mayTurn;
}

/// The least |g| between two samples, by parabolas and where they do not help by halves, until the sign is
/// another one or the place is known.
std::optional<Sample> beyondZero(const Function& g, Sample a, Sample b, double tau) {
    Sample middle{tau, g(tau)};
    const double sign = a.value > 0 ? 1 : -1;
    if (!(sign * middle.value < std::min(sign * a.value, sign * b.value))) return {};
    for (int evaluations = 0; evaluations < 60; ++evaluations) {
        if (std::isnan(middle.value)) return {};
        if (sign * middle.value <= 0) return middle;
        if (b.tau - a.tau < 1e-12) return {};
        double next = vertex(a.tau, a.value, middle.tau, middle.value, b.tau, b.value);
        const double width = b.tau - a.tau, apart = 1e-3 * width;
        const bool isFar =
            next > a.tau + apart && next < b.tau - apart && std::abs(next - middle.tau) > apart;
        if (evaluations % 3 == 2 || !isFar)
            next =
                b.tau - middle.tau > middle.tau - a.tau ? (middle.tau + b.tau) / 2 : (a.tau + middle.tau) / 2;
        Sample other{next, g(next)};
        if (std::isnan(other.value)) return {};
        if (other.tau < middle.tau) std::swap(other, middle);
        // Now a < middle < other < b: the one nearer to zero is kept in between.
        if (sign * middle.value < sign * other.value) {
            b = other;
        } else {
            a = middle;
            middle = other;
        }
    }
    return {};
}

/// Whether |g| gets smaller towards the place, on one side at least, more than a jump of this size would let
/// it.
bool isZero(const Function& g, double tau, const Sample& a, const Sample& b) {
    const double size = std::max(std::abs(a.value), std::abs(b.value)), width = b.tau - a.tau;
    const auto nearest = [&](double distance) {
        double least = std::numeric_limits<double>::infinity();
        for (const double at : {tau - distance, tau + distance})
            if (at >= a.tau && at <= b.tau)
                if (const double value = std::abs(g(at)); value < least) least = value;
        return least;
    };
    const double close = nearest(std::max(4 * roundOff, 1e-8 * width));
    if (!(close < std::numeric_limits<double>::infinity())) return false;
    if (close == 0) return true;
    if (close > nearest(width / 128) / 2) return false;
    return close <= 1e-4 * size || close <= nearest(width / 16384) / 2;
}

/// tau of the sign change between two samples, if it is a zero.
std::optional<double> zeroBetween(const Function& g, const Sample& a, const Sample& b) {
    if (b.value == 0) return isZero(g, b.tau, a, b) ? std::optional(b.tau) : std::nullopt;
    bool isLost = false;
    // Bounded, as a pole is not to be extrapolated from; near zero it is g.
    const auto bounded = [](double value) {
        return std::isinf(value) ? std::copysign(1.0, value) : value / (1 + std::abs(value));
    };
    const auto at = [&](double tau) {
        const double value = g(tau);
        isLost = isLost || std::isnan(value);
        return isLost ? 0 : bounded(value);
    };
    std::uintmax_t evaluations = 200;
    const auto [low, high] =
        boost::math::tools::toms748_solve(at, a.tau, b.tau, bounded(a.value), bounded(b.value),
                                          boost::math::tools::eps_tolerance<double>(), evaluations);
    const double tau = (low + high) / 2;
    return !isLost && isZero(g, tau, a, b) ? std::optional(tau) : std::nullopt;
}

}  // namespace

double roundingOf(std::span<const double> values) {
    double largest = 0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    return 64 * roundOff * largest;
}

void StepSamples::begin(const Integrator& integrator, std::size_t size) {
    integrator_ = &integrator;
    const double periods = std::clamp(integrator.periodsPerStep(), 0.0, 1e3);
    const std::size_t parts = std::clamp(static_cast<std::size_t>(std::ceil(samplesPerPeriod * periods)),
                                         fewestParts, CrossingFinder::mostParts);
    if (places_.size() + 1 != parts) {
        // Not quite at equal distances: a function with the period of the places would look constant.
        const double golden = (std::sqrt(5.0) - 1) / 2;
        places_.resize(parts - 1);
        for (std::size_t j = 1; j < parts; ++j) {
            const auto place = static_cast<double>(j);
            places_[j - 1] =
                (place + 0.2 * (std::fmod(place * golden, 1.0) - 0.5)) / static_cast<double>(parts);
        }
        known_.resize(parts - 1);
    }
    isKnown_.assign(places_.size(), 0);
    other_.resize(size);
    for (std::vector<double>& x : known_) x.resize(size);
}

const double* StepSamples::at(double tau) {
    const auto place = std::lower_bound(places_.begin(), places_.end(), tau);
    if (place == places_.end() || *place != tau) {
        integrator_->denseOutput(tau, other_);
        return other_.data();
    }
    const auto k = static_cast<std::size_t>(place - places_.begin());
    if (!isKnown_[k]) integrator_->denseOutput(tau, known_[k]);
    isKnown_[k] = 1;
    return known_[k].data();
}

void CrossingFinder::search(double first, double last, const std::vector<double>& places, const Function& g) {
    found_.clear();
    samples_.clear();
    samples_.push_back({0, first});
    // Where g is not a number inside the step, what is around it is looked at.
    const auto add = [this](double tau, double value) {
        if (!std::isnan(value)) samples_.push_back({tau, value});
    };
    for (const double tau : places) add(tau, g(tau));
    samples_.push_back({1, last});
    while (!isResolved() && 2 * samples_.size() <= mostParts + 2) refine(g);
    lookForExtrema(g);
    for (std::size_t i = 0; i + 1 < samples_.size(); ++i) addZeros(g, samples_[i], samples_[i + 1], 2);
}

/// Twice as many samples.
void CrossingFinder::refine(const Function& g) {
    finer_.clear();
    for (std::size_t i = 0; i + 1 < samples_.size(); ++i) {
        finer_.push_back(samples_[i]);
        const double tau = (samples_[i].tau + samples_[i + 1].tau) / 2, value = g(tau);
        if (!std::isnan(value)) finer_.push_back({tau, value});
    }
    finer_.push_back(samples_.back());
    samples_.swap(finer_);
}

bool CrossingFinder::isResolved() {
    double low = samples_.front().value, high = low;
    for (const Sample& s : samples_) {
        low = std::min(low, s.value);
        high = std::max(high, s.value);
    }
    range_ = high - low;
    if (!std::isfinite(range_)) return true;  // at a pole no number of samples is enough
    if (range_ <= noise_) return true;
    if (low > farAway * range_ || high < -farAway * range_) return true;
    for (std::size_t i = 1; i + 1 < samples_.size(); i += 2)
        if (misfit(i) > smooth * range_) return false;
    return true;
}

/// What the parabola through the samples before and after this one, and one of their kind, misses it by.
double CrossingFinder::misfit(std::size_t i) const {
    const std::size_t n = samples_.size();
    if (i + 3 >= n && i < 3) return 0;
    const Sample &a = samples_[i - 1], &b = samples_[i + 1], &c = samples_[i + 3 < n ? i + 3 : i - 3];
    return std::abs(samples_[i].value -
                    parabola(samples_[i].tau, a.tau, a.value, b.tau, b.value, c.tau, c.value));
}

void CrossingFinder::lookForExtrema(const Function& g) {
    extrema_.clear();
    for (std::size_t i = 0; i + 1 < samples_.size(); ++i)
        if (double tau = 0; mayTurn(samples_, range_, i, tau))
            if (const auto found = beyondZero(g, samples_[i], samples_[i + 1], tau))
                extrema_.push_back(*found);
    if (extrema_.empty()) return;
    samples_.insert(samples_.end(), extrema_.begin(), extrema_.end());
    std::sort(samples_.begin(), samples_.end(),
              [](const Sample& a, const Sample& b) { return a.tau < b.tau; });
}

void CrossingFinder::addZeros(const Function& g, const Sample& a, const Sample& b, int depth) {
    const bool isUpwards = passesUpwards(a.value, b.value);
    if (!isUpwards && !passesDownwards(a.value, b.value)) return;
    const auto zero = zeroBetween(g, a, b);
    if (!zero) return;
    const std::size_t place = found_.size();
    found_.push_back({*zero, isUpwards});
    if (depth > 0 && *zero > a.tau && *zero < b.tau) addHiddenZeros(g, a, b, *zero, depth - 1);
    // With two more on one side the one in the middle goes the other way.
    if (found_.size() == place + 1) return;
    std::sort(found_.begin() + static_cast<std::ptrdiff_t>(place), found_.end(),
              [](const Crossing& x, const Crossing& y) { return x.tau < y.tau; });
    for (std::size_t k = place; k < found_.size(); ++k)
        found_[k].isUpwards = (k - place) % 2 == 0 ? isUpwards : !isUpwards;
}

/// Two more zeros beside one: h = g/(tau - zero) has the same sign at a and b, and another one in between.
void CrossingFinder::addHiddenZeros(const Function& g, const Sample& a, const Sample& b, double zero,
                                    int depth) {
    const auto quotient = [&](double tau) { return g(tau) / (tau - zero); };
    const Function h = functionOf(quotient);
    Samples around{{a.tau, a.value / (a.tau - zero)}};
    for (const double tau : {(a.tau + zero) / 2, (zero + b.tau) / 2}) around.push_back({tau, h(tau)});
    around.push_back({b.tau, b.value / (b.tau - zero)});
    double low = around[0].value, high = low;
    for (const Sample& s : around) {
        low = std::min(low, s.value);
        high = std::max(high, s.value);
    }
    for (std::size_t i = 0; i + 1 < around.size(); ++i) {
        double tau = 0;
        if (!mayTurn(around, high - low, i, tau)) continue;
        const auto found = beyondZero(h, around[i], around[i + 1], tau);
        if (!found || found->value == 0) continue;
        const Sample turned{found->tau, g(found->tau)};
        const double near = zero + 1e-3 * (turned.tau - zero);
        const Sample beside{near, g(near)};
        if (turned.tau < zero) {
            addZeros(g, a, turned, depth);
            addZeros(g, turned, beside, depth);
        } else {
            addZeros(g, beside, turned, depth);
            addZeros(g, turned, b, depth);
        }
        return;
    }
}

}  // namespace extremal
