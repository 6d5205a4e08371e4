// SPDX-License-Identifier: GPL-3.0-or-later
/// Slow models of the pendulum on a stiff spring, a = extension, theta = angle, w = sqrt(k/m):
///
/// "rod"            H = p^2/(2 m l^2) - m g l cos theta: no spring. Wrong in theta by a part 1/k.
/// "averaged"       the spring at its mean extension, with the energy I w(p) of its oscillation, I constant,
///                      H = min_a [p^2/(2 m (l+a)^2) - m g (l+a) cos theta + k a^2/2] + I w(p),
///                      w(p)^2 = k/m + 3 p^2/(m^2 l^4).
///                  Wrong in theta by the fast part of theta, a part 1/k, which it leaves out.
/// "normal-form-s"  s = 1, 2, 3: averaged to 1/k^s, with the fast parts of all variables and the phase of the
///                  oscillation (normal_form.hpp): the whole motion, extension and all.
#pragma once

#include <vector>

#include "engine/model/slow/slow_models.hpp"

namespace extremal::slow {

struct SpringParameters {
    double m, g, l, k;
};

/// All of them, the crudest first.
std::vector<SlowModel> springModels(const SpringParameters& spring);

}  // namespace extremal::slow
