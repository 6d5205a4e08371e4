// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/body/body_hand.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "engine/group/so3.hpp"

namespace extremal {
namespace {

using Vector = so3::Vector<double>;
using Quaternion = so3::Quaternion<double>;

Quaternion unitAttitude(const double* x) { return so3::normalised(Quaternion(x[0], x[1], x[2], x[3])); }
void putBodyMomentum(const Vector& inBody, double* x) {
    const Vector inSpace = so3::matrix(unitAttitude(x)) * inBody;
    std::copy_n(inBody.data(), 3, x + 4);
    std::copy_n(inSpace.data(), 3, x + 7);
}

Value bodyWritten(Value initial, const double* x, bool keepsMotion, bool isInSpace) {
    initial.set("attitude", handNumbers(x, 4));
    if (isInSpace) initial.set("position", handNumbers(x + 10, 3));
    if (keepsMotion) return initial;
    dropKeys(initial, {"omega", "velocity"});
    initial.set("momentum", handNumbers(x + 4, 3));
    if (isInSpace) initial.set("linear_momentum", handNumbers(x + 13, 3));
    return initial;
}

}  // namespace

ByHand bodyByHand(const Body& body) {
    ByHand hand;
    const bool isInSpace = body.dimension == 6;
    hand.freedoms = body.dimension;
    hand.move = [isInSpace](double* x, const double* by) {
        const Vector momentum(x + 4);
        const Quaternion turned =
            so3::normalised(so3::product(so3::quaternionExp(Vector(by)), unitAttitude(x)));
        std::copy_n(turned.data(), 4, x);
        putBodyMomentum(momentum, x);
        for (int i = 0; i < 3 && isInSpace; ++i) x[10 + i] += by[3 + i];
    };
    hand.velocity = [body, isInSpace](const double* x, double* by) {
        Vector rate(x + 4);
        for (int i = 0; i < 3; ++i) rate(i) /= body.inertia[static_cast<std::size_t>(i)];
        const Vector inSpace = so3::matrix(unitAttitude(x)) * rate;
        std::copy_n(inSpace.data(), 3, by);
        for (int i = 0; i < 3 && isInSpace; ++i) by[3 + i] = x[13 + i] / body.inertia[3];
        return true;
    };
    hand.push = [body, isInSpace](double* x, const double* by) {
        const Vector rate = so3::matrix(unitAttitude(x)).transpose() * Vector(by);
        Vector momentum(x + 4);
        for (int i = 0; i < 3; ++i) momentum(i) += body.inertia[static_cast<std::size_t>(i)] * rate(i);
        putBodyMomentum(momentum, x);
        for (int i = 0; i < 3 && isInSpace; ++i) x[13 + i] += body.inertia[3] * by[3 + i];
    };
    hand.written = [isInSpace](Value initial, const double* x, bool keepsMotion) {
        return bodyWritten(std::move(initial), x, keepsMotion, isInSpace);
    };
    return hand;
}

}  // namespace extremal
