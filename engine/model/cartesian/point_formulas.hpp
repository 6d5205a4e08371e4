// SPDX-License-Identifier: GPL-3.0-or-later
/// Places and velocities of points as formulas in the coordinates of a mechanism. Internal to
/// engine/model/cartesian.
#pragma once

#include <string>
#include <vector>

#include "engine/model/cartesian/elements.hpp"

namespace extremal::cartesian {

/// How a place changes with one coordinate: dx and dy are formulas.
struct Slope {
    std::string coordinate, dx, dy;
};

struct PointFormulas {
    std::string x, y, xRate, yRate;
    std::vector<Slope> slopes;  ///< empty: it is fixed
};
PointFormulas formulasOf(const Elements& elements, std::size_t point);

/// The shortest text of a number, or the formula in brackets.
std::string textOf(const Amount& amount);
/// a - b, where what is 0 is left out; a and b are sums or single terms.
std::string difference(const std::string& a, const std::string& b);
/// A formula with brackets around it, unless it is a name or a number.
std::string bracketed(const std::string& formula);
/// factor * formula, where a factor of 1 is left out; "0" where either is 0.
std::string product(const std::string& factor, const std::string& formula);
/// a + b, where what is 0 is left out.
std::string sum(const std::string& a, const std::string& b);

}  // namespace extremal::cartesian
