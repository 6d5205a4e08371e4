// SPDX-License-Identifier: GPL-3.0-or-later
/// What plots of a sweep have in common: the axis of errors with its floors, and how they are finished.
/// Internal to engine/figure.
#pragma once

#include <string>

#include "engine/figure/figure.hpp"
#include "engine/study/sweep.hpp"

namespace extremal {

/// Title of the errors of a sweep, with its unit.
std::string errorTitle(const Sweep& sweep);

/// Without series: the errors of the sweep's metric upwards, what the reference does not resolve as a band,
/// and round-off.
Figure studyFigureStart(const Sweep& sweep, const char* view, const char* title);

/// Values that a logarithmic axis cannot show become gaps; ranges, and a sentence: "`what` of 3 schemes, 33
/// points".
void finishStudyFigure(Figure& figure, const std::string& what);

}  // namespace extremal
