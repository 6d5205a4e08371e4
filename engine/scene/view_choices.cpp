// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/view_choices.hpp"

#include <algorithm>
#include <cmath>

#include "engine/family/parts/shape_functions.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/map_grid.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {
namespace {

std::vector<std::string> stateNames(const System& system) {
    std::vector<std::string> names{"t"};
    for (const Quantity& c : stateColumns(system)) names.push_back(c.name);
    return names;
}

}  // namespace

std::vector<View> shownViews(const Scene& scene) {
    if (!scene.views.empty()) return scene.views;
    std::vector<View> result;
    for (const char* id : {"work-precision", "energy", "error", "momentum", "norm", "trajectory", "phase"}) {
        const ViewEntry* entry = findView(id);
        const bool isObserved =
            entry && (entry->observable.empty() || std::find(scene.observe.begin(), scene.observe.end(),
                                                             entry->observable) != scene.observe.end());
        if (isObserved) result.push_back({id, "", ""});
    }
    return result;
}

std::string unsuitableFor(const ViewEntry& view, const ResolvedScheme& scheme) {
    if (!view.unsuitable) return {};
    if (scheme.baseline) return "a baseline, which no discrete action defines";
    if (scheme.plain()) return view.unsuitable(*scheme.plain());
    if (scheme.isTested()) return "steps that keep invariants, which no discrete action defines";
    if (scheme.isMonitored()) return "steps that follow a monitor, in another time than the action";
    return "a composition, whose step is several elements";
}

std::vector<std::string> columnsFor(const std::string& view, const Scene& scene, const System& system) {
    std::vector<std::string> names = stateNames(system);
    if (!keysOf(view, &system).hasObserved) return names;
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
        if (const auto made = discretizationOf(s);
            made && familyPart<ShapeFunctions>(made->space) && s.step.value > 0)
            last = std::min(last, std::max(1.0, std::round(1 / s.step.value) - 1));
    return static_cast<int>(last);
}

}  // namespace extremal
