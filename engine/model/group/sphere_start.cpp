// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/number_in.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/group/second_derivatives.hpp"
#include "engine/model/group/sphere_system.hpp"

namespace extremal::spheres {
namespace {

using Three = Eigen::Vector3d;

constexpr double told = 1e-12;  ///< what may be changed without a word

const Value* givenOf(const Settings& initial, const std::string& key) {
    const Value* const given = initial.find(key);
    return given && !given->isNull() ? given : nullptr;
}

Three vectorOf(const Value& given, const std::string& pointer) {
    return Three(numbersIn(given, pointer, 3, {}, "[0.6, 0, -0.8], say").data());
}

/// The place and velocity of one sphere as they are given, and on the sphere.
struct Start {
    Three given, givenRate, x, rate;
};

Start startOfSphere(const std::string& name, const Settings& initial, bool isExample) {
    const Value *const at = givenOf(initial, name), *const velocity = givenOf(initial, name + "_t");
    Start s{Three::UnitX(), isExample ? Three(0, 0.5, 0.2) : Three(0, 0, 0), {}, {}};
    if (at) s.given = vectorOf(*at, "/" + name);
    if (!at && !isExample)
        throw InvalidScene("/" + name, "is required",
                           "a point of length 1, \"" + name + "\": [0, 0, -1], say");
    if (velocity) s.givenRate = vectorOf(*velocity, "/" + name + "_t");
    if (!(s.given.norm() > 0) || !std::isfinite(s.given.norm()))
        throw InvalidScene("/" + name, "has no direction", "a point of length 1, [0, 0, -1], say");
    s.x = s.given.normalized();
    s.rate = s.givenRate - s.givenRate.dot(s.x) * s.x;
    return s;
}

std::vector<Start> startsOf(const Spheres& on, const Settings& initial) {
    const bool isExample = std::none_of(on.names.begin(), on.names.end(), [&](const std::string& name) {
        return givenOf(initial, name) || givenOf(initial, name + "_t");
    });
    std::vector<Start> all;
    for (const std::string& name : on.names) all.push_back(startOfSphere(name, initial, isExample));
    return all;
}

std::string listOf(const Three& v) {
    return "[" + formatNumber(v(0)) + ", " + formatNumber(v(1)) + ", " + formatNumber(v(2)) + "]";
}

}  // namespace

std::vector<FieldInfo> startFields(const std::vector<std::string>& names) {
    std::vector<FieldInfo> fields;
    for (const std::string& name : names) {
        fields.push_back(optionalJsonField(name, name, "The place, three numbers: a point of length 1."));
        fields.push_back(
            optionalJsonField(name + "_t", name + "'", "The velocity, three numbers, normal to the point."));
    }
    return fields;
}

std::vector<Problem> startNotesOf(const Spheres& on, const Settings& initial) {
    std::vector<Problem> notes;
    const std::vector<Start> all = startsOf(on, initial);
    for (std::size_t k = 0; k < all.size(); ++k) {
        const Start& s = all[k];
        if ((s.given - s.x).norm() > told)
            notes.push_back({"/" + on.names[k], "has the length " + formatNumber(s.given.norm(), 6),
                             "the run starts at " + listOf(s.x)});
        if ((s.givenRate - s.rate).norm() > told * std::max(1.0, s.givenRate.norm()))
            notes.push_back({"/" + on.names[k] + "_t", "is not normal to the point",
                             "the run starts with its part in the tangent plane, " + listOf(s.rate)});
    }
    return notes;
}

std::vector<double> startOf(const Spheres& on, const Settings& initial) {
    const GroupMechanics& m = *on.mechanics;
    const std::vector<Start> all = startsOf(on, initial);
    std::vector<double> x;
    for (const Start& s : all) x.insert(x.end(), s.x.data(), s.x.data() + 3);
    const MatrixGroup::Entries g = framesAt(m, x.data());
    MatrixGroup::Vector eta(m.dimension()), mu(m.dimension());
    const auto frame = [&g](std::size_t k) { return frameOf(g, static_cast<int>(3 * k)); };
    for (std::size_t k = 0; k < all.size(); ++k)
        eta.segment<3>(static_cast<Eigen::Index>(3 * k)) =
            frame(k).transpose() * so3::cross(all[k].x, all[k].rate);
    for (const int k : m.isotropy) eta(k) = 0;
    double value = 0;
    m.gradient(m.model.get(), g.data(), eta.data(), &value, mu.data(), nullptr);
    for (const int k : m.isotropy) mu(k) = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const Three pi = frame(k) * mu.segment<3>(static_cast<Eigen::Index>(3 * k));
        x.insert(x.end(), pi.data(), pi.data() + 3);
    }
    return x;
}

void checkRegular(const Spheres& on, const State& initial) {
    const GroupMechanics& m = *on.mechanics;
    const int d = m.dimension();
    const MatrixGroup::Entries g = framesAt(m, initial.x.data());
    MatrixGroup::Vector eta = MatrixGroup::Vector::Zero(d), mu;
    bodyMomenta(g, initial.x.data() + d, mu);
    const bool isFound = m.velocity(m.model.get(), g.data(), mu.data(), eta.data());
    const groups::SecondDerivatives second(m, g.data(), eta, false);
    if (!second.isFinite())
        throw InvalidScene("/lagrangian", "is not finite, or has no finite derivatives, at the initial data",
                           "another start, or a Lagrangian that has a meaning there");
    if (const auto [ratio, null] = second.leastInertia(m.isotropy); ratio <= 1e-12) {
        Eigen::Index k = 0;
        null.cwiseAbs().maxCoeff(&k);
        throw InvalidScene("/lagrangian",
                           "is degenerate at the initial data: it has no inertia along a velocity of \"" +
                               on.names[static_cast<std::size_t>(k / 3)] +
                               "\", so momenta do not determine velocities",
                           "a kinetic energy in which every velocity occurs; what is of first order in time "
                           "is a model of spins");
    }
    if (!isFound)
        throw InvalidScene("/lagrangian", "has no velocity that belongs to the momenta of the initial data",
                           "another start");
}

}  // namespace extremal::spheres
