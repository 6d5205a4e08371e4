#include "engine/observe/catalog.hpp"

#include <algorithm>

namespace extremal {

const ObservableEntry* findObservable(std::string_view id) {
    const auto& all = observableEntries();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const ObservableEntry& e) { return e.item.id == id; });
    return found == all.end() ? nullptr : &*found;
}

const std::vector<CatalogItem>& observableCatalog() {
    static const std::vector<CatalogItem> items = [] {
        std::vector<CatalogItem> all;
        for (const ObservableEntry& e : observableEntries()) all.push_back(e.item);
        return all;
    }();
    return items;
}

}  // namespace extremal
