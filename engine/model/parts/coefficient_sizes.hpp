// SPDX-License-Identifier: GPL-3.0-or-later
/// The sizes of the coefficients of a field in its basis: are there enough of them?
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/model/parts.hpp"

namespace extremal {

struct CoefficientSizes {
    static constexpr PartInfo part{"coefficient-sizes", "a series", false};
    struct Line {
        std::string part;              ///< "along x"; empty where there is one line
        std::vector<double> x, sizes;  ///< |c| over wave number or degree
    };
    std::string title;  ///< of x: "wave number"
    double low = 0, high = 0;
    std::string remark;  ///< what the lines are, where there are several
    /// Of a sample (FieldSampling), the first line the most important one.
    std::function<std::vector<Line>(const std::vector<double>& sample)> lines;
};

}  // namespace extremal
