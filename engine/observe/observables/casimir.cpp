/// The Casimir of a body's bracket: |Pi|^2 of a free body, Pi . R^T e_3 of a top. Kept by every exact
/// solution; schemes that turn the momentum by a rotation keep it too.
#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry casimir() {
    ObservableEntry e;
    e.item = {
        "casimir", "Casimir", "Square of a free body's angular momentum; of tops, its vertical component.",
        {},        {},        "a rigid body"};
    e.applies = [](const System& system) { return static_cast<bool>(system.casimir); };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.columns = {{"casimir", "C", "", {}, {}}};
        o.evaluate = [casimir = context.system.casimir](const State& state, const StepReport&,
                                                        double* values) {
            values[0] = casimir(state.t, state.x.data());
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
