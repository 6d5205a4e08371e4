// SPDX-License-Identifier: GPL-3.0-or-later
/// An observable that systems evaluate themselves (System::measures): the entry is its descriptor alone, and
/// it applies to the systems that have such a measure.
#pragma once

#include "engine/observe/catalog.hpp"

namespace extremal {

ObservableEntry measuredObservable(CatalogItem item);

/// The measure bound to a run.
Observer bindMeasure(const Measure& measure, const State& initial);

}  // namespace extremal
