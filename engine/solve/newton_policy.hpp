// SPDX-License-Identifier: GPL-3.0-or-later
/// The one policy of the iterations that solve a step: when they are done, when they want a new Jacobian,
/// when they are given up, and what they start from. Every number is named here, with its reason.
///
/// An iteration says how large its correction is relative to the unknowns, e_j = |delta_j| / |x|
/// (solve/correction_size.hpp), and is told what to do. Corrections go on to round-off, so that symplecticity
/// and momentum maps hold to round-off: a tolerance is for those who want less. Users: the condensed Galerkin
/// step (integrator/), the Lie group step, the product form and the moving times (family/), small dense
/// systems (solve/newton.hpp). Fixed-point iterations have a policy of their own
/// (solve/fixed_point_policy.hpp).
///
/// T: scalar of the step. epsilon: unit of its last place.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <type_traits>

#include "engine/core/outcome.hpp"
#include "engine/solve/correction_size.hpp"

namespace extremal {

enum class SolverMethod { automatic, newton, fixedPoint };

/// What a scene says of the solver.
struct SolverPolicy {
    SolverMethod method = SolverMethod::automatic;
    double tolerance = 0;    ///< relative size of the last correction; 0: round-off
    int maxIterations = 50;  ///< Newton or fixed-point iterations in one step
    bool operator==(const SolverPolicy&) const = default;
};

/// The relative correction that ends an iteration: that of the scene, and at least a unit of the last place.
template <class T>
T toleranceOf(const SolverPolicy& policy) {
    const T epsilon = std::numeric_limits<T>::epsilon();
    return policy.tolerance > 0 ? std::max(T(policy.tolerance), epsilon) : epsilon;
}

template <class T>
struct NewtonLimits {
    /// A correction of at most this ends the iteration.
    T tolerance = std::numeric_limits<T>::epsilon();
    /// So does one after which the next, e_{j+1} = e_j^2 / e_{j-1} if the contraction stays as it is, would
    /// be at most this; 0: never. Saves the evaluation that would only confirm it.
    T predicted = T(0);
    /// Below this, a correction that no longer shrinks is the round-off of the equations, and the end.
    T stagnation = roundOffOfSums<T>();
    /// Below this, it is so after it has not shrunk three times, whatever the Jacobian; 0: never. Steps of
    /// stiff systems are ill-conditioned, and stay two digits further from round-off.
    T illConditioned = T(0);
    /// A first correction larger than this belongs to a poor starting value that is not worth improving.
    T largestFirst = std::numeric_limits<T>::infinity();
    /// After a larger correction the Jacobian belongs to another place.
    T refreshAbove = std::numeric_limits<T>::infinity();
    /// Corrections with the same Jacobian before a slow contraction counts: the first one says nothing of it,
    /// as it is that of the starting value.
    int patience = 2;
    /// Corrections that shrink by less are slow. A tenth: then round-off is 16 corrections away, and a new
    /// Jacobian costs less than what it saves.
    T slow = T(0.1);
    /// So many corrections in a row, none smaller than the one before, do not come back: one or two happen
    /// where the starting value is far away.
    int mostGrowing = 4;

    static constexpr int never = std::numeric_limits<int>::max();

    /// Newton's method of the condensed step, with a Jacobian that is kept while it contracts. Beyond a tenth
    /// of the unknowns a correction has moved the nodes to where forces are others.
    static NewtonLimits condensedStep(const T& tolerance, bool isFallback) {
        NewtonLimits l;
        l.tolerance = tolerance;
        l.illConditioned = 100 * l.stagnation;
        // Curves with many functions swing far beyond their step: then the next rung of the ladder is better.
        if (!isFallback) l.largestFirst = T(1);
        l.refreshAbove = T(0.1);
        return l;
    }
    /// Newton's method of the Lie group step, whose evaluations are dear: the last is not made where the next
    /// correction would be a quarter of the tolerance, as contractions vary by less than that.
    static NewtonLimits lieStep(const T& tolerance) {
        NewtonLimits l;
        l.tolerance = tolerance;
        l.predicted = T(0.25) * tolerance;
        return l;
    }
    /// Newton's method of the step of a mechanism, with a Jacobian that is kept while it contracts: how far
    /// and how fast is measured apart from the multipliers (solve/contraction.hpp).
    static NewtonLimits mechanismStep(const T& tolerance) {
        NewtonLimits l;
        l.tolerance = tolerance;
        return l;
    }
    /// One element whose step is varied until its energy is right: a new Jacobian in every iteration, whose
    /// factors at the solution say how it moves with the step.
    static NewtonLimits elementStep(const T& tolerance) {
        NewtonLimits l;
        l.tolerance = tolerance;
        return l;
    }
    /// The product form, with a new Jacobian in every iteration. Amplitudes over a small mean are
    /// ill-conditioned: their last digits never settle, and half of the digits is what can be had.
    /// Corrections may grow for a while, as the first guess is one of another space.
    static NewtonLimits productStep() {
        NewtonLimits l;
        l.tolerance = 4 * std::numeric_limits<T>::epsilon();
        l.stagnation = T(1e-7);
        l.mostGrowing = never;
        return l;
    }
    /// A small dense system with a new Jacobian in every iteration and damping, which sees to it that
    /// residuals shrink where corrections do not.
    static NewtonLimits dense() {
        NewtonLimits l;
        l.mostGrowing = never;
        return l;
    }
};

/// How often half of a correction is taken back that leads out of the domain of L, before an iteration is
/// given up: so many halvings leave 1e-9 of it.
inline constexpr int mostRetreats = 30;

/// What to do after a correction: it is the last one; go on; go on with a new Jacobian; give up.
enum class NewtonVerdict { converged, proceed, slow, diverged, notFinite };

/// How the iteration has ended, if it has.
constexpr std::optional<Outcome> endOf(NewtonVerdict verdict) {
    switch (verdict) {
        case NewtonVerdict::converged:
            return Outcome::converged;
        case NewtonVerdict::diverged:
            return Outcome::diverged;
        case NewtonVerdict::notFinite:
            return Outcome::notFinite;
        case NewtonVerdict::proceed:
        case NewtonVerdict::slow:
            break;
    }
    return {};
}

template <class T>
class NewtonPolicy {
public:
    using Verdict = NewtonVerdict;

    explicit NewtonPolicy(const NewtonLimits<T>& limits) : limits_(limits) {}

    /// After a correction of this relative size. `floor`: what round-off in the equations leaves of
    /// corrections, where that is known.
    Verdict judge(const T& size, const T& floor = T(0)) {
        if (!(size < std::numeric_limits<T>::infinity())) return Verdict::notFinite;
        const bool isFirst = !(last_ < std::numeric_limits<T>::infinity());
        if (isFirst && size > limits_.largestFirst) return Verdict::diverged;
        const bool isStalled = size >= last_ * T(stall);
        if (size <= limits_.tolerance || isNextSmall(size, isFirst)) return Verdict::converged;
        if (isStalled && (size < limits_.stagnation || (isJacobianNew() && size < floor)))
            return Verdict::converged;
        if (isStalled && size < limits_.illConditioned && ++stalls_ >= mostStalls) return Verdict::converged;
        ++sinceJacobian_;
        growing_ = size >= last_ ? growing_ + 1 : 0;
        const bool isSlow =
            sinceJacobian_ >= limits_.patience && size > last_ * limits_.slow && size > limits_.stagnation;
        last_ = size;
        if (growing_ >= limits_.mostGrowing) return Verdict::diverged;
        return isSlow || size > limits_.refreshAbove ? Verdict::slow : Verdict::proceed;
    }
    /// The same where some coordinates may be buried (correction_size.hpp): `measure()` gives the
    /// CorrectionSize of the correction, and is asked once a correction has stopped shrinking far from
    /// round-off.
    template <class Measure>
    requires std::is_invocable_v<Measure> Verdict judge(const T& size, const Measure& measure) {
        hasBuried_ = hasBuried_ || (size > limits_.stagnation && size >= last_ * T(stall));
        return hasBuried_ ? judgeApart(measure()) : judge(size);
    }
    void jacobianIsNew() { sinceJacobian_ = 0; }
    bool isJacobianNew() const { return sinceJacobian_ == 0; }

private:
    /// Corrections at round-off vary by less than a factor of four; those that shrink by less are at it.
    static constexpr double stall = 0.25;
    static constexpr int mostStalls = 3;

    /// The verdicts above do not see buried coordinates: a correction is the last one when these no longer
    /// shrink either, with a new Jacobian.
    Verdict judgeApart(const CorrectionSize<T>& correction) {
        const bool isNew = isJacobianNew(), isStalled = correction.buried >= lastBuried_ * T(stall);
        lastBuried_ = correction.buried > T(0) ? correction.buried : std::numeric_limits<T>::infinity();
        const Verdict verdict = judge(correction.size);
        if (verdict != Verdict::converged || correction.buried <= limits_.tolerance) return verdict;
        if (isStalled && isNew) return Verdict::converged;
        ++sinceJacobian_;
        return isStalled ? Verdict::slow : Verdict::proceed;
    }

    bool isNextSmall(const T& size, bool isFirst) const {
        if (!(limits_.predicted > T(0))) return false;
        return (isFirst ? size : T(size * std::min(T(1), T(size / last_)))) <= limits_.predicted;
    }

    NewtonLimits<T> limits_;
    T last_ = std::numeric_limits<T>::infinity(), lastBuried_ = std::numeric_limits<T>::infinity();
    bool hasBuried_ = false;
    int growing_ = 0, stalls_ = 0, sinceJacobian_ = 0;
};

/// Whether the pivots of a factorised Jacobian tell that it is regular: a thousand times closer to singular
/// than round-off, as stiff and soft directions of one step legitimately differ by that much.
template <class T>
bool isRegular(const T& smallestPivot, const T& largestPivot) {
    return smallestPivot > std::numeric_limits<T>::epsilon() * T(1e-3) * largestPivot;
}

/// What Newton's method starts from: the previous step's curve extrapolated; the smooth part of that curve,
/// which varies less beyond its step; or what is known without it, a Taylor step.
enum class StartingValue { extrapolated, previous, fallback };

/// The ladder of starting values: down a rung where one was poor, and back to the first after some steps.
class StartingLadder {
public:
    /// The rung to begin a step with.
    StartingValue begin(bool hasPrevious) {
        if (pause_ > 0 && --pause_ == 0) best_ = StartingValue::extrapolated;
        return hasPrevious ? best_ : StartingValue::fallback;
    }
    /// The rung below one that failed, and where the next steps begin.
    StartingValue below(StartingValue failed, bool hasSmoothPart) {
        best_ = failed == StartingValue::extrapolated && hasSmoothPart ? StartingValue::previous
                                                                       : StartingValue::fallback;
        pause_ = stepsBelow;
        return best_;
    }

private:
    /// What made extrapolation poor, a turning point or a large force, lasts for some steps; each attempt
    /// that fails costs an assembly.
    static constexpr int stepsBelow = 16;

    StartingValue best_ = StartingValue::extrapolated;
    int pause_ = 0;  ///< steps until extrapolation is tried again
};

/// Steps for which Newton's method is preferred after the fixed point was slow: it is so while forces are
/// stiff, and each trial costs some sweeps over the nodes.
inline constexpr int stepsWithNewton = 32;

}  // namespace extremal
