// SPDX-License-Identifier: GPL-3.0-or-later
/// The fixed point of a cell (phase/phase_cell.hpp) for a Hamiltonian whose gradients are known at many nodes
/// together: a sweep places all nodes by the gradients of the sweep before, and evaluates there.
///
/// Arrays by columns of `rows` nodes, a multiple of 8; those beyond the last node repeat it. Columns of
/// gradients: H_q, then H_p. Nothing is allocated after the constructor.
#pragma once

#include <Eigen/Core>

#include "engine/core/algebra/small_product.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/phase/phase_cell.hpp"

namespace extremal {

class PhaseLanes {
public:
    using Matrix = Eigen::MatrixXd;

    PhaseLanes(const PhaseMechanics& mechanics, const SharedCell& cell);

    /// The rates from which sweeps go on: H_p and -H_q at the nodes, node i, coordinate k.
    void start(const Eigen::Ref<const Matrix>& K, const Eigen::Ref<const Matrix>& F);
    /// Those of a constant field: H_p and -H_q at (q0, p0).
    void startAt(double t, const double* q0, const double* p0);
    /// Gives what it has changed, each coordinate against its own increments and the round-off of its value;
    /// infinity where that is not finite.
    double sweep(double t, double h, const double* q0, const double* p0);
    /// The rates of the last sweep.
    void rates(Eigen::Ref<Matrix> K, Eigen::Ref<Matrix> F) const;

private:
    int d() const { return H_.dimension; }
    int rows() const { return static_cast<int>(times_.size()); }
    void setStep(double h);
    double change(double h, const double* q0, const double* p0);

    PhaseMechanics H_;
    SharedCell cell_;
    NodeSums sums_;
    double h_ = 0;
    Matrix A_, B_;  ///< h A and -h B
    Eigen::VectorXd fromStart_, times_;
    Matrix places_, gradients_, next_;  ///< places: q, then p
    Eigen::VectorXd moved_, size_;      ///< by column of the gradients; in eights
};

}  // namespace extremal
