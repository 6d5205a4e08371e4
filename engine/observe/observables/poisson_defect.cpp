// SPDX-License-Identifier: GPL-3.0-or-later
/// How far each step is from keeping a bracket, max |M J_0 M^T - J_1| with its tangent map M: what
/// `symplecticity` is on problems with coordinates. Gauss collocation keeps a constant bracket, and no other.
#include "engine/model/first_order/poisson.hpp"
#include "engine/observe/quantity_observable.hpp"

namespace extremal::observables {

ObservableEntry poisson_defect() {
    ObservableEntry e = defectObservable(
        {"poisson-defect",
         "defect of the bracket",
         "Largest entry of M J_0 M^T - J_1, M the tangent map of the step that ended at each row and J the "
         "bracket of the variables at its ends.",
         {},
         {},
         "a scheme with a tangent map"},
        {"poisson_defect", "max |MJ₀Mᵀ − J₁|", "", {}, {}});
    e.takes = Takes::only<PoissonStructure>();
    return e;
}

}  // namespace extremal::observables
