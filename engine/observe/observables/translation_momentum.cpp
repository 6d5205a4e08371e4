// SPDX-License-Identifier: GPL-3.0-or-later
/// -integral of u_t u_x of a field, and its change: the momentum of translation, which the field equation of
/// a periodic field keeps, and a scheme on a mesh nearly.
#include "engine/observe/measured.hpp"

namespace extremal::observables {

ObservableEntry translation_momentum() {
    return measuredObservable(
        {"translation-momentum",
         "momentum of translation",
         "-∫u_t u_x of a field, and its change; a mesh is no longer homogeneous, so that it "
         "is kept approximately.",
         {},
         {},
         "a field"});
}

}  // namespace extremal::observables
