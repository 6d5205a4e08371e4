// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/density/part.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/view/catalog.hpp"

#include <algorithm>

#include "engine/observe/catalog.hpp"

namespace extremal {

const ViewEntry* findView(std::string_view id) {
    const auto& all = viewEntries();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const ViewEntry& e) { return e.item.id == id; });
    return found == all.end() ? nullptr : &*found;
}

const std::vector<CatalogItem>& viewCatalog() {
    static const std::vector<CatalogItem> items = [] {
        std::vector<CatalogItem> result;
        for (const ViewEntry& e : viewEntries()) result.push_back(e.item);
        return result;
    }();
    return items;
}

std::string missingFor(const View& view, const System& system) {
    const ViewEntry* entry = findView(view.id);
    if (!entry) return {};
    const ObservableEntry* const observable = findObservable(entry->observable);
    const Takes takes = entry->takes ? *entry->takes
                        : observable ? observable->takes
                                     : plainProblemsAndGroups().with<DensityField>();
    if (const std::string needed = neededInstead(takes, system.parts); !needed.empty()) return needed;
    if (observable && !appliesTo(*observable, system))
        return observable->item.needs.empty() ? "the observable " + entry->observable
                                              : observable->item.needs;
    return entry->missing ? entry->missing(view, system) : std::string();
}

std::vector<std::string> viewsOf(const System& system) {
    std::vector<std::string> ids;
    for (const ViewEntry& e : viewEntries())
        if (missingFor({e.item.id, "", ""}, system).empty()) ids.push_back(e.item.id);
    return ids;
}

ViewKeys keysOf(const std::string& view, const System* system) {
    const ViewEntry* entry = findView(view);
    if (!entry) return {};
    ViewKeys keys = entry->keys;
    keys.hasScheme = keys.hasScheme || (entry->isOfOneScheme && system && entry->isOfOneScheme(*system));
    return keys;
}

CatalogItem viewItem(std::string id, std::string title, std::string description,
                     std::vector<FieldInfo> keys) {
    return {std::move(id), std::move(title), std::move(description), std::move(keys), {}, {}};
}

}  // namespace extremal
