#include "engine/baseline/catalog.hpp"

#include <algorithm>

namespace extremal {

const BaselineEntry* findBaseline(std::string_view id) {
    const auto& all = baselineCatalog();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const BaselineEntry& e) { return e.item.id == id; });
    return found == all.end() ? nullptr : &*found;
}

Claims claimsOf(const BaselineEntry& entry, const Settings& settings) {
    return entry.claims ? entry.claims(settings) : entry.item.claims.value_or(Claims{});
}

}  // namespace extremal
