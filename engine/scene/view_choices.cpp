#include "engine/scene/view_choices.hpp"

#include <algorithm>
#include <cmath>

#include "engine/observe/catalog.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/map_grid.hpp"

namespace extremal {
namespace {

std::vector<std::string> stateNames(const System& system) {
    std::vector<std::string> names{"t"};
    for (const Quantity& c : stateColumns(system)) names.push_back(c.name);
    return names;
}

/// The columns of a CSV of this scene.
std::vector<std::string> columnNames(const System& system, const Scene& scene) {
    std::vector<std::string> names = stateNames(system);
    const State initial = initialState(scene, system);
    for (const std::string& id : scene.observe)
        if (const ObservableEntry* entry = findObservable(id); entry && entry->bind)
            for (const Column& column : entry->bind({system, initial, {}}).columns) names.push_back(column.name);
    return names;
}

/// Of the scheme with the fewest elements.
int lastNodeOf(const Scene& scene) {
    double last = 1e5;
    for (const SchemeSpec& s : scene.schemes)
        if (const auto pair = pairOf(s); pair && pair->space.type == "elliptic-elements" && s.step.value > 0)
            last = std::min(last, std::max(1.0, std::round(1 / s.step.value) - 1));
    return static_cast<int>(last);
}

}  // namespace

ViewChoices choicesOf(const std::string& view, const Scene& scene, const System* system) {
    ViewChoices c;
    c.hasZeros = view == "section";
    c.hasColumns = view == "phase" || view == "trajectory" || c.hasZeros;
    c.hasScheme = view == "sparsity" || view == "carpet" || view == mapView ||
                  (view == "profile" && system && !system->field.y.empty());
    c.hasNode = view == "shape-function";
    if (c.hasColumns && system) c.columns = c.hasZeros ? stateNames(*system) : columnNames(*system, scene);
    if (c.hasZeros && system) c.zeros.assign(c.columns.begin() + 1, c.columns.end());
    if (c.hasScheme)
        for (const SchemeSpec& s : scene.schemes) c.schemes.push_back(s.label);
    if (c.hasNode) c.lastNode = lastNodeOf(scene);
    return c;
}

}  // namespace extremal
