// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies about a heavy one in Jacobi coordinates: each is seen from the centre of mass of those before it,
///     r_i = q_i - R_{i-1},   R_i = R_{i-1} + m_i/M_i r_i,   M_i = m_0 + .. + m_i,   m'_i = m_i M_{i-1}/M_i,
/// so that the kinetic energy stays a sum of squares, and with the whole potential V
///     L = 1/2 M |R'|^2 + sum_i (1/2 m'_i |r_i'|^2 + K_i / |r_i|) - U,    U = V + sum_i K_i / |r_i|:
/// Kepler motions and a small potential of the places alone (Wisdom and Holman 1991, Astron. J. 102, 1528).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "engine/core/algebra/lanes.hpp"
#include "engine/family/free_motion/kepler_arc.hpp"
#include "engine/family/free_motion/kepler_arc_kernel.hpp"
#include "engine/model/parts/held_bodies.hpp"

namespace extremal {

/// T: double, or a number with a derivative.
template <class T>
class JacobiMotion {
public:
    using Columns =
        std::array<std::vector<T>, 3>;  ///< of all bodies but the centre: component after component

    explicit JacobiMotion(const HeldBodies& all) : bodies_(all.bodies), size_(all.bodies.size() - 1) {
        for (Columns* each : {&x_, &v_})
            for (std::vector<T>& column : *each) column.assign(padded(), T(0));
        double mass = bodies_[0].mass;
        for (std::size_t i = 0; i < size_; ++i) {
            const double own = bodies_[i + 1].mass, inner = mass;
            mass += own;
            share_.push_back(std::isinf(mass) ? 0 : own / mass);
            mu_.push_back(bodies_[i + 1].strength * (std::isinf(mass) ? 1 / own : mass / (own * inner)));
        }
        mu_.resize(padded(), mu_.back());
    }

    std::size_t size() const { return size_; }
    Columns none() const { return {std::vector<T>(size_), std::vector<T>(size_), std::vector<T>(size_)}; }
    Columns& places() { return x_; }
    Columns& velocities() { return v_; }
    const Columns& places() const { return x_; }
    const Columns& velocities() const { return v_; }

    /// Takes the places and momenta of all bodies.
    void read(const T* q, const T* p) {
        centre_ = seenFromInside(q, false, x_);
        drift_ = seenFromInside(p, true, v_);
        // The lanes behind the last body move like it.
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = size_; i < padded(); ++i) {
                x_[k][i] = x_[k][size_ - 1];
                v_[k][i] = v_[k][size_ - 1];
            }
    }
    void writePlaces(T* q) const { ofBodies(x_, centre_, false, q); }
    void writeMomenta(T* p) const { ofBodies(v_, drift_, true, p); }

    /// Kepler motions of all over a time, and of the centre of mass on its straight line.
    void move(double time) {
        for (std::size_t k = 0; k < 3; ++k) centre_[k] += drift_[k] * T(time);
        for (std::size_t first = 0; first < size_; first += 8) {
            if constexpr (std::is_same_v<T, double>) {
                const EightBodies eight{{&x_[0][first], &x_[1][first], &x_[2][first]},
                                        {&v_[0][first], &v_[1][first], &v_[2][first]},
                                        &mu_[first]};
                if (moveOnEllipses(eight, time)) continue;
            }
            for (std::size_t i = first; i < std::min(first + 8, size_); ++i) {
                std::array<T, 3> x{x_[0][i], x_[1][i], x_[2][i]}, v{v_[0][i], v_[1][i], v_[2][i]};
                KeplerArc::move(x, v, mu_[i], time);
                for (std::size_t k = 0; k < 3; ++k) {
                    x_[k][i] = x[k];
                    v_[k][i] = v[k];
                }
            }
        }
    }

    /// -(dU/dr_i) / m'_i and how the centre of mass is accelerated, from the force -dV/dq on all bodies at
    /// the present places.
    std::array<T, 3> accelerations(const T* force, Columns& a) const {
        const std::array<T, 3> ofCentre = seenFromInside(force, true, a);
        for (std::size_t i = 0; i < size_; ++i) {
            const T w = pull(i);
            for (std::size_t k = 0; k < 3; ++k) a[k][i] += w * x_[k][i];
        }
        return ofCentre;
    }
    void kick(const Columns& accelerations, const std::array<T, 3>& ofCentre, double time) {
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t i = 0; i < size_; ++i) v_[k][i] += accelerations[k][i] * T(time);
            drift_[k] += ofCentre[k] * T(time);
        }
    }
    /// The accelerations of the Kepler motions by themselves.
    T fall(std::size_t k, std::size_t i) const { return -(pull(i) * x_[k][i]); }

private:
    std::size_t padded() const { return inWholeLanes(size_); }
    /// mu / |r_i|^3.
    T pull(std::size_t i) const {
        using std::sqrt;
        const T square = x_[0][i] * x_[0][i] + x_[1][i] * x_[1][i] + x_[2][i] * x_[2][i];
        return T(mu_[i]) / (square * sqrt(square));
    }

    /// Jacobi coordinates of places, or of momenta and forces over their masses; returns those of the centre
    /// of mass. Divides: momenta that are multiplied by a rounded inverse once a step grow with the steps.
    std::array<T, 3> seenFromInside(const T* of, bool isPerMass, Columns& to) const {
        std::array<T, 3> inside{};
        const auto valueOf = [&](const HeldBodies::OneBody& body, std::size_t k) {
            const int at = body.place[k];
            if (at < 0) return T(0);
            return isPerMass ? of[at] / T(body.mass) : of[at];
        };
        for (std::size_t k = 0; k < 3; ++k) {
            inside[k] = valueOf(bodies_[0], k);
            for (std::size_t i = 0; i < size_; ++i) {
                to[k][i] = valueOf(bodies_[i + 1], k) - inside[k];
                inside[k] += to[k][i] * T(share_[i]);
            }
        }
        return inside;
    }
    void ofBodies(const Columns& from, const std::array<T, 3>& centre, bool isTimesMass, T* to) const {
        for (std::size_t k = 0; k < 3; ++k) {
            T inside = centre[k];
            const auto put = [&](const HeldBodies::OneBody& body, const T& value) {
                const int at = body.place[k];
                if (at >= 0) to[at] = isTimesMass ? value * T(body.mass) : value;
            };
            for (std::size_t i = size_; i-- > 0;) {
                inside -= from[k][i] * T(share_[i]);
                put(bodies_[i + 1], inside + from[k][i]);
            }
            put(bodies_[0], inside);
        }
    }

    std::vector<HeldBodies::OneBody> bodies_;
    std::size_t size_;
    std::vector<double> share_;  ///< m_i / M_i
    std::vector<double> mu_;     ///< of the Kepler motions, K_i / m'_i
    Columns x_, v_;
    std::array<T, 3> centre_{}, drift_{};  ///< the centre of mass and its velocity
};

}  // namespace extremal
