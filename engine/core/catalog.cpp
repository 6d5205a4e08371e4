// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/catalog.hpp"

#include <utility>

namespace extremal {

CatalogItem::CatalogItem(std::string itsId, std::string itsTitle, std::string itsDescription,
                         std::vector<FieldInfo> itsParameters, std::optional<Claims> itsClaims,
                         std::string itsNeeds)
    : id(std::move(itsId)),
      title(std::move(itsTitle)),
      description(std::move(itsDescription)),
      parameters(std::move(itsParameters)),
      claims(std::move(itsClaims)),
      needs(std::move(itsNeeds)) {}
CatalogItem::CatalogItem() = default;
CatalogItem::CatalogItem(const CatalogItem&) = default;
CatalogItem::CatalogItem(CatalogItem&&) noexcept = default;
CatalogItem& CatalogItem::operator=(const CatalogItem&) = default;
CatalogItem& CatalogItem::operator=(CatalogItem&&) noexcept = default;
CatalogItem::~CatalogItem() = default;

std::vector<std::string> idsOf(const std::vector<CatalogItem>& items) {
    std::vector<std::string> ids;
    for (const CatalogItem& item : items) ids.push_back(item.id);
    return ids;
}

}  // namespace extremal
