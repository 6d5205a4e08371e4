// SPDX-License-Identifier: GPL-3.0-or-later
/// Polynomials on [-1, 1] that vanish at both ends, for wave functions with a Dirichlet boundary.
///
/// Through N + 1 Chebyshev extrema, N = n + 1, psi = sum_j u_j phi_j over the n inner ones. The action's
/// integrals over x by Clenshaw-Curtis with 2N + 1 nodes (exact to degree 2N + 1) give
///     mass       M_ij = sum_k w_k phi_i(y_k) phi_j(y_k)    = R^T R,   R upper triangular
///     stiffness  K_ij = sum_k w_k phi_i'(y_k) phi_j'(y_k)
/// both symmetric, and i hbar M u' = (hbar^2/2m K + V) u. The state of a run is c = R u: then |c|^2 = u* M u
/// is the norm squared of the discrete inner product, and the operator R^-T (..) R^-1 is real and symmetric.
/// Squared differentiation matrices at the nodes are not, and lose the norm.
///
/// An Interval is immutable; lengths are those of [-1, 1]. What has no dimension here gets it in
/// wave/hamiltonian.hpp.
#pragma once

#include <Eigen/Core>

#include <complex>
#include <memory>

namespace extremal {

class Interval {
public:
    /// Remembered for each n. Any thread may ask.
    static std::shared_ptr<const Interval> of(int n);
    explicit Interval(int n);

    int size() const { return static_cast<int>(nodes.size()); }

    Eigen::VectorXd nodes;            ///< the n inner ones, ascending
    Eigen::VectorXd points, weights;  ///< of the rule; point 2j + 2 is node j, point N the middle
    /// (i, k): basis function i, of which c are the coordinates, and its derivative at point k.
    Eigen::MatrixXd values, slopes;
    Eigen::MatrixXd kinetic;      ///< R^-T K R^-1
    Eigen::MatrixXd factor;       ///< R: u to c
    Eigen::MatrixXd inverse;      ///< c to u
    Eigen::MatrixXd coefficient;  ///< (k, i): Chebyshev coefficient k = 0 .. N of basis function i
};

namespace chebyshev {

/// Extrema in [-1, 1], N + 1 of them, ascending.
Eigen::VectorXd extrema(int N);
/// (i, j): the cardinal polynomial of node j at point i, for extrema as the nodes; barycentric.
Eigen::MatrixXd cardinals(const Eigen::VectorXd& points, const Eigen::VectorXd& nodes);
/// (i, j): its derivative at node i.
Eigen::MatrixXd differentiation(const Eigen::VectorXd& nodes);

}  // namespace chebyshev

/// out = A v, for a real A. Not in place.
void multiply(const Eigen::MatrixXd& A, const std::complex<double>* v, std::complex<double>* out);

}  // namespace extremal
