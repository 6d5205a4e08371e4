// SPDX-License-Identifier: GPL-3.0-or-later
/// The virial of each scheme against time.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry virial() {
    return {.item = viewItem("virial", "Virial", "q p of every scheme against time"),
            .recipe = ColumnAgainstTime{"virial"},
            .scales = againstTime,
            .observable = "virial"};
}

}  // namespace extremal::views
