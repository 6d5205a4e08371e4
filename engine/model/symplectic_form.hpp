// SPDX-License-Identifier: GPL-3.0-or-later
/// The symplectic form of a system's phase space, in the coordinates of its variations (integrator.hpp):
///     w(a, b) = a_q . b_p - a_p . b_q,
/// on the cotangent bundle of a group, left trivialised, a = (zeta_a, mu_a), at the momentum mu
///     w(a, b) = zeta_a . mu_b - mu_a . zeta_b + mu . [zeta_a, zeta_b],
/// so that Om(mu) = [[-[mu]x, 1], [-1, 0]] on SO(3). `mu` is in the body: (Pi, p) on SE(3), where
/// [(u, v), (u', v')] = (u x u', u x v' - u' x v).
/// Of a one-form it is its derivative, w(a, b) = -a . Om(x) b (model/first_order/one_form.hpp).
#pragma once

#include <cstddef>
#include <optional>

#include "engine/group/so3.hpp"
#include "engine/model/first_order/one_form.hpp"
#include "engine/model/group/group_mechanics.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/model/system.hpp"

namespace extremal {

class SymplecticForm {
public:
    explicit SymplecticForm(const System& system) {
        if (const OneForm* const form = system.parts.find<OneForm>()) oneForm_.emplace(*form);
        if (const Body* const body = system.parts.find<Body>())
            group_ = static_cast<std::size_t>(body->dimension);
        if (const LieGroup* const given = system.parts.find<LieGroup>()) data_ = given->mechanics;
    }

    /// Of two variations of length n at the state x.
    double operator()(const double* x, const double* a, const double* b, std::size_t n) const {
        if (oneForm_) return ofOneForm(x, a, b);
        const std::size_t half = n / 2;
        double sum = 0;
        for (std::size_t i = 0; i < half; ++i) sum += a[i] * b[half + i] - a[half + i] * b[i];
        if (data_) return sum + bracketOfData(x, a, b);
        return group_ == 0 ? sum : sum + bracket(x, a, b);
    }

private:
    using Three = so3::Vector<double>;

    /// mu . [zeta_a, zeta_b] at a state of a body (model/body/body.hpp).
    double bracket(const double* x, const double* a, const double* b) const {
        const auto part = [](const double* v) { return Three(v[0], v[1], v[2]); };
        const Three u = part(a), other = part(b);
        double sum = part(x + 4).dot(so3::cross(u, other));
        if (group_ < 6) return sum;
        const so3::Matrix<double> R = so3::matrix(so3::Quaternion<double>(x[0], x[1], x[2], x[3]));
        const Three p = R.transpose() * part(x + 13);
        return sum + p.dot(so3::cross(u, part(b + 3)) - so3::cross(other, part(a + 3)));
    }

    /// The same of a group given as data (model/group/group_mechanics.hpp).
    double bracketOfData(const double* x, const double* a, const double* b) const {
        using Vector = Eigen::Map<const MatrixGroup::Vector>;
        const int d = data_->dimension();
        return Vector(x + data_->group->entries(), d).dot(data_->group->bracket(Vector(a, d), Vector(b, d)));
    }

    /// -a . Om(x) b, which is the form above for theta = p dq.
    double ofOneForm(const double* x, const double* a, const double* b) const {
        const Eigen::MatrixXd& form = oneForm_->form(x);
        const Eigen::Index m = form.rows();
        return -Eigen::Map<const Eigen::VectorXd>(a, m).dot(form * Eigen::Map<const Eigen::VectorXd>(b, m));
    }

    mutable std::optional<OneFormEquations> oneForm_;  ///< its buffers
    std::shared_ptr<const GroupMechanics> data_;       ///< null: none
    std::size_t group_ = 0;                            ///< dimension; 0: none
};

}  // namespace extremal
