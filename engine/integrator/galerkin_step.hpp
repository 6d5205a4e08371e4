/// One step of a generalized Galerkin variational integrator: the stationarity conditions of the discrete action.
///
/// Given (q_0, p_0) at t_0 and a table of a space and a rule (action/table.hpp), find Y_0..Y_{m-1} in R^d with
///     R_a = sum_i b_i [ h L_q(i) phi_a(c_i) + L_v(i) phi_a'(c_i) ] = 0,                     a < m - 1 (interior)
///     R_{m-1} = p_0 + sum_i b_i [ h L_q(i) psi(c_i) + L_v(i) psi'(c_i) ] = 0,               psi: trace 1 at the start
/// where L(i) is taken at t_0 + c_i h, q(c_i), v(c_i). Then q_1 = q_0 + Y_{m-1} and, testing with the function 1,
///     p_1 = p_0 + h sum_i b_i L_q(i):
/// the multiplier of the continuity constraint is the momentum (Leok 2004, sec. 2.1; stationarity at the start of the
/// next element reads dS^{i+1}/dq_{i+1}^0 = -lambda_i, the printed one has the element index wrong).
///
/// The nonlinear system is solved by Newton with the Jacobian factored at the starting guess and kept while it contracts
/// well, or, for separable Lagrangians, by fixed-point iteration over all nodes together (node_iteration.hpp). Both go on
/// to round-off, so that symplecticity and momentum maps hold to round-off. Newton's starting guess: the previous curve
/// continued, and where that fails or is missing a Taylor step.
///
/// What q and p lose to rounding when a step is added is carried on to the next (compensated summation), so that over
/// millions of steps the energy error grows like a random walk of the round-off of the increments only.
///
/// T: scalar; D: dimension d at compile time or Eigen::Dynamic. All buffers are allocated in the constructor.
/// Array shapes: Y is d x m, node quantities d x n.
#pragma once

#include <Eigen/LU>

#include <optional>
#include <stop_token>

#include "engine/action/table.hpp"
#include "engine/core/outcome.hpp"
#include "engine/integrator/node_iteration.hpp"
#include "engine/model/mechanics.hpp"

namespace extremal {

enum class SolverMethod { automatic, newton, fixedPoint };

struct SolverPolicy {
    SolverMethod method = SolverMethod::automatic;
    double tolerance = 0;    ///< relative size of the last correction; 0: round-off
    int maxIterations = 50;  ///< Newton or fixed-point iterations in one step
    bool operator==(const SolverPolicy&) const = default;
};

template <class T, int D>
class GalerkinStep {
public:
    using Vector = Eigen::Matrix<T, D, 1>;
    using Columns = Eigen::Matrix<T, D, Eigen::Dynamic>;

    GalerkinStep(Mechanics<T> mechanics, Table<T> table, T step, SolverPolicy policy);

    /// Moves (q, p), arrays of length d, from t to t + h. On failure they are left as they were.
    StepReport advance(const T& t, T* q, T* p, const std::stop_token& stop);

    /// The curve of the last step at tau in [0, 1]: q, and p by the momentum equation integrated to tau.
    void curve(const T& tau, T* q, T* p) const;

    /// Forgets the previous curve: the next step starts from a Taylor guess.
    void restart() {
        hasCurve_ = false;
        if (together_) together_->forget();
    }

private:
    using Square = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
    using Flat = Eigen::Matrix<T, Eigen::Dynamic, 1>;

    enum class Attempt { solved, failed, notFinite, singular, stopped };

    int d() const { return mechanics_.dimension; }
    int m() const { return table_.unknowns(); }
    int n() const { return table_.nodes(); }
    void placeNodes();
    void evaluateForces(const T& t);
    void residual();
    bool assembleJacobian(const T& t);
    bool guess(const T& t);
    bool startVelocity(const T& t);
    T correction();
    Attempt iterate(const T& t, const std::stop_token& stop);
    Attempt newton(const T& t, const std::stop_token& stop);
    Attempt fixedPoint(const T& t, const std::stop_token& stop);
    Attempt solve(const T& t, const std::stop_token& stop);
    void takeUp(const T* q, const T* p);
    void add(T* q, T* p);

    Mechanics<T> mechanics_;
    Table<T> table_;
    T h_;
    SolverPolicy policy_;
    T tolerance_;

    Columns Y_, previousY_, nodeQ_, nodeV_, Lq_, Lv_, R_, delta_, trial_;
    Vector q0_, p0_, v0_, a0_, dq_, dp_;
    Vector carryQ_, carryP_, lastQ_, lastP_;  ///< lost to rounding; and the state it belongs to
    Flat jetGradient_, jetHessian_;
    Square jacobian_;
    Eigen::PartialPivLU<Square> lu_;
    Square kineticInverse_;  ///< (a, b): inverse of the kinetic Jacobian for unit mass
    Flat flatR_, flatDelta_;
    Square block_;
    bool hasCurve_ = false;                      ///< Y_ of Newton's last step can be continued
    std::optional<NodeIteration<T>> together_;  ///< separable Lagrangians
    bool isTogether_ = false;                   ///< it solved the last step
    int newtonSteps_ = 0;  ///< steps for which Newton is preferred after the fixed point was slow
    StepReport report_;
};

}  // namespace extremal
