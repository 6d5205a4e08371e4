// SPDX-License-Identifier: GPL-3.0-or-later
/// One step of a generalized Galerkin variational integrator: the stationarity conditions of the discrete
/// action.
///
/// Given (q_0, p_0) at t_0 and a table of a space and a rule (action/table.hpp), find Y_0..Y_{m-1} in R^d
/// with
///     R_a = sum_i b_i [ h L_q(i) phi_a(c_i) + L_v(i) phi_a'(c_i) ] = 0,                     a < m - 1
///     (interior) R_{m-1} = p_0 + sum_i b_i [ h L_q(i) psi(c_i) + L_v(i) psi'(c_i) ] = 0,               psi:
///     trace 1 at the start
/// where L(i) is taken at t_0 + c_i h, q(c_i), v(c_i). Then q_1 = q_0 + Y_{m-1} and, testing with the
/// function 1,
///     p_1 = p_0 + h sum_i b_i L_q(i):
/// the multiplier of the continuity constraint is the momentum (Leok 2004, sec. 2.1; stationarity at the
/// start of the next element reads dS^{i+1}/dq_{i+1}^0 = -lambda_i, the printed one has the element index
/// wrong).
///
/// The nonlinear system is solved by Newton with the Jacobian factored at the starting guess and kept while
/// it contracts well, or, for separable Lagrangians, by fixed-point iteration over all nodes together
/// (node_iteration.hpp). Both go on to round-off, so that symplecticity and momentum maps hold to round-off.
/// Newton's starting guess: the previous curve continued, and where that fails or is missing a Taylor step;
/// where coordinates have spaces of their own, and a Taylor step fails too, the motion itself in small
/// explicit steps. Where all of these fail at an edge of the domain of L, the root of a short step is
/// followed to the whole one (solve/step_continuation.hpp).
///
/// A root that was not near its starting value is accepted only if its curve follows the forces
/// (force_defect.hpp). If not, Newton's method starts again, from a Taylor step and from the motion itself in
/// small explicit steps; if no root follows the forces, the step is refused as lost.
///
/// What q and p lose to rounding when a step is added is carried on to the next (compensated summation), so
/// that over millions of steps the energy error grows like a random walk of the round-off of the increments
/// only.
///
/// Terms of L may have rules of their own: then the sums run over the nodes of all rules, and L(i) is the
/// part of L that node i is for. The sum of the discrete actions is one discrete action: p_0, p_1 and all
/// that follows from them are as before.
///
/// Every coordinate k may have a table of its own, with its own functions and m_k of them, on the same nodes:
/// then Y_a and R_a above are those of one coordinate. A separable Lagrangian on one slow table is solved for
/// all nodes together (node_iteration.hpp), and so is another one with as many nodes as unknowns
/// (velocity_iteration.hpp); where that is slow, by Newton's method. Of many coordinates that do not all act
/// on each other its Jacobian is sparse (sparse_jacobian.hpp).
///
/// T: scalar; D: dimension d at compile time or Eigen::Dynamic. Buffers are allocated in the constructor, and
/// the matrices of Newton's method of many coordinates where it is first needed.
/// Array shapes: Y is coordinate by coordinate, entry a of coordinate k at offset(k) + a; node quantities are
/// n x d.
#pragma once

#include <optional>
#include <stop_token>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/core/algebra/lu.hpp"
#include "engine/core/algebra/small_product.hpp"
#include "engine/core/outcome.hpp"
#include "engine/core/text/archive.hpp"
#include "engine/integrator/force_defect.hpp"
#include "engine/integrator/sweep/node_iteration.hpp"
#include "engine/integrator/sparse_jacobian.hpp"
#include "engine/integrator/variation/transposed_step.hpp"
#include "engine/integrator/sweep/velocity_iteration.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/solve/correction_size.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {
namespace detail {

template <class T>
const typename Table<T>::Vector& ofKineticEnergy(const Table<T>& table) {
    return table.kineticWeight.size() > 0 ? table.kineticWeight : table.weight;
}

}  // namespace detail

template <class T, int D>
class GalerkinStep {
public:
    using Vector = Eigen::Matrix<T, D, 1>;
    using Columns = Eigen::Matrix<T, Eigen::Dynamic, D>;

    /// One table for all coordinates, or one for each; these share nodes and weights. `parts`: what the nodes
    /// of a table with parts are for; empty: all of them for the whole Lagrangian. `entries`: null where they
    /// are not known.
    GalerkinStep(Mechanics<T> mechanics, std::vector<Table<T>> tables, T step, SolverPolicy policy,
                 std::vector<LagrangianTerm<T>> parts = {}, const LagrangianEntries* entries = nullptr);
    GalerkinStep(Mechanics<T> mechanics, Table<T> table, T step, SolverPolicy policy)
        : GalerkinStep(std::move(mechanics), std::vector<Table<T>>{std::move(table)}, step, policy) {}

    /// Moves (q, p), arrays of length d, from t to t + h. On failure they are left as they were.
    StepReport advance(const T& t, T* q, T* p, const std::stop_token& stop);

    /// The curve of the last step at tau in [0, 1]: q, and p by the momentum equation integrated to tau.
    void denseOutput(const T& tau, T* q, T* p) const;

    /// Steps of another length from now on, without allocating. Not for tables whose functions change with
    /// the step (oscillatory ones): these are made anew.
    void setStep(const T& step);

    /// Y of the last step: entry a of coordinate k after the m_0 + ... + m_{k-1} of those before it.
    void coefficients(T* Y) const;

    /// W <- M W for columns (dq, dp), with the tangent map M of the last step, which began at t
    /// (galerkin_step_tangent.hpp). False where its equations are singular.
    bool applyTangent(const T& t, T* W, int columns);
    /// W <- M^T W for columns of derivatives by (q_1, p_1), with one transposed solve for each; with the
    /// derivatives at nodes by `pull`, where it is not null.
    bool applyTransposed(const T& t, T* W, int columns, NodePull* pull = nullptr);
    /// The nodes of the last step, which began at t; not of terms with rules of their own.
    template <class Visit>
    void visitNodes(const T& t, const Visit& visit) {
        placeSolution();
        for (int i = 0; i < n(); ++i) visit(nodeAt(t, i));
    }

    /// Forgets the previous curve: the next step starts from a Taylor guess.
    void restart() {
        hasPrevious_ = false;
        withFixedPoint([](auto& solver) { solver.forget(); });
    }

    /// What is known at the end of the last step of `other`, of the same system, for a step that begins
    /// there.
    void takeEnd(const GalerkinStep& other) {
        if (auto* const own = std::get_if<NodeIteration<T>>(&fixedPointSolver_))
            if (const auto* const its = std::get_if<NodeIteration<T>>(&other.fixedPointSolver_))
                own->takeEnd(*its);
    }

    /// What the next step depends on besides its start (Integrator::checkpoint).
    void checkpoint(Archive& archive) requires std::is_same_v<T, double> {
        archive(previousY_, hasPrevious_, carryQ_, carryP_, lastQ_, lastP_, ladder_, newtonSteps_);
        withFixedPoint([&](auto& solver) { archive(solver); });
    }

private:
    using Square = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
    using Flat = Eigen::Matrix<T, Eigen::Dynamic, 1>;

    using Accumulator = std::conditional_t<std::is_same_v<T, double>, long double, T>;

    /// The functions of a table, node by node and function by function. The equations are the gradient of one
    /// sum of numbers, S = sum_i w_i L(q_0 + sum_a phi_a(c_i) Y_a, sum_a phi_a'(c_i) Y_a): test and trial
    /// functions, and the weights of L_q and L_v, are the same to the last bit. Rounded differently (b_i h
    /// here, division by h there) they would be the gradient of nothing, and the energy of stiff systems
    /// drifts.
    struct Functions {
        Square value, slope;      ///< (i, a): phi_a(c_i), and phi_a'(c_i) by time, over h
        Square valueAt, slopeAt;  ///< (a, i), with rows of 0 up to a multiple of 8
        Square kineticInverse;  ///< (a, b): inverse of the kinetic Jacobian for unit mass, on the first step
    };

    int d() const { return mechanics_.dimension; }
    int n() const { return tables_.front().nodes(); }
    /// Rows of node quantities: n, or, where nodes are taken eight at a time, the next multiple of 8; the
    /// last node is repeated with weight 0.
    int rows() const { return rows_; }
    int m(int k) const { return table(k).unknowns(); }
    const Table<T>& table(int k) const {
        return tables_.size() == 1 ? tables_.front() : tables_[static_cast<std::size_t>(k)];
    }
    const LagrangianTerm<T>& partAt(int i) const {
        return parts_[static_cast<std::size_t>(tables_.front().part[static_cast<std::size_t>(i)])];
    }
    const Functions& functions(int k) const {
        return functions_.size() == 1 ? functions_.front() : functions_[static_cast<std::size_t>(k)];
    }
    int offset(int k) const { return offset_[static_cast<std::size_t>(k)]; }
    void addProduct(const Square& A, int height, const T* B, int columns, T* C, int strideC) const;
    bool hasFixedPoint() const { return fixedPointSolver_.index() > 0; }
    /// use(solver), where there is one.
    template <class Use>
    void withFixedPoint(Use&& use) {
        std::visit(
            [&](auto& solver) {
                if constexpr (!std::is_same_v<std::decay_t<decltype(solver)>, std::monostate>) use(solver);
            },
            fixedPointSolver_);
    }
    template <class Use>
    void withFixedPoint(Use&& use) const {
        std::visit(
            [&](const auto& solver) {
                if constexpr (!std::is_same_v<std::decay_t<decltype(solver)>, std::monostate>) use(solver);
            },
            fixedPointSolver_);
    }
    void roomForNewton();
    void scaleToStep();
    void placeNodes();
    void evaluateGradients(const T& t);
    Accumulator actionGradient(int k, T* grad);
    void residual();
    bool evaluateHessians(const T& t);
    void assembleNode(int i);
    void assembleBlock(int k, int l);
    void applyHessian(int k, int l, bool isSlope);
    bool assembleJacobian(const T& t);
    bool assembleSparse(const T& t);
    bool factoriseJacobian();
    bool startFrom(const T& t, StartingValue start);
    bool startVelocity(const T& t);
    bool startFromMotion(const T& t);
    bool followsForces(const T& t);
    T correction();
    T massAt(int k) const;
    CorrectionSize<T> measured() const;
    bool retreat(const T& t);
    bool shortenIntoDomain(const T& t);
    Outcome iterate(const T& t, StartingValue start, const std::stop_token& stop);
    Outcome newton(const T& t, StartingValue start, const std::stop_token& stop);
    Outcome fromElsewhere(const T& t, const std::stop_token& stop);
    Outcome fromShorterSteps(const T& t, const std::stop_token& stop);
    Outcome anyRoot(const T& t, const std::stop_token& stop);
    void rememberNodes();
    Outcome fixedPoint(const T& t, const std::stop_token& stop);
    Outcome solve(const T& t, const std::stop_token& stop);
    void resume(const T* q, const T* p);
    void add(T* q, T* p);
    void placeSolution();
    NodePull::Node nodeAt(const T& t, int i) requires std::is_same_v<T, double>;
    bool linearise(const T& t);
    void vary(const T* dq0, bool movesY);
    void pullBack(const T& t, const T* byMomentum, NodePull* pull);
    void addHessian(int i);
    bool takeHessians(const T& t, NodePull& pull);
    bool iterateTransposed();

    Mechanics<T> mechanics_;
    std::vector<LagrangianTerm<T>> parts_;  ///< empty: the whole Lagrangian at every node
    std::vector<Table<T>> tables_;
    std::vector<Functions> functions_;
    std::vector<int> offset_;
    T h_;
    T kineticScale_ = T(1);  ///< of kineticInverse: h over that of the first step
    SolverPolicy policy_;
    T tolerance_;

    Flat Y_, previousY_, R_, delta_;
    int rows_ = 0;
    bool isVectorised_ = false;  ///< many nodes: sums go through kernels of this machine
    NodeSums sums_;
    Columns nodeQ_, nodeV_;
    Square gradient_;             ///< (i, k): L_q, then L_v
    Flat node_, weight_, times_;  ///< c_i, h b_i, t_i
    Vector q0_, p0_, v0_, a0_, dq_, dp_;
    Square mass_;                                 ///< at the start of the step
    mutable Square ownCoefficients_, ownForces_;  ///< room for coefficients()
    Vector carryQ_, carryP_, lastQ_, lastP_;      ///< lost to rounding; and the state it belongs to
    Vector placeQ_, placeV_;
    // Of the iteration on transposed equations: (coordinate, node) and (coordinate, unknown).
    Square tested_, pulled_, right_, next_, dual_;
    std::vector<std::pair<int, int>> coupled_;  ///< coordinates whose Hessian is not 0 at every node
    Vector eta_, rate_, byQ_, byV_;             ///< of the test curve at one node, and derivatives there
    Flat weightedLq_, weightedLv_;  ///< h b_i times L_q(i) and L_v(i), or rows of L'', of one coordinate
    Flat jetGradient_, jetHessian_;
    Square hessians_;              ///< (i, j): entry j of the Hessian at node i
    std::vector<bool> isPresent_;  ///< entry j is not 0 at all nodes
    Square applied_;               ///< (i, c): a row of the Hessian applied to function c
    Square jacobian_;
    Eigen::PartialPivLU<Square> lu_;
    std::optional<SparseJacobian> sparse_;  ///< in place of these three, but for tangent maps
    bool hasPrevious_ = false;              ///< Y_ of Newton's last step can be extrapolated
    bool continues_ = true;                 ///< so can those of all steps of its tables
    /// Where it applies; else Newton's method alone.
    std::variant<std::monostate, NodeIteration<T>, VelocityIteration<T>> fixedPointSolver_;
    bool hasLeftDomain_ = false;            ///< Newton's method did, in this step: L has an edge nearby
    bool isSolvedByFixedPoint_ = false;     ///< it solved the last step
    std::optional<ForceDefect<T>> defect_;  ///< not of oscillatory functions
    T nearness_ = T(0);                     ///< first correction of the last iteration
    Flat motion_;                           ///< states and rates of the explicit steps
    std::vector<Accumulator> impulse_;      ///< change of h sum_i b_i L_q(i) of a variation
    StartingLadder ladder_;
    int newtonSteps_ = 0;  ///< steps for which Newton is preferred after the fixed point was slow
    StepReport report_;
};

}  // namespace extremal
