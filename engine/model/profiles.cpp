// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/profiles.hpp"

#include "engine/model/field/profile.hpp"
#include "engine/model/plane_field/start.hpp"
#include "engine/model/wave/start/packet.hpp"

namespace extremal {

const std::vector<CatalogItem>& profileCatalog() {
    static const std::vector<CatalogItem> all = [] {
        std::vector<CatalogItem> items = fieldProfiles();
        for (CatalogItem& profile : planeFieldProfiles()) items.push_back(std::move(profile));
        for (CatalogItem& packet : wave::packets()) items.push_back(std::move(packet));
        return items;
    }();
    return all;
}

}  // namespace extremal
