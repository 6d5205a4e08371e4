// SPDX-License-Identifier: GPL-3.0-or-later
/// One step of a Galerkin variational integrator on a Lie group, in the natural chart at its base point.
///
/// The base point g_b is that of the curve at a time nu of the step, in [0, 1]: the curve is g(tau) = g_b
/// exp(xi(tau)), xi = sum_a Y_a psi_a(tau) with psi_a = phi_a - phi_a(nu) and the functions phi_a of the
/// table, and g_b = g_0 exp(-xi_0). xi_0 and xi_1 are xi at the ends. With eta_i = dexp(xi_i) xi'_i, m_i = M
/// eta_i and the force f_i of the potential at node i,
///     L_d = h sum_i b_i [ 1/2 eta_i . M eta_i - U(g_b exp xi_i) ],      p_a = dL_d / dY_a at fixed g_b
///         = sum_i b_i { h psi_a(c_i) [ (D_xi eta_i)^T m_i + dexp(xi_i)^T f_i ] + psi_a'(c_i) dexp(xi_i)^T
///         m_i },
///     W = -h sum_i b_i Ad_exp(-xi_i)^T f_i                        (L_d depends on g_b through U alone)
/// and dL_d = mu_1 . zeta_1 - mu_0 . zeta_0 with the variations zeta = g^{-1} dg of the ends, zeta_k =
/// Ad_exp(-xi_k) zeta_b + dexp(xi_k) dxi_k, for all zeta_b and dY:
///     mu_b = Ad_exp(-xi_0)^T mu_0,      mu_1 = Ad_exp(xi_1)^T (mu_b - W),
///     p_a = psi_a(1) dexp(-xi_1)^T (mu_b - W) - psi_a(0) dexp(xi_0)^T mu_0.
/// With nu = 0 these are the discrete Euler-Poincare equations; the form has no singularity at |xi_1| = 2 pi.
/// No logarithm is ever taken. Momenta are updated by the line of mu_1 and not by p_a, so that they are kept
/// to round-off even where the iteration is not. For a free body g and W drop out: the reduced step.
/// Unreduced, its kinetic energy is evaluated in space axes, at every g, and what g does to it is found to
/// cancel. The adjoint of a step has the nodes 1 - c_i and its base point at 1 - nu, so that nu = 1/2 with
/// nodes that are their own mirror image is symmetric. Source: Leok 2004, sec. 3.2 and 4.2, for nu = 0.
/// Corrected: the body rate is dexp_{-ad xi} xi' (printed xi'); the variation of eta is dexp_{-ad} l'/h + l
/// D_xi[dexp_{-ad xi} xi'] (the printed ddexp_{ad} term is wrong); f = g_k^{-1} g_{k+1} (printed inverted);
/// the curve ends at g_1 (printed g_0^{-1} g_1).
///
/// Newton with the Jacobian of the predicted curve, kept while it contracts well, to round-off.
/// T: scalar; G, a policy: RotationGroup<T> or MotionGroup<T> (lie_groups.hpp), or DataGroup
/// (data_group.hpp), whose dimension is known when it runs and whose momenta may depend on g. It brings its
/// Lagrangian (ChartLagrangian<T, G>) and its guess (StepGuess<T, G>). All buffers are allocated in the
/// constructor.
#pragma once

#include <Eigen/Core>

#include <stop_token>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/action/chain_rule.hpp"
#include "engine/action/table.hpp"
#include "engine/core/outcome.hpp"
#include "engine/core/text/archive.hpp"
#include "engine/family/lie/chart_lagrangian.hpp"
#include "engine/family/lie/lie_groups.hpp"
#include "engine/family/lie/lie_guess.hpp"
#include "engine/family/lie/product_blocks.hpp"
#include "engine/solve/block_lu.hpp"
#include "engine/solve/newton_policy.hpp"
#include "engine/solve/small_lu.hpp"

namespace extremal {

template <class T, class G>
class LieStep {
public:
    static constexpr int n = G::n;  ///< Eigen::Dynamic: known when it runs
    using Mechanics = typename G::Mechanics;
    using Pose = typename G::Pose;
    using Vector = typename G::Vector;
    using Matrix = typename G::Matrix;

    /// `isReduced`: leave g out of the equations where L is invariant; `base`: nu, where the chart is.
    LieStep(const Mechanics& mechanics, Table<T> table, const T& step, bool isReduced, const T& base,
            SolverPolicy policy);

    /// Moves the pose by one step and adds to the report. On failure it is left as it was.
    Outcome advance(Pose& pose, StepReport& report, const std::stop_token& stop);

    /// The pose of the last step at tau in [0, 1] from its start.
    Pose denseOutput(const T& tau) const;

    /// W <- M W for columns (zeta, dmu), with the tangent map M of the last step (lie_step_tangent.hpp).
    /// False where its equations are singular.
    bool applyTangent(T* W, int columns);

    const G& group() const { return group_; }
    /// Y of the last step, n x m: column a is the coefficient of the table's function a, less its value at
    /// nu.
    const Eigen::Matrix<T, n, Eigen::Dynamic>& coefficients() const { return Y_; }
    /// Steps of another length from now on.
    void setStep(const T& step) { h_ = step; }
    /// The impulse of the last step, which the first Jacobian of the next one takes for its own.
    void forget() { W_.setZero(); }
    void checkpoint(Archive& archive) requires std::is_same_v<T, double> { archive(W_); }

private:
    using Columns = Eigen::Matrix<T, n, Eigen::Dynamic>;
    using Square = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
    using Flat = Eigen::Matrix<T, Eigen::Dynamic, 1>;
    using Lagrangian = ChartLagrangian<T, G>;
    /// Of a product: the matrix is one of blocks, some of which are not there (product_jacobian.hpp).
    static constexpr bool isCoupled = requires(const Lagrangian& L) { L.couplings(); };
    /// Of a space on which the group acts: equations xi_k = 0 in place of some (data_group.hpp).
    static constexpr bool hasIsotropy = requires(const G& group) { group.isotropy(); };
    int m() const { return table_.unknowns(); }
    int d() const {
        if constexpr (n == Eigen::Dynamic)
            return group_.dimension();
        else
            return n;
    }
    /// The entries of function a in the flat vector, and block (a, c) of the Jacobian.
    auto part(int a) { return flat_.template segment<n>(d() * a, d()); }
    int nodes() const { return table_.nodes(); }
    /// The chart at xi: of a product the one of charts_, which has its room already.
    template <int K, class V>
    decltype(auto) chart(const V& xi) {
        if constexpr (isCoupled) {
            typename G::template Chart<K>& at = std::get<K>(charts_);
            at.place(xi);
            return (at);
        } else {
            return group_.template chart<K>(xi);
        }
    }
    /// The chart that leads from the start to the base point, beside the others.
    decltype(auto) chartToBase() {
        forXi_ = -begin_;
        if constexpr (isCoupled) {
            auto& at = std::get<3>(charts_);
            at.place(forXi_);
            return (at);
        } else {
            return group_.template chart<0>(forXi_);
        }
    }
    void placeNodes();
    void placeBase();
    bool predict();
    void residual();
    /// The matrix of lu_, to be filled.
    auto jacobian() requires(!isCoupled) { return Eigen::Map<Square>(lu_.column(0), d() * m(), d() * m()); }
    Outcome assembleJacobian();
    void fillJacobian() requires(!isCoupled);
    void fillJacobian() requires(isCoupled);
    void addEnds() requires(isCoupled);
    void addForceAt(int i, const typename G::template Chart<2>& at, const typename Lagrangian::ForceSlope& F,
                    const Matrix& toBase) requires(!isCoupled);
    template <class Node, class Chart, class End>
    void addForceAt(int i, const Chart& at, const Node& node, const End& end, const End& toBase,
                    const Couplings::Pair& pair);
    /// Calls f(a, c, factor(a) other(c)) for the functions for which neither is 0.
    template <class F>
    void forFunctions(const std::vector<T>& factor, const std::vector<T>& other, const F& f) const {
        for (int a = 0; a < m(); ++a)
            for (int c = 0; c < m(); ++c)
                if (const T both = valueOf(factor, a) * valueOf(other, c); both != T(0)) f(a, c, both);
    }
    static const T& valueOf(const std::vector<T>& of, int a) { return of[static_cast<std::size_t>(a)]; }
    T correction();
    void correct();
    void updateImpulse();
    Outcome iterate(const std::stop_token& stop);
    Vector vary(const Vector& base, bool movesY);
    /// Test functions of the table at node i.
    auto testAt(int i) const {
        return [this, i](int a) {
            return testFunction(table_.weight(i), h_, table_.value(i, a), table_.derivative(i, a));
        };
    }

    auto trialAt(int i) const {
        return [this, i](int c) { return TrialFunction<T>{table_.value(i, c), table_.derivative(i, c)}; };
    }

    G group_;
    Table<T> table_;  ///< with psi_a in place of phi_a
    T h_;
    T nu_;
    bool isUnreduced_;                ///< g is in the equations
    bool hasBegin_, hasEnd_;          ///< some function is not 0 there: the base point is not at that end
    std::vector<T> atBase_;           ///< phi_a(nu)
    std::vector<T> atBegin_, atEnd_;  ///< psi_a at the ends
    SolverPolicy policy_;
    T tolerance_;
    Lagrangian lagrangian_;
    StepGuess<T, G> guess_;

    Pose known_, base_;  ///< the start of the step; the base point of the chart
    typename G::Element knownElement_, baseElement_;
    Vector mu_, muBase_;  ///< the momentum that the step starts with, in the body there and at the base point
    Vector W_;
    Vector forXi_, forV_, begin_, end_;  ///< of a node; xi at the ends
    /// W in space, on spheres: summed there node by node, a component that no force has is 0 to the last bit.
    Vector inSpace_;
    Columns Y_, xi_, v_, force_, R_;
    Square atPoints_, fit_;  ///< (k, a): values at m points from Y, and the opposite
    Columns points_;
    std::conditional_t<isCoupled, BlockLu, SmallLu<T>> lu_;  ///< the Jacobian, then its factors
    bool isJoined_ = false;                                  ///< in one block
    struct None {};
    template <class H>
    static auto chartsOf(const G& group) {
        if constexpr (isCoupled)
            return std::tuple(
                typename H::template Chart<0>(group.group()), typename H::template Chart<1>(group.group()),
                typename H::template Chart<2>(group.group()), typename H::template Chart<0>(group.group()));
        else
            return None();
    }
    /// By derivatives, of a product; the last leads to the base point.
    decltype(chartsOf<G>(std::declval<const G&>())) charts_;
    Flat flat_;
    std::vector<T> times_;  ///< of the m points
    StepReport* report_ = nullptr;
};

}  // namespace extremal
