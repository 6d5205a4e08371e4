// SPDX-License-Identifier: GPL-3.0-or-later
/// What every catalogue (models, spaces, quadratures, schemes, baselines, observables, views) says of an
/// entry.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/field.hpp"

namespace extremal {

/// What a scheme promises; each claim is measured by tests/laws.
struct Claims {
    int order = 0;             ///< order of the end-point map, for q and p
    bool isSymmetric = false;  ///< equals its adjoint: a step forward and one back return
    bool isSymplectic = false;
    std::vector<std::string> conserves;  ///< "momentum", "quadratic invariants", "energy", ...
    bool isOneStep = true;               ///< carries nothing from step to step but the state: no memory
    bool operator==(const Claims&) const = default;
};

/// One line of `extremal list KIND`.
struct CatalogItem {
    std::string id;
    std::string title;
    std::string description;
    std::vector<FieldInfo> parameters;
    std::optional<Claims> claims;  ///< schemes and baselines
    std::string needs;  ///< what a model must have ("a mechanical system", "smooth forces"), or empty

    // Compiled once.
    CatalogItem(std::string id, std::string title, std::string description,
                std::vector<FieldInfo> parameters = {}, std::optional<Claims> claims = {},
                std::string needs = {});
    CatalogItem();
    CatalogItem(const CatalogItem&);
    CatalogItem(CatalogItem&&) noexcept;
    CatalogItem& operator=(const CatalogItem&);
    CatalogItem& operator=(CatalogItem&&) noexcept;
    ~CatalogItem();
};

std::vector<std::string> idsOf(const std::vector<CatalogItem>& items);

}  // namespace extremal
