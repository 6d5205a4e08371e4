// SPDX-License-Identifier: GPL-3.0-or-later
/// Carlson's symmetric elliptic integrals R_F and R_J, of any arguments.
///
/// Those of Boost.Math go on for a million iterations, some seconds, where an argument is not a number or
/// infinite, as it is for a motion asked for at a time of 1e308. Here the value is then not a number.
#pragma once

#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>

#include <cmath>
#include <limits>

#include "engine/core/algebra/quiet_math.hpp"

namespace extremal {

inline double carlsonRf(double x, double y, double z) {
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
        return std::numeric_limits<double>::quiet_NaN();
    return boost::math::ellint_rf(x, y, z, quiet);
}

inline double carlsonRj(double x, double y, double z, double p) {
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z) || !std::isfinite(p))
        return std::numeric_limits<double>::quiet_NaN();
    return boost::math::ellint_rj(x, y, z, p, quiet);
}

}  // namespace extremal
