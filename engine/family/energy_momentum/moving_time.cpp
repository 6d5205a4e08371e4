// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/energy_momentum/moving_time.hpp"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/core/algebra/exact_sum.hpp"
#include "engine/family/energy_momentum/density.hpp"
#include "engine/family/energy_momentum/element_step.hpp"

namespace extremal {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

class MovingTime final : public Integrator {
public:
    MovingTime(const Mechanics<double>& mechanics, const Table<double>& table,
               const MovingTimeOptions& options, const SolverPolicy& policy)
        : element_(mechanics, table, policy), mechanics_(mechanics), options_(options) {}

    TimeGrid grid() const override { return TimeGrid::free; }
    std::vector<MemoryPart> memoryParts() const override {
        return {{"discrete energy", 1},
                {"last step", 1},
                {"growth of the last step", 1},
                {"lost to rounding", lostNumbers()}};
    }

    /// The first step is made once for its energy, and again by advance().
    void begin(State& state) override {
        StepReport report;
        placeAt(state);
        const Outcome outcome = element_.solve(state.t, options_.first, stop(), report);
        state.memory.assign(lost + lostNumbers(), 0);
        state.memory[discreteEnergy] = outcome == Outcome::converged
                                           ? element_.discreteEnergy()
                                           : std::numeric_limits<double>::quiet_NaN();
        state.memory[lastStep] = options_.first;
        state.memory[growth] = 1;
    }

    StepReport advance(State& state, double) override {
        if (state.memory.empty()) begin(state);
        report_ = StepReport{};
        placeAt(state);
        double energy = state.memory[discreteEnergy];
        report_.outcome = std::isfinite(energy) ? choose(state, energy) : firstTrouble(state);
        if (report_.outcome == Outcome::converged) finish(state, energy);
        return report_;
    }

    std::span<const Quantity> quantities() const override {
        static const std::array<Quantity, 3> all = {
            {{"discrete_energy", "", "E_d", ""}, {"density", "", "ℓ", ""}, {"monitor", "", "", ""}}};
        return all;
    }
    void measure(const State&, double* values) const override {
        values[0] = energy_;
        values[1] = density_;
        values[2] = std::abs(lastStep_) * std::pow(std::abs(density_), 1.0 / (options_.order + 1));
    }

    /// Of (t, q, -E, p), where the step has the energy of those before it.
    std::size_t tangentSize() const override {
        return static_cast<std::size_t>(2 * mechanics_.dimension + 2);
    }
    bool applyTangent(std::span<double> W) override {
        return report_.event == StepEvent::none &&
               element_.applyTangent(W.data(), static_cast<int>(W.size() / tangentSize()));
    }

    void denseOutput(double tau, std::span<double> x) const override { element_.denseOutput(start_, tau, x); }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<MovingTime>(*this); }

private:
    /// Places in State::memory: E, the last step, its ratio to the one before (1 after a step without a
    /// root), and what the sums of q, p and t have lost to rounding. A step is a function of the state alone,
    /// to the last bit.
    enum : std::size_t { discreteEnergy, lastStep, growth, lost };
    std::size_t lostNumbers() const { return static_cast<std::size_t>(2 * mechanics_.dimension + 1); }

    void placeAt(const State& state) {
        start_ = state.t;
        element_.startAt(state.x.data(), state.x.data() + mechanics_.dimension);
    }

    /// Why the first step has no energy.
    Outcome firstTrouble(const State& state) {
        const Outcome outcome = element_.solve(state.t, options_.first, stop(), report_);
        return outcome == Outcome::converged ? Outcome::notFinite : outcome;
    }

    /// Leaves the element solved for the step that is taken; `energy` is that of the steps to come.
    Outcome choose(const State& state, double& energy) {
        const double last = state.memory[lastStep];
        if (state.node == 0 && isUndetermined(last)) return Outcome::refused;
        Nearest nearest;
        if (refine(energy, last, state.memory[growth]) || search(energy, last, nearest))
            return Outcome::converged;
        if (stop().stop_requested()) return Outcome::stopped;
        ++report_.cost.rejected;
        if (options_.policy == UnsolvablePolicy::stop) return Outcome::energyUnsolvable;
        report_.event = StepEvent::energyUnsolvable;
        const double first = std::copysign(options_.first, last),
                     h = options_.policy == UnsolvablePolicy::minimise ? bestStep(energy, last, nearest)
                                                                       : first;
        const Outcome outcome = element_.solve(start_, h, stop(), report_);
        if (outcome == Outcome::converged && options_.policy == UnsolvablePolicy::reset)
            energy = element_.discreteEnergy();
        return outcome;
    }

    /// Whether every step has the same discrete energy, to round-off: a free particle, an equilibrium.
    bool isUndetermined(double h) {
        if (element_.solve(start_, h, stop(), report_) != Outcome::converged) return false;
        return std::abs(h * element_.energyByStep()) <= undetermined * epsilon * element_.energyScale();
    }

    /// E_d(h) - E; not a number where the step has no solution.
    double excess(double h, double energy) {
        const bool isSolved = element_.solve(start_, h, stop(), report_) == Outcome::converged;
        return isSolved ? element_.discreteEnergy() - energy : std::numeric_limits<double>::quiet_NaN();
    }
    double tolerance(double energy) const {
        return 2 * epsilon * std::max(std::abs(energy), element_.energyScale());
    }
    /// The steps that are allowed after one of length `last`, as lengths.
    std::pair<double, double> window(double last) const {
        const double low = std::clamp(options_.shrink * std::abs(last), options_.least, options_.most),
                     high = std::clamp(options_.grow * std::abs(last), options_.least, options_.most);
        return {low, high};
    }

    /// Newton's method for u = h^r, from a step that grows as the last one did. One beyond the window is
    /// taken back to its end.
    bool refine(double energy, double last, double expectedGrowth) {
        constexpr int mostIterations = 12;
        const auto [low, high] = window(last);
        double h = std::copysign(std::clamp(expectedGrowth * std::abs(last), low, high), last),
               smallest = std::numeric_limits<double>::infinity(), best = h;
        bool isAtEnd = false;
        for (int i = 0; i < mostIterations; ++i) {
            const double F = excess(h, energy);
            if (std::abs(F) <= tolerance(energy)) return true;
            if (!(std::abs(F) < smallest)) break;
            smallest = std::abs(F);
            best = h;
            const double r = options_.order, u = 1 - r * F / (h * element_.energyByStep());
            if (!(u > 0)) return false;
            const double wanted = std::abs(h) * std::pow(u, 1 / r), next = std::clamp(wanted, low, high);
            if (next != wanted && isAtEnd) return false;
            isAtEnd = next != wanted;
            h = std::copysign(next, last);
        }
        // Where E_d hardly depends on h its last digits are noise.
        constexpr double noise = 32;
        return std::abs(excess(best, energy)) <= noise * tolerance(energy);
    }

    /// Of the lengths on a grid the one with the smallest |E_d - E|; that of its neighbours is `ratio` times
    /// as long or short at most.
    struct Nearest {
        double h = 0, distance = std::numeric_limits<double>::infinity(), ratio = 1;
    };

    /// Sign changes on a grid of the window, the one nearest to the last step first.
    bool search(double energy, double last, Nearest& nearest) {
        constexpr int perSide = 8;
        const auto [low, high] = window(last);
        const double middle = std::clamp(std::abs(last), low, high);
        struct Side {
            double end, ratio, h, F;
        };
        const double atMiddle = excess(std::copysign(middle, last), energy);
        std::array<Side, 2> sides = {{{high, std::pow(high / middle, 1.0 / perSide), middle, atMiddle},
                                      {low, std::pow(low / middle, 1.0 / perSide), middle, atMiddle}}};
        const auto note = [&](double h, double F) {
            if (std::abs(F) < nearest.distance) nearest = {h, std::abs(F), nearest.ratio};
        };
        nearest.h = middle;  // where no step has a solution
        nearest.ratio = std::max(sides[0].ratio, 1 / sides[1].ratio);
        note(middle, atMiddle);
        for (int j = 1; j <= perSide; ++j)
            for (Side& side : sides) {
                if (side.ratio == 1) continue;
                const double h = j < perSide ? side.h * side.ratio : side.end,
                             F = excess(std::copysign(h, last), energy);
                if (stop().stop_requested()) return false;
                if (side.F * F <= 0 && isolate(energy, last, side.h, h, side.F, F)) return true;
                note(h, F);
                side.h = h;
                side.F = F;
            }
        return false;
    }
    bool isolate(double energy, double last, double a, double b, double Fa, double Fb) {
        if (a > b) {
            std::swap(a, b);
            std::swap(Fa, Fb);
        }
        bool hasFailed = false;
        const auto value = [&](double h) {
            const double F = excess(std::copysign(h, last), energy);
            hasFailed = hasFailed || std::isnan(F);
            return hasFailed ? 0 : F;  // ends the search
        };
        std::uintmax_t evaluations = 60;
        const auto ends = boost::math::tools::toms748_solve(
            value, a, b, Fa, Fb, boost::math::tools::eps_tolerance<double>(), evaluations);
        if (hasFailed) return false;
        const double F = excess(std::copysign((ends.first + ends.second) / 2, last), energy);
        // A pole has a sign change as well.
        return std::abs(F) < std::max(std::abs(Fa), std::abs(Fb));
    }

    /// The step in the window with the smallest (E_d - E)^2, from the grid of the search.
    double bestStep(double energy, double last, const Nearest& nearest) {
        constexpr int bits = 20;
        const auto [low, high] = window(last);
        const auto signedExcess = [&](double h) { return excess(std::copysign(h, last), energy); };
        if (nearest.h == low || nearest.h == high) {
            const double F = signedExcess(nearest.h), inward = nearest.h == low ? 1 : -1;
            if (low == high || F * std::copysign(inward, last) * element_.energyByStep() > 0)
                return std::copysign(nearest.h, last);
        }
        const auto square = [&](double h) {
            const double F = signedExcess(h);
            return std::isnan(F) ? std::numeric_limits<double>::infinity() : F * F;
        };
        std::uintmax_t evaluations = 50;
        const auto [h, value] = boost::math::tools::brent_find_minima(
            square, std::max(low, nearest.h / nearest.ratio), std::min(high, nearest.h * nearest.ratio), bits,
            evaluations);
        return std::copysign(value < nearest.distance * nearest.distance ? h : nearest.h, last);
    }

    void finish(State& state, double energy) {
        const int d = mechanics_.dimension;
        const double h = element_.step();
        double* const q = state.x.data();
        double* const p = q + d;
        const auto* const model = mechanics_.model.get();
        const double before = mechanics_.energy(model, state.t, q, p);
        double* const rest = state.memory.data() + lost;
        for (int k = 0; k < d; ++k) {
            q[k] = addExactly(q[k], element_.positionChange(k) + rest[k], rest[k]);
            p[k] = addExactly(p[k], element_.momentumChange(k) + rest[d + k], rest[d + k]);
        }
        state.t = addExactly(state.t, h + rest[2 * d], rest[2 * d]);
        const double after = mechanics_.energy(model, state.t, q, p);
        energy_ = element_.discreteEnergy();
        density_ = actionErrorDensity((before + after) / 2, energy_, h, options_.order);
        const bool isRoot = report_.event == StepEvent::none;
        state.memory[growth] = isRoot && state.node > 0 ? h / state.memory[lastStep] : 1;
        state.memory[discreteEnergy] = energy;
        state.memory[lastStep] = h;
        ++state.node;
        report_.step = lastStep_ = h;
    }

    /// |h dE_d/dh| below this many units of the last place of E_d leaves no digit of h.
    static constexpr double undetermined = 100;

    ElementStep element_;
    Mechanics<double> mechanics_;
    MovingTimeOptions options_;
    double start_ = 0, lastStep_ = 0, energy_ = 0, density_ = 0;  ///< of the last step
    StepReport report_;
};

}  // namespace

std::unique_ptr<Integrator> makeMovingTime(const Mechanics<double>& mechanics, const Table<double>& table,
                                           const MovingTimeOptions& options, const SolverPolicy& policy) {
    return std::make_unique<MovingTime>(mechanics, table, options, policy);
}

}  // namespace extremal
