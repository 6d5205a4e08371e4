// SPDX-License-Identifier: GPL-3.0-or-later
/// The step of a discretization with as many nodes as unknowns on any Lagrangian L(t, q, v), solved by
/// fixed-point iteration on the velocities at the nodes.
///
/// The velocities at the nodes are then free, and stationarity (galerkin_step.hpp) is a partitioned
/// Runge-Kutta method (tableau/tableau.hpp): with A = Phi D^-1, D the slopes and Phi the values of the
/// functions at the nodes, mu_ij = A_ij / b_j, and impulses w_j F_j, w_j = h b_j,
///     q(c_i) = q_0 + sum_j mu_ij w_j v_j,              q_1 = q_0 + sum_j w_j v_j,
///     p(c_i) = p_0 + sum_j (1 - mu_ji) w_j F_j,        p_1 = p_0 + sum_j w_j F_j,
/// with L_v(q, v) = p and F = L_q(q, v) at each node, provided that the rule integrates the slopes. It is
/// symplectic whatever mu: both matrices are multiples of one unit, so that they add up to 1 to the last bit
/// (Antonana, Makazaga and Murua, Numer. Algorithms 76 (2017)). A sweep takes the gradient of L at all nodes
/// together, and moves
///     v <- v + M^-1 (p - L_v(q, v)),       q <- q_0 + sum_j mu_ij w_j v_j,
/// M = L_vv where the iteration starts, once a step; as a part of L_v it costs little beside it. Forces of
/// stiffness k contract by k (h A)^2 / M, as in node_iteration.hpp, whose starting values and end these are.
///
/// T: scalar. Arrays are d x stride, node fastest; beyond the nodes they repeat the last one.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <stop_token>
#include <type_traits>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/core/outcome.hpp"
#include "engine/core/text/archive.hpp"
#include "engine/integrator/sweep/node_couplings.hpp"
#include "engine/integrator/sweep/velocity_kernel.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/solve/correction_size.hpp"

namespace extremal {

template <class T>
class VelocityIteration {
public:
    using Square = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

    /// Whether the step is of this kind, and the system evaluates many nodes together, without which Newton's
    /// method is as fast.
    static bool applies(const Mechanics<T>& mechanics, const Table<T>& table);

    /// L' and the masses L_vv (d x d) at many nodes, otherwise as Mechanics::gradients.
    using GradientsAndMasses = void (*)(const void*, const T* t, int nodes, const T* q, const T* v,
                                        T* gradients, T* masses);

    /// `withMasses`, of the model of `mechanics`, has the masses with the gradient of the first sweep;
    /// without it they are from the second derivatives, all of which are evaluated for them.
    VelocityIteration(const Mechanics<T>& mechanics, const Table<T>& table, const T& h, const T& tolerance,
                      GradientsAndMasses withMasses = nullptr);

    /// As NodeIteration: solves the step from (t, q, p); carryQ and carryP are what q and p have lost to
    /// rounding.
    Outcome solve(const T& t, const T* q, const T* p, const T* carryQ, const T* carryP, int maxIterations,
                  const std::stop_token& stop, StepReport& report);
    void increments(T* dq, T* dp, T* carryQ, T* carryP) const;
    void coefficients(Eigen::Ref<Square> Y, Eigen::Ref<Square> forces) const;
    /// The same Y, function by function.
    void curve(T* Y) const;
    const T& nearness() const { return nearness_; }

    /// Velocities at the nodes, n x d, of a step solved otherwise: the next one starts from them.
    void remember(const Eigen::Ref<const Square>& velocities);
    void forget() { hasVelocities_ = false; }
    void checkpoint(Archive& archive) requires std::is_same_v<T, double> { archive(V_, hasVelocities_); }

    void setStep(const T& step);

private:
    using Array = std::vector<T>;

    std::size_t at(int k, int i) const { return static_cast<std::size_t>(k * stride_ + i); }
    bool start(const T& t, const T* q, const T* p);
    void evaluateMasses();
    void evaluate(bool withMasses);
    const T* curveOf(int k) const;
    CorrectionSize<T> measured(const T* q, const T* p) const;

    Mechanics<T> mechanics_;
    GradientsAndMasses withMasses_;
    int d_, n_, stride_;
    T h_, tolerance_;
    bool isExact_;  ///< solve to round-off
    NodeCouplings<T> couplings_;
    VelocityKernel<T> kernel_;
    Array weight_;                    ///< h b_i
    Array times_, V_, Q_, P_;         ///< at the nodes
    Array drift_, impulse_, before_;  ///< w_j v_j; w_j F_j; the velocities of the step before
    Array gradient_, hessian_;        ///< 2d and 4d^2 x stride
    Array inverse_;                   ///< entry (k, l) of M^-1 at k * d + l, x stride
    mutable Array curve_;             ///< Y of one coordinate
    std::vector<SweepSize<T>> size_;  ///< of the last correction and of the velocities, as increments
    bool hasVelocities_ = false;
    T nearness_ = T(1);
};

}  // namespace extremal
