// SPDX-License-Identifier: GPL-3.0-or-later
/// Tables in quadruple precision, of spaces that can be evaluated there. Includes the header of quadruple
/// numbers.
#pragma once

#include <boost/multiprecision/float128.hpp>

#include "engine/action/table.hpp"

namespace extremal {

using Quad = boost::multiprecision::float128;

/// The space must have evaluateQuadruple. Throws as makeTable.
Table<Quad> makeQuadrupleTable(const Space<double>& space, const Rule<Quad>& rule);

}  // namespace extremal
