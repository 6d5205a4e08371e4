// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/baseline/gauss_tableau.hpp"

#include <vector>

#include "engine/tableau/tableau.hpp"

namespace extremal {

std::shared_ptr<const Tableau> gaussTableau(int stages) {
    const Rule<Quad> rule = gauss<Quad>(stages);
    Tableau::Matrix A(stages, stages);
    std::vector<Quad> share(static_cast<std::size_t>(stages));
    for (int i = 0; i < stages; ++i) {
        partialWeights<Quad>(rule, rule.c[static_cast<std::size_t>(i)], share);
        for (int j = 0; j < stages; ++j) A(i, j) = share[static_cast<std::size_t>(j)];
    }
    const Eigen::Map<const Tableau::Vector> b(rule.b.data(), stages), c(rule.c.data(), stages);
    return std::make_shared<const Tableau>(plainTableau(A, b, c));
}

}  // namespace extremal
