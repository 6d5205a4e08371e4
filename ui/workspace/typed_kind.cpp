// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/typed_kind.hpp"

#include <QObject>

#include <array>

#include "ui/workspace/document.hpp"

namespace extremal {

namespace {

constexpr std::array<TypedKind, 4> kinds{{
    {"lagrangian", "lagrangian", "L", QT_TR_NOOP("Lagrangian L"),
     QT_TR_NOOP(
         "L as a formula: velocities are x_t or dot(x), time is t. Lines \"slow: ...\" make terms that "
         "may have rules of their own. Handbook: Typing a Lagrangian."),
     "coordinates", "", "_t", 1, "%1_t^2/2", nullptr, nullptr, nullptr,
     QT_TR_NOOP("The Euler-Lagrange equations; λ is the multiplier of a constraint, the force that keeps it"),
     "lagrangian", "lagrangian#what-is-refused"},
    {"hamiltonian", "hamiltonian", "H", QT_TR_NOOP("Hamiltonian H"),
     QT_TR_NOOP("H as a formula: the momentum of x is p_x, time is t. Lines \"kinetic: ...\" make terms by "
                "name. Handbook: Phase space."),
     "coordinates", "p_", "", 1, "p_%1^2/2", nullptr, nullptr, nullptr, QT_TR_NOOP("Hamilton's equations"),
     "phase-space", "phase-space#keys"},
    {"phase-space", "hamiltonian", "H", QT_TR_NOOP("Hamiltonian H"),
     QT_TR_NOOP("H as a formula in the variables; the one-form below it says how they move. Lines \"along: "
                "...\" make terms by name. Handbook: Phase space."),
     "variables", "", "", 2, "(%1^2 + %2^2)/2", "one_form", "%1", "%2",
     QT_TR_NOOP("The equations of motion: dθ on the velocities is the gradient of H"), "phase-space",
     "phase-space#keys"},
    {"poisson", "hamiltonian", "H", QT_TR_NOOP("Hamiltonian H"),
     QT_TR_NOOP("H as a formula in the variables; the brackets below it say how they move. Lines \"slow: "
                "...\" make terms by name. Handbook: Phase space."),
     "variables", "", "", 2, "(%1^2 + %2^2)/2", "bracket", "%1,%2", "1",
     QT_TR_NOOP("The equations of motion: the velocity of x is its bracket with H"), "phase-space",
     "phase-space#keys"},
}};

}  // namespace

std::string TypedKind::nameOfRate(const std::string& rate) const {
    const std::string_view front(before), back(behind);
    if (!hasRates() || rate.size() <= front.size() + back.size()) return {};
    if (!rate.starts_with(front) || !rate.ends_with(back)) return {};
    return rate.substr(front.size(), rate.size() - front.size() - back.size());
}

const TypedKind* typedKind(std::string_view model) {
    for (const TypedKind& kind : kinds)
        if (model == kind.model) return &kind;
    return nullptr;
}

const TypedKind* typedKindOf(const Value& document) {
    const Value* const type = valueAt(document, "/model/type");
    return type && type->isString() ? typedKind(type->asString()) : nullptr;
}

std::vector<std::string> typedNamesOf(const Value& document) {
    std::vector<std::string> names;
    const TypedKind* const kind = typedKindOf(document);
    const Value* const all = kind ? valueAt(document, kind->namesPlace()) : nullptr;
    if (all && all->isArray())
        for (const Value& name : all->asArray())
            if (name.isString()) names.push_back(name.asString());
    return names;
}

}  // namespace extremal
