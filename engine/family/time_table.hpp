// SPDX-License-Identifier: GPL-3.0-or-later
/// Space x rule in time of a field's scheme: polynomials of degree s on one slab, nodal at its s + 1 Lobatto
/// points, and where the rule looks at them.
///
/// value(q, l) = psi_l(c_q), slope(q, l) = psi_l'(c_q), mass(l, m) = sum_q b_q psi_l'(c_q) psi_m'(c_q); level
/// 0 is the start of the slab, level s its end.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/quadrature/rule.hpp"

namespace extremal {

class TimeTable {
public:
    TimeTable(int degree, const Rule<double>& rule);

    int degree() const { return degree_; }
    int points() const { return static_cast<int>(weight_.size()); }
    /// tau of level l.
    double level(int l) const { return level_[static_cast<std::size_t>(l)]; }
    double weight(int q) const { return weight_[static_cast<std::size_t>(q)]; }
    double value(int q, int l) const { return value_[at(q, l)]; }
    double slope(int q, int l) const { return slope_[at(q, l)]; }
    double mass(int l, int m) const { return mass_[at(l, m)]; }
    /// The potential is seen at both ends alone, and the velocity is one number: the step is explicit where
    /// the mass in space is.
    bool isTrapezoid() const { return isTrapezoid_; }
    /// Potential forces weigh the same at the start and at the end of the slab, point by point.
    bool isBalanced() const { return isBalanced_; }

private:
    std::size_t at(int row, int l) const { return static_cast<std::size_t>(row * (degree_ + 1) + l); }

    int degree_;
    std::vector<double> level_, weight_, value_, slope_, mass_;
    bool isTrapezoid_, isBalanced_;
};

}  // namespace extremal
