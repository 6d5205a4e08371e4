// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/galerkin/fitted_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/family/galerkin/tables.hpp"
#include "engine/space/typed.hpp"

namespace extremal::galerkin {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Sizes {
    std::vector<double> distance, defect;
    int ruleDegree = 0;
    bool isSymmetric = false;
};

Sizes at(const Settings& space, const Settings& quadrature, double h) {
    const Settings known = withStep(space, h);
    const TypedSpace typed = typedSpace(known);
    const Rule<double> rule = ruleOn<double>(typed.space, quadrature);
    const Table<double> table = extremal::makeTable(typed.space, rule);
    return {typed.distance, consistencyDefects(table, typed.space.size + 1), rule.degree,
            rule.isSymmetric && typed.space.isSymmetric};
}

/// Rate between h and h/2, plus the place; infinite where the finer one is 0.
double least(const std::vector<double>& coarse, const std::vector<double>& fine, double zero) {
    double result = infinite;
    for (std::size_t j = 0; j < coarse.size(); ++j) {
        if (fine[j] < zero) continue;
        const double rate = std::max(0.0, std::log2(coarse[j] / fine[j]));
        result = std::min(result, static_cast<double>(j) + rate);
    }
    return result;
}

struct Rates {
    double m, kappa;
    bool isNear(const Rates& other) const {
        const auto same = [](double a, double b) { return a == b || std::abs(a - b) < 0.15; };
        return same(m, other.m) && same(kappa, other.kappa);
    }
};

int twice(double rate) { return rate < 1000 ? 2 * static_cast<int>(std::lround(rate)) : 2000; }

}  // namespace

FittedOrder fittedOrder(const Settings& space, const Settings& quadrature) {
    // What is in the space, and round-off of the table.
    constexpr double contained = 1e-20, exact = 1e-13;
    FittedOrder found;
    for (double h = 0.25; h > 1e-6; h /= 8) {
        const Sizes one = at(space, quadrature, h), two = at(space, quadrature, h / 2),
                    four = at(space, quadrature, h / 4);
        const Rates first{least(one.distance, two.distance, contained), least(one.defect, two.defect, exact)},
            second{least(two.distance, four.distance, contained), least(two.defect, four.defect, exact)};
        found.bounds = {twice(second.m) - 2, four.ruleDegree + 1, twice(second.kappa)};
        found.step = h;
        found.isSymmetric = four.isSymmetric;
        if (first.isNear(second)) break;
    }
    return found;
}

}  // namespace extremal::galerkin
