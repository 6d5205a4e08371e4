/// The step of a pair on a separable Lagrangian, L = 1/2 sum_k m_k v_k^2 - V(t, q), solved by fixed-point iteration on the
/// positions at the nodes.
///
/// Stationarity (galerkin_step.hpp) is then linear in Y but for the forces F_i = -V'(q(c_i)), so Y can be eliminated
/// once and for all: with K_ab = sum_i b_i psi_a'(c_i) phi_b'(c_i) / h and B_ai = h b_i psi_a(c_i),
///     Y = K^-1 (-e_last p_0 - B F) / m,      Z_i = q(c_i) - q_0 = sum_a phi_a(c_i) Y_a = base_i + sum_j G_ij F_j / m:
/// a Runge-Kutta-Nystrom method with matrix G, in which all nodes are evaluated together. It starts from the forces of
/// the previous step, continued by the polynomial that the rule sees best, or, where these are missing, from a constant
/// force; and goes on to round-off, so that symplecticity and momenta hold to round-off.
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
#include "engine/integrator/node_kernel.hpp"
#include "engine/model/mechanics.hpp"

namespace extremal {

template <class T>
class NodeIteration {
public:
    using Square = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

    NodeIteration(const Mechanics<T>& mechanics, const Table<T>& table, const T& h, const T& tolerance);

    enum class Result { solved, slow, notFinite, stopped };

    /// Solves the step from (t, q, p); carryQ and carryP, arrays of length d, are what q and p have lost to rounding.
    /// Counts into the report.
    Result solve(const T& t, const T* q, const T* p, const T* carryQ, const T* carryP, int maxIterations,
                 const std::stop_token& stop, StepReport& report);

    /// Of the step last solved: the increments of q and p.
    void increments(T* dq, T* dp) const;
    /// The same step's Y, d x m, and forces at the nodes, d x n.
    void coefficients(Eigen::Ref<Square> Y, Eigen::Ref<Square> forces) const;

    /// Forces at the nodes, d x n, of a step solved otherwise: the next one starts from them.
    void remember(const Eigen::Ref<const Square>& forces);
    void forget() { hasForces_ = false; }

private:
    using Array = std::vector<T>;

    void place(const T& t, const T* p, const T* carryQ, const T* carryP);
    void evaluateForces();
    void startFromConstantForce(const T& t, const T* q);
    T largestChange(const T* q) const;
    /// The sums that move q and p go through extended precision: rounded in double they were biased, and the energy of
    /// ten million steps drifted by 1e-12.
    using Wide = std::conditional_t<std::is_same_v<T, double>, long double, T>;
    Wide impulse(const Array& weights, int row, int k) const;
    std::size_t at(int k, int i) const { return static_cast<std::size_t>(k * stride_ + i); }

    Mechanics<T> mechanics_;
    int d_, n_, m_, stride_;
    T h_, tolerance_;
    bool isExact_;                 ///< solve to round-off
    Array node_;                   ///< c_i
    Array G_, start_;              ///< by columns: G, and G times the continuation of the forces
    Array slope_;                  ///< base_i = slope_i v_0: h c_i where the space has the linear functions
    Array toForces_, toVelocity_;  ///< Y_a = toVelocity_a v_0 + sum_i toForces(a, i) F_i / m; (a, i) at a * stride + i
    Array weight_, residue_;       ///< h b_i; what rounding takes from the last row of toForces_
    Array inverseMass_, v0_, lost_, place_, force_;
    Array times_, base_, F_, Z_, Q_;
    std::vector<SweepSize<T>> size_;
    void (*sweep_)(const Sweep<T>&) = nullptr;
    bool hasForces_ = false;
};

}  // namespace extremal
