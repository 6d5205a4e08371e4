// SPDX-License-Identifier: GPL-3.0-or-later
/// Kepler's equation for the change E of the eccentric anomaly,
///     E - c sin E + s (1 - cos E) = n t,    c = 1 - r_0/a,  s = x_0 . v_0 / sqrt(mu a),  n = sqrt(mu / a^3),
/// by the iteration of order four of Danby (Fundamentals of Celestial Mechanics (1988), sec. 6.6) from E = n
/// t, all lanes until the last one is there. What is added to x and v is formed without cancellation, from
/// sines and cosines of E/2: what rounds the same way in every step would make an ellipse grow.
#include "engine/family/free_motion/kepler_arc_kernel.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes_trigonometry.hpp"
#include "engine/core/algebra/registers.hpp"

namespace extremal {
namespace {

// Vectors by name: of loops over eight numbers the compiler makes scalars here.
using registers::Eight;
using EightBits [[gnu::vector_size(64)]] = std::uint64_t;

/// Whether all are between the limits; false of what is not a number.
bool areWithin(const Eight& a, double least, double most) {
    int outside = 0;
    for (std::size_t i = 0; i < 8; ++i) outside += a[i] > least && a[i] < most ? 0 : 1;
    return outside == 0;
}
Eight rootOf(const Eight& a) {
    Eight r{};
    for (std::size_t i = 0; i < 8; ++i) r[i] = __builtin_sqrt(a[i]);
    return r;
}

struct Ellipses {
    Eight cosine, sine, mean;
};

/// sin and cos of E/2, both with the same sign, which does not matter; sin E and 1 - cos E.
struct HalfAngle {
    Eight s, c;
    Eight sine() const { return 2 * s * c; }
    Eight versine() const { return 2 * s * s; }
};
HalfAngle halfOf(const Eight& E) {
    const auto a = detail::reduceAngle<EightBits, Eight>(0.5 * E);
    const Eight s = detail::sinNearZero(a.y, a.dy), c = detail::cosNearZero(a.y, a.dy);
    return {detail::inQuadrant(a.quadrant, s, c), detail::inQuadrant(a.quadrant + 1, s, c)};
}

/// False where a lane does not converge.
bool solve(const Ellipses& e, HalfAngle& half) {
    if (!areWithin(e.mean, -detail::largestReduced, detail::largestReduced)) return false;
    Eight E = e.mean;
    half = halfOf(E);
    for (int i = 0; i < 8; ++i) {
        const Eight s = half.sine(), v = half.versine(), c = 1 - v, second = e.cosine * s + e.sine * c,
                    third = e.cosine * c - e.sine * s, slope = 1 - third,
                    f = (E - e.mean) - e.cosine * s + e.sine * v;
        const Eight first = f / slope, better = f / (slope - first * (0.5 * second)),
                    d = f / (slope - better * (0.5 * second - better * third * (1.0 / 6)));
        E -= d;
        if (areWithin(d, -3e-5, 3e-5)) {
            // Turned by -d/2, with the next terms below round-off; what is left of the equation is d^4.
            const Eight y = -0.5 * d, yy = y * y, sine = y - y * yy * (1.0 / 6),
                        versine = yy * (0.5 - yy * (1.0 / 24));
            half = {half.s + (half.c * sine - half.s * versine), half.c - (half.s * sine + half.c * versine)};
            return true;
        }
        if (!areWithin(d, -10, 10)) return false;
        half = halfOf(E);
    }
    return false;
}

Eight load(const double* from) {
    Eight v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
void store(const Eight& v, double* to) { std::memcpy(to, &v, sizeof v); }

void moveEight(const EightBodies* bodies, double time, bool* isDone) {
    const Eight x = load(bodies->x[0]), y = load(bodies->x[1]), z = load(bodies->x[2]),
                vx = load(bodies->v[0]), vy = load(bodies->v[1]), vz = load(bodies->v[2]),
                mu = load(bodies->mu);
    const Eight radius = rootOf(x * x + y * y + z * z),
                beta = 2 * mu / radius - (vx * vx + vy * vy + vz * vz);
    *isDone = areWithin(beta, 0, __builtin_inf());
    if (!*isDone) return;
    const Eight root = rootOf(beta), a = mu / beta, ratio = radius * beta / mu, rate = beta * root / mu;
    const Ellipses e{1 - ratio, (x * vx + y * vy + z * vz) * root / mu, rate * time};
    HalfAngle half;
    *isDone = solve(e, half);
    if (!*isDone) return;
    const Eight s = half.sine(), v = half.versine(), now = a * (ratio + e.cosine * v + e.sine * s),
                f = -(v / ratio), g = (ratio * s + e.sine * v) / rate, df = -(mu / root) * s / (radius * now),
                dg = -(a * v / now);
    store(x + (f * x + g * vx), bodies->x[0]);
    store(y + (f * y + g * vy), bodies->x[1]);
    store(z + (f * z + g * vz), bodies->x[2]);
    store(vx + (df * x + dg * vx), bodies->v[0]);
    store(vy + (df * y + dg * vy), bodies->v[1]);
    store(vz + (df * z + dg * vz), bodies->v[2]);
}

}  // namespace

bool moveOnEllipses(const EightBodies& bodies, double time) {
    static const auto move = ForThisMachine<&moveEight>::call();
    bool isDone = false;
    move(&bodies, time, &isDone);
    return isDone;
}

}  // namespace extremal
