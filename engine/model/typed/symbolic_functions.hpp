// SPDX-License-Identifier: GPL-3.0-or-later
/// The functions of typed formulas that GiNaC lacks, with their derivatives.
///
/// abs' = sign; floor, comparisons and the like have the derivative 0; max, min and `if` that of the branch
/// that is taken; a table that of its pieces.
#pragma once

#include <ginac/ginac.h>

#include <string_view>
#include <utility>

#include "engine/model/typed/graph.hpp"

namespace extremal::typed {

DECLARE_FUNCTION_1P(magnitude)
DECLARE_FUNCTION_1P(signum)
DECLARE_FUNCTION_1P(errorFunction)
DECLARE_FUNCTION_1P(complementaryErrorFunction)
DECLARE_FUNCTION_1P(floorOf)
DECLARE_FUNCTION_1P(ceilOf)
DECLARE_FUNCTION_1P(rounded)
DECLARE_FUNCTION_1P(heavisideOf)
DECLARE_FUNCTION_2P(hypotenuse)
DECLARE_FUNCTION_2P(isLess)
DECLARE_FUNCTION_2P(isLessOrEqual)
DECLARE_FUNCTION_2P(isEqualTo)
DECLARE_FUNCTION_2P(isNotEqualTo)
DECLARE_FUNCTION_2P(greaterOf)
DECLARE_FUNCTION_2P(smallerOf)
DECLARE_FUNCTION_3P(choice)
/// A derivative of a table: of x, with the number of the table, the order and the degree of its pieces.
DECLARE_FUNCTION_4P(lookedUp)

/// Their names in GiNaC, and in a graph.
inline constexpr std::pair<std::string_view, Function> ownFunctions[] = {
    {"magnitude", Function::abs},
    {"signum", Function::sign},
    {"errorFunction", Function::erf},
    {"complementaryErrorFunction", Function::erfc},
    {"floorOf", Function::floor},
    {"ceilOf", Function::ceil},
    {"rounded", Function::round},
    {"heavisideOf", Function::heaviside},
    {"hypotenuse", Function::hypot},
    {"isLess", Function::less},
    {"isLessOrEqual", Function::lessOrEqual},
    {"isEqualTo", Function::equal},
    {"isNotEqualTo", Function::notEqual},
    {"greaterOf", Function::max},
    {"smallerOf", Function::min},
    {"choice", Function::choose},
};

}  // namespace extremal::typed
