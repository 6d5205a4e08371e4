/// The time-independent problem: stationary points of -v* H v + lambda (1 - v* W v), that is
///     H v = E W v,  E = -lambda,  v* W v = 1:
/// the multiplier of the norm is the energy (the printed equations have -lambda v and lack the mass). Dense, Hermitian H, positive W.
///
/// Newton's method on the KKT system
///     [ H - E W   -W v ] [dv]   [ -(H v - E W v)    ]
///     [ -(W v)*     0  ] [dE] = [ -(1 - v* W v)/2   ]
/// converges quadratically from any guess near a state, and does not shift it.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/wave/hamiltonian.hpp"

namespace extremal {

struct StationaryProblem {
    Eigen::MatrixXcd H, W;
};

struct StationaryState {
    double energy = 0;
    Eigen::VectorXcd v;
    std::vector<double> history;  ///< energies from the guess on
    bool isConverged = false;
};

/// The lowest n states of the whole spectrum, by reduction to diagonal form.
std::vector<StationaryState> lowestStates(const StationaryProblem& problem, int n);

/// Newton from a guess; stops when the energy moves by less than 1e-15 of its size, or after 12 steps.
StationaryState refineState(const StationaryProblem& problem, const Eigen::VectorXcd& v, double energy);

/// The operator of the pseudo-spectral method, at the nodes; W = 1.
StationaryProblem pseudoSpectral(const Hamiltonian& hamiltonian);

/// The seed's Galerkin method: the convolution with V taken exactly over a, b = -N/2 .. N/2 with weights 1/2 at the ends of all
/// three sums, then the coefficients at N/2 and -N/2 identified, by adding both rows and both columns. Hermitian, with W = 1/2
/// there; the printed equation keeps one of the rows and is not.
StationaryProblem convolutionGalerkin(const Hamiltonian& hamiltonian);

/// W^{-1/2} H W^{-1/2} of a problem in Fourier coefficients with diagonal W, in the coordinates of the inverse transform: real
/// and symmetric, as complex conjugation commutes with it.
Eigen::MatrixXd realMatrix(const StationaryProblem& problem, const Fourier& fourier);

/// An interval [left, left + L] with psi = 0 at both ends: polynomials of degree N through Chebyshev points, mass, stiffness and
/// potential from the action by 2N + 1 Clenshaw-Curtis nodes. Symmetric, so that its Gauss steps are unitary in the mass;
/// collocation with squared differentiation matrices is not.
StationaryProblem chebyshevInterval(int N, const wave::Domain& domain, double hbar, double mass, const wave::Potential& potential);

}  // namespace extremal
