// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/time_table.hpp"

#include <cmath>

#include "engine/model/field/nodes.hpp"

namespace extremal {

TimeTable::TimeTable(int degree, const Rule<double>& rule) : degree_(degree), weight_(rule.b) {
    const LobattoBasis basis(degree);
    level_ = basis.reference;
    const std::size_t levels = level_.size();
    value_.resize(levels * weight_.size());
    slope_.resize(levels * weight_.size());
    mass_.assign(levels * levels, 0);
    isTrapezoid_ = isBalanced_ = degree == 1;
    for (std::size_t q = 0; q < weight_.size(); ++q) {
        basis.at(rule.c[q], value_.data() + q * levels, slope_.data() + q * levels);
        for (std::size_t l = 0; l < levels; ++l)
            for (std::size_t m = 0; m < levels; ++m)
                mass_[l * levels + m] += weight_[q] * slope_[q * levels + l] * slope_[q * levels + m];
        const bool isEnd = rule.c[q] == 0 || rule.c[q] == 1;
        isTrapezoid_ = isTrapezoid_ && isEnd && std::abs(weight_[q] - 0.5) < 1e-15;
        isBalanced_ = isBalanced_ && std::abs(rule.c[q] - 0.5) < 1e-15;
    }
}

}  // namespace extremal
