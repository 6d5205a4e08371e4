// SPDX-License-Identifier: GPL-3.0-or-later
/// The share of a wave function in its highest modes.
#include "engine/observe/measured.hpp"

namespace extremal::observables {

ObservableEntry spectrum_tail() {
    return measuredObservable({"spectrum-tail",
                               "spectrum tail",
                               "Share of the wave function in the upper eighth of its modes: is N enough?",
                               {},
                               {},
                               "a wave function"});
}

}  // namespace extremal::observables
