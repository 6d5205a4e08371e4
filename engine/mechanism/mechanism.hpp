// SPDX-License-Identifier: GPL-3.0-or-later
/// What a Lagrangian, constraints, rolling conditions and forces say together at one state.
///
/// The constraints g(t, q) = 0 and the rolling conditions r = a(t, q) v - b(t, q) = 0 are rows of one matrix:
/// g_q stands for [g_q; a] below, g_t for [g_t; -b], and lambda for the multipliers of both.
///
/// With the velocity v, the acceleration a and the multipliers lambda of a state on g(t, q) = 0,
///     L_vv a - g_q^T lambda = L_q + F - L_vq v - L_vt,    g_q a = -(v^T g_qq v + 2 g_qt v + g_tt):
/// constraints differentiated twice (index 1). These lambda are the reactions of the state; the multipliers
/// of a step are those of its discrete action, and less accurate one by one.
///
/// Projection: a momentum p becomes L_v(q, v) with L_v(q, v) = p + g_q^T kappa, g_q v + g_t = 0; a place q
/// becomes q - M^-1 g_q^T (..) until g = 0, M = L_vv.
///
/// L_vt is found by a difference, where L depends on time and on velocities together. Buffers are made in the
/// constructor: each thread and each integrator has its own Mechanism. Shapes as in model/parts.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>

#include "engine/mechanism/conditions.hpp"
#include "engine/mechanism/own_copy.hpp"
#include "engine/mechanism/state_equations.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/model/parts/constraint.hpp"
#include "engine/model/parts/force.hpp"
#include "engine/model/parts/rolling.hpp"
#include "engine/model/parts/wall.hpp"

namespace extremal {

/// By entries and in blocks (linkage.hpp) where that is less work, wherever it can be, or nowhere.
enum class LinkedAlgebra { automatic, always, never };

/// The parts by their entries where these are what a mechanism is to be solved by.
std::optional<LinkedParts> linkedParts(const Parts& parts, LinkedAlgebra algebra);

class Mechanism {
public:
    using Vector = Eigen::VectorXd;
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    /// The parts of a system with coordinates that move it.
    explicit Mechanism(const Parts& parts, LinkedAlgebra algebra = LinkedAlgebra::automatic);
    /// Whether there is more in it than a Lagrangian.
    static bool isOne(const Parts& parts) {
        return parts.find<Constraint>() || parts.find<Force>() || parts.find<Rolling>() || parts.find<Wall>();
    }

    const Mechanics<double>& mechanics() const { return mechanics_; }
    const std::optional<Constraint>& constraint() const { return conditions_.constraint; }
    const std::optional<Force>& force() const { return force_; }
    /// Set where its matrices are in blocks.
    const std::optional<LinkedParts>& linked() const { return linked_; }
    int dimension() const { return mechanics_.dimension; }
    const std::optional<Rolling>& rolling() const { return conditions_.rolling; }
    /// How many of the rows are constraints, and how many there are in all.
    int holonomic() const { return conditions_.holonomic(); }
    int constraints() const { return conditions_.count(); }
    const std::string& nameOf(int row) const { return conditions_.nameOf(row); }

    /// The rows at (t, q): g with 0 for rolling conditions, [g_q; a], [g_t; -b].
    void conditions(double t, const double* q, Vector& value, Rows& byPlace, Vector& byTime) {
        conditions_.evaluate(t, q, value, byPlace, byTime);
    }

    /// Acceleration and multipliers at (t, q, v). False where they are not determined. With a feedback alpha
    /// the differentiated constraints pull back (Baumgarte): g_q a = -(..) - 2 alpha (g_q v + g_t) -
    /// alpha^2 g.
    bool accelerate(double t, const double* q, const double* v, Vector& acceleration, Vector& multipliers,
                    double feedback = 0);
    /// Moves p onto the constraint and gives v; `kappa`: the multipliers that it took. v is the starting
    /// value where `knowsVelocity`. False where there is no solution.
    bool project(double t, const double* q, double* p, Vector& v, Vector& kappa, bool knowsVelocity = false);
    /// Moves q onto the constraint; velocities for the mass matrix are 0. False where it cannot.
    bool projectPlace(double t, double* q);
    /// Gives p an impulse J along `normal` after which normal . v = `target`, with velocities that stay on
    /// constraints: L_v(q, v) = p + normal J + g_q^T mu, g_q v + g_t = 0. Returns J; nothing where there is
    /// no solution.
    std::optional<double> strike(double t, const double* q, double* p, const double* normal, double target);
    /// Moves variations of what project() was given to those of its result p, column after column: of the
    /// place by dq, of the time by dt. `v` and `kappa` as it left them. False where there is no solution.
    bool varyProjection(double t, const double* q, const Vector& v, const Vector& kappa,
                        const Eigen::MatrixXd& dq, const Eigen::RowVectorXd& dt, Eigen::MatrixXd& dp);
    /// Derivatives by (q, p) of its result become those of what it was given; columns of 2 d.
    bool transposeProjection(double t, const double* q, const Vector& v, const Vector& kappa,
                             Eigen::Map<Eigen::MatrixXd> columns);
    /// The derivative of g_q v + g_t and of a v - b along dq, at a fixed velocity; `to` has its size.
    void rateAlong(double t, const double* q, const Vector& v, const Vector& dq, Vector& to);
    /// tr(F_v L_vv^-1) over the velocities that the conditions allow: the rate at which forces change volumes
    /// of phase space. Not a number where it is not determined.
    double expansion(double t, const double* q, const double* v);
    /// qdot = v and pdot = L_q + F + g_q^T lambda, of a state that need not be on the constraint.
    bool flow(double t, const double* q, const double* p, double* qdot, double* pdot, double feedback = 0);
    /// L_vv(k, k) where accelerate() was asked last.
    double mass(int k) const { return state_->mass(k); }
    /// g_q^T lambda and g_t at a place.
    void reaction(double t, const double* q, const Vector& lambda, Vector& to);
    const Vector& byTime(double t, const double* q);
    /// The largest |g_k| at (t, q), and the largest |g_q v + g_t| and |a v - b|.
    double largestValue(double t, const double* q);
    double largestRate(double t, const double* q, const double* v);
    /// Smallest over largest singular value of M^(-1/2) g_q^T, and the constraint that depends on others most
    /// nearly: redundant constraints have a ratio of round-off.
    struct Rank {
        double ratio = 1;
        int dependent = -1;
    };
    Rank rank(double t, const double* q);

private:
    /// Solves the equations of state_ for rhs_; false where they are singular.
    bool solveForState();
    /// The derivatives by time of g_q^T kappa, and of g_q v + g_t and a v - b.
    void byTimeOfConditions(double t, const double* q, const Vector& v, const Vector& kappa, Vector& reaction,
                            Vector& rate);

    Mechanics<double> mechanics_;
    Conditions conditions_;
    std::optional<Force> force_;
    std::optional<LinkedParts> linked_;
    OwnCopy<StateEquations> state_;
    Vector rates_, rate_, rhs_, sum_, given_, acceleration_, multipliers_;
    Vector ahead_, byTimeOfMomentum_;  ///< L' at another time; L_vt
};

}  // namespace extremal
