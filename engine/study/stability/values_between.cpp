// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/stability/values_between.hpp"

#include <cmath>

namespace extremal {

std::vector<double> valuesBetween(double from, double to, int count, bool isLog) {
    std::vector<double> all;
    for (int i = 0; i < count; ++i) {
        const double part = count > 1 ? static_cast<double>(i) / (count - 1) : 0;
        all.push_back(isLog ? from * std::pow(to / from, part) : from + (to - from) * part);
    }
    if (count > 1) all.back() = to;
    return all;
}

}  // namespace extremal
