// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/baseline/gauss_tableau.hpp"

#include "engine/quadrature/collocation.hpp"
#include "engine/tableau/tableau.hpp"

namespace extremal {

std::shared_ptr<const Tableau> gaussTableau(int stages) {
    const Rule<Quad> rule = gauss<Quad>(stages);
    const Eigen::Map<const Tableau::Vector> b(rule.b.data(), stages), c(rule.c.data(), stages);
    return std::make_shared<const Tableau>(plainTableau(collocationMatrix(rule), b, c));
}

}  // namespace extremal
