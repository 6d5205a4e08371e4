// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers of a scene that are wanted to more digits than a double has: nodes, weights and coefficients of
/// tables, and the places of knots. Typed as "(3-sqrt(3))/6" they are evaluated in quadruple precision; a
/// JSON number is the decimal fraction that was written.
#pragma once

#include <boost/multiprecision/float128.hpp>

#include <string>

#include "engine/core/text/expression.hpp"
#include "engine/core/value.hpp"

namespace extremal {

/// The value of an expression without names. Throws ExpressionError where it has one.
boost::multiprecision::float128 exactValue(const Expression& expression);

/// The number at this pointer: finite. InvalidScene says what it should be; `example`: such an expression.
boost::multiprecision::float128 exactNumber(const Value& entry, const std::string& pointer,
                                            const std::string& example);

}  // namespace extremal
