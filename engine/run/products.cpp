#include "engine/run/products.hpp"

#include "engine/scene/view_choices.hpp"

namespace extremal {

ProductPlan::ProductPlan(const Scene& scene, const System& system) {
    for (const View& view : shownViews(scene))
        if (const ViewEntry* entry = findView(view.id))
            for (const Product product : entry->products) add(product);
    if (system.field) add(Product::frames);  // rows do not hold the state: the export writes it from frames
}

bool needs(const View& view, Product product) {
    const ViewEntry* entry = findView(view.id);
    return entry &&
           std::find(entry->products.begin(), entry->products.end(), product) != entry->products.end();
}

}  // namespace extremal
