// SPDX-License-Identifier: GPL-3.0-or-later
/// An observable of fields that some schemes can say of their last step (Integrator::quantities), and others
/// leave unknown.
#pragma once

#include "engine/observe/catalog.hpp"

namespace extremal {

/// One column, whose name is that of the quantity; its size goes into the summary.
ObservableEntry quantityObservable(CatalogItem item, Column column);

/// Of variations of the state (integrator/variation/with_variations.hpp): columns by the names of their
/// quantities, the first of which goes into the summary where `isDefect`. Of systems with coordinates and of
/// bodies.
ObservableEntry variationObservable(CatalogItem item, std::vector<Column> columns, VariationPlan plan,
                                    bool isDefect);

/// What `symplecticity` of a step is where it has another name.
ObservableEntry defectObservable(CatalogItem item, Column column);

/// Columns by the names of their quantities; unknown where the integrator has none.
Observer observeQuantities(const ObserveContext& context, const std::vector<Column>& columns);
/// The observer of one column, whose size goes into the summary.
Observer observeQuantity(const ObserveContext& context, const Column& column);

}  // namespace extremal
