// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/step/wave_kick.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes_trigonometry.hpp"
#include "engine/core/algebra/registers.hpp"

namespace extremal {
namespace {

using registers::lanesOf;

/// Real and imaginary parts of as many places, which take turns in memory.
template <class Pack>
[[gnu::always_inline]] inline void readParts(const double* from, Pack& re, Pack& im) {
    constexpr int n = lanesOf<Pack>;
    Pack low, high;
    registers::load(low, from);
    registers::load(high, from + n);
    registers::Mask<Pack> real;
    for (int k = 0; k < n; ++k) real[k] = 2 * k;
    re = __builtin_shuffle(low, high, real);
    im = __builtin_shuffle(low, high, real + 1);
}
template <class Pack>
[[gnu::always_inline]] inline void writeParts(const Pack& re, const Pack& im, double* to) {
    constexpr int n = lanesOf<Pack>;
    registers::Mask<Pack> first;
    for (int k = 0; k < n; ++k) first[k] = k / 2 + k % 2 * n;
    registers::store(to, __builtin_shuffle(re, im, first));
    registers::store(to + n, __builtin_shuffle(re, im, first + n / 2));
}

template <class Pack>
[[gnu::always_inline]] inline bool areAllWithin(const Pack& angle, double bound) {
    const registers::Mask<Pack> within = (angle <= bound) & (angle >= -bound);
    long long all = -1;
    for (int k = 0; k < lanesOf<Pack>; ++k) all &= within[k];
    return all != 0;
}

/// Both of every angle by the polynomials of lanes_trigonometry.hpp, reduced once, and not at all where the
/// reduction would change nothing. What one lane gets does not depend on the others, so that packs of all
/// widths give the same bits.
template <class Pack>
[[gnu::always_inline]] inline void sineAndCosine(const Pack& angle, Pack& s, Pack& c) {
    using Bits [[gnu::vector_size(sizeof(Pack))]] = std::uint64_t;
    if (areAllWithin(angle, detail::largestUnreduced)) {
        const Pack none{};
        s = detail::sinNearZero(angle, none);
        c = detail::cosNearZero(angle, none);
    } else if (areAllWithin(angle, detail::largestReduced)) {
        const auto a = detail::reduceAngle<Bits>(angle);
        const Pack sine = detail::sinNearZero(a.y, a.dy), cosine = detail::cosNearZero(a.y, a.dy);
        s = detail::inQuadrant(a.quadrant, sine, cosine);
        c = detail::inQuadrant(a.quadrant + 1, sine, cosine);
    } else {
        for (int k = 0; k < lanesOf<Pack>; ++k) {
            const double each = angle[k];
            const bool isReduced = std::abs(each) <= detail::largestReduced;
            s[k] = isReduced ? detail::sinTurned(each, 0) : std::sin(each);
            c[k] = isReduced ? detail::sinTurned(each, 1) : std::cos(each);
        }
    }
}

template <class Pack>
[[gnu::always_inline]] inline void kickPlaces(const double* V, double density, double factor, double scale,
                                              double* psi) {
    Pack x, y, potential, s, c;
    registers::load(potential, V);
    readParts(psi, x, y);
    const Pack angle = factor * (potential + density * (x * x + y * y));
    sineAndCosine(angle, s, c);
    s *= scale;
    c *= scale;
    writeParts<Pack>(x * c - y * s, x * s + y * c, psi);
}
template <class Pack>
void kickAll(const double* V, double density, double factor, double scale, std::size_t n, double* psi) {
    constexpr std::size_t all = lanesOf<Pack>;
    const std::size_t rest = n % all, whole = n - rest;
    for (std::size_t first = 0; first < whole; first += all)
        kickPlaces<Pack>(V + first, density, factor, scale, psi + 2 * first);
    if (rest == 0) return;
    std::array<double, all> lastV{};
    std::array<double, 2 * all> last{};
    std::copy_n(V + whole, rest, lastV.data());
    std::copy_n(psi + 2 * whole, 2 * rest, last.data());
    kickPlaces<Pack>(lastV.data(), density, factor, scale, last.data());
    std::copy_n(last.data(), 2 * rest, psi + 2 * whole);
}

}  // namespace

void kickByDensity(const double* V, double density, double factor, double scale, std::size_t n, double* psi) {
    static const auto call = ForThisMachine<&kickAll<registers::Eight>, &kickAll<registers::Four>,
                                            &kickAll<registers::Two>>::call();
    call(V, density, factor, scale, n, psi);
}

}  // namespace extremal
