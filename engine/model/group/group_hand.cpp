// SPDX-License-Identifier: GPL-3.0-or-later
/// Groups given as data, and points on spheres, moved by hand.
#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "engine/model/group/group_system.hpp"
#include "engine/model/group/sphere_system.hpp"
#include "engine/model/parts/by_hand.hpp"

namespace extremal {
namespace {

using Vector = MatrixGroup::Vector;
using Entries = MatrixGroup::Entries;

/// g, then the momentum in the body, then J.
void put(const GroupMechanics& on, const Entries& g, const Vector& mu, double* x) {
    const Vector J = on.group->inSpace(g, mu);
    x = std::copy_n(g.data(), g.size(), x);
    x = std::copy_n(mu.data(), mu.size(), x);
    std::copy_n(J.data(), J.size(), x);
}

/// As {"exp": [..]} where the logarithm is found, else as rows.
Value elementOf(const MatrixGroup::Factor& factor, const MatrixGroup::View& g, const double* xi) {
    const Value way = handNumbers(xi, static_cast<std::size_t>(factor.d));
    GroupFactor::Vector rounded(factor.d);
    for (int k = 0; k < factor.d; ++k) rounded(k) = way.asArray()[static_cast<std::size_t>(k)].asNumber();
    constexpr double near = 1e-6;
    if (rounded.allFinite() && (factor.exponential(rounded) - g).cwiseAbs().maxCoeff() < near)
        return Value::Object{{"exp", way}};
    Value::Array rows;
    for (int i = 0; i < factor.n; ++i) {
        Value::Array row;
        for (int j = 0; j < factor.n; ++j) row.emplace_back(g(i, j));
        rows.emplace_back(row);
    }
    return rows;
}

Value groupWritten(const GroupMechanics& on, Value initial, const double* x, bool keepsMotion) {
    const MatrixGroup& group = *on.group;
    const Eigen::Map<const Entries> g(x, group.entries());
    const Vector xi = group.logarithm(g, Vector::Zero(group.dimension()));
    Value::Object byFactor;
    for (const MatrixGroup::Factor& f : group.factors())
        byFactor.emplace_back(f.name, elementOf(f, group.part(f, g), xi.data() + f.coordinate));
    const bool isProduct = !group.factors()[0].name.empty();
    initial.set("g", isProduct ? Value(byFactor) : byFactor.front().second);
    const bool hasMomentum = initial.find("mu") || (initial.find("xi") && on.hasConstantMasses);
    if (keepsMotion && hasMomentum) return initial;
    dropKeys(initial, {"xi"});
    initial.set("mu", handNumbers(x + group.entries(), static_cast<std::size_t>(on.dimension())));
    return initial;
}

/// The velocity of each point, w x x with w = R eta.
Vector velocitiesOf(const GroupMechanics& on, const double* x) {
    const Entries g = spheres::framesAt(on, x);
    Vector mu, eta = Vector::Zero(on.dimension()), v = eta;
    spheres::bodyMomenta(g, x + on.dimension(), mu);
    for (const int k : on.isotropy) mu(k) = 0;
    if (!on.velocity(on.model.get(), g.data(), mu.data(), eta.data()))
        return Vector::Constant(on.dimension(), std::numeric_limits<double>::quiet_NaN());
    for (int k = 0; k < on.dimension(); k += 3) {
        const Eigen::Vector3d w = spheres::frameOf(g, k) * eta.segment<3>(k);
        v.segment<3>(k) = so3::cross(w, Eigen::Vector3d(x + k));
    }
    return v;
}

Value threeNumbers(const double* x) { return Value::Array{x[0], x[1], x[2]}; }

Value spheresWritten(const Spheres& on, Value initial, const double* x) {
    const Vector v = velocitiesOf(*on.mechanics, x);
    for (std::size_t k = 0; k < on.names.size(); ++k) {
        const std::string rate = on.names[k] + "_t";
        initial.set(on.names[k], threeNumbers(x + 3 * k));
        if (initial.find(rate) || !v.segment<3>(static_cast<Eigen::Index>(3 * k)).isZero(0))
            initial.set(rate, threeNumbers(v.data() + 3 * k));
    }
    return initial;
}

/// x by the way `by`, and back to the sphere; pi turns with it.
void moveOnSphere(const double* by, double* x, double* pi) {
    const Eigen::Vector3d before(x), after = (before + Eigen::Vector3d(by)).normalized(),
                                     axis = so3::cross(before, after);
    const double cosine = before.dot(after);
    const auto turned = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
        return cosine * p + so3::cross(axis, p) + axis * (axis.dot(p) / (1 + cosine));
    };
    Eigen::Vector3d momentum = turned(Eigen::Vector3d(pi));
    momentum -= momentum.dot(after) * after;
    std::copy_n(after.data(), 3, x);
    std::copy_n(momentum.data(), 3, pi);
}

}  // namespace

namespace groups {

ByHand byHand(const GroupMechanics& on) {
    ByHand hand;
    hand.freedoms = on.dimension();
    hand.move = [on](double* x, const double* by) {
        const Vector mu = Eigen::Map<const Vector>(x + on.group->entries(), on.dimension());
        Entries g;
        on.group->moved(Eigen::Map<const Entries>(x, on.group->entries()),
                        Eigen::Map<const Vector>(by, on.dimension()), g);
        put(on, g, mu, x);
    };
    hand.velocity = [on](const double* x, double* by) {
        return on.velocity(on.model.get(), x, x + on.group->entries(), by);
    };
    hand.push = [on](double* x, const double* by) {
        const Entries g = Eigen::Map<const Entries>(x, on.group->entries());
        Vector mu = Eigen::Map<const Vector>(x + g.size(), on.dimension()), eta = mu;
        if (!on.velocity(on.model.get(), g.data(), mu.data(), eta.data())) return;
        eta += Eigen::Map<const Vector>(by, on.dimension());
        double value = 0;
        on.gradient(on.model.get(), g.data(), eta.data(), &value, mu.data(), nullptr);
        put(on, g, mu, x);
    };
    hand.written = [on](Value initial, const double* x, bool keepsMotion) {
        return groupWritten(on, std::move(initial), x, keepsMotion);
    };
    return hand;
}

}  // namespace groups

namespace spheres {

ByHand byHand(const Spheres& on) {
    ByHand hand;
    const int d = on.mechanics->dimension();
    hand.freedoms = d;
    hand.move = [d](double* x, const double* by) {
        for (int k = 0; k < d; k += 3) moveOnSphere(by + k, x + k, x + d + k);
    };
    hand.velocity = [on](const double* x, double* by) {
        const Vector v = velocitiesOf(*on.mechanics, x);
        std::copy_n(v.data(), v.size(), by);
        return v.allFinite();
    };
    hand.push = [on](double* x, const double* by) {
        const Vector v = velocitiesOf(*on.mechanics, x);
        Settings start;
        for (std::size_t k = 0; k < on.names.size(); ++k) {
            const auto at = static_cast<Eigen::Index>(3 * k);
            const Eigen::Vector3d velocity = v.segment<3>(at) + Eigen::Vector3d(by + 3 * k);
            start.keys.emplace_back(on.names[k], threeNumbers(x + 3 * k));
            start.keys.emplace_back(on.names[k] + "_t", threeNumbers(velocity.data()));
        }
        const std::vector<double> made = startOf(on, start);
        std::copy(made.begin(), made.end(), x);
    };
    hand.written = [on](Value initial, const double* x, bool) {
        return spheresWritten(on, std::move(initial), x);
    };
    return hand;
}

}  // namespace spheres
}  // namespace extremal
