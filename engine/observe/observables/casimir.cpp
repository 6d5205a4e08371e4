// SPDX-License-Identifier: GPL-3.0-or-later
/// The Casimir of a body's bracket.
#include "engine/observe/measured.hpp"

namespace extremal::observables {

ObservableEntry casimir() {
    return measuredObservable({"casimir",
                               "Casimir",
                               "Square of a free body's angular momentum; of tops, its vertical component.",
                               {},
                               {},
                               "a rigid body"});
}

}  // namespace extremal::observables
