// SPDX-License-Identifier: GPL-3.0-or-later
/// How large a correction of a step is: the one place that says what it is compared with.
///
/// An iteration is measured coordinate by coordinate, since coordinates may have units of their own and
/// bodies masses of very different sizes: the change of a coordinate against its increments in the step, or
/// against the round-off of its value, whichever is larger (relativeCorrection).
///
/// That measure cannot be met by a coordinate whose own increments are round-off: one that a symmetry keeps
/// at rest, whose forces are differences of equal terms, or one at an equilibrium. Nor can it where the
/// momentum is far larger than the mass times the velocity, as in a strong magnetic field: p_0 - L_v then has
/// the round-off of p. Both leave corrections that do not shrink. Such corrections are told from those of an
/// iteration that fails by their size in the metric of the kinetic energy, in which coordinates of different
/// units can be compared: with the mass m_k = L_vv(k, k) of coordinate k, its largest change e_k, its
/// increments y_k, its value q_k and its momentum p_k,
///
///     sqrt(m_k) e_k <= 100 epsilon max_l ( sqrt(m_l) y_l, sqrt(m_l) |q_l|, h |p_l| / sqrt(m_l) ).
///
/// This alone does not end an iteration, since a light body beside a heavy one may be below it and converge
/// all the same: such a correction is *buried*, and counts as round-off once it has stopped shrinking
/// (NewtonPolicy, FixedPointPolicy). It may shrink for as many sweeps as there are coordinates where each
/// acts on its neighbours alone: far from a place that moves, a chain has increments of 1e-20, 1e-40, .. of
/// those there, and every sweep finds the next of them. Such corrections would be round-off with the largest
/// mass of all, sqrt(max m_l) e_k <= epsilon max_l (..): they are *negligible*, and are not waited for.
///
/// T: scalar of the step. epsilon: unit of its last place.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace extremal {

/// Four digits above round-off: a residual is a sum of many terms that cancel, divided by a Jacobian of
/// modest condition.
template <class T>
constexpr T roundOffOfSums() {
    return T(1e4) * std::numeric_limits<T>::epsilon();
}

/// Size of a correction of one coordinate: against its increments in the step, or the round-off of its own
/// value, whichever is larger. A hundredth of that round-off is not a correction at all.
template <class T>
T relativeCorrection(const T& change, const T& increments, const T& value) {
    using std::abs;
    if (!(change <= std::numeric_limits<T>::max())) return std::numeric_limits<T>::infinity();
    const T roundOff = std::numeric_limits<T>::epsilon() * abs(value), known = std::max(increments, roundOff);
    if (!(change > roundOff * T(0.01))) return T(0);
    return known > T(0) ? T(change / known) : T(1);  // 0: at rest in 0 so far
}

/// What a correction does to one coordinate.
template <class T>
struct CoordinateCorrection {
    T change;      ///< the largest change of its unknowns
    T increments;  ///< the largest of its unknowns, as differences from the start of the step
    T value;       ///< at the start of the step
    T mass;        ///< L_vv(k, k), of any sign; 0: unknown, never buried
    T impulse;     ///< h p_k
};

/// The relative size of a correction, apart from that of buried coordinates.
template <class T>
struct CorrectionSize {
    T size = T(0);
    T buried = T(0);            ///< the largest relative correction of a buried coordinate
    bool areNegligible = true;  ///< all buried ones
};

/// `of(k)` is the CoordinateCorrection of coordinate k. Corrections of a unit in the last place of the
/// coordinate's own increments belong to `size`, whatever their size in the metric.
template <class T, class Of>
CorrectionSize<T> measureCorrection(int coordinates, const Of& of) {
    using std::abs;
    using std::sqrt;
    const T mostRoundOff = T(100) * std::numeric_limits<T>::epsilon();
    T common(0), heaviest(0);
    for (int k = 0; k < coordinates; ++k) {
        const CoordinateCorrection<T> c = of(k);
        const T root = sqrt(T(abs(c.mass)));
        if (!(root > T(0))) continue;
        heaviest = std::max(heaviest, root);
        common = std::max({common, T(root * c.increments), T(root * abs(c.value)), T(abs(c.impulse) / root)});
    }
    CorrectionSize<T> all;
    for (int k = 0; k < coordinates; ++k) {
        const CoordinateCorrection<T> c = of(k);
        const T own = relativeCorrection(c.change, c.increments, c.value), root = sqrt(T(abs(c.mass)));
        const bool isBuried = own > std::numeric_limits<T>::epsilon() && root > T(0) &&
                              root * c.change <= mostRoundOff * common;
        T& worst = isBuried ? all.buried : all.size;
        worst = std::max(worst, own);
        if (isBuried && !(heaviest * c.change <= std::numeric_limits<T>::epsilon() * common))
            all.areNegligible = false;
    }
    return all;
}

/// Whether buried coordinates are at round-off: they have not halved in five sweeps of a fixed-point
/// iteration, which an iteration that still contracts does; or have all been negligible in three of them,
/// after which a light coordinate of an iteration that contracts is at round-off too.
template <class T>
class BuriedWatch {
public:
    bool hasSettled(const CorrectionSize<T>& correction) {
        constexpr int patience = 5, whileNegligible = 3;
        const T& buried = correction.buried;
        if (!(buried > T(0))) {  // nothing is buried: what comes later is measured afresh
            *this = BuriedWatch();
            return true;
        }
        const bool hasHalved = 2 * buried < least_;
        sinceHalved_ = hasHalved ? 0 : sinceHalved_ + 1;
        if (hasHalved) least_ = buried;
        if (correction.areNegligible) ++negligible_;
        return sinceHalved_ >= patience || negligible_ >= whileNegligible;
    }

private:
    T least_ = std::numeric_limits<T>::infinity();
    int sinceHalved_ = 0, negligible_ = 0;
};

}  // namespace extremal
