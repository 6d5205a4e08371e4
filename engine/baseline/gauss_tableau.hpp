// SPDX-License-Identifier: GPL-3.0-or-later
/// Collocation at Gauss points as a Runge-Kutta method: a_ij is the integral of the cardinal polynomial l_j
/// over [0, c_i] (Hairer, Lubich, Wanner 2006, II.1.2).
#pragma once

#include <memory>

namespace extremal {

struct Tableau;

std::shared_ptr<const Tableau> gaussTableau(int stages);

}  // namespace extremal
