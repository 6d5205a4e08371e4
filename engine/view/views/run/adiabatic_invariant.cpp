// SPDX-License-Identifier: GPL-3.0-or-later
/// The fast energy over its frequency of the moment: what slow motion leaves nearly as it is.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry adiabatic_invariant() {
    return {
        .item = viewItem("adiabatic-invariant", "Adiabatic invariant",
                         "fast energy over its frequency against time; nearly constant over very long times"),
        .recipe = ColumnAgainstTime{"adiabatic_invariant", true},
        .scales = againstTime,
        .observable = "adiabatic-invariant"};
}

}  // namespace extremal::views
