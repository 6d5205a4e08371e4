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

}  // namespace

ViewKeys keysOf(const std::string& view, const System* system) {
    ViewKeys k;
    k.hasZeros = view == "section";
    k.hasColumns = view == "phase" || view == "trajectory" || k.hasZeros;
    k.hasScheme = view == "sparsity" || view == "carpet" || view == mapView ||
                  (view == "profile" && system && !system->field.y.empty());
    k.hasNode = view == "shape-function";
    return k;
}

std::vector<std::string> columnsFor(const std::string& view, const Scene& scene, const System& system) {
    std::vector<std::string> names = stateNames(system);
    if (keysOf(view, &system).hasZeros) return names;
    const State initial = initialState(scene, system);
    for (const std::string& id : scene.observe)
        if (const ObservableEntry* entry = findObservable(id); entry && entry->bind)
            for (const Column& column : entry->bind({system, initial, {}}).columns)
                names.push_back(column.name);
    return names;
}

std::vector<std::string> zerosFor(const System& system) {
    std::vector<std::string> names = stateNames(system);
    names.erase(names.begin());
    return names;
}

std::vector<std::string> labelsOf(const Scene& scene) {
    std::vector<std::string> labels;
    for (const SchemeSpec& s : scene.schemes) labels.push_back(s.label);
    return labels;
}

/// Of the scheme with the fewest elements.
int lastNodeOf(const Scene& scene) {
    double last = 1e5;
    for (const SchemeSpec& s : scene.schemes)
        if (const auto pair = pairOf(s); pair && pair->space.type == "elliptic-elements" && s.step.value > 0)
            last = std::min(last, std::max(1.0, std::round(1 / s.step.value) - 1));
    return static_cast<int>(last);
}

}  // namespace extremal
