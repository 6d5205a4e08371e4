// SPDX-License-Identifier: GPL-3.0-or-later
/// The plots of a fit (study/fit/fit.hpp): what was measured with what is computed for it, and residuals.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/figure/figure.hpp"
#include "engine/study/fit/fit.hpp"
#include "engine/study/fit/measured_data.hpp"

namespace extremal {

/// A column against time: dots, and a line through `computed`, one value for each measurement of the data.
Figure measuredFigure(const MeasuredData& data, std::size_t column, const std::vector<double>& computed);

/// (computed - measured) / deviation against time, a series for each column; the scatter of the residuals
/// takes the place of deviations that the data do not have. Lines at 0 and at 1 and -1.
Figure residualsFigure(const FitAnswer& answer);

}  // namespace extremal
