// SPDX-License-Identifier: GPL-3.0-or-later
/// The order measured by running again with half and a quarter of the step; fills order_measured in the
/// summary.
#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry order() {
    ObservableEntry e;
    e.item = {
        "order", "measured order", "Runs at step/2 and step/4 too and fits the order of the final error.", {},
        {},      "a reference"};
    e.needsReference = true;
    e.takes = Takes::everything();
    return e;
}

}  // namespace extremal::observables
