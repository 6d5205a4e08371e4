#include "ui/shell/fitting.hpp"

#include "engine/baseline/catalog.hpp"
#include "engine/core/problem.hpp"
#include "engine/family/scheme.hpp"
#include "engine/family/wave/wave.hpp"
#include "engine/scene/bind.hpp"
#include "engine/space/catalog.hpp"

namespace extremal {
namespace {

/// Where H is a full matrix there are few ways, and their makers know; a trial costs little with at most 512
/// modes.
bool isForBoundary(const BaselineEntry& e, const System& system) {
    if (!hasFullMatrix(system)) return true;
    Settings settings{e.item.id, {}, {}};
    for (const FieldInfo& f : e.item.parameters) settings.keys.emplace_back(f.key, f.firstValue());
    try {
        (void)e.make(system, {{0, 1e-9}, 0, 0, settings});
    } catch (const InvalidScene&) {
        return false;
    }
    return true;
}

bool isForBoundary(const Discretization& pair, const System& system) {
    return !isBetweenWalls(system) || pair.space.text("form") != "three-level";
}

}  // namespace

std::vector<CatalogItem> fittingSpaces(const Scene& scene) {
    const System system = makeSystem(scene);
    std::vector<CatalogItem> items;
    for (const SpaceEntry& e : spaceEntries())
        if (appliesTo(e, system)) items.push_back(e.item);
    return items;
}

std::vector<const BaselineEntry*> fittingBaselines(const Scene& scene) {
    const System system = makeSystem(scene);
    std::vector<const BaselineEntry*> entries;
    for (const BaselineEntry& e : baselineCatalog())
        if (appliesTo(e, system) && isForBoundary(e, system)) entries.push_back(&e);
    return entries;
}

std::vector<const SchemeEntry*> fittingSchemes(const Scene& scene) {
    const System system = makeSystem(scene);
    std::vector<const SchemeEntry*> entries;
    for (const SchemeEntry& e : schemeCatalog())
        if (const Discretization pair = e.make(e.minDegree);
            isPairFor(pair, system) && isForBoundary(pair, system))
            entries.push_back(&e);
    return entries;
}

std::string pairSpace(const Scene& scene) {
    const std::vector<CatalogItem> items = fittingSpaces(scene);
    for (const CatalogItem& item : items)
        if (item.id == "polynomial") return item.id;
    return items.empty() ? "polynomial" : items.front().id;
}

}  // namespace extremal
