// SPDX-License-Identifier: GPL-3.0-or-later
/// A step on the harmonic oscillator, and the intervals of z = step * frequency in which it is unstable.
///
/// On L = (v^2 - w^2 q^2)/2 the discrete action of one step is a quadratic form of the coefficients y =
/// (q_0, those inside the step, q_1),
///     S = (y^T K y - z^2 y^T M y) / 2,    K_ab = sum_i b_i phi_a' phi_b',   M_ab = sum_i b_i phi_a phi_b,
/// with h = 1. The step maps (q_0, p_0) to (q_1, p_1) with determinant 1; it is unstable where half its trace
/// is beyond 1 in magnitude. Half the trace is 1 where a periodic function (q_1 = q_0) is stationary, and -1
/// where an antiperiodic one (q_1 = -q_0) is: all ends of the intervals are among the roots of
///     K y = z^2 M y    on periodic and on antiperiodic functions.
/// For a symplectic partitioned Runge-Kutta method with the tableaus A, Ahat the same conditions on the
/// stages read
///     Q / z^2 = -(I - 1 bHat^T) A (I - 1 b^T) Ahat Q     (periodic),
///     Q / z^2 = -(A - 1 b^T / 2) (Ahat - 1 bHat^T / 2) Q (antiperiodic).
/// Nothing is searched for: the eigenvalues divide the axis, half the trace in the middle of two neighbours,
/// in quadruple precision, says whether what is between them is unstable, and the ends are then bisected to
/// round-off. Compositions are assembled in the same way from their parts.
///
/// Source: the theory of Hill's equation; Leok 2004, sec. 2, for the action.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <vector>

#include "engine/integrator/unstable_interval.hpp"
#include "engine/tableau/splitting_table.hpp"
#include "engine/tableau/tableau.hpp"

namespace extremal {

/// K and M, rows and columns in the order start, inside, end. The function 1 is the sum of the first and the
/// last function, as those inside vanish at both ends and are no part of it.
struct OscillatorAction {
    Eigen::MatrixXd stiffness, mass;
};

class OscillatorStep {
public:
    using Matrix = Eigen::Matrix<Quad, Eigen::Dynamic, Eigen::Dynamic>;
    explicit OscillatorStep(const OscillatorAction& action);
    /// Of K and M in quadruple precision.
    OscillatorStep(Matrix stiffness, Matrix mass);
    /// Of a symplectic method.
    explicit OscillatorStep(std::shared_ptr<const Tableau> tableau);
    /// One after the other over parts g_i of the step, sum g_i = 1.
    OscillatorStep composed(std::vector<double> parts) const;

    /// Not a number where the equations of the step are singular.
    Quad halfTrace(double z) const;
    /// Logarithm of the factor by which a step magnifies: arcosh |half trace|, 0 where it is stable, infinity
    /// where its equations are singular.
    double growth(double z) const;
    /// Number of eigenvalues of either problem.
    Eigen::Index unknowns() const;
    /// All intervals that begin below z = 10^4, ascending. Left out are those whose growth stays below what
    /// rounding the coefficients does: 1e-12 per step where they are in quadruple precision, 1e-7 where
    /// they are in double.
    std::vector<UnstableInterval> intervals() const;

private:
    Eigen::Matrix<Quad, 2, 2> partMap(const Quad& square) const;
    OscillatorAction assembled() const;
    std::vector<double> candidates() const;

    Matrix stiffness_, mass_;                 ///< of one part; empty where there is a tableau
    bool isRounded_ = false;                  ///< their entries are in double precision
    std::shared_ptr<const Tableau> tableau_;  ///< of one part
    Matrix forth_;                            ///< A Ahat
    std::vector<double> parts_{1.0};
};

/// The largest stable step * frequency of a splitting. Remembered: finding it takes longer than most scenes.
double stabilityLimit(const Splitting& splitting);

}  // namespace extremal
