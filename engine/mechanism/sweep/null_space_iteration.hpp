// SPDX-License-Identifier: GPL-3.0-or-later
/// The step of a mechanism (mechanism_step.hpp) by sweeps over its nodes along the directions that the
/// constraints leave free, without a factorisation.
///
/// With the tests l_a and the places u_b at the Lobatto nodes e_0..e_m, u_0 = q_0, reactions are those of one
/// node each: of the rows
///     R_a = p_0 [a = 0] + sum_i b_i [h l_a (L_q + F) + l_a' L_v] + g_q(u_a)^T Lambda_a = 0,    a < m,
/// those along N_a, g_q(u_a) N_a = 0, have no multipliers. A sweep brings the places onto the constraints by
/// the coordinates that depend on others, and takes from E_a = N_a^T R_a
///     u_b <- u_b + N_b x_b,    x = -h J^-1 E,    J_ab = C_a^T K_ab C_b,    K_ab = sum_i b_i l_a' l_b',
/// where C_a^T C_a = N_a^T M N_a, M = L_vv at the start of some step. J is the derivative of E but for forces
/// and for how N turns in a step, of first order in h, so that sweeps contract by as much; K^-1 is known
/// beforehand. (The C are those of the first sweep.) The reactions that A is a sum of are what R_a has across
/// N_a.
///
/// The end of the iteration is that of all sweeps (solve/fixed_point_policy.hpp): a correction of a tenth of
/// what is asked for is not taken any more, as R and A belong to the places before it; to round-off it is,
/// and R is evaluated again. Where corrections shrink slowly, two of them tell the next (Anderson's mixing of
/// depth one).
#pragma once

#include <Eigen/Core>

#include <optional>
#include <stop_token>
#include <vector>

#include "engine/core/algebra/lanes.hpp"
#include "engine/core/outcome.hpp"
#include "engine/core/text/archive.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/mechanism_curve.hpp"
#include "engine/mechanism/sweep/coordinate_sharing.hpp"
#include "engine/mechanism/sweep/null_space_kernel.hpp"
#include "engine/solve/correction_size.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {

class NullSpaceIteration {
public:
    using Vector = Eigen::VectorXd;

    /// Of constraints that do not move and tell how coordinates depend on each other, on a Lagrangian that
    /// evaluates many nodes together, with its forces, if any; unless the policy asks for Newton's method, or
    /// for round-off of more than six functions. Nothing else.
    static std::optional<NullSpaceIteration> of(const Mechanism& mechanism, const MechanismCurve& curve,
                                                const SolverPolicy& policy);

    /// A step of length h that starts at t from (q, p).
    struct From {
        double t, h;
        const double *q, *p;
        const std::stop_token& stop;
    };
    /// Starts from the last curve that was solved here, where this step begins at its end with the same
    /// length. False where its increments would differ from the last ones by more than these, as at a turning
    /// point: a root near such a curve may be any.
    bool goOn(const From& from);
    /// Starts from what goOn() would, but from velocity and acceleration there alone.
    bool startFromEnd(const From& from);
    /// Starts from t v + t^2 a / 2, with velocity and acceleration at the start, or from Y (m x d), function
    /// by function. False where constraints depend on each other there.
    bool startFromMotion(const From& from, const Vector& v, const Vector& a);
    bool startFromCurve(const From& from, const Vector& v, const Vector& Y);
    /// From one of these. Converged: to the one root there is near the start. Diverged: to none, or to any.
    Outcome solve(StepReport& report);
    /// How far its start was from the root, against the increments of the step.
    double nearness() const { return nearness_; }

    /// Y of the last step.
    void curve(Eigen::Ref<Vector> Y) const;
    /// Lambda (m x n) of the last step, that from (t, q).
    void multipliers(double t, const double* q, Vector& Lambda) const;
    /// q_1 - q_0 of the last step, and A. From here on the next step is what this is about.
    void increments(Vector& dq, Vector& dp);
    /// Where L_v = M v with constant masses: the impulse of reactions that brings momenta p at the end of the
    /// last step onto the constraints on velocities. False where that is not so.
    bool project(const Vector& p, Vector& impulse) const;

    void checkpoint(Archive& archive);

private:
    /// In whole registers of eight, which a vector of numbers would not be aligned to.
    using Array = std::vector<Lanes>;

    NullSpaceIteration(const Mechanism& mechanism, const MechanismCurve& curve, const SolverPolicy& policy);
    /// The gradients that the sweeps take, and the model they belong to.
    struct Gradients {
        void (*call)(const void*, const double*, int, const double*, const double*, double*) = nullptr;
        const void* model = nullptr;
    };
    static Gradients gradientsOf(const Mechanism& mechanism);

    int freedoms() const { return d_ - n_; }
    void setStep(double h);
    bool start(const From& from, const Vector& v);
    bool share(const From& from);
    void prepare(const From& from);
    void evaluate();
    void countBy(int k, double increments);
    double measureAgain();
    CorrectionSize<double> measured();

    Mechanics<double> mechanics_;
    Constraint constraint_;
    CoordinateSharing sharing_;
    std::optional<Force> force_;  ///< what `gradients_` may be of
    Gradients gradients_;
    SolverPolicy policy_;
    double tolerance_, h_ = 0;
    bool isExact_;          ///< solve to round-off
    bool isTimeDependent_;  ///< forces, or L
    int d_, n_, m_, nodes_, places_, inside_;
    NullSpaceKernel kernel_ = nullSpaceKernel();
    Eigen::MatrixXd fit_, toPlaces_;  ///< Y by increments, and increments by Y
    /// As in NullSpaceSweep, but for h: by increments, by tests, K^-1; and the increments of the next
    /// step.
    Array value_, slope_, testValue_, testSlope_, weight_, inverse_, onward_;
    Vector velocityAtEnd_, accelerationAtEnd_;  ///< of the curve, by increments, but for powers of h
    Vector v_, a_;                              ///< room
    Array slopeOverH_, weightH_, inverseH_;     ///< with it
    Array nodeTime_, placeTime_, times_, placeTimes_;
    Array U_, previousU_, P_, Q_, V_, gradient_, N_, factor_, start_, R_, E_, S_, lastS_, change_,
        lastChange_;            ///< as in NullSpaceSweep
    std::vector<double> ends_;  ///< e_1..e_m
    std::vector<double> perSize_, least_;
    std::vector<ChangeSize> size_;
    const std::stop_token* stop_ = nullptr;
    NullSpaceSweep sweep_;    ///< of the step at hand
    bool hasLast_ = false;    ///< previousU_ is that of the last step
    bool isGoingOn_ = false;  ///< from the last curve
    bool hasCurve_ = false;   ///< U is that of the last step
    double nearness_ = 0;
    double contraction_ = 0;  ///< the slowest of the last step
};

}  // namespace extremal
