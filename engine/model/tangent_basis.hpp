// SPDX-License-Identifier: GPL-3.0-or-later
/// Which variations of a state are those of states that the equations allow.
#pragma once

#include <functional>
#include <vector>

namespace extremal {

/// A basis of them at a state: orthonormal columns, one after the other. Empty function: any variation is
/// allowed.
using TangentBasis = std::function<std::vector<double>(double t, const double* x)>;

}  // namespace extremal
