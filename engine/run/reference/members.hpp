// SPDX-License-Identifier: GPL-3.0-or-later
/// References that can be trusted: a computed reference beside methods of other kinds, on steps of their own.
///
///     A   collocation of fixed steps (the computed reference)
///     B   the explicit pair rk8pd, else fehlberg78, at a tolerance of 1e-13; where A and B part by more than
///         round-off explains, at 1e-15 in its place, so that its own error is not taken for that of A
///     C   the extrapolation code bulirsch-stoer at 1e-13, where A and B part or one of them failed
///
/// Two step sizes of one method are no pair: they may err to the same side. The nearest pair of different
/// kinds decides, and the reference is its member with the smaller error of the energy, A unless the other's
/// is much smaller. With d(t) the largest distance of the pair up to t,
///
///     bound(t) = 3 d(t),   agreed = d at the end,   horizon: where 3 d passes a thousandth of the motion.
///
/// B and C begin a step anew at the ends of the pulses that the formula of the forces has (force_pulses.hpp),
/// since no error control finds what none of its stages falls on.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/run/reference/confirmation.hpp"
#include "engine/run/reference/reference.hpp"

namespace extremal {

/// States of the two members that decide, at the same times.
struct ReferencePair {
    std::string chosen, by;  ///< their names
    std::size_t width = 0;
    std::vector<double> times, first, second;  ///< first: of the one that was chosen

    std::span<const double> firstAt(std::size_t i) const {
        return std::span(first).subspan(i * width, width);
    }
    std::span<const double> secondAt(std::size_t i) const {
        return std::span(second).subspan(i * width, width);
    }
};

/// In any number that the columns of the error give.
Confirmation confirmation(const ReferencePair& pair, const ResolvedScene& scene, const DistanceOf& distance);

/// Of a system with coordinates: confirms a computed reference, or takes a better one in its place; one that
/// is a scheme of the user's is confirmed and stays. Fills confirmedBy, agreed, bound, horizon and the
/// caution of its info; where the bound is above a millionth of the motion the estimated error as well.
void confirmReference(Reference& reference, const ResolvedScene& scene, const std::stop_token& stop);

}  // namespace extremal
