// SPDX-License-Identifier: GPL-3.0-or-later
/// Adds to a space its evaluation in quadruple precision, so that tables are computed without round-off.
/// Internal to engine/space: includes the large header of quadruple numbers.
#pragma once

#include <utility>
#include <vector>

#include "engine/core/algebra/long_numbers.hpp"
#include "engine/space/space.hpp"

namespace extremal {

inline Space<double> withQuadruple(Space<double> space, Space<Quad> twin) {
    space.evaluateQuadruple = [twin = std::move(twin)](__float128 tau, std::span<__float128> value,
                                                       std::span<__float128> derivative) {
        std::vector<Quad> v(value.size()), d(value.size());
        twin.evaluate(Quad(tau), v, d);
        for (std::size_t a = 0; a < value.size(); ++a) {
            value[a] = v[a].backend().value();
            derivative[a] = d[a].backend().value();
        }
    };
    return space;
}

}  // namespace extremal
