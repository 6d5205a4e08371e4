// SPDX-License-Identifier: GPL-3.0-or-later
/// Rigid bodies in quadruple precision.
#pragma once

#include <boost/multiprecision/float128.hpp>

#include "engine/group/so3.hpp"
#include "engine/model/body/body.hpp"

namespace extremal {

using Quad = boost::multiprecision::float128;

inline BodyMechanics<Quad> quadrupleBody() {
    BodyMechanics<Quad> body;
    body.dimension = 3;
    body.inertia = {Quad(1), Quad(2), Quad(3)};
    return body;
}

/// Heavy top of weight 1 with its centre of mass at (0.3, 0, 1).
inline void topPotential(const void*, const Quad* R, const Quad*, Quad* value, Quad* force, Quad* slope) {
    const so3::Vector<Quad> gamma(R[2], R[5], R[8]), arm(Quad(3) / 10, Quad(0), Quad(1));
    const Quad U = so3::dot(arm, gamma);
    if (value) *value = U;
    const so3::Vector<Quad> torque = so3::cross(gamma, arm);
    for (int i = 0; i < 3; ++i) force[i] = torque(i);
    if (!slope) return;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) slope[3 * c + r] = (r == c ? U : Quad(0)) - gamma(r) * arm(c);
}

inline BodyMechanics<Quad> quadrupleTop() {
    BodyMechanics<Quad> body = quadrupleBody();
    body.inertia = {Quad(1), Quad(1), Quad(1) / 2};
    body.potential = topPotential;
    return body;
}

}  // namespace extremal
