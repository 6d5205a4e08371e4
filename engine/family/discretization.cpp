// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/discretization.hpp"

namespace extremal {

Properties::Properties() = default;
Properties::Properties(const Properties&) = default;
Properties::Properties(Properties&&) noexcept = default;
Properties& Properties::operator=(const Properties&) = default;
Properties& Properties::operator=(Properties&&) noexcept = default;
Properties::~Properties() = default;

}  // namespace extremal
