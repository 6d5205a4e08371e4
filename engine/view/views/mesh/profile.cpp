// SPDX-License-Identifier: GPL-3.0-or-later
/// A field over space at the last time of each scheme; of wave functions the modulus, or the real and
/// imaginary parts. Over a rectangle that of one scheme, as colours.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry profile() {
    FieldInfo part = choiceField("part", "part", {"modulus", "real", "imaginary", "both"},
                                 "Of wave functions: the modulus, the real part, the imaginary part, or both "
                                 "parts (over a rectangle the real one).");
    return {.item = viewItem(
                "profile", "Profile",
                "a field over space at the end; of wave functions modulus or parts, and the potential",
                {std::move(part)}),
            .recipe = OwnRecipe{"profile"},
            .scales = againstPlace,
            .products = {Product::frames},
            .takes = Takes::everything(),
            .missing =
                [](const View&, const System& system) {
                    return std::string(system.field ? "" : "a field or a wave function");
                },
            .isOfOneScheme = [](const System& system) { return !system.field.y.empty(); }};
}

}  // namespace extremal::views
