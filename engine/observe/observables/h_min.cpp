// SPDX-License-Identifier: GPL-3.0-or-later
/// The length of the smallest element of a field's mesh.
#include "engine/observe/measured.hpp"

namespace extremal::observables {

ObservableEntry h_min() {
    return measuredObservable(
        {"h-min",
         "smallest element",
         "Length of the smallest element of the mesh; the same at all times where nodes "
         "do not move.",
         {},
         {},
         "a field"});
}

}  // namespace extremal::observables
