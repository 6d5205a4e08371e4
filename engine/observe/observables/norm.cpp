// SPDX-License-Identifier: GPL-3.0-or-later
/// The norm of a wave function, and its change.
#include "engine/observe/measured.hpp"

namespace extremal::observables {

ObservableEntry norm() {
    return measuredObservable(
        {"norm", "norm", "Norm of the wave function, and its change.", {}, {}, "a wave function"});
}

}  // namespace extremal::observables
