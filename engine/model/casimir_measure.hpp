// SPDX-License-Identifier: GPL-3.0-or-later
/// The measure "casimir" of systems with a bracket: functions that are constant whatever H is, and the
/// largest of their changes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/model/system.hpp"

namespace extremal {

/// `columns` of the functions; `evaluate` fills their values at (t, x).
inline Measure casimirMeasure(std::vector<Quantity> columns, const Measure::Evaluate& evaluate) {
    const std::size_t n = columns.size();
    Measure made{"casimir", std::move(columns), static_cast<int>(n), {}};
    made.columns.push_back({"casimir_error", "", "max |C − C(0)|", ""});
    made.bind = [evaluate, n](const State& initial) -> Measure::Evaluate {
        std::vector<double> first(n);
        evaluate(initial.t, initial.x.data(), first.data());
        return [evaluate, first](double t, const double* x, double* values) {
            evaluate(t, x, values);
            double& change = values[first.size()] = 0;
            for (std::size_t k = 0; k < first.size(); ++k)
                change = std::max(change, std::abs(values[k] - first[k]));
        };
    };
    return made;
}

}  // namespace extremal
