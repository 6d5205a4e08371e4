// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/flow_jacobian.hpp"

#include <limits>

namespace extremal {

FlowJacobian::FlowJacobian(const Mechanics<double>& mechanics)
    : mechanics_(mechanics),
      gradient_(Vector::Zero(2 * mechanics.dimension)),
      hessian_(Square::Zero(2 * mechanics.dimension, 2 * mechanics.dimension)),
      matrix_(hessian_),
      inverseMass_(Square::Zero(mechanics.dimension, mechanics.dimension)),
      vq_(inverseMass_),
      identity_(Square::Identity(mechanics.dimension, mechanics.dimension)),
      state_(gradient_),
      massLu_(mechanics.dimension) {
    for (int i = 0; i < mechanics.dimension && mechanics.isSeparable; ++i)
        matrix_(i, mechanics.dimension + i) = 1 / mechanics.masses[i];
    if (const FirstOrder* const equations = firstOrderOf(mechanics)) firstOrder_.emplace(*equations);
}

const FlowJacobian::Square& FlowJacobian::evaluate(double t, const double* q, const double* p,
                                                   const double* v) {
    const int d = mechanics_.dimension;
    if (const PhaseMechanics* const H = hamiltonianOf(mechanics_)) {
        H->hessian(H->model.get(), t, q, p, hessian_.data());
        matrix_.topRows(d) = hessian_.bottomRows(d);
        matrix_.bottomRows(d) = -hessian_.topRows(d);
        return matrix_;
    }
    if (firstOrder_) {
        state_ << Eigen::Map<const Vector>(q, d), Eigen::Map<const Vector>(p, d);
        if (const Square* const slope = (*firstOrder_)->jacobian(state_.data()))
            matrix_ = *slope;
        else
            matrix_.setConstant(std::numeric_limits<double>::quiet_NaN());
        return matrix_;
    }
    double value = 0;
    mechanics_.jet(mechanics_.model.get(), t, q, v, &value, gradient_.data(), hessian_.data());
    if (mechanics_.isSeparable) {
        matrix_.bottomLeftCorner(d, d) = hessian_.topLeftCorner(d, d);
        return matrix_;
    }
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

}  // namespace extremal
