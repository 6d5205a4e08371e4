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
/// M = L_vv where the iteration starts, once a step. Forces of stiffness k contract by k (h A)^2 / M, as in
/// node_iteration.hpp, whose starting values and end these are.
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
#include "engine/integrator/node_iteration.hpp"
#include "engine/integrator/node_kernel.hpp"
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

    VelocityIteration(const Mechanics<T>& mechanics, const Table<T>& table, const T& h, const T& tolerance);

    /// As NodeIteration: solves the step from (t, q, p); carryQ and carryP are what q and p have lost to
    /// rounding.
    Outcome solve(const T& t, const T* q, const T* p, const T* carryQ, const T* carryP, int maxIterations,
                  const std::stop_token& stop, StepReport& report);
    void increments(T* dq, T* dp, T* carryQ, T* carryP) const;
    void coefficients(Eigen::Ref<Square> Y, Eigen::Ref<Square> forces) const;
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
    void invertMasses();
    void kick(const T* p);
    void drift(const T* q);
    CorrectionSize<T> measured(const T* q, const T* p) const;

    Mechanics<T> mechanics_;
    int d_, n_, stride_;
    T h_, tolerance_;
    bool isExact_;                    ///< solve to round-off
    Square toY_;                      ///< D^-1, (a, i): Y_a = h sum_i toY(a, i) v_i
    Array node_;                      ///< c_i
    Array b_, weight_;                ///< b_i; h b_i
    Array mu_, nu_;                   ///< by columns: mu_ij; 1 - mu_ji
    Array onward_;                    ///< by columns: weight of v_j in its extrapolation to 1 + c_i
    Array ones_, carryQ_, carryP_;    ///< d; d x stride
    Array times_, V_, Q_, P_;         ///< at the nodes
    Array moved_, kicked_;            ///< q(c_i) - q_0; p(c_i) - p_0
    Array drift_, impulse_, before_;  ///< w_j v_j; w_j F_j; the velocities of the step before
    Array gradient_, hessian_;        ///< 2d and 4d^2 x stride
    Array inverse_;                   ///< entry (k, l) of M^-1 at k * d + l, x stride
    Array change_;                    ///< of the velocities of one coordinate
    std::vector<SweepSize<T>> size_;  ///< of that correction and of the velocities, as increments
    void (*sweep_)(const Sweep<T>&) = nullptr;
    bool hasVelocities_ = false;
    T nearness_ = T(1);
};

}  // namespace extremal
