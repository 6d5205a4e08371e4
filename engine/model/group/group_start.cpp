// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "engine/core/problem.hpp"
#include "engine/core/text/number_in.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/group/group_flow.hpp"
#include "engine/model/group/group_system.hpp"
#include "engine/model/group/named_groups.hpp"
#include "engine/model/group/second_derivatives.hpp"
#include "engine/model/group/typed_group.hpp"

namespace extremal::groups {
namespace {

using Vector = MatrixGroup::Vector;
using Entries = MatrixGroup::Entries;
using Factor = MatrixGroup::Factor;

std::string factorNames(const MatrixGroup& group) {
    std::vector<std::string> names;
    for (const Factor& f : group.factors()) names.push_back(f.name);
    return joinNames(names);
}

/// Coordinates in a list, as many as a factor has.
void readList(const Value& given, const std::string& pointer, int d, double* to) {
    const std::vector<double> numbers =
        numbersIn(given, pointer, d, {}, "one for each matrix of the basis, in its order");
    std::copy(numbers.begin(), numbers.end(), to);
}

/// Calls read(value, pointer, factor) of each factor that an object of a product gives.
template <class Read>
void readByFactor(const MatrixGroup& group, const Value& given, const std::string& pointer,
                  const Read& read) {
    for (const auto& [name, value] : given.asObject()) {
        const auto f = std::find_if(group.factors().begin(), group.factors().end(),
                                    [&](const Factor& each) { return each.name == name; });
        if (f == group.factors().end())
            throw InvalidScene(pointer + "/" + name, "there is no factor \"" + name + "\"",
                               "factors: " + factorNames(group));
        read(value, pointer + "/" + name, *f);
    }
}

bool isProduct(const MatrixGroup& group) { return !group.factors()[0].name.empty(); }

/// xi or mu: a list of all, or of a product an object of lists, 0 where a factor is left out.
Vector readVector(const MatrixGroup& group, const Value& given, const std::string& pointer) {
    Vector v = Vector::Zero(group.dimension());
    if (given.isObject() && isProduct(group))
        readByFactor(group, given, pointer, [&](const Value& value, const std::string& at, const Factor& f) {
            readList(value, at, f.d, v.data() + f.coordinate);
        });
    else
        readList(given, pointer, group.dimension(), v.data());
    return v;
}

void readElement(const Value& given, const std::string& pointer, const Factor& f, Entries& g) {
    if (given.isString() && given.asString() == "identity") return;
    Eigen::Map<MatrixGroup::Square> to(g.data() + f.entry, f.n, f.n);
    if (given.isArray()) {
        to = matrixOf(given, pointer, f.n);
        return;
    }
    const Value* const way = given.isObject() ? given.find("exp") : nullptr;
    if (!way || given.asObject().size() != 1)
        throw InvalidScene(pointer, "is not an element of the group",
                           "\"identity\", the rows of a matrix, or {\"exp\": [coordinates]}");
    GroupFactor::Vector xi(f.d);
    readList(*way, pointer + "/exp", f.d, xi.data());
    to = f.exponential(xi);
}

Entries readStart(const GroupMechanics& on, const Value* given) {
    const MatrixGroup& group = *on.group;
    Entries g = group.identity();
    if (!given || given->isNull()) return g;
    if (!isProduct(group)) {
        readElement(*given, "/g", group.factors()[0], g);
    } else if (given->isObject()) {
        readByFactor(group, *given, "/g", [&](const Value& value, const std::string& at, const Factor& f) {
            readElement(value, at, f, g);
        });
    } else if (!given->isString() || given->asString() != "identity") {
        throw InvalidScene("/g", "must be \"identity\", or an object of elements by factor",
                           "factors: " + factorNames(group));
    }
    constexpr double near = 1e-8;
    const double off = on.invariants->distance(g);
    if (!(off <= near))
        throw InvalidScene("/g", "is not on the group: its distance is " + formatNumber(off, 3),
                           "a matrix of the group to 1e-8, or {\"exp\": [coordinates]}");
    for (int k = 0; k < 2 && off > 1e-15; ++k) on.invariants->cure(g);
    return g;
}

/// Where a scene says nothing: 0.5, 0.1, 0.3 and so on.
Vector exampleVelocity(int d) {
    constexpr std::array<double, 3> values{0.5, 0.1, 0.3};
    Vector xi(d);
    for (int k = 0; k < d; ++k) xi(k) = values[static_cast<std::size_t>(k % 3)];
    return xi;
}

}  // namespace

std::vector<double> startOf(const GroupMechanics& on, const Settings& initial) {
    const MatrixGroup& group = *on.group;
    const int d = group.dimension();
    const Entries g = readStart(on, initial.find("g"));
    const Value *const xi = initial.find("xi"), *const mu = initial.find("mu");
    const bool hasXi = xi && !xi->isNull(), hasMu = mu && !mu->isNull();
    const Value* const given = initial.find("g");
    const bool isExample = !hasXi && !hasMu && (!given || given->isNull());
    if (hasXi == hasMu && !isExample)
        throw InvalidScene(hasXi ? "/mu" : "",
                           hasXi ? "stands beside xi: one is too many" : "has neither xi nor mu",
                           "give exactly one of xi and mu, in the body");
    Vector m = Vector::Zero(d);
    if (!hasMu) {
        const Vector eta = isExample ? exampleVelocity(d) : readVector(group, *xi, "/xi");
        double value = 0;
        on.gradient(on.model.get(), g.data(), eta.data(), &value, m.data(), nullptr);
    } else {
        m = readVector(group, *mu, "/mu");
    }
    const Vector J = group.inSpace(g, m);
    std::vector<double> x(g.data(), g.data() + g.size());
    x.insert(x.end(), m.data(), m.data() + d);
    x.insert(x.end(), J.data(), J.data() + d);
    x.resize(static_cast<std::size_t>(evenStateSize(on)));
    return x;
}

void checkRegular(const GroupMechanics& on, const State& initial) {
    const int d = on.dimension();
    const double *const g = initial.x.data(), *const mu = g + on.group->entries();
    Vector eta = Vector::Zero(d);
    const bool isFound = on.velocity(on.model.get(), g, mu, eta.data());
    const SecondDerivatives second(on, g, eta, false);
    if (!second.isFinite())
        throw InvalidScene("/lagrangian", "is not finite, or has no finite derivatives, at the initial data",
                           "another start, or a Lagrangian that has a meaning there");
    const std::vector<std::string> names = velocityNames(*on.group);
    if (const auto [ratio, null] = second.leastInertia({}); ratio <= 1e-12) {
        std::string direction;
        for (int i = 0; i < d; ++i)
            if (std::abs(null(i)) > 1e-6)
                direction += (direction.empty() ? "" : ", ") + names[static_cast<std::size_t>(i)] + ": " +
                             formatNumber(null(i), 3);
        throw InvalidScene("/lagrangian",
                           "is degenerate at the initial data: it has no inertia along the velocity (" +
                               direction + "), so momenta do not determine velocities",
                           "an inertia in every direction; a body without one about its axis is a point on a "
                           "sphere, which has no such rotation");
    }
    if (!isFound)
        throw InvalidScene("/lagrangian", "has no velocity that belongs to the momenta of the initial data",
                           "\"xi\" instead of \"mu\" at the start, or another start");
}

}  // namespace extremal::groups
