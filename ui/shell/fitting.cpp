#include "ui/shell/fitting.hpp"

#include "engine/baseline/catalog.hpp"
#include "engine/integrator/scheme.hpp"
#include "engine/scene/bind.hpp"
#include "engine/space/catalog.hpp"

namespace extremal {

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
        if (appliesTo(e, system)) entries.push_back(&e);
    return entries;
}

std::vector<const SchemeEntry*> fittingSchemes(const Scene& scene) {
    const System system = makeSystem(scene);
    std::vector<const SchemeEntry*> entries;
    for (const SchemeEntry& e : schemeCatalog())
        if (isPairFor(e.make(e.minDegree), system)) entries.push_back(&e);
    return entries;
}

std::string pairSpace(const Scene& scene) {
    const std::vector<CatalogItem> items = fittingSpaces(scene);
    for (const CatalogItem& item : items)
        if (item.id == "polynomial") return item.id;
    return items.empty() ? "polynomial" : items.front().id;
}

}  // namespace extremal
