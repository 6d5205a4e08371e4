// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/products.hpp"

#include "engine/scene/resolve.hpp"
#include "engine/scene/view_choices.hpp"

namespace extremal {

ProductPlan::ProductPlan(const ResolvedScene& resolved) {
    for (const View& view : shownViews(resolved.scene))
        if (const ViewEntry* entry = findView(view.id))
            for (const Product product : entry->products) add(product);
    // Rows do not hold the state of a field, nor every step of a scheme whose times are unknowns: exports
    // write files of both.
    if (resolved.system->field) add(Product::frames);
    for (const ResolvedScheme& scheme : resolved.schemes)
        if (scheme.grid == TimeGrid::free) add(Product::steps);
}

bool needs(const View& view, Product product) {
    const ViewEntry* entry = findView(view.id);
    return entry &&
           std::find(entry->products.begin(), entry->products.end(), product) != entry->products.end();
}

}  // namespace extremal
