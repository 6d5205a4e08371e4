// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/symmetry/conserved.hpp"

#include <algorithm>

#include "engine/model/mechanisms.hpp"
#include "engine/model/parts/written_form.hpp"
#include "engine/symmetry/candidates.hpp"
#include "engine/symmetry/symmetry.hpp"

namespace extremal {
namespace {

/// Built-in systems say what they conserve; the columns of their files do not change by what a search finds.
bool isSearched(const System& system) {
    return isTaken(Takes::only<Mechanical, Constraint, Wall>(), system.parts) &&
           (system.momenta.empty() || system.id == "lagrangian" || system.parts.find<WrittenForm>());
}
std::shared_ptr<const std::vector<Symmetry>> searched(const System& system) {
    return system.isMovedOnlyBy<Mechanical>() ? symmetriesOf(system) : symmetriesBesideForces(system, true);
}

bool isKnown(const System& system, const std::string& name) {
    return std::any_of(system.momenta.begin(), system.momenta.end(),
                       [&](const MomentumMap& map) { return map.name == name; });
}

/// A momentum of its own: exact, independent, and not the energy.
bool isMomentum(const Symmetry& s) { return s.isExact() && !s.isDependent && s.name != "energy"; }

/// The coordinate that a symmetry alone moves, where F = 0; empty: it is not that of a cyclic coordinate.
std::string cyclicName(const System& system, const Symmetry& s) {
    if (s.kind != SymmetryKind::translation || !s.F.empty()) return {};
    const auto moved = [](double b) { return b != 0; };
    if (std::count_if(s.b.begin(), s.b.end(), moved) != 1) return {};
    const auto at = std::find_if(s.b.begin(), s.b.end(), moved) - s.b.begin();
    return system.coordinates[static_cast<std::size_t>(at)].name;
}

std::string without(std::string text, char c) {
    std::erase(text, c);
    return text;
}

std::string symbolOf(const Symmetry& s) {
    const std::string about = s.name.substr(s.name.find('.') + 1);
    switch (s.kind) {
        case SymmetryKind::translation:
            return "p_" + about;
        case SymmetryKind::rotation:
            return "L_" + without(about, '-');  // about: the plane, as x-y
        case SymmetryKind::boost:
            return "G_" + about;
        default:
            return "J";
    }
}

std::string unitOf(const System& system, const Symmetry& s) {
    if (s.kind != SymmetryKind::translation) return {};
    const auto at = std::find_if(s.b.begin(), s.b.end(), [](double b) { return b != 0; }) - s.b.begin();
    return system.coordinates[static_cast<std::size_t>(at)].momentumUnit;
}

ConservedMomentum momentumOf(const System& system, const Symmetry& s) {
    const auto d = static_cast<std::size_t>(system.dimension());
    return {s.name, symbolOf(s), unitOf(system, s),
            [s, mechanics = system.mechanics(), d](double t, const double* x) {
                return s.momentum(mechanics, t, x, x + d);
            },
            s.movesTime()};
}

}  // namespace

bool hasMomenta(const System& system) {
    if (!system.momenta.empty()) return true;
    if (!isSearched(system)) return false;
    const auto found = searched(system);
    return std::any_of(found->begin(), found->end(), isMomentum);
}

std::vector<ConservedMomentum> momentaOf(const System& system) {
    std::vector<ConservedMomentum> all;
    const auto d = static_cast<std::size_t>(system.dimension());
    for (const MomentumMap& map : system.momenta)
        all.push_back({map.name, map.symbol, map.unit,
                       [value = map.value, d](double, const double* x) { return value(x, x + d); }});
    if (!isSearched(system)) return all;
    for (const Symmetry& s : *searched(system)) {
        if (!isMomentum(s)) continue;
        if (const std::string cyclic = cyclicName(system, s); !cyclic.empty() && isKnown(system, cyclic))
            continue;
        all.push_back(momentumOf(system, s));
    }
    return all;
}

std::vector<BalancedMomentum> momentaBesideForces(const System& system) {
    std::vector<BalancedMomentum> all;
    for (const Symmetry& s : *symmetriesBesideForces(system, false)) {
        if (!isMomentum(s) || s.movesTime()) continue;
        BalancedMomentum each{momentumOf(system, s), s};
        if (const std::string cyclic = cyclicName(system, s); !cyclic.empty()) each.momentum.name = cyclic;
        all.push_back(std::move(each));
    }
    return all;
}

}  // namespace extremal
