// SPDX-License-Identifier: GPL-3.0-or-later
/// Gauss and Lobatto rules, remembered: their nodes are roots, which take longer to find than dozens of steps
/// of what uses them.
#pragma once

#include "engine/quadrature/rule.hpp"

namespace extremal {

/// gauss<double>(n) and lobatto<double>(n), for as long as the program runs. Any thread may ask.
const Rule<double>& knownGauss(int n);
const Rule<double>& knownLobatto(int n);

}  // namespace extremal
