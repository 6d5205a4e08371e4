// SPDX-License-Identifier: GPL-3.0-or-later
/// How far the elements of a moving mesh are from equal shares of their monitor: the largest difference of
/// the squared shares of two neighbours, over the mean.
#include "engine/observe/quantity_observable.hpp"

namespace extremal::observables {

ObservableEntry mesh_residual() {
    return quantityObservable({"mesh-residual",
                               "mesh residual",
                               "Of moving meshes, the largest difference between the shares that two "
                               "neighbouring elements have of the monitor, over the mean share (both "
                               "squared); round-off where equidistribution is a constraint.",
                               {},
                               {},
                               "a field"},
                              {"mesh_residual", "max |g|", "", {}, {}});
}

}  // namespace extremal::observables
