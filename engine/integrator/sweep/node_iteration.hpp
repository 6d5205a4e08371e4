// SPDX-License-Identifier: GPL-3.0-or-later
/// The step of a discretization on a separable Lagrangian, L = 1/2 sum_k m_k v_k^2 - V(t, q), solved by
/// fixed-point iteration on the positions at the nodes.
///
/// Stationarity (galerkin_step.hpp) is then linear in Y but for the forces F_j = -V'(q(c_j)), so Y can be
/// eliminated once and for all: with K_ab = sum_i b_i psi_a'(c_i) phi_b'(c_i) / h and B_aj = h b_j
/// psi_a(c_j),
///     Y = K^-1 (-e_last p_0 - B F) / m,
/// the nodes see each other through the impulses I_j = h b_j F_j alone,
///     q(c_i) = q_0 + s_i v_0 + sum_j N_ij I_j / m,
///     q_1 = q_0 + S v_0 + sum_j (S - s_j) I_j / m,        p_1 = p_0 + sum_j I_j,
/// (s_i = h c_i and S = h where the space has the linear functions): a Runge-Kutta-Nystrom method, in which
/// all nodes are evaluated together. It is symplectic for any I if N_ij - N_ji = s_i - s_j. Rounded as they
/// come, coefficients miss that by 1e-17 and the energy drifts by some 1e-20 of itself a step, always the
/// same way; so N and s are multiples of one unit, and the condition holds to the last bit (after Antonana,
/// Makazaga and Murua, Numer. Algorithms 76 (2017), who do so for Runge-Kutta methods). What is left is a
/// random walk.
///
/// The iteration starts from the forces of the previous step, continued by the polynomial that the rule sees
/// best, or, where these are missing, from a constant force; and goes on to round-off, so that symplecticity
/// and momenta hold to round-off.
///
/// Where no node sees itself, and the nodes that are seen see no others, the method is explicit, such as
/// linear functions under the trapezoidal rule: each force is evaluated once, and the nodes are the fixed
/// point of a sweep to the last bit. Where the step begins at exactly the place where the last node of the
/// step before was, its force is known.
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
#include "engine/integrator/sweep/node_kernel.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/solve/correction_size.hpp"

namespace extremal {

template <class T>
class NodeIteration {
public:
    using Square = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

    NodeIteration(const Mechanics<T>& mechanics, const Table<T>& table, const T& h, const T& tolerance);

    /// Solves the step from (t, q, p); carryQ and carryP, arrays of length d, are what q and p have lost to
    /// rounding. Counts into the report.
    Outcome solve(const T& t, const T* q, const T* p, const T* carryQ, const T* carryP, int maxIterations,
                  const std::stop_token& stop, StepReport& report);

    /// Of the step last solved: the increments of q and p; what rounding takes from them is added to the
    /// carries.
    void increments(T* dq, T* dp, T* carryQ, T* carryP) const;
    /// The same step's Y, m x d, and forces at the nodes, n x d.
    void coefficients(Eigen::Ref<Square> Y, Eigen::Ref<Square> forces) const;

    /// Of the step last solved: the first change that a sweep made, relative to the increments; 1 where it
    /// did not start from the step before.
    const T& nearness() const { return nearness_; }

    /// Forces at the nodes, n x d, of a step solved otherwise: the next one starts from them.
    void remember(const Eigen::Ref<const Square>& forces);
    void forget() { hasForces_ = false; }
    /// The last node of another one's last step, of the same system, for a step that begins there.
    void takeEnd(const NodeIteration& other) { end_ = other.end_; }
    /// What the next step starts from.
    void checkpoint(Archive& archive) requires std::is_same_v<T, double> {
        archive(F_, hasForces_, end_.place, end_.force, end_.t, end_.isKnown);
    }

    /// Steps of another length from now on; nothing is allocated.
    void setStep(const T& step);

private:
    using Array = std::vector<T>;

    void place(const T& t, const T* p, const T* carryQ, const T* carryP);
    void evaluateForces();
    void evaluateOneByOne(int first, int last);  ///< nodes of [first, last)
    void weigh();                                ///< impulses from forces
    void startFromConstantForce(const T& t, const T* q);
    void findSources();
    bool beginsAtEnd(const T& t, const T* q) const;
    bool solveExplicitly(const T& t, const T* q, const T* carryQ, StepReport& report);
    T largestChange(const T* q) const;
    CorrectionSize<T> measured(const T* q, const T* p) const;
    /// The sums that move q and p go through extended precision: rounded in double they were biased, and the
    /// energy of ten million steps drifted by 1e-12.
    using Accumulator = std::conditional_t<std::is_same_v<T, double>, long double, T>;
    Accumulator displacement(int k) const;
    static T split(const Accumulator& sum, T& carry);
    std::size_t at(int k, int i) const { return static_cast<std::size_t>(k * stride_ + i); }

    Mechanics<T> mechanics_;
    int d_, n_, m_, stride_;
    T h_, tolerance_;
    bool isExact_;  ///< solve to round-off
    /// The tables of the first step, not yet rounded.
    struct {
        T step;
        Square N, start, toForces;
        Eigen::Matrix<T, Eigen::Dynamic, 1> times, velocities, weight;
    } made_;
    Array node_;           ///< c_i
    Array N_, start_;      ///< by columns: N, and G_ij = N_ij h b_j times the extrapolation of the forces
    Array slope_, toEnd_;  ///< s_i, S - s_i
    T velocityToEnd_;      ///< S
    Array weight_;         ///< h b_i
    Array toForces_,
        toVelocity_;  ///< Y_a = toVelocity_a v_0 + sum_i toForces(a, i) F_i / m; (a, i) at a * stride + i
    Array inverseMass_, v0_, lost_, place_, force_;
    Array times_, base_, F_, impulse_, Z_, Q_;
    std::vector<SweepSize<T>> size_;
    void (*sweep_)(const Sweep<T>&) = nullptr;
    bool hasForces_ = false;
    /// How many nodes see no other, the first ones, where all others see these alone; 0: it is not explicit.
    int sources_ = 0;
    bool endsAtNode_ = false;  ///< it is, and the step ends where its last node is
    /// The last node of an explicit step.
    struct {
        Array place, force;
        T t = T(0);
        bool isKnown = false;
    } end_;
    T nearness_ = T(1);
};

}  // namespace extremal
