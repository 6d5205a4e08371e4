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

#include "engine/model/mechanics.hpp"
#include "engine/model/parts/constraint.hpp"
#include "engine/model/parts/force.hpp"
#include "engine/model/parts/rolling.hpp"
#include "engine/model/parts/wall.hpp"
#include "engine/solve/small_lu.hpp"

namespace extremal {

class Mechanism {
public:
    using Vector = Eigen::VectorXd;
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    /// The parts of a system with coordinates that move it.
    explicit Mechanism(const Parts& parts);
    /// Whether there is more in it than a Lagrangian.
    static bool isOne(const Parts& parts) {
        return parts.find<Constraint>() || parts.find<Force>() || parts.find<Rolling>() || parts.find<Wall>();
    }

    const Mechanics<double>& mechanics() const { return mechanics_; }
    const std::optional<Constraint>& constraint() const { return constraint_; }
    const std::optional<Force>& force() const { return force_; }
    int dimension() const { return mechanics_.dimension; }
    const std::optional<Rolling>& rolling() const { return rolling_; }
    /// How many of the rows are constraints, and how many there are in all.
    int holonomic() const { return constraint_ ? constraint_->count() : 0; }
    int constraints() const { return holonomic() + (rolling_ ? rolling_->count() : 0); }
    const std::string& nameOf(int row) const {
        return row < holonomic() ? constraint_->names[static_cast<std::size_t>(row)]
                                 : rolling_->names[static_cast<std::size_t>(row - holonomic())];
    }

    /// The rows at (t, q): g with 0 for rolling conditions, [g_q; a], [g_t; -b].
    void conditions(double t, const double* q, Vector& value, Rows& byPlace, Vector& byTime);

    /// Acceleration and multipliers at (t, q, v). False where they are not determined.
    bool accelerate(double t, const double* q, const double* v, Vector& acceleration, Vector& multipliers);
    /// Moves p onto the constraint and gives v; `kappa`: the multipliers that it took. v is the starting
    /// value where `knowsVelocity`. False where there is no solution.
    bool project(double t, const double* q, double* p, Vector& v, Vector& kappa, bool knowsVelocity = false);
    /// Moves q onto the constraint; velocities for the mass matrix are 0. False where it cannot.
    bool projectPlace(double t, double* q);
    /// Gives p an impulse J along `normal` after which normal . v = `target`, with velocities that stay on
    /// constraints: L_v(q, v) = p + normal J + g_q^T mu, g_q v + g_t = 0. Returns J; nothing where there is
    /// no solution.
    std::optional<double> strike(double t, const double* q, double* p, const double* normal, double target);
    /// qdot = v and pdot = L_q + F + g_q^T lambda, of a state that need not be on the constraint.
    bool flow(double t, const double* q, const double* p, double* qdot, double* pdot);
    /// L_vv(k, k) where accelerate() was asked last.
    double mass(int k) const { return hessian_(dimension() + k, dimension() + k); }
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
    bool factoriseSaddle();
    void evaluate(double t, const double* q, const double* v);

    Mechanics<double> mechanics_;
    std::optional<Constraint> constraint_;
    std::optional<Force> force_;
    std::optional<Rolling> rolling_;
    SmallLu<double> lu_;
    Rows hessian_, byPlace_;
    Vector gradient_, value_, byTime_, rates_, forces_, rhs_, velocity_, acceleration_, multipliers_;
    Vector byTimeOfMomentum_;                     ///< L_vt
    Vector rollingValue_, rollingByTime_, rest_;  ///< r and r_t; no velocities
    Rows rollingByState_;
};

}  // namespace extremal
