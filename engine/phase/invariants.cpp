// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/invariants.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/algebra/differences.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/conservative.hpp"
#include "engine/model/first_order/first_order.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/model/first_order/poisson.hpp"
#include "engine/model/typed/typed_function.hpp"
#include "engine/phase/monitor.hpp"
#include "engine/phase/monitored.hpp"
#include "engine/symmetry/conserved.hpp"

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;

constexpr std::string_view momentumPrefix = "momentum.", casimirPrefix = "casimir.";

std::string placeOf(std::size_t i) { return "/keep/" + std::to_string(i); }

/// By differences of order 6 over a good part of the state: of momenta of affine symmetries, which have
/// degree 2, they are exact.
Invariant byDifferences(const std::string& name, std::function<double(const double*)> value, std::size_t n) {
    return {name, false,
            [n, value = std::move(value), at = std::vector<double>()](const double* x, double* g) mutable {
                at.assign(x, x + n);
                double size = 0;
                for (const double entry : at) size = std::max(size, std::abs(entry));
                const double shift = 0.05 * (size > 0 ? size : 1);
                for (std::size_t k = 0; k < at.size(); ++k)
                    g[k] = slopeByDifferences(at[k], shift, [&] { return value(at.data()); });
            }};
}

InvalidScene unknownName(const std::string& text, std::size_t place, const std::vector<std::string>& names) {
    return {placeOf(place), "there is no \"" + text + "\"",
            names.empty() ? "this system has none of that kind" : "known: " + joinNames(names)};
}

Invariant momentumNamed(const std::string& text, std::size_t place, const System& system) {
    std::vector<std::string> names;
    if (!system.hasCoordinates()) {
        for (const MomentumMap& each : system.momenta) {
            names.push_back(std::string(momentumPrefix) + each.name);
            if (names.back() == text)
                return byDifferences(
                    text, [value = each.value](const double* x) { return value(x, x); },
                    system.columns.size() + system.columns.size() % 2);
        }
        throw unknownName(text, place, names);
    }
    for (ConservedMomentum& each : momentaOf(system)) {
        if (std::string(momentumPrefix) + each.name != text) {
            if (!each.movesTime) names.push_back(std::string(momentumPrefix) + each.name);
            continue;
        }
        if (each.movesTime)
            throw InvalidScene(placeOf(place),
                               "is of a symmetry that moves time: steps of one length do not "
                               "have it",
                               "leave it out");
        return byDifferences(
            text, [value = std::move(each.value)](const double* x) { return value(0, x); },
            2 * static_cast<std::size_t>(system.dimension()));
    }
    throw unknownName(text, place, names);
}

Invariant casimirNamed(const std::string& text, std::size_t place, const System& system) {
    std::vector<std::string> names;
    if (const PoissonStructure* const bracket = system.parts.find<PoissonStructure>())
        for (const PoissonStructure::Casimir& each : bracket->casimirs) {
            names.push_back(std::string(casimirPrefix) + each.name);
            if (names.back() == text)
                return {text, false,
                        [value = each.value](const double* x, double* gradient) { value(x, gradient); }};
        }
    throw unknownName(text, place, names);
}

Invariant energyOf(const std::string& text, std::size_t place, const System& system) {
    if (!conservesEnergy(system))
        throw InvalidScene(placeOf(place), "is not constant along the motion: " + energySource(system),
                           "a conserved quantity of this system, or \"keep\": \"symplectic\"");
    if (!isFirstOrder(system)) return {text, true, {}};
    const FirstOrder equations = firstOrderOf(system);
    const PoissonStructure* const bracket = system.parts.find<PoissonStructure>();
    return {text, bracket && bracket->isConstant,
            [equations](const double* x, double* gradient) { equations.energy(x, gradient); }};
}

Invariant invariantOf(const KeptQuantity& kept, std::size_t place, const System& system) {
    if (kept.text == "energy") return energyOf(kept.text, place, system);
    if (kept.text.starts_with(momentumPrefix)) return momentumNamed(kept.text, place, system);
    if (kept.text.starts_with(casimirPrefix)) return casimirNamed(kept.text, place, system);
    auto function = std::make_shared<const typed::TypedFunction>(
        kept.formula, placeOf(place), namesInState(system), std::vector<std::pair<std::string, double>>{});
    return {kept.text, false,
            [function, unnamed = system.hasCoordinates() ? 0 : system.columns.size() % 2](const double* x,
                                                                                          double* gradient) {
                double value = 0;
                function->evaluate(x, &value, gradient, nullptr);
                std::fill_n(gradient + function->variables(), unnamed, 0.0);
            }};
}

/// Gradients as columns, each of length 1, and f in the last; empty where they are not finite.
Eigen::MatrixXd directionsAt(std::vector<Invariant>& all, const Mechanics<double>& flow, const Vector& x,
                             double t) {
    const int d = flow.dimension;
    Eigen::MatrixXd made(2 * d, static_cast<Eigen::Index>(all.size()) + 1);
    Vector f(2 * d), gradient(2 * d);
    if (!flow.flow(flow.model.get(), t, x.data(), x.data() + d, f.data(), f.data() + d)) return {};
    for (std::size_t a = 0; a < all.size(); ++a) {
        if (!all[a].gradient)
            gradient << -f.tail(d), f.head(d);
        else
            all[a].gradient(x.data(), gradient.data());
        made.col(static_cast<Eigen::Index>(a)) = gradient.normalized();
    }
    made.rightCols(1) = f.norm() > 0 ? Vector(f.normalized()) : f;
    return made.allFinite() ? made : Eigen::MatrixXd();
}

void check(std::vector<Invariant>& all, const System& system, const State& start) {
    constexpr double roundOff = 1e-8, dependent = 1e-7;
    const Mechanics<double> flow = flowOf(system);
    const Vector x = Eigen::Map<const Vector>(start.x.data(), 2 * flow.dimension);
    const double size = x.cwiseAbs().maxCoeff() > 0 ? x.cwiseAbs().maxCoeff() : 1;
    const auto m = static_cast<Eigen::Index>(all.size());
    for (int k = 0; k < 4; ++k) {
        Vector at = x;
        for (Eigen::Index i = 0; i < at.size() && k > 0; ++i)
            at(i) += 0.1 * size * std::sin(static_cast<double>((i + 1) * (2 * k + 1)));
        // Other times as well: a motion that t changes keeps what it keeps at all of them.
        const Eigen::MatrixXd found = directionsAt(all, flow, at, start.t + 0.37 * k);
        if (found.size() == 0) continue;
        for (Eigen::Index a = 0; a < m; ++a)
            if (const double rate = found.col(a).dot(found.col(m)); std::abs(rate) > roundOff)
                throw InvalidScene(placeOf(static_cast<std::size_t>(a)),
                                   "is not constant along the motion: " +
                                       all[static_cast<std::size_t>(a)].name + " changes with it",
                                   "a conserved quantity of this system");
    }
    const Eigen::MatrixXd atStart = directionsAt(all, flow, x, start.t);
    if (atStart.size() == 0 || m < 2) return;
    Eigen::VectorXi order;
    const Eigen::VectorXd pivots = dense::rankPivots(atStart.leftCols(m), order);
    for (Eigen::Index k = 0; k < m; ++k) {
        if (k < pivots.size() && pivots(k) > dependent) continue;
        const auto which = static_cast<std::size_t>(order(k));
        throw InvalidScene(
            placeOf(which),
            "depends on the others at the start: " + all[which].name + " has no direction of its own there",
            "leave it out, or another start");
    }
}

}  // namespace

std::vector<std::string> namesInState(const System& system) {
    if (system.hasCoordinates()) return monitorNames(system.coordinates);
    std::vector<std::string> names;
    if (isFirstOrder(system))
        for (const Quantity& column : system.columns) names.push_back(column.title);
    return names;
}

bool canKeepInvariants(const System& system) { return hasHamiltonian(system) || isFirstOrder(system); }

std::vector<Invariant> invariantsOf(const std::vector<KeptQuantity>& kept, const System& system,
                                    const State& start) {
    std::vector<Invariant> all;
    for (std::size_t i = 0; i < kept.size(); ++i) all.push_back(invariantOf(kept[i], i, system));
    if (!start.x.empty()) check(all, system, start);
    return all;
}

}  // namespace extremal
