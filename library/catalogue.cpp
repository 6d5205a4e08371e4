// SPDX-License-Identifier: GPL-3.0-or-later
#include "extremal/catalogue.hpp"

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/study/atlas/catalogues.hpp"

namespace extremal::api {

std::vector<std::string> catalogueNames() {
    std::vector<std::string> names;
    for (const Catalogue& each : catalogues()) names.push_back(each.name);
    return names;
}

Value catalogue(const std::string& name) {
    const Catalogue* const found = findCatalogue(name);
    if (!found)
        throw InvalidScene("", "there is no catalogue \"" + name + "\"", suggestName(name, catalogueNames()));
    return catalogueValue(*found);
}

}  // namespace extremal::api
