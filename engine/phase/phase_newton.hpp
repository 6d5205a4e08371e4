// SPDX-License-Identifier: GPL-3.0-or-later
/// Newton's method for the cell of a Hamiltonian (phase/phase_cell.hpp), and its tangent map.
///
/// Unknowns (alpha, beta - e_1 p_0), both increments, entry (a, k) of each at a d + k; with H'' at the nodes
///     d alpha - h ofRates (H_pq dq + H_pp dp) = ..,    d beta + h ofForces (H_qq dq + H_qp dp) = ..,
///     dq = phi d alpha,   dp = psi d beta.
/// At the solution the same matrix gives the tangent map. Nothing is allocated after the constructor, but for
/// the factors of large systems.
#pragma once

#include <Eigen/Core>

#include <span>
#include <stop_token>
#include <vector>

#include "engine/core/algebra/lu.hpp"
#include "engine/core/outcome.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/phase/phase_cell.hpp"
#include "engine/solve/small_lu.hpp"

namespace extremal {

class PhaseNewton {
public:
    using Vector = Eigen::VectorXd;
    using Matrix = Eigen::MatrixXd;

    PhaseNewton(const PhaseMechanics& mechanics, const SharedCell& cell);

    /// The unknowns that K and F at the nodes make.
    void startFrom(double h, const Eigen::Ref<const Matrix>& K, const Eigen::Ref<const Matrix>& F);
    /// Counts its work in the report.
    Outcome solve(double t, double h, const Eigen::Ref<const Vector>& q0, const Eigen::Ref<const Vector>& p0,
                  double tolerance, int maxIterations, const std::stop_token& stop, StepReport& report);
    /// q and p at the nodes, node i, coordinate k.
    void place(const Eigen::Ref<const Vector>& q0, const Eigen::Ref<const Vector>& p0, Eigen::Ref<Matrix> Q,
               Eigen::Ref<Matrix> P) const;
    /// W <- M W at the nodes of a solution; false where it does not exist.
    bool applyTangent(double t, double h, const Eigen::Ref<const Matrix>& Q,
                      const Eigen::Ref<const Matrix>& P, std::span<double> W);

    Vector& unknowns() { return x_; }

private:
    int d() const { return H_.dimension; }
    int size() const { return 2 * cell_->unknowns() * d(); }

    void residual(double t, double h);
    void measure(double h, const Eigen::Ref<const Vector>& q0, const Eigen::Ref<const Vector>& p0,
                 double& size, double& floor) const;
    void assemble(double t, double h);
    Outcome factorise();
    void solveFor(double* x);

    PhaseMechanics H_;
    SharedCell cell_;
    Vector x_, r_;                ///< (alpha, beta - e_1 p_0), and the residual
    Matrix Q_, P_;                ///< coordinate k, node i
    std::vector<Matrix> second_;  ///< H'' at each node
    Vector gradient_, rhs_;
    Matrix moved_;  ///< d(q, p) at the nodes, of the tangent map
    static constexpr int small = 64;
    Matrix matrix_;
    SmallLu<double> lu_;
    Eigen::PartialPivLU<Matrix> large_;
};

}  // namespace extremal
