// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/spins/spins.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/observe/quantity_observable.hpp"

#include <cmath>
#include <utility>

#include "engine/model/first_order/one_form.hpp"
#include "engine/model/first_order/poisson.hpp"
#include "engine/model/phase_mechanics.hpp"

namespace extremal {

Observer observeQuantities(const ObserveContext& context, const std::vector<Column>& columns) {
    std::vector<std::optional<std::size_t>> places;
    Observer o;
    o.columns = columns;
    for (const Column& column : columns) {
        places.push_back(context.quantity(column.name));
        o.readsQuantities = o.readsQuantities || places.back();
    }
    o.evaluate = [places](const NodeBlock& nodes, double* values, std::size_t stride) {
        for (std::size_t i = 0; i < nodes.size(); ++i, values += stride)
            for (std::size_t k = 0; k < places.size(); ++k)
                values[k] = places[k] ? nodes.quantities(i)[*places[k]] : std::nan("");
    };
    return o;
}

Observer observeQuantity(const ObserveContext& context, const Column& column) {
    Observer o = observeQuantities(context, {column});
    o.extreme = 0;
    return o;
}

ObservableEntry variationObservable(CatalogItem item, std::vector<Column> columns, VariationPlan plan,
                                    bool isDefect) {
    ObservableEntry e;
    e.item = std::move(item);
    e.variations = plan;
    e.takes = Takes::only<Mechanical, Body, LieGroup, PhaseMechanics, Spins, OneForm, PoissonStructure>();
    e.bind = [columns = std::move(columns), isDefect](const ObserveContext& context) {
        Observer o = observeQuantities(context, columns);
        if (isDefect) o.extreme = 0;
        return o;
    };
    return e;
}

ObservableEntry quantityObservable(CatalogItem item, Column column) {
    ObservableEntry e;
    e.item = std::move(item);
    e.takes = Takes::only<ScalarField>();
    e.bind = [column = std::move(column)](const ObserveContext& context) {
        return observeQuantity(context, column);
    };
    return e;
}

ObservableEntry defectObservable(CatalogItem item, Column column) {
    ObservableEntry e = variationObservable(std::move(item), {}, {.map = true}, true);
    e.bind = [column = std::move(column)](const ObserveContext& context) {
        const auto place = context.quantity("symplecticity");
        Observer o;
        o.columns = {column};
        o.extreme = 0;
        o.readsQuantities = place.has_value();
        o.evaluate = [place](const NodeBlock& nodes, double* values, std::size_t stride) {
            for (std::size_t i = 0; i < nodes.size(); ++i)
                values[i * stride] = place ? nodes.quantities(i)[*place] : std::nan("");
        };
        return o;
    };
    return e;
}

}  // namespace extremal
