// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/parts/by_hand.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {

double handNumber(double value, double largest, int digits) {
    if (!(largest > 0)) return value;
    const double unit = std::pow(10, std::floor(std::log10(largest)) - (digits - 1));
    const double rounded =
        unit < 1 ? std::round(value / unit) / std::round(1 / unit) : std::round(value / unit) * unit;
    return std::isfinite(rounded) ? rounded + 0.0 : value;  // no -0
}

Value handNumbers(const double* x, std::size_t count, int digits) {
    double largest = 0;
    for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, std::abs(x[i]));
    Value::Array list;
    for (std::size_t i = 0; i < count; ++i) list.emplace_back(handNumber(x[i], largest, digits));
    return list;
}

void dropKeys(Value& object, std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : keys)
        std::erase_if(object.asObject(), [&](const Value::Member& m) { return m.first == key; });
}

}  // namespace extremal
