// SPDX-License-Identifier: GPL-3.0-or-later
/// How much of the force along the curve of a step its rule has missed: whether a root of the step's
/// equations is the motion.
///
/// The equations of a step see forces at the nodes alone. They may have roots that have nothing to do with
/// the motion: a curve that jumps over a singularity between two nodes, and sees no force there, is a root to
/// round-off. For the curve q_d of a root
///
///     D = | I - I_h | / ( max(|p_0|, |p_1|) + A ),       I = int_0^h L_q dt,   A = int_0^h |L_q| dt,
///
/// the integrals by Simpson's rule at equal times, both ends included; I_h and A_h are what the rule of the
/// step takes them for. Forces are missed where D > 1/2, so that more than half of what acts on the system is
/// not in the step, and A and A_h differ by more than a factor of 10, so that this is a force between the
/// nodes and not the error of a rule of low order. Both are far away where a step follows its forces; and as
/// D = 0 for linear forces (with rules of order 2 at least), however long the step, schemes may jump over
/// fast linear motion as they are made to.
///
/// That forces are missed makes a step inaccurate. That the root is another one than the motion takes more:
/// forces that depend on the place. The curve that the missed impulse would make of q_d is displaced by
///
///     Delta = h/2 [ v(q_0, p_0 + I - I_h) - v(q_0, p_0) ]
///
/// on average, if it acts at the start. If F(q_d + Delta) is F(q_d) + F' Delta all along, the equations of
/// the step are linear from here to there and have one root, which is at hand; it errs by what its rule
/// leaves out, as every scheme does. So a root does not belong to the motion only if, besides,
///
///     N = 1/2 int_0^h | L_q(q_d + Delta) + L_q(q_d - Delta) - 2 L_q(q_d) | dt > A/2:
///
/// the second difference is 0 for linear forces and for those that depend on time alone, whatever their
/// jumps, pulses and zeros at a start from rest, where there is neither a momentum nor an impulse to compare
/// with. Beside a singularity N = A: displaced by what it does there, the curve would not meet it. (Kepler's
/// problem with e = 0.9999 at the perihelion, four Gauss nodes, h = 0.05: the straight line is a root, D =
/// 0.99, and N = A as Delta is 4000. From rest under x sign(sin 3t) - x^2/2 at x = 1: D = 1 and N = 0, as the
/// force is -1 at t = 0 and nearly 0 just after.)
///
/// Norms are those of the largest coordinate. Internal to integrator/.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/model/mechanics.hpp"

namespace extremal {

template <class T>
class ForceDefect {
public:
    using Flat = Eigen::Matrix<T, Eigen::Dynamic, 1>;

    /// Tables without oscillatory functions, one for all coordinates or one for each.
    /// `parts`: as in GalerkinStep.
    ForceDefect(const Mechanics<T>& mechanics, const std::vector<Table<T>>& tables,
                const std::vector<LagrangianTerm<T>>& parts = {})
        : mechanics_(mechanics), parts_(parts), part_(tables.front().part) {
        const Table<T>& first = tables.front();
        const int panels = 2 * (first.nodes() + 1), d = mechanics_.dimension;
        for (int i = 0; i < first.nodes(); ++i) nodes_.push_back({first.node(i), first.weight(i)});
        for (int j = 0; j <= panels; ++j)
            times_.push_back({T(j) / T(panels), (j == 0 || j == panels ? T(1)
                                                 : j % 2 == 1          ? T(4)
                                                                       : T(2)) /
                                                    T(3 * panels)});
        std::vector<T> value, slope;
        for (const Table<T>& table : tables) {
            Curve seen{table.value, table.derivative};
            Curve along{Square(panels + 1, table.unknowns()), Square(panels + 1, table.unknowns())};
            value.resize(static_cast<std::size_t>(table.space.size));
            slope.resize(value.size());
            for (int j = 0; j <= panels; ++j) {
                table.space.evaluate(times_[static_cast<std::size_t>(j)].tau, value, slope);
                const Eigen::Map<const Flat> phi(value.data(), table.space.size),
                    dphi(slope.data(), table.space.size);
                along.value.row(j) = phi.transpose() * table.change;
                along.slope.row(j) = dphi.transpose() * table.change;
            }
            seen_.push_back(std::move(seen));
            along_.push_back(std::move(along));
        }
        q_ = v_ = impulse_ = missed_ = place_ = shift_ = second_ = Flat::Zero(d);
        gradient_ = Flat::Zero(2 * d);
    }

    /// Whether the curve Y of a step from (t, q, p), coordinate by coordinate, follows the forces.
    bool isFollowing(const T& t, const T& h, const T* q, const T* p, const T* Y) {
        using std::abs;
        constexpr double most = 0.5, apart = 10;
        const T A = integrate(along_, times_, t, h, q, Y);
        if (!(A <= std::numeric_limits<T>::max())) return false;
        missed_ = impulse_;
        const T seen = integrate(seen_, nodes_, t, h, q, Y);
        missed_ -= impulse_;
        if (!(A > T(apart) * seen) && !(seen > T(apart) * A)) return true;
        T momentum(0);
        for (int k = 0; k < mechanics_.dimension; ++k)
            momentum = std::max({momentum, T(abs(p[k])), T(abs(p[k] + impulse_(k)))});
        if (missed_.template lpNorm<Eigen::Infinity>() <= T(most) * (momentum + A)) return true;
        return displace(t, h, q, p) && secondDifference(t, h, q, Y) <= T(2) * T(most) * A;
    }

private:
    using Square = typename Table<T>::Matrix;
    struct Curve {
        Square value, slope;  ///< (j, a): the functions of a table at some times, slopes by tau
    };
    struct Weight {
        T tau, weight;
    };

    /// Into shift_: Delta. False where no velocity is found.
    bool displace(const T& t, const T& h, const T* q, const T* p) {
        const int d = mechanics_.dimension;
        const auto velocity = [&](Flat& v) {
            return mechanics_.velocity(mechanics_.model.get(), t, q, place_.data(), v.data());
        };
        place_ = Eigen::Map<const Flat>(p, d);
        if (!velocity(v_)) return false;
        place_ += missed_;
        if (!velocity(shift_)) return false;
        shift_ = h * (shift_ - v_) / T(2);
        return true;
    }

    /// int |L_q(q_d + Delta) + L_q(q_d - Delta) - 2 L_q(q_d)| dt.
    T secondDifference(const T& t, const T& h, const T* q, const T* Y) {
        using std::abs;
        T all(0);
        for (std::size_t j = 0; j < times_.size(); ++j) {
            follow(along_, j, h, q, Y);
            place_ = q_;
            second_.setZero();
            for (const int side : {0, 1, -1}) {
                q_ = place_ + T(side) * shift_;
                mechanics_.gradient(mechanics_.model.get(), t + h * times_[j].tau, q_.data(), v_.data(),
                                    gradient_.data());
                second_ += T(side == 0 ? -2 : 1) * gradient_.head(mechanics_.dimension);
            }
            all += abs(h * times_[j].weight) * second_.template lpNorm<Eigen::Infinity>();
        }
        return all;
    }

    /// Puts q_ and v_ on the curve Y at time j of `curves`.
    void follow(const std::vector<Curve>& curves, std::size_t j, const T& h, const T* q, const T* Y) {
        for (int k = 0; k < mechanics_.dimension; ++k) {
            const Curve& curve = curves[curves.size() == 1 ? 0 : static_cast<std::size_t>(k)];
            const Eigen::Map<const Flat> y(Y, curve.value.cols());
            const auto row = static_cast<Eigen::Index>(j);
            q_(k) = q[k] + curve.value.row(row).dot(y);
            v_(k) = curve.slope.row(row).dot(y) / h;
            Y += y.size();
        }
    }

    /// Into impulse_; returns the integral of its size.
    T integrate(const std::vector<Curve>& curves, const std::vector<Weight>& times, const T& t, const T& h,
                const T* q, const T* Y) {
        using std::abs;
        const int d = mechanics_.dimension;
        impulse_.setZero();
        T all(0);
        for (std::size_t j = 0; j < times.size(); ++j) {
            follow(curves, j, h, q, Y);
            const LagrangianTerm<T>* const part =
                parts_.empty() || &curves != &seen_ ? nullptr : &parts_[static_cast<std::size_t>(part_[j])];
            (part ? part->gradient : mechanics_.gradient)((part ? part->model : mechanics_.model).get(),
                                                          t + h * times[j].tau, q_.data(), v_.data(),
                                                          gradient_.data());
            const auto force = gradient_.head(d);
            impulse_ += h * times[j].weight * force;
            all += abs(h * times[j].weight) * force.template lpNorm<Eigen::Infinity>();
        }
        return all;
    }

    Mechanics<T> mechanics_;
    std::vector<LagrangianTerm<T>> parts_;
    std::vector<int> part_;
    std::vector<Weight> nodes_, times_;
    std::vector<Curve> seen_, along_;
    Flat q_, v_, impulse_, missed_, gradient_;
    Flat place_, shift_, second_;
};

}  // namespace extremal
