// SPDX-License-Identifier: GPL-3.0-or-later
/// The numbers that tables of typed spaces are made with: quadruple precision, and a hundred digits where
/// that is not enough. For sources alone: includes large headers.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/float128.hpp>

namespace extremal {

using Quad = boost::multiprecision::float128;
using Hundred =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;

inline Quad toQuad(const Quad& x) { return x; }
inline Quad toQuad(const Hundred& x) { return x.convert_to<Quad>(); }

}  // namespace extremal
