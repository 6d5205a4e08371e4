// SPDX-License-Identifier: GPL-3.0-or-later
/// Boost.Math without exceptions: where a function has no value, or none that can be represented, it is NaN
/// or an infinity, as those of <cmath> are.
///
///     boost::math::ellint_1(k, phi, quiet)
#pragma once

#include <boost/math/policies/policy.hpp>

namespace extremal {

using Quiet = boost::math::policies::policy<
    boost::math::policies::domain_error<boost::math::policies::ignore_error>,
    boost::math::policies::pole_error<boost::math::policies::ignore_error>,
    boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
    boost::math::policies::evaluation_error<boost::math::policies::ignore_error>,
    boost::math::policies::rounding_error<boost::math::policies::ignore_error>>;
inline constexpr Quiet quiet{};

}  // namespace extremal
