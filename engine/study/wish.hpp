// SPDX-License-Identifier: GPL-3.0-or-later
/// What is wished of a metric: a value that it stays below.
#pragma once

#include <string>

namespace extremal {

struct Wish {
    std::string metric;
    double value = 0;
    bool operator==(const Wish&) const = default;
};

}  // namespace extremal
