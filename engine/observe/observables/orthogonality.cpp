/// How far the attitude is from a rotation: |R^T R - 1| (Frobenius) of the matrix that the quaternion gives
/// as it stands, which is the square of its length times a rotation.
#include <cmath>

#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry orthogonality() {
    ObservableEntry e;
    e.item = {
        "orthogonality", "orthogonality", "|RᵀR - 1| of the attitude: zero where it is a rotation.", {}, {},
        "a rigid body"};
    e.applies = [](const System& system) { return system.hasBody(); };
    e.bind = [](const ObserveContext&) {
        Observer o;
        o.columns = {{"orthogonality", "|RᵀR - 1|", "", {}, {}}};
        o.evaluate = [](const State& state, const StepReport&, double* values) {
            const double* q = state.x.data();
            const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
            values[0] = std::sqrt(3.0) * std::abs(square - 1) * (square + 1);
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
