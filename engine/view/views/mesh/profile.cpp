// SPDX-License-Identifier: GPL-3.0-or-later
/// A field over space at the last time of each scheme; of wave functions the modulus, or the real and
/// imaginary parts. Over a rectangle that of one scheme, as colours.
#include <algorithm>

#include "engine/core/text/text.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry profile() {
    FieldInfo part = choiceField("part", "part", {"modulus", "real", "imaginary", "both"},
                                 "Of wave functions: the modulus, the real part, the imaginary part, or both "
                                 "parts (over a rectangle the real one).");
    FieldInfo component =
        textField("component", "", "",
                  "Of a field with several components: the one that is shown. By default the size and phase "
                  "of two that turn into each other, else the first.");
    return {.item = viewItem(
                "profile", "Profile",
                "a field over space at the end; of wave functions modulus or parts, and the potential",
                {std::move(part), std::move(component)}),
            .recipe = OwnRecipe{"profile"},
            .scales = againstPlace,
            .products = {Product::frames},
            .takes = Takes::everything(),
            .missing =
                [](const View& view, const System& system) {
                    if (!system.field) return std::string("a field or a wave function");
                    const std::string name = view.keys.text("component");
                    const auto& names = system.field.components;
                    const bool isThere =
                        name.empty() || std::find(names.begin(), names.end(), name) != names.end();
                    return isThere ? std::string() : "one of the components " + joinNames(names);
                },
            .isOfOneScheme = [](const System& system) { return !system.field.y.empty(); }};
}

}  // namespace extremal::views
