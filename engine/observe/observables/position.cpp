// SPDX-License-Identifier: GPL-3.0-or-later
/// The mean position of a wave function.
#include "engine/observe/measured.hpp"

namespace extremal::observables {

ObservableEntry position() {
    return measuredObservable(
        {"position",
         "position",
         "Mean position of the wave function; on a periodic interval the mean of cos x too.",
         {},
         {},
         "a wave function"});
}

}  // namespace extremal::observables
