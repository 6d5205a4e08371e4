// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/part_kinds.hpp"

#include <QObject>

#include <algorithm>

#include "engine/model/system.hpp"

namespace extremal {

const std::vector<PartKind>& partKinds() {
    static const std::vector<PartKind> all{
        {"one_form", QT_TR_NOOP("one-form"), PartNaming::byCoordinate, "", "", "y",
         QT_TR_NOOP("θ of a variable: what its velocity is multiplied with. Variables without a line have no "
                    "velocity in L")},
        {"bracket", QT_TR_NOOP("bracket"), PartNaming::byPair, "", "", "1",
         QT_TR_NOOP("{x, y} of two variables; pairs without a line commute")},
        {"casimirs", QT_TR_NOOP("Casimir"), PartNaming::free, "C", "", "x + y",
         QT_TR_NOOP("A function that commutes with every variable, which is checked: it is constant whatever "
                    "H is")},
        {"constraints", QT_TR_NOOP("constraint"), PartNaming::free, "rod", "= 0", "x^2 + y^2 - l^2",
         QT_TR_NOOP("A relation of coordinates and t that holds at all times: the formula is 0")},
        {"rolling", QT_TR_NOOP("rolling"), PartNaming::free, "wheel", "= 0", "x_t - r*theta_t",
         QT_TR_NOOP("A relation that is linear in velocities, as of what rolls: the formula is 0")},
        {"forces", QT_TR_NOOP("force"), PartNaming::byCoordinate, "", "", "-c*x_t + sin(t)",
         QT_TR_NOOP("A force on a coordinate that no Lagrangian has; velocities and t may be in it")},
        {"dissipation", QT_TR_NOOP("damping"), PartNaming::single, "", "", "c/2*x_t^2",
         QT_TR_NOOP("Rayleigh's function D: adds the force -dD/dv to each coordinate")},
        {"controls", QT_TR_NOOP("control"), PartNaming::free, "u", "", "sin(t)",
         QT_TR_NOOP("A name for a function of time that forces and Hamiltonians may use")},
        {"walls",
         QT_TR_NOOP("wall"),
         PartNaming::free,
         "floor",
         "≥ 0",
         "y",
         QT_TR_NOOP("The gap, a formula that stays positive, and what part of the speed comes back"),
         {{"gap", ""}, {"restitution", "1"}}}};
    return all;
}

bool isOffered(const PartKind& kind, const std::string& model) {
    const ModelEntry* const entry = findModel(model);
    return entry && std::any_of(entry->item.parameters.begin(), entry->item.parameters.end(),
                                [&](const FieldInfo& field) { return field.key == kind.key; });
}

}  // namespace extremal
