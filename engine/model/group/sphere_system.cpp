// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/group/sphere_system.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/own_buffers.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/model/group/group_symmetry.hpp"
#include "engine/model/group/named_groups.hpp"
#include "engine/model/group/second_derivatives.hpp"
#include "engine/model/group/typed_group.hpp"
#include "engine/model/parts/named_start.hpp"
#include "engine/model/typed/formula.hpp"

namespace extremal::spheres {
namespace {

using Vector = MatrixGroup::Vector;
using Matrix = MatrixGroup::Matrix;
using Entries = MatrixGroup::Entries;

constexpr const char* axes[] = {"x", "y", "z"};

/// A state in frames at its points, and room for derivatives of L; one of each thread (core/own_buffers.hpp).
struct InFrames {
    Entries g;
    Vector mu, eta, m, f;
    double L = 0;
    bool isKnown = false;

    explicit InFrames(const GroupMechanics& on)
        : g(on.group->entries()), mu(on.dimension()), eta(mu), m(mu), f(mu) {}
    void place(const GroupMechanics& on, const double* x) {
        framesAt(on, x, g);
        bodyMomenta(g, x + on.dimension(), mu);
        for (const int k : on.isotropy) mu(k) = 0;
        isKnown = on.velocity(on.model.get(), g.data(), mu.data(), eta.data());
        if (!isKnown) eta.setConstant(std::nan(""));
    }
    void differentiate(const GroupMechanics& on) {
        on.gradient(on.model.get(), g.data(), eta.data(), &L, m.data(), f.data());
    }
};
InFrames inFrames(const GroupMechanics& on, const double* x) {
    InFrames made(on);
    made.place(on, x);
    return made;
}

/// x' = w x x and pi' = R f with w = R eta.
bool rate(const GroupMechanics& on, long long id, const double* x, double* dx) {
    InFrames& at = ownBuffers<InFrames>(id, on);
    at.place(on, x);
    at.differentiate(on);
    const int d = on.dimension();
    for (int k = 0; k < d; k += 3) {
        const Frame R = frameOf(at.g, k);
        const Eigen::Vector3d w = R * at.eta.segment<3>(k);
        Eigen::Map<Eigen::Vector3d>(dx + k) = so3::cross(w, Eigen::Vector3d(x[k], x[k + 1], x[k + 2]));
        Eigen::Map<Eigen::Vector3d>(dx + d + k) = R * at.f.segment<3>(k);
    }
    return at.isKnown;
}

double energyAt(const GroupMechanics& on, const double* x) {
    InFrames at = inFrames(on, x);
    at.differentiate(on);
    return at.eta.dot(at.mu) - at.L;
}

/// How fast points go around their spheres, or swing: the larger.
double frequencyAt(const GroupMechanics& on, const double* x) {
    const InFrames at = inFrames(on, x);
    const double turning = on.group->adNorm(at.eta);
    const groups::SecondDerivatives second(on, at.g.data(), at.eta);
    const double swinging = std::sqrt(second.largestRatio(on.isotropy));
    return std::isfinite(swinging) ? std::max(turning, swinging) : turning;
}

std::vector<std::string> namesOf(const Settings& settings) {
    constexpr std::size_t most = typed::maxCoordinates / 5;  // two velocities and three entries each
    std::vector<std::string> names;
    for (const Value& each : settings.find("spheres")->asArray()) {
        const std::string pointer = "/spheres/" + std::to_string(names.size()), &name = each.asString();
        if (const std::string problem = nameProblem(name); !problem.empty())
            throw InvalidScene(pointer, "the name \"" + name + "\" " + problem, "another name");
        if (std::find(names.begin(), names.end(), name) != names.end())
            throw InvalidScene(pointer, "the name \"" + name + "\" is listed twice",
                               "every sphere has a name of its own");
        names.push_back(name);
    }
    if (names.empty() || names.size() > most)
        throw InvalidScene("/spheres", "has " + std::to_string(names.size()) + " names",
                           "1 to " + std::to_string(most) + " spheres");
    return names;
}

Spheres spheresOf(const Settings& settings) {
    Spheres made{namesOf(settings), nullptr};
    std::vector<MatrixGroup::Definition> factors;
    groups::OwnNames own;
    for (const std::string& name : made.names) {
        own.isotropy.push_back(static_cast<int>(3 * factors.size()) + 2);
        factors.push_back({name, groups::basisOf("so3"), "/spheres"});
        for (int i = 1; i <= 3; ++i) {
            const std::string entry = name + "_g" + std::to_string(i), at = name + "_" + std::to_string(i);
            own.meanings.emplace_back(at, entry + "3");
            own.meanings.emplace_back(at + "_t",
                                      entry + "1*" + name + "_xi2 - " + entry + "2*" + name + "_xi1");
        }
    }
    made.mechanics =
        std::make_shared<const GroupMechanics>(groups::mechanicsOf(MatrixGroup(factors), settings, own));
    return made;
}

void describeColumns(System& s, const std::vector<std::string>& names) {
    for (const auto& [prefix, title, symbol] :
         {std::tuple{"", "place of ", "x_"}, {"pi.", "angular momentum of ", "π_"}})
        for (const std::string& name : names)
            for (int i = 0; i < 3; ++i)
                s.columns.push_back({prefix + name + "." + std::to_string(i + 1),
                                     std::string(title) + name + ", " + axes[i],
                                     symbol + name + "," + std::to_string(i + 1), ""});
    const std::string& last = names.back();
    s.phaseX = last + ".3";
    s.phaseY = "pi." + last + ".3";
    s.trajectoryX = last + ".1";
    s.trajectoryY = last + ".2";
    s.hasPlanarTrajectory = true;
    for (const std::string& name : names)
        if (s.timePlots.size() < 3) s.timePlots.push_back(name + ".3");
}

void describeError(System& s, const std::vector<std::string>& names) {
    s.error.columns = {{"error", "", "|x - x_ref|", ""}, {"error.p", "", "|π - π_ref|", ""}};
    for (const std::string& name : names)
        s.error.columns.push_back({"error." + name, "", "|x_" + name + " - ref|", ""});
    s.error.evaluate = [n = names.size()](const double* x, const double* reference, double* values) {
        const auto distance = [&](std::size_t from, std::size_t count) {
            return scaledDistance(count, x + from, reference + from);
        };
        values[0] = distance(0, 3 * n);
        values[1] = distance(3 * n, 3 * n);
        for (std::size_t k = 0; k < n; ++k) values[2 + k] = distance(3 * k, 3);
    };
}

/// A direction of J that is the same axis of every sphere, or null.
const char* commonAxis(const Eigen::VectorXd& zeta) {
    for (int axis = 0; axis < 3; ++axis)
        if (zeta.isApprox(Eigen::Vector3d::Unit(axis).replicate(zeta.size() / 3, 1), 1e-6)) return axes[axis];
    return nullptr;
}

void describeKept(System& s, const Spheres& on) {
    const Eigen::MatrixXd kept = groups::keptDirections(*on.mechanics);
    int combinations = 0;
    for (Eigen::Index k = 0; k < kept.cols(); ++k) {
        const Eigen::VectorXd zeta = kept.col(k);
        const char* const axis = commonAxis(zeta);
        Eigen::Index one = 0;
        zeta.cwiseAbs().maxCoeff(&one);
        const bool isOne = (zeta.array() != 0).count() == 1;
        const std::string sphere = on.names[static_cast<std::size_t>(one / 3)],
                          name = axis    ? std::string("angular.") + axis
                                 : isOne ? "angular." + sphere + "." + axes[one % 3]
                                         : "combination." + std::to_string(++combinations);
        s.momenta.push_back(
            {name, axis ? std::string("J_") + axis : "π·ζ", "", [zeta](const double* x, const double*) {
                 return zeta.dot(Eigen::Map<const Eigen::VectorXd>(x + zeta.size(), zeta.size()));
             }});
    }
}

/// How far points are from length 1 and momenta from the tangent planes.
Measure distanceFrom(std::size_t spheres) {
    return {"group-distance",
            {{"group-distance", "", "max(||x| - 1|, |π·x|)", ""}},
            0,
            [spheres](const State&) -> Measure::Evaluate {
                return [spheres](double, const double* x, double* values) {
                    values[0] = 0;
                    for (std::size_t k = 0; k < 3 * spheres; k += 3) {
                        const Eigen::Map<const Eigen::Vector3d> at(x + k), pi(x + 3 * spheres + k);
                        values[0] = std::max({values[0], std::abs(at.norm() - 1), std::abs(at.dot(pi))});
                    }
                };
            }};
}

}  // namespace

System systemOf(const Settings& settings) {
    const Spheres on = spheresOf(settings);
    System s;
    s.id = "spheres";
    s.parts.set(on);
    describeColumns(s, on.names);
    describeError(s, on.names);
    const auto mechanics = on.mechanics;
    s.energy = [mechanics](double, const double* x) { return energyAt(*mechanics, x); };
    s.kineticEnergy = [mechanics](double, const double* x) {
        const InFrames at = inFrames(*mechanics, x);
        return at.eta.dot(at.mu) / 2;
    };
    s.rate = [mechanics, id = nextModelId()](double, const double* x, double* dx) {
        return rate(*mechanics, id, x, dx);
    };
    s.frequency = [mechanics](double, const double* x) { return frequencyAt(*mechanics, x); };
    s.start = [on](const Settings& initial, double) { return startOf(on, initial); };
    s.parts.set(NamedStart{startFields(on.names),
                           [on](const Settings& initial) { return startNotesOf(on, initial); }});
    s.measures.push_back(distanceFrom(on.names.size()));
    describeKept(s, on);
    describePicture(s, on);
    s.parts.set(byHand(on));
    return s;
}

}  // namespace extremal::spheres
