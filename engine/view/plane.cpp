// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/view/plane.hpp"

#include "engine/view/catalog.hpp"

namespace extremal {
namespace {

/// By default the plane of the second coordinate; of a system with one, the momentum against time.
ViewPlane planeOfSection(const View& view, const System& system) {
    ViewPlane plane{view.x, view.y, view.at};
    const auto& coordinates = system.coordinates;
    const std::vector<Quantity> columns = stateColumns(system);
    if (plane.at.empty() && !columns.empty()) plane.at = columns.front().name;
    if (coordinates.size() > 1) {
        if (plane.x.empty()) plane.x = "q." + coordinates[1].name;
        if (plane.y.empty()) plane.y = "p." + coordinates[1].name;
    }
    if (plane.x.empty()) plane.x = "t";
    if (plane.y.empty())
        plane.y = !coordinates.empty() ? "p." + coordinates.front().name
                  : columns.empty()    ? std::string()
                                       : columns.back().name;
    return plane;
}

}  // namespace

std::optional<ViewPlane> planeOf(const View& view, const System& system) {
    const ViewEntry* const entry = findView(view.id);
    if (!entry) return {};
    if (entry->keys.hasZeros) return planeOfSection(view, system);
    if (const auto* columns = std::get_if<ColumnAgainstColumn>(&entry->recipe))
        return ViewPlane{columns->x(view, system), columns->y(view, system)};
    return {};
}

std::vector<FieldInfo> startsFields() {
    FieldInfo spread =
        integerField("spread", "", 0, ViewStarts::most, 0.0,
                     "that many more starts, spread evenly over what the energy admits (section) "
                     "or over the range of the view");
    FieldInfo starts =
        optionalJsonField("starts", "starts",
                          "points [x, y] from which motions start besides that of the scene, coloured by "
                          "their Lyapunov exponent; "
                          "in a section the momentum of the column that passes zero follows from the energy");
    return {starts, spread};
}

}  // namespace extremal
