// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/force_pulses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/model/typed/typed_mechanics.hpp"
#include "engine/run/reference/interval.hpp"

namespace extremal {
namespace {

/// The change of the forces over a range of time, at the states of a motion.
class ForceChange {
public:
    ForceChange(const System& system, const typed::Tape& gradient, const State& initial, double end,
                const ExactSolution& motion)
        : gradient_(gradient),
          d_(static_cast<std::size_t>(system.dimension())),
          registers_(gradient.registers()) {
        constexpr int fewStates = 200, kept = 4;
        std::vector<double> x(initial.x.size()), v(d_);
        const auto& m = system.mechanics();
        for (int i = 0; i <= fewStates; ++i) {
            const double t = initial.t + (end - initial.t) * i / fewStates;
            if (i == 0)
                x = initial.x;
            else if (motion)
                motion(t, x);
            if (!std::all_of(x.begin(), x.end(), [](double each) { return std::isfinite(each); })) continue;
            for (std::size_t k = 0; k < d_; ++k) momentum_ = std::max(momentum_, std::abs(x[d_ + k]));
            if (i % (fewStates / kept) != 0) continue;
            if (!m.velocity(m.model.get(), t, x.data(), x.data() + d_, v.data())) continue;
            std::vector<double> state(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(d_));
            state.insert(state.end(), v.begin(), v.end());
            states_.push_back(std::move(state));
        }
    }

    bool hasStates() const { return !states_.empty(); }
    double momentum() const { return momentum_; }
    double over(double a, double b) {
        double most = 0;
        for (const std::vector<double>& state : states_) {
            for (std::size_t k = 0; k < state.size(); ++k) registers_[k] = {state[k], state[k]};
            registers_[state.size()] = {a, b};
            enclose(gradient_, registers_.data());
            for (std::size_t k = 0; k < d_; ++k)
                most = std::max(most, gradient_.output(k, registers_.data()).width());
        }
        return most;
    }

private:
    const typed::Tape& gradient_;
    std::size_t d_;
    std::vector<RealInterval> registers_;
    std::vector<std::vector<double>> states_;  ///< (q, v)
    double momentum_ = 0;
};

struct Scan {
    ForcePulses found;
    double impulse = 0;  ///< of all leaves, at most
};

/// The run in leaves on each of which the impulse changes by at most this.
Scan scanned(ForceChange& change, double start, double end, double allowed) {
    constexpr double leastLength = 1e-9;
    constexpr int mostBoxes = 20'000;
    Scan scan;
    std::vector<std::pair<double, double>> stack{{start, end}};
    scan.found.ends = {start};
    while (!stack.empty()) {
        const auto [a, b] = stack.back();
        stack.pop_back();
        if (++scan.found.boxes > mostBoxes) {  // an unknown function, or a force that never rests
            scan.found.isEverywhere = true;
            return scan;
        }
        const double impulse = change.over(a, b) * (b - a);
        if (impulse <= allowed || b - a < leastLength * (end - start)) {
            scan.found.ends.push_back(b);
            scan.impulse += impulse;
            continue;
        }
        const double middle = a + (b - a) / 2;
        stack.emplace_back(middle, b);
        stack.emplace_back(a, middle);
    }
    return scan;
}

/// Neighbouring leaves that are shorter than a thousandth of the run.
std::vector<ReferenceInfo::At> pulsesIn(const std::vector<double>& ends) {
    constexpr double part = 1e-3, most = 0.1;  // of the run
    const double length = ends.back() - ends.front();
    std::vector<ReferenceInfo::At> all;
    double from = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 1; i < ends.size(); ++i) {
        const bool isShort = ends[i] - ends[i - 1] < part * length;
        if (isShort && std::isnan(from)) from = ends[i - 1];
        const bool isEnd = !std::isnan(from) && (!isShort || i + 1 == ends.size());
        if (!isEnd) continue;
        const double to = isShort ? ends[i] : ends[i - 1];
        if (to - from < most * length) all.push_back({(from + to) / 2, to - from});
        from = std::numeric_limits<double>::quiet_NaN();
    }
    return all;
}

}  // namespace

double ForcePulses::shortestIn(double a, double b) const {
    double least = std::numeric_limits<double>::infinity();
    for (auto at = std::upper_bound(ends.begin(), ends.end(), a); at != ends.end(); ++at) {
        if (at != ends.begin()) least = std::min(least, *at - *std::prev(at));
        if (*at >= b) break;
    }
    return least;
}

ForcePulses forcePulses(const System& system, const State& initial, double end, const ExactSolution& motion) {
    constexpr double part = 0.02, ofWhole = 1e-3, settled = 0.3;
    constexpr int everywhere = 2'000, mostScans = 12;
    const Mechanical* const mechanics = system.parts.find<Mechanical>();
    const typed::Tape* const gradient = mechanics ? typed::gradientTapeOf(*mechanics) : nullptr;
    const double length = end - initial.t;
    if (!gradient || !mechanics->isTimeDependent || !(length > 0)) return {};
    ForceChange change(system, *gradient, initial, end, motion);
    const double whole = change.hasStates() ? change.over(initial.t, end) : 0;
    if (!(whole > 0)) return {};
    double allowed = part * change.momentum();
    const bool isAtRest = !(allowed > 0);
    if (isAtRest) allowed = std::isfinite(whole) ? ofWhole * whole * length : HUGE_VAL;
    Scan scan = scanned(change, initial.t, end, allowed);
    // From rest the momentum is what the forces give: at most the sum over the leaves, which falls with them.
    for (int i = 1; i < mostScans && isAtRest && part * scan.impulse < settled * allowed; ++i) {
        allowed = part * scan.impulse;
        scan = scanned(change, initial.t, end, allowed);
    }
    ForcePulses found = std::move(scan.found);
    found.isEverywhere = found.isEverywhere || found.ends.size() > everywhere;
    if (found.isEverywhere)
        found.ends.clear();
    else
        found.pulses = pulsesIn(found.ends);
    return found;
}

}  // namespace extremal
