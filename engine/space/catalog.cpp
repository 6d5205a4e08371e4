#include "engine/space/catalog.hpp"

#include <algorithm>

#include "engine/core/problem.hpp"

namespace extremal {

const std::vector<CatalogItem>& spaceCatalog() {
    static const std::vector<CatalogItem> items = [] {
        std::vector<CatalogItem> all;
        for (const SpaceEntry& e : spaceEntries()) all.push_back(e.item);
        return all;
    }();
    return items;
}

Space<double> makeSpace(const Settings& space) {
    const auto& all = spaceEntries();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const SpaceEntry& e) { return e.item.id == space.type; });
    if (found == all.end()) throw InvalidScene("/space/type", "there is no space \"" + space.type + "\"");
    return found->make(space);
}

}  // namespace extremal
