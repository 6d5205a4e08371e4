#include "engine/observe/quantity_observable.hpp"

#include <cmath>
#include <utility>

namespace extremal {

Observer observeQuantity(const ObserveContext& context, const Column& column) {
    const std::optional<std::size_t> place = context.quantity(column.name);
    Observer o;
    o.columns = {column};
    o.extreme = 0;
    o.readsQuantities = place.has_value();
    o.evaluate = [place](const NodeBlock& nodes, double* values, std::size_t stride) {
        for (std::size_t i = 0; i < nodes.size(); ++i, values += stride)
            values[0] = place ? nodes.quantities(i)[*place] : std::nan("");
    };
    return o;
}

ObservableEntry quantityObservable(CatalogItem item, Column column) {
    ObservableEntry e;
    e.item = std::move(item);
    e.applies = isField;
    e.bind = [column = std::move(column)](const ObserveContext& context) {
        return observeQuantity(context, column);
    };
    return e;
}

}  // namespace extremal
