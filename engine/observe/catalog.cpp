// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/observe/catalog.hpp"

#include <algorithm>
#include <limits>
#include <memory>

namespace extremal {

Observer observeQuantity(const ObserveContext& context, std::string_view quantity, Column value,
                         Column change) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    const std::optional<std::size_t> index = context.quantity(quantity);
    Observer o;
    o.readsQuantities = index.has_value();
    o.columns = {std::move(value), std::move(change)};
    o.extreme = 1;
    const auto first = std::make_shared<double>(unknown);
    o.evaluate = [index, first](const NodeBlock& nodes, double* values, std::size_t stride) {
        for (std::size_t i = 0; i < nodes.size(); ++i, values += stride) {
            values[0] = index ? nodes.quantities(i)[*index] : unknown;
            if (!(*first == *first)) *first = values[0];
            values[1] = values[0] - *first;
        }
    };
    o.checkpoint = [first](Archive& archive) { archive(*first); };
    return o;
}

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
