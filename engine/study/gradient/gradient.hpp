// SPDX-License-Identifier: GPL-3.0-or-later
/// The gradient of a number of a run,
///
///     J = F(q_N, p_N, t_N) + sum_k sum_i h b_i c(t_i, q_i, v_i),
///
/// by numbers of the scene and by the values of controls that are tables: exactly that of the discrete
/// motion, by one sweep backwards (study/gradient/run_derivative.hpp). The integral is the quadrature of the
/// scheme itself. A table of straight lines has a derivative for each of its rows, where these are at ends of
/// steps.
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

struct StudyTable;

struct GradientRequest {
    std::string of = {};                 ///< F, in coordinates, momenta p_x, t and parameters; may be empty
    std::string over = {};               ///< c, a formula of the model; may be empty
    std::vector<std::string> with = {};  ///< pointers; "/model/controls/u": all rows of its table
    std::string scheme = {};             ///< its label; empty: the first enabled one
};

struct GradientRow {
    std::string name, pointer;
    double value = 0, derivative = 0;
};

struct GradientAnswer {
    std::string scheme;
    long long steps = 0;
    double value = 0, atEnd = 0, integral = 0;
    std::vector<GradientRow> rows;
    std::size_t statesKept = 0;   ///< at once, of those of the run
    std::string problem, remedy;  ///< why there is no gradient; empty: there is
    bool isFound() const { return problem.empty(); }
};

/// Throws InvalidScene ("--of", "--over", "--with", "--scheme") where the request cannot be met.
GradientAnswer gradient(const ResolvedScene& scene, const GradientRequest& request,
                        const std::stop_token& stop = {});

/// gradient.csv: a row per number.
StudyTable gradientTable(const GradientAnswer& answer);
/// The answer as JSON, with its rows.
Value gradientValue(const GradientAnswer& answer);

}  // namespace extremal
