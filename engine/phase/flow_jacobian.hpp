// SPDX-License-Identifier: GPL-3.0-or-later
/// The Jacobian of Hamilton's vector field X_H = (qdot, pdot), from the Hessian of L at v = v(q, p): with
/// M = L_vv,
///     v_q = -M^{-1} L_vq,  v_p = M^{-1},   pdot_q = L_qq + L_qv v_q,  pdot_p = L_qv v_p,
/// or of a Hamiltonian (model/phase_mechanics.hpp) from that of H itself, or of equations
/// of first order (model/first_order.hpp), which know it. For implicit baselines. Rows and
/// columns: q first, then p. Nothing is allocated after the constructor.
#pragma once

#include <optional>

#include "engine/core/algebra/lu.hpp"
#include "engine/model/first_order/first_order.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/model/phase_mechanics.hpp"

namespace extremal {

class FlowJacobian {
public:
    using Square = Eigen::MatrixXd;
    using Vector = Eigen::VectorXd;

    explicit FlowJacobian(const Mechanics<double>& mechanics);

    /// At (q, p), v = v(q, p) being known.
    const Square& evaluate(double t, const double* q, const double* p, const double* v);

    /// The one last evaluated.
    const Square& matrix() const { return matrix_; }

private:
    Mechanics<double> mechanics_;
    Vector gradient_;
    Square hessian_, matrix_, inverseMass_, vq_, identity_;
    Vector state_;
    std::optional<OwnFirstOrder> firstOrder_;
    Eigen::PartialPivLU<Square> massLu_;
};

}  // namespace extremal
