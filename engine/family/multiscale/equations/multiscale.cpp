// SPDX-License-Identifier: GPL-3.0-or-later
/// Functions that oscillate with a step: known once the step is, and different for each coordinate.
#include <algorithm>

#include "engine/family/multiscale/oscillatory.hpp"
#include "engine/family/multiscale/product.hpp"
#include "engine/family/multiscale/slow.hpp"
#include "engine/family/step_equations.hpp"

namespace extremal::equations {
namespace {

constexpr const char* changing = "made of functions that change with the step, not of one table";

/// Of the coordinate with the most functions.
Table<double> richestTable(const StepCase& c) {
    const std::vector<Table<double>> all = oscillatoryTables(c.system, c.discretization, c.step);
    return *std::max_element(all.begin(), all.end(), [](const Table<double>& a, const Table<double>& b) {
        return a.unknowns() < b.unknowns();
    });
}

}  // namespace

StepEquations multiscale() {
    StepEquations e;
    e.family = "multiscale";
    e.matrix.instead = changing;
    e.functions = {
        richestTable, "", [](const Discretization& d) -> std::string {
            return isOscillatory(d.space) ? ""
                   : isSlow(d.space)
                       ? "polynomials of the slow model's coordinates"
                       : "made of products whose phase is an unknown, not of functions that are known";
        }};
    e.spaceFunctions.instead = "functions of time alone";
    e.coordinates.instead = e.actions.instead = changing;
    return e;
}

}  // namespace extremal::equations
