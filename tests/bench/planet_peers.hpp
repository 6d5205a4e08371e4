// SPDX-License-Identifier: GPL-3.0-or-later
/// The outer solar system by hand: accelerations, recurrences of Taylor coefficients, and the splittings that
/// are made for planets, of Kepler motions about the Sun and kicks by the other planets (Wisdom and Holman
/// 1991; democratic heliocentric coordinates, Duncan, Levison and Lee 1998; kicks at the nodes of Gauss,
/// Laskar and Robutel 2001; Blanes et al. 2013).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/tableau/splitting_table.hpp"
#include "tests/bench/taylor.hpp"

namespace extremal::bench {

class Planets {
public:
    static constexpr std::size_t bodies = 6, d = 3 * bodies;
    using Places = std::array<double, d>;

    Planets(double G, const Places& masses) : G_(G) {
        for (std::size_t i = 0; i < bodies; ++i) mass_[i] = masses[3 * i];
    }

    void accelerate(const double* x, double* a) const {
        for (std::size_t k = 0; k < d; ++k) a[k] = 0;
        for (std::size_t i = 0; i < bodies; ++i)
            for (std::size_t j = 0; j < i; ++j) attract(x, i, j, 1, a);
    }

    /// The coefficients n of all accelerations.
    std::array<double, d> coefficients(const std::array<Taylor, d>& x, std::size_t n) {
        std::array<double, d> a{};
        for (std::size_t i = 0, pair = 0; i < bodies; ++i)
            for (std::size_t j = 0; j < i; ++j, ++pair) {
                Pair& p = pairs_[pair];
                double square = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    p.along[k][n] = x[3 * i + k][n] - x[3 * j + k][n];
                    square += product(p.along[k], p.along[k], n);
                }
                p.square[n] = square;
                p.cube[n] = n == 0 ? std::pow(square, -1.5) : power(p.square, p.cube, -1.5, n);
                for (std::size_t k = 0; k < 3; ++k) {
                    const double pull = G_ * product(p.along[k], p.cube, n);
                    a[3 * i + k] -= mass_[j] * pull;
                    a[3 * j + k] += mass_[i] * pull;
                }
            }
        return a;
    }

    /// n steps of Kepler motions between kicks, by a splitting that begins with a motion.
    std::array<double, 2 * d> byKeplerArcs(const std::array<double, 2 * d>& start, double end, double n,
                                           const Splitting& splitting) const {
        double all = 0;
        std::array<double, 3> centre{}, drift{};
        for (std::size_t i = 0; i < bodies; ++i) {
            all += mass_[i];
            for (std::size_t k = 0; k < 3; ++k) {
                centre[k] += mass_[i] * start[3 * i + k];
                drift[k] += mass_[i] * start[d + 3 * i + k];
            }
        }
        // Places from the Sun, velocities from the centre of mass.
        std::array<double, d> q{}, v{};
        for (std::size_t i = 1; i < bodies; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                q[3 * i + k] = start[3 * i + k] - start[k];
                v[3 * i + k] = start[d + 3 * i + k] - drift[k] / all;
            }
        const double h = end / n;
        std::vector<double> arcs, kicks;
        for (const SplittingStage& stage : splitting.stages)
            (stage.isKick ? kicks : arcs).push_back(stage.fraction * h);
        arcs.pop_back();  // it is one with the first of the next step
        for (double step = 0; step < n; ++step) {
            for (std::size_t s = 0; s < arcs.size(); ++s) {
                const bool isFirst = s == 0 && step > 0;  // with the last arc of the step before
                arc(q, v, isFirst ? 2 * arcs[0] : arcs[s]);
                const double kick = kicks[s];
                jump(q, v, kick / 2);
                for (std::size_t i = 1; i < bodies; ++i)
                    for (std::size_t j = 1; j < i; ++j) attract(q.data(), i, j, kick, v.data());
                jump(q, v, kick / 2);
            }
        }
        arc(q, v, arcs[0]);
        std::array<double, 2 * d> x{};
        std::array<double, 3> sun{}, ofSun{};
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t i = 1; i < bodies; ++i) {
                sun[k] += mass_[i] * q[3 * i + k];
                ofSun[k] -= mass_[i] * v[3 * i + k] / mass_[0];
            }
            sun[k] = (centre[k] + end * drift[k] - sun[k]) / all;
            for (std::size_t i = 0; i < bodies; ++i) {
                x[3 * i + k] = sun[k] + q[3 * i + k];
                x[d + 3 * i + k] = drift[k] / all + (i == 0 ? ofSun[k] : v[3 * i + k]);
            }
        }
        return x;
    }

private:
    void attract(const double* x, std::size_t i, std::size_t j, double time, double* v) const {
        double r[3], square = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            r[k] = x[3 * i + k] - x[3 * j + k];
            square += r[k] * r[k];
        }
        const double w = time * G_ / (square * std::sqrt(square));
        for (std::size_t k = 0; k < 3; ++k) {
            v[3 * i + k] -= mass_[j] * w * r[k];
            v[3 * j + k] += mass_[i] * w * r[k];
        }
    }
    /// The Sun moves against all planets.
    void jump(std::array<double, d>& q, const std::array<double, d>& v, double time) const {
        for (std::size_t k = 0; k < 3; ++k) {
            double sum = 0;
            for (std::size_t i = 1; i < bodies; ++i) sum += mass_[i] * v[3 * i + k];
            for (std::size_t i = 1; i < bodies; ++i) q[3 * i + k] += time * sum / mass_[0];
        }
    }
    /// Every planet on its ellipse: Kepler's equation for the change of the eccentric anomaly, f and g.
    void arc(std::array<double, d>& q, std::array<double, d>& v, double time) const {
        const double mu = G_ * mass_[0];
        for (std::size_t i = 1; i < bodies; ++i) {
            double *const x = &q[3 * i], *const u = &v[3 * i];
            const double r = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]),
                         along = x[0] * u[0] + x[1] * u[1] + x[2] * u[2],
                         a = 1 / (2 / r - (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]) / mu),
                         root = std::sqrt(mu * a), rate = root / (a * a), eCos = 1 - r / a,
                         eSin = along / root, M = rate * time;
            double E = M - eSin * (1 - std::cos(M)) + eCos * std::sin(M), s = 0, c = 1;
            for (int iteration = 0; iteration < 20; ++iteration) {
                s = std::sin(E);
                c = std::cos(E);
                const double f = E - eCos * s + eSin * (1 - c) - M, slope = 1 - eCos * c + eSin * s;
                const double change = f / slope;
                E -= change;
                if (std::abs(change) < 1e-8) {  // the next one would be its square
                    s = std::sin(E);
                    c = std::cos(E);
                    break;
                }
            }
            const double now = a * (1 - eCos * c + eSin * s), f = 1 - a / r * (1 - c),
                         g = time - (E - s) / rate, df = -root / (r * now) * s, dg = 1 - a / now * (1 - c);
            for (int k = 0; k < 3; ++k) {
                const double place = f * x[k] + g * u[k];
                u[k] = df * x[k] + dg * u[k];
                x[k] = place;
            }
        }
    }

    struct Pair {
        std::array<Taylor, 3> along;
        Taylor square, cube;
    };
    double G_;
    std::array<double, bodies> mass_{};
    std::array<Pair, bodies*(bodies - 1) / 2> pairs_{};
};

}  // namespace extremal::bench
