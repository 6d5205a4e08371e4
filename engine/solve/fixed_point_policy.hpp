// SPDX-License-Identifier: GPL-3.0-or-later
/// When the fixed-point iteration over all nodes of a step (integrator/node_iteration.hpp) is done, and when
/// it is given up for Newton's method.
///
/// It says after each sweep how large its correction was relative to the increments of the step. Corrections
/// need not shrink alike: the contraction of a stiff step has pairs of complex eigenvalues and is far from
/// normal, so that they fall fast and slowly by turns. What counts is their mean over three sweeps.
///
/// T: scalar of the step. epsilon: unit of its last place.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/outcome.hpp"
#include "engine/core/text/archive.hpp"
#include "engine/solve/correction_size.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {

/// A root this far from its starting value, against the increments of the step, may be another one than that
/// of the motion.
inline constexpr double farFromRoot = 0.25;

/// Whether sweeps have come to the one root there is near their start: the start is near to it by its first
/// correction, or sweeps contract on the way to the last one by so much each that the equations are nearly
/// linear there.
inline bool isOneRoot(double first, double last, int contractions, double linear = 0.1) {
    return first <= farFromRoot || (contractions > 0 && last <= first * std::pow(linear, contractions));
}

/// Steps that are left to Newton's method after one for which sweeps have not converged: none, and where this
/// goes on one, two, four ..
class SweepPause {
public:
    bool isOver() { return left_ == 0 || --left_ < 0; }
    /// How the sweeps of a step have ended.
    void after(Outcome outcome) {
        if (outcome == Outcome::stopped) return;
        const bool hasFailed = outcome != Outcome::converged;
        left_ = hasFailed ? next_ : 0;
        next_ = hasFailed ? std::clamp(2 * next_, 1, stepsWithNewton) : 0;
    }
    void checkpoint(Archive& archive) { archive(left_, next_); }

private:
    int left_ = 0, next_ = 0;
};

template <class T>
class FixedPointPolicy {
public:
    enum class Verdict { converged, proceed, slow, notFinite };

    /// `tolerance`: relative size of the last correction; at most epsilon: solve to round-off. `worth`: so
    /// many sweeps cost what a step of Newton's method costs, which is 20 to 60 of them where nodes are
    /// evaluated one by one. `noise`: what round-off leaves of corrections at most, where that is known and
    /// not the unit of the last place.
    explicit FixedPointPolicy(const T& tolerance, int worth = 21, const T& noise = T(0))
        : tolerance_(tolerance), worth_(worth), noise_(noise) {}

    Verdict judge(const T& size) {
        if (!(size < std::numeric_limits<T>::infinity())) return Verdict::notFinite;
        if (isSmall(size) || isRoundOff(size)) return Verdict::converged;
        const bool isSlow = ++sweeps_ >= patience && isFar(size);
        for (int i = 2; i > 0; --i) earlier_[i] = earlier_[i - 1];
        earlier_[0] = size;
        return isSlow ? Verdict::slow : Verdict::proceed;
    }

    /// The same where some coordinates may be buried (correction_size.hpp): `measure()` gives the
    /// CorrectionSize of the correction, and is asked once the iteration seems slow.
    template <class Measure>
    Verdict judge(const T& size, const Measure& measure) {
        if (hasBuried_) return judgeApart(measure());
        const Verdict verdict = judge(size);
        if (verdict != Verdict::slow || !(measure().size < size)) return verdict;
        *this = FixedPointPolicy(tolerance_, worth_, noise_);
        hasBuried_ = true;
        return Verdict::proceed;
    }

private:
    /// The verdicts above do not see buried coordinates, for which it may go on.
    Verdict judgeApart(const CorrectionSize<T>& correction) {
        const bool isSettled = buried_.hasSettled(correction);
        const Verdict verdict = judge(correction.size);
        if (verdict != Verdict::converged || correction.buried <= std::max(tolerance_, epsilon))
            return verdict;
        return isSettled ? Verdict::converged : Verdict::proceed;
    }

    static constexpr T epsilon = std::numeric_limits<T>::epsilon();
    /// Sweeps before a slow contraction counts: the first ones are those of the starting value.
    static constexpr int patience = 5;
    /// Corrections at round-off vary by less than a factor of four.
    static constexpr double stall = 0.25;

    /// The iteration to round-off ends where one more sweep would change a hundredth of the last place, at
    /// the slower contraction of the last two: left at round-off itself the forces have a bias that adds up
    /// over millions of steps. A correction beyond the increments, of a coordinate near zero, says nothing of
    /// the contraction.
    bool isSmall(const T& size) const {
        if (tolerance_ > epsilon) return size <= tolerance_;
        T ratio(1);
        if (sweeps_ > 0 && earlier_[0] < T(1))
            ratio = std::min(ratio, std::max(T(size / earlier_[0]), T(earlier_[0] / earlier_[1])));
        return size * ratio <= epsilon / 100;
    }
    /// Corrections that shrank fast, over two sweeps, and suddenly do not, near round-off; or have not shrunk
    /// over three sweeps, within four digits of it, as sums of terms that cancel leave no more. Where the
    /// noise is known, corrections below it that twice have not halved.
    bool isRoundOff(const T& size) const {
        if (noise_ > T(0))
            return size < noise_ && size >= T(0.5) * earlier_[0] && earlier_[0] >= T(0.5) * earlier_[1];
        const bool isSudden = size >= earlier_[0] * T(stall) && earlier_[0] < earlier_[2] * T(stall * stall);
        return (size < 8 * epsilon && isSudden) ||
               (size < roundOffOfSums<T>() && size >= earlier_[2] * T(stall));
    }
    /// More sweeps from round-off than Newton's method is worth.
    bool isFar(const T& size) const {
        const T ratio = size / earlier_[2];  // of three sweeps
        const T near = tolerance_ > epsilon ? tolerance_ : epsilon;
        T then = size;
        for (int sweeps = 3; sweeps <= worth_; sweeps += 3) {
            then *= ratio;
            if (then <= near && ratio < T(1)) return false;  // and would be with all of them
        }
        return then > near;
    }

    T tolerance_;
    int worth_;
    T noise_;
    bool hasBuried_ = false;
    BuriedWatch<T> buried_;
    int sweeps_ = 0;
    T earlier_[3] = {std::numeric_limits<T>::infinity(), std::numeric_limits<T>::infinity(),
                     std::numeric_limits<T>::infinity()};
};

}  // namespace extremal
