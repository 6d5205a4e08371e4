// SPDX-License-Identifier: GPL-3.0-or-later
/// The four-bar of presets/four-bar.json by hand: a crank of length 1 about the origin, a coupler of length 2
/// and a rocker of length 1.8 about (2.5, 0), masses 1 and 2 at its joints, a motor of torque 12 on the
/// crank, a damper of 1.5 on the second joint.
#pragma once

#include <array>
#include <cmath>

#include "engine/core/algebra/lanes_trigonometry.hpp"

namespace extremal::bench {

struct FourBar {
    static constexpr double m1 = 1, m2 = 2, g = 9.81, coupler = 2, rocker = 1.8, base = 2.5, torque = 12,
                            damping = 1.5;
    /// x1, y1, x2, y2 and their rates.
    using State = std::array<double, 8>;

    /// The forces of the motor, the damper and the weights.
    static std::array<double, 4> forces(const double* z) {
        return {-torque * z[1], torque * z[0] - m1 * g, -damping * z[6], -damping * z[7] - m2 * g};
    }
    /// Half the derivatives of the rods are (r), (-d, d) and (e), with r and e the places of the joints from
    /// the pivots and d from joint to joint.
    struct Rods {
        double rx, ry, dx, dy, ex, ey;
        explicit Rods(const double* z)
            : rx(z[0]), ry(z[1]), dx(z[2] - z[0]), dy(z[3] - z[1]), ex(z[2] - base), ey(z[3]) {}
    };

    /// The multipliers of these, from a system with three diagonals, such that the rods' second rates vanish.
    static std::array<double, 3> multipliers(const double* z) {
        const Rods at(z);
        const auto f = forces(z);
        const double wx = z[6] - z[4], wy = z[7] - z[5];
        const double ax = f[0] / m1, ay = f[1] / m1, bx = f[2] / m2, by = f[3] / m2;
        const double r1 = -(z[4] * z[4] + z[5] * z[5]) - at.rx * ax - at.ry * ay,
                     r2 = -(wx * wx + wy * wy) - at.dx * (bx - ax) - at.dy * (by - ay),
                     r3 = -(z[6] * z[6] + z[7] * z[7]) - at.ex * bx - at.ey * by;
        const double a11 = (at.rx * at.rx + at.ry * at.ry) / m1, a12 = -(at.rx * at.dx + at.ry * at.dy) / m1,
                     a22 = (at.dx * at.dx + at.dy * at.dy) * (1 / m1 + 1 / m2),
                     a23 = (at.dx * at.ex + at.dy * at.ey) / m2, a33 = (at.ex * at.ex + at.ey * at.ey) / m2;
        const double q1 = a12 / a11, q3 = a23 / a33,
                     l2 = (r2 - q1 * r1 - q3 * r3) / (a22 - q1 * a12 - q3 * a23);
        return {(r1 - a12 * l2) / a11, l2, (r3 - a23 * l2) / a33};
    }
    /// The accelerations of index 1.
    static void accelerate(const double* z, double* a) {
        const Rods at(z);
        const auto f = forces(z);
        const auto l = multipliers(z);
        a[0] = (f[0] + l[0] * at.rx - l[1] * at.dx) / m1;
        a[1] = (f[1] + l[0] * at.ry - l[1] * at.dy) / m1;
        a[2] = (f[2] + l[1] * at.dx + l[2] * at.ex) / m2;
        a[3] = (f[3] + l[1] * at.dy + l[2] * at.ey) / m2;
    }

    /// Where the joints are at an angle of the crank: the loop is closed by two circles. Of numbers and of
    /// lanes.
    template <class T>
    static std::array<T, 4> places(const T& angle) {
        using std::cos;
        using std::sin;
        using std::sqrt;
        const T x = cos(angle), y = sin(angle), dx = T(base) - x, dy = -y, square = dx * dx + dy * dy,
                along = (T(coupler * coupler - rocker * rocker) + square) / (T(2.0) * square),
                across = sqrt(T(coupler * coupler) / square - along * along);
        return {x, y, x + along * dx - across * dy, y + along * dy + across * dx};
    }
    /// With u and w the first and second derivative of the second joint by the angle, the mass is m1 + m2
    /// u.u, half its derivative m2 u.w, and the potential of the weights has the derivative m1 g x + m2 g
    /// u_y.
    template <class T>
    struct AtAngle {
        T mass, halfOfMassByAngle, x, uy, uu;
        explicit AtAngle(const T& angle) {
            const auto p = places(angle);
            x = p[0];
            const T y = p[1], dx = p[2] - x, dy = p[3] - y, ex = p[2] - T(base), ey = p[3];
            const T inverse = T(1.0) / (ex * dy - ey * dx), turn = (dy * x - dx * y) * inverse,
                    ux = -turn * ey;
            uy = turn * ex;
            uu = ux * ux + uy * uy;
            // e.w = -u.u and d.w = -d.r - |u - r'|^2.
            const T vx = ux + y, vy = uy - x, alongE = -uu, alongD = -(dx * x + dy * y) - (vx * vx + vy * vy);
            const T wx = (alongE * dy - alongD * ey) * inverse, wy = (alongD * ex - alongE * dx) * inverse;
            mass = T(m1) + T(m2) * uu;
            halfOfMassByAngle = T(m2) * (ux * wx + uy * wy);
        }
    };
    /// The acceleration of the angle.
    static void accelerateAngle(const double* z, double* a) {
        const AtAngle<double> at(z[0]);
        a[0] = (torque - m1 * g * at.x - m2 * g * at.uy - damping * at.uu * z[1] -
                at.halfOfMassByAngle * z[1] * z[1]) /
               at.mass;
    }
    /// The rates of the angle and of its momentum.
    template <class T>
    static void ratesOfAngle(const T* z, T* dz) {
        const AtAngle<T> at(z[0]);
        dz[0] = z[1] / at.mass;
        dz[1] = T(torque) - T(m1 * g) * at.x - T(m2 * g) * at.uy - T(damping) * at.uu * dz[0] +
                at.halfOfMassByAngle * dz[0] * dz[0];
    }
};

}  // namespace extremal::bench
