/// An observable of fields that some schemes can say of their last step (Integrator::quantities), and others
/// leave unknown.
#pragma once

#include "engine/observe/catalog.hpp"

namespace extremal {

/// One column, whose name is that of the quantity; its size goes into the summary.
ObservableEntry quantityObservable(CatalogItem item, Column column);

/// The observer of that column.
Observer observeQuantity(const ObserveContext& context, const Column& column);

}  // namespace extremal
