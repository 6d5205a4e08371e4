// SPDX-License-Identifier: GPL-3.0-or-later
/// How far the attitude of a body is from a rotation.
#include "engine/observe/measured.hpp"

namespace extremal::observables {

ObservableEntry orthogonality() {
    return measuredObservable({"orthogonality",
                               "orthogonality",
                               "|RᵀR - 1| of the attitude: zero where it is a rotation.",
                               {},
                               {},
                               "a rigid body"});
}

}  // namespace extremal::observables
