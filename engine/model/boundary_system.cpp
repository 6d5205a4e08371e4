// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/boundary_system.hpp"

#include <cmath>
#include <utility>

namespace extremal {

System boundarySystem(std::string id, std::vector<Quantity> columns, std::string error, double scale) {
    System s;
    s.id = std::move(id);
    s.independent = "x";
    s.isSolvedAtOnce = true;
    s.columns = std::move(columns);
    s.error.columns = {{"error", "", std::move(error), ""}};
    s.error.evaluate = [scale](const double* x, const double* reference, double* values) {
        values[0] = std::abs(x[0] - reference[0]) / scale;
    };
    s.start = [width = s.columns.size()](const Settings&, double) { return std::vector<double>(width, 0.0); };
    s.draw = [](const double*, Drawing&) {};
    s.phaseX = s.trajectoryX = "t";
    s.phaseY = s.trajectoryY = "u";
    return s;
}

}  // namespace extremal
