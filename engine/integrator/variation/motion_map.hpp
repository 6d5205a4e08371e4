// SPDX-License-Identifier: GPL-3.0-or-later
/// n equal steps of a scheme as a map of the state at their start and of their length:
///
///     x_n = Phi_h^n(x_0),   h = length / n,   M = d x_n / d x_0 = M_{n-1} ... M_0,
///
/// with the tangent maps M_k of the steps (Integrator::applyTangent), so that M is the derivative of the
/// discrete motion and not of the equations; of schemes without tangent maps it is a difference. Newton's
/// method on it finds periodic orbits (study/orbits) and motions between two positions
/// (scene/outlook/two_positions.hpp). The derivative by the length is a difference: it is only the means of
/// an iteration, whose residual is exact.
///
/// x: as many entries as the tangent map has. Trouble is an Outcome.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "engine/integrator/integrator.hpp"

namespace extremal {

/// Why a scheme has no such map with an exact derivative, as "it has ..."; empty: it has.
std::string motionMapProblem(const Integrator& integrator);

class MotionMap {
public:
    /// An integrator of a fixed grid without memory. `steps` at least 1.
    MotionMap(std::unique_ptr<Integrator> integrator, double start, long long steps);

    long long steps() const { return steps_; }
    double start() const { return start_; }
    /// Where the map begins, for systems that depend on time.
    void setStart(double t) { start_ = t; }
    void setStop(std::stop_token stop) { integrator_->setStop(std::move(stop)); }

    /// Where the last apply() failed: the time of the step.
    double failedAt() const { return failedAt_; }
    /// The image of x over `length`, which is not 0; M is filled unless null. refused: a step did more than
    /// go on, so that its tangent map is not the derivative of the map.
    Outcome apply(const Eigen::VectorXd& x, double length, Eigen::VectorXd& image, Eigen::MatrixXd* M);
    /// d image / d length, by central differences.
    Outcome slope(const Eigen::VectorXd& x, double length, Eigen::VectorXd& slope);
    /// The first step alone.
    Outcome firstStep(const Eigen::VectorXd& x, double length, Eigen::VectorXd& image);
    /// Calls see(k, state) for k = 0 .. n along the motion.
    template <class See>
    Outcome follow(const Eigen::VectorXd& x, double length, See&& see) {
        begin(x, length);
        see(0, std::as_const(state_));
        for (long long k = 1; k <= steps_; ++k) {
            if (const StepReport report = step(k); report.outcome != Outcome::converged)
                return report.outcome;
            see(k, std::as_const(state_));
        }
        return Outcome::converged;
    }

private:
    void begin(const Eigen::VectorXd& x, double length);
    StepReport step(long long k);
    Outcome differences(const Eigen::VectorXd& x, double length, Eigen::MatrixXd& M);

    std::unique_ptr<Integrator> integrator_;
    double start_;
    long long steps_;
    Clock clock_;
    State state_;
    double failedAt_ = 0;
};

/// Newton's method for the momenta p with which the motion from q arrives at `goal` after `length`: x = (q,
/// p) with a guess of p, which is replaced; J = dq_n/dp_0, a block of M. `misses`: |q_n - goal| of each
/// iterate, unless null. The Outcome of the method, or of a step on the way.
Outcome arrive(MotionMap& map, Eigen::VectorXd& x, double length, const Eigen::VectorXd& goal,
               std::vector<double>* misses = nullptr);

}  // namespace extremal
