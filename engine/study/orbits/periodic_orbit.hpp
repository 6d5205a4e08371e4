// SPDX-License-Identifier: GPL-3.0-or-later
/// Periodic orbits of the discrete motion, by Newton's method on the tangent map of its steps:
///
///     Phi_h^n(x) = x + w,   h = T / n,                                n fixed, w whole turns of angles
///     f . (x - x_ref) = 0                                             a motion without explicit time
///     H(x) = E   (energy held),   or T given                          of a family of orbits, this one
///
/// for x and, without explicit time, T. What is found closes to round-off, and is an orbit of the scheme; how
/// far it is from one of the equations is said by the same with half the step. The multipliers are the
/// eigenvalues of M = d Phi_h^n / d x, on a manifold of constraints of M along it.
///
/// There are more equations than unknowns where the energy is kept, and fewer where a symmetry moves orbits
/// into others: a correction is the least-squares one of least norm, with singular values below `rankFloor`
/// of the largest left out. Entries of x are measured in their size along the guess, T in that of the guess.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <stop_token>
#include <vector>

#include "engine/integrator/variation/motion_map.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/study/orbits/orbit_facts.hpp"

namespace extremal {

/// What makes an orbit: a start, and how long it takes.
struct OrbitGuess {
    Eigen::VectorXd x;
    double period = 0;
};
OrbitGuess guessOf(const PeriodicOrbit& orbit);

/// The equations of the orbits of one scheme of a scene with n steps.
class OrbitEquations {
public:
    /// The scene must outlive it. Throws InvalidScene where the scheme has no map or the system no such
    /// orbits.
    OrbitEquations(std::shared_ptr<const ResolvedScene> scene, std::size_t scheme, long long steps);

    OrbitKind kind() const { return kind_; }
    long long steps() const { return map_.steps(); }
    const System& system() const { return *system_; }
    double start() const { return map_.start(); }
    double energyAt(const Eigen::VectorXd& x) const;
    void setStop(const std::stop_token& stop) { map_.setStop(stop); }

    /// Sizes, turns and the phase condition, from a guess. Throws InvalidScene where it is at rest, fails on
    /// the way, or takes a time that is not a period of the equations.
    void measure(const OrbitGuess& guess);
    /// The sizes and turns of others, for the orbits of a family; the phase condition is that of the guess.
    void measureAs(const OrbitEquations& other, const OrbitGuess& guess);
    void hold(OrbitHold what, double value);
    OrbitHold held() const { return hold_; }

    /// Number of unknowns: variations of x, and T where it is free.
    Eigen::Index unknowns() const { return free_ + (isPeriodFree() ? 1 : 0); }
    bool isPeriodFree() const { return kind_ != OrbitKind::forced && hold_ != OrbitHold::period; }

    struct Residual {
        Eigen::VectorXd value;       ///< of all equations, each over its size
        Eigen::MatrixXd derivative;  ///< by the unknowns, each over its size
        Eigen::MatrixXd M;
        double gap = 0;
    };
    Outcome evaluate(const OrbitGuess& at, Residual& residual, bool isDerivativeWanted);
    /// The guess moved by unknowns over their sizes, on constraints put back onto them.
    OrbitGuess moved(const OrbitGuess& from, const Eigen::VectorXd& by) const;
    /// The inverse, to first order: where `to` is from `from`.
    Eigen::VectorXd between(const OrbitGuess& from, const OrbitGuess& to) const;

    /// The orbit that a guess is where these equations are solved; `closes`: the gaps of the iterates.
    PeriodicOrbit orbitAt(const OrbitGuess& at, const Residual& residual, std::vector<double> closes) const;
    OrbitStability stabilityOf(const PeriodicOrbit& orbit) const;
    /// How many multipliers are 1 by themselves.
    std::size_t trivial() const {
        return kind_ == OrbitKind::conservative ? 2 : kind_ == OrbitKind::dissipative ? 1 : 0;
    }
    /// The motion of an orbit at its nodes.
    Outcome follow(const OrbitGuess& orbit, std::vector<State>& nodes);
    double failedAt() const { return map_.failedAt(); }

private:
    Eigen::MatrixXd basisAt(const Eigen::VectorXd& x) const;
    void setPhase(const OrbitGuess& guess);

    std::shared_ptr<const ResolvedScene> scene_;
    const System* system_;
    EnergyFunction energy_;
    OrbitKind kind_;
    MotionMap map_;
    Eigen::Index free_;          ///< variations of x
    Eigen::VectorXd sizes_;      ///< of the entries of x
    Eigen::VectorXd turns_;      ///< w
    Eigen::VectorXd phase_, x_;  ///< f over the sizes, of length 1, and x_ref
    double time_ = 1;            ///< the size of T
    OrbitHold hold_ = OrbitHold::nothing;
    double held_ = 0;
};

/// The least-squares solution of least norm of J d = -r, with small singular values left out.
Eigen::VectorXd leastCorrection(const Eigen::MatrixXd& J, const Eigen::VectorXd& r);

}  // namespace extremal
