// SPDX-License-Identifier: GPL-3.0-or-later
/// The probability current through the middle of the domain.
#include "engine/observe/measured.hpp"

namespace extremal::observables {

ObservableEntry current() {
    return measuredObservable({"current",
                               "current",
                               "Probability current through the middle of the domain, counted to the right.",
                               {},
                               {},
                               "a wave function"});
}

}  // namespace extremal::observables
