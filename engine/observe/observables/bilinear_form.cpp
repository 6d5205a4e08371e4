/// The bilinear form that three-level schemes for wave functions conserve, between the previous node and this
/// one, and its change: what the integrator says of its last step. Empty at the first node, and for schemes
/// that have none: one-step schemes conserve the norm.
#include <limits>

#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry bilinear_form() {
    ObservableEntry e;
    e.item = {"bilinear-form",
              "bilinear form",
              "What three-level schemes of wave functions keep in place of the norm.",
              {},
              {},
              "a wave function"};
    e.applies = [](const System& system) { return isWave(system); };
    e.bind = [](const ObserveContext& context) {
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        const std::optional<std::size_t> form = context.quantity("bilinear_form");
        Observer o;
        o.extreme = 1;
        o.readsQuantities = form.has_value();
        o.columns = {{"bilinear_form", "J", "", {}, {}}, {"bilinear_form_error", "J - J(0)", "", {}, {}}};
        o.evaluate = [form, first = unknown](const NodeBlock& nodes, double* values,
                                             std::size_t stride) mutable {
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride) {
                values[0] = form ? nodes.quantities(i)[*form] : unknown;
                if (!(first == first)) first = values[0];
                values[1] = values[0] - first;
            }
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
