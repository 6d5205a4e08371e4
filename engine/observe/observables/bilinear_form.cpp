// SPDX-License-Identifier: GPL-3.0-or-later
/// The bilinear form that three-level schemes for wave functions conserve, between the previous node and this
/// one, and its change: what the integrator says of its last step. Empty at the first node, and for schemes
/// that have none: one-step schemes conserve the norm.
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
    e.takes = Takes::only<Wave>();
    e.bind = [](const ObserveContext& context) {
        return observeQuantity(context, "bilinear_form", {"bilinear_form", "J", "", {}, {}},
                               {"bilinear_form_error", "J - J(0)", "", {}, {}});
    };
    return e;
}

}  // namespace extremal::observables
