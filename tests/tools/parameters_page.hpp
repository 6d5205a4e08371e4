// SPDX-License-Identifier: GPL-3.0-or-later
/// The handbook's page of the keys of spaces and quadratures, and of what their default pairs claim: made
/// from the descriptors and from describe(), so that it says what the program does.
#pragma once

#include <string>

namespace extremal::tools {

std::string parametersPage();

}  // namespace extremal::tools
