// SPDX-License-Identifier: GPL-3.0-or-later
/// A Lagrangian on a group given as data that is a rigid body's: L = 1/2 eta . M eta - U(g) with a constant,
/// positive M on an algebra that is so(3) in some basis (group/rotation_algebra.hpp).
///
/// In the basis F = E T in which brackets are vector products and M is diagonal it is BodyMechanics, and the
/// steps of rigid bodies do for it: eta_E = T eta_F, mu_F = T^T mu_E and J alike. Matrices of spin 1 are
/// P R P^-1 with a rotation R; those of spin 1/2 are q_0 + 2 sum_a q_a F_a with a quaternion q of length 1.
/// There are bodies in a potential on the first alone, as U may tell q from -q.
#pragma once

#include <optional>
#include <vector>

#include "engine/group/so3.hpp"
#include "engine/model/body/body.hpp"
#include "engine/model/group/group_mechanics.hpp"

namespace extremal {

class BodyForm {
public:
    /// Nothing where the problem is another one.
    static std::optional<BodyForm> of(const GroupMechanics& mechanics);

    const BodyMechanics<double>& body() const { return body_; }

    /// Between the state of the group (g, mu, J) and what moves of a body: attitude, and momentum in space.
    void read(const double* x, so3::Quaternion<double>& attitude, so3::Vector<double>& momentum) const;
    void write(const so3::Quaternion<double>& attitude, const so3::Vector<double>& momentum, double* x) const;
    /// Columns (zeta, dmu) of variations, to those of the body and back.
    void varyBody(double* W) const;
    void varyGroup(double* W) const;

private:
    using Three = so3::Vector<double>;
    using Square = so3::Matrix<double>;

    BodyMechanics<double> body_;
    int n_ = 0;  ///< rows of g
    Square T_, inverse_;
    bool isHalf_ = false;
    bool isPlain_ = false;               ///< T is 1 and g is R
    Square P_, inverseP_;                ///< of spin 1
    std::vector<Eigen::MatrixXd> unit_;  ///< of spin 1/2: 1, 2 F_1, 2 F_2, 2 F_3
};

}  // namespace extremal
