// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "engine/model/system.hpp"

namespace extremal {

const ModelEntry* findModel(std::string_view id) {
    const auto& all = modelCatalog();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const ModelEntry& e) { return e.item.id == id; });
    return found == all.end() ? nullptr : &*found;
}

}  // namespace extremal
