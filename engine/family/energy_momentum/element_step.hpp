// SPDX-License-Identifier: GPL-3.0-or-later
/// The step of a table from a fixed (q_0, p_0), as a function of its length h: the inner problem of the
/// energy equation.
///
/// For each h the discrete Euler-Lagrange equations of the element, with z = (q_0, Y) as in
/// action/element_kernel.hpp,
///     dS/dY_a = 0 (a < m - 1),    p_0 + dS/dq_0 - dS/dY_{m-1} = 0,
/// are solved for Y by Newton's method. Then q_1 = q_0 + Y_{m-1}, p_1 = p_0 + dS/dq_0, the discrete energy is
///     E_d(h) = -dS/dh = sum_i b_i [ L_v . v - L ],
/// and along the solutions Y(h)
///     dE_d/dh = -d2S/dh2 - (d2S/dY dh) . dY/dh,    J dY/dh = -dR/dh,
/// with J and R the Jacobian and the left-hand sides above. The solution for one h, carried on by dY/dh, is
/// the starting value for the next; the first starts from q_0 + h v_0. What a previous step was is of no use
/// here (extrapolating it saved no iteration), so that steps depend on nothing but their start. Where
/// Newton's method fails at an edge of the domain of L, the root of a short step is followed to the whole one
/// (solve/step_continuation.hpp).
///
/// Index roles: unknown a of coordinate k at a d + k. All buffers are allocated in the constructor. Source:
/// Leok 2004, sec. 5, with the corrected sign: E_d of consecutive elements is equal.
#pragma once

#include <Eigen/Core>

#include <span>
#include <stop_token>

#include "engine/action/element_kernel.hpp"
#include "engine/core/outcome.hpp"
#include "engine/solve/newton_policy.hpp"
#include "engine/solve/small_lu.hpp"

namespace extremal {

class ElementStep {
public:
    ElementStep(Mechanics<double> mechanics, Table<double> table, const SolverPolicy& policy);

    int dimension() const { return mechanics_.dimension; }

    /// Steps begin at (q, p) from now on.
    void startAt(const double* q, const double* p);

    /// Solves for one length of the step, of either sign. What it cost is added to the report.
    Outcome solve(double t, double h, const std::stop_token& stop, StepReport& report);

    // Of the last solution:
    double step() const { return h_; }
    double discreteEnergy() const { return -derivatives_.byStep; }
    double energyByStep() const { return energyByStep_; }
    /// Size of the terms of E_d, to which its round-off is relative.
    double energyScale() const;
    /// q_1 - q_0 and p_1 - p_0.
    double positionChange(int k) const { return Y_(Y_.size() - dimension() + k); }
    double momentumChange(int k) const { return derivatives_.gradient(k); }

    /// W <- M W for columns (dt, dq, -dE, dp), with the tangent map M of the last solution as a step of
    /// energy E = E_d. One equation and one unknown more than Newton's method has:
    ///     J dY + R_h dh = -R_q dq_0 - R_p dp_0,    -S_hY dY - S_hh dh = dE + S_hq dq_0.
    /// False where it is singular.
    bool applyTangent(double* W, int columns);

    /// The trial curve of the last solution at tau, and p by the momentum equation integrated to tau.
    void denseOutput(double t, double tau, std::span<double> x) const;

private:
    using Vector = Eigen::VectorXd;
    int unknowns() const { return static_cast<int>(Y_.size()); }
    bool evaluate(double t, double h, StepReport& report);
    Outcome newton(double t, double h, const std::stop_token& stop, StepReport& report);
    bool startAfresh(double t, double h);
    void findMasses(double t, double h);
    bool retreat(double t, double h, StepReport& report);
    void followStep();

    Mechanics<double> mechanics_;
    Table<double> table_;
    ElementKernel<double> kernel_;
    ElementDerivatives<double> derivatives_;
    SmallLu<double> lu_, extended_;  ///< extended_: of the tangent map, made where it is asked for
    Vector moved_;                   ///< (dY, dh), then (dq_0, dY)
    SolverPolicy policy_;
    double tolerance_;
    Vector z_, Y_, byStep_, residual_;  ///< z = (q_0, Y); byStep: dY/dh
    Vector p0_, velocity_, masses_, gradient_, hessian_;
    double h_ = 0, energyByStep_ = 0;
    bool isSolved_ = false;       ///< Y_ belongs to h_ and to this start
    bool hasLeftDomain_ = false;  ///< Newton's method did: L has an edge nearby
};

}  // namespace extremal
