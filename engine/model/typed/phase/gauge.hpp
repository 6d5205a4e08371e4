// SPDX-License-Identifier: GPL-3.0-or-later
/// A one-form in which half of the variables have no velocity, made from one in which they have.
///
/// A function chi(x) changes theta to theta - d chi and no motion. Where half of the variables, y, have
///     Om_yy = 0,    Om_ij = d_i theta_j - d_j theta_i,
/// theta_y is a gradient in y at fixed q, and with chi its integral from a fixed y* the form is P(q, y) . dq:
///     P_j(q, y) = theta_j(q, y) - int_0^1 (y - y*) . d theta_y / dq_j (q, y* + sigma (y - y*)) d sigma.
/// For two variables either will do. The integral is by Gauss with at most 12 nodes, exact for
/// polynomials in y of degree 23; what it is not exact for is left as it is.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/model/typed/typed_function.hpp"

namespace extremal::typed {

struct Gauged {
    std::vector<int> places, free;                    ///< q and y
    std::vector<std::optional<TypedFunction>> theta;  ///< by variable; empty for y
};

/// `texts`: a formula for each variable, "0" for those without, and `theta` the functions that they are; Om
/// is regular. Up to 8 variables all halves are tried. Empty where no half has such a form.
std::optional<Gauged> gaugedForm(const std::vector<std::string>& names,
                                 const std::vector<std::pair<std::string, double>>& parameters,
                                 const std::vector<std::string>& texts,
                                 const std::vector<std::optional<TypedFunction>>& theta);

}  // namespace extremal::typed
