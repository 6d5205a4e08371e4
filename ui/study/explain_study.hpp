// SPDX-License-Identifier: GPL-3.0-or-later
/// What a number of a study's table is: how it is measured, over which nodes or runs, in which unit and
/// against what. Plain text of some lines.
#pragma once

#include <QString>

#include <string>

#include "engine/study/catalog.hpp"
#include "engine/study/request.hpp"

namespace extremal {

/// Of a column of the table that a study shows, with the value of the cell in full. Every column of every
/// study has an explanation; empty for one that no study has.
QString explainStudyCell(const AnyStudy& study, const std::string& column, const Value& value);

}  // namespace extremal
