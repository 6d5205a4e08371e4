// SPDX-License-Identifier: GPL-3.0-or-later
/// The Jacobian of Hamilton's vector field X_H = (qdot, pdot), from the Hessian of L at v = v(q, p): with
/// M = L_vv,
///     v_q = -M^{-1} L_vq,  v_p = M^{-1},   pdot_q = L_qq + L_qv v_q,  pdot_p = L_qv v_p,
/// or of a Hamiltonian (model/phase_mechanics.hpp) from that of H itself, or of a one-form
/// (model/one_form.hpp) from its second derivatives. For implicit baselines. Rows and
/// columns: q first, then p. Nothing is allocated after the constructor.
#pragma once

#include <Eigen/LU>

#include <limits>
#include <optional>

#include "engine/model/mechanics.hpp"
#include "engine/model/one_form.hpp"
#include "engine/model/phase_mechanics.hpp"

namespace extremal {

class FlowJacobian {
public:
    using Square = Eigen::MatrixXd;
    using Vector = Eigen::VectorXd;

    explicit FlowJacobian(const Mechanics<double>& mechanics)
        : mechanics_(mechanics),
          gradient_(Vector::Zero(2 * mechanics.dimension)),
          hessian_(Square::Zero(2 * mechanics.dimension, 2 * mechanics.dimension)),
          matrix_(hessian_),
          inverseMass_(Square::Zero(mechanics.dimension, mechanics.dimension)),
          vq_(inverseMass_),
          identity_(Square::Identity(mechanics.dimension, mechanics.dimension)),
          state_(gradient_),
          massLu_(mechanics.dimension) {
        if (const OneForm* const form = oneFormOf(mechanics)) oneForm_.emplace(*form);
    }

    /// At (q, p), v = v(q, p) being known.
    const Square& evaluate(double t, const double* q, const double* p, const double* v) {
        const int d = mechanics_.dimension;
        if (const PhaseMechanics* const H = hamiltonianOf(mechanics_)) {
            H->hessian(H->model.get(), t, q, p, hessian_.data());
            matrix_.topRows(d) = hessian_.bottomRows(d);
            matrix_.bottomRows(d) = -hessian_.topRows(d);
            return matrix_;
        }
        if (oneForm_) {
            state_ << Eigen::Map<const Vector>(q, d), Eigen::Map<const Vector>(p, d);
            if (const Square* const slope = oneForm_->jacobian(state_.data()))
                matrix_ = *slope;
            else
                matrix_.setConstant(std::numeric_limits<double>::quiet_NaN());
            return matrix_;
        }
        double value = 0;
        mechanics_.jet(mechanics_.model.get(), t, q, v, &value, gradient_.data(), hessian_.data());
        massLu_.compute(hessian_.bottomRightCorner(d, d));
        inverseMass_ = massLu_.solve(identity_);
        vq_.noalias() = -inverseMass_.lazyProduct(hessian_.bottomLeftCorner(d, d));
        matrix_.topLeftCorner(d, d) = vq_;
        matrix_.topRightCorner(d, d) = inverseMass_;
        matrix_.bottomLeftCorner(d, d) =
            hessian_.topLeftCorner(d, d) + hessian_.topRightCorner(d, d).lazyProduct(vq_);
        matrix_.bottomRightCorner(d, d) = hessian_.topRightCorner(d, d).lazyProduct(inverseMass_);
        return matrix_;
    }

    /// The one last evaluated.
    const Square& matrix() const { return matrix_; }

private:
    Mechanics<double> mechanics_;
    Vector gradient_;
    Square hessian_, matrix_, inverseMass_, vq_, identity_;
    Vector state_;
    std::optional<OneFormEquations> oneForm_;
    Eigen::PartialPivLU<Square> massLu_;
};

}  // namespace extremal
