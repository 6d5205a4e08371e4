// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/step_functions.hpp"

#include "engine/figure/build.hpp"
#include "engine/space/typed.hpp"

namespace extremal {

std::vector<Series> stepFunctions(const Table<double>& table, bool areSlopes) {
    constexpr int points = 240;
    const auto n = static_cast<std::size_t>(table.space.size);
    std::vector<double> value(n), slope(n);
    std::vector<Series> all(static_cast<std::size_t>(table.unknowns()));
    for (int i = 0; i <= points; ++i) {
        const double tau = static_cast<double>(i) / points;
        table.space.evaluate(tau, value, slope);
        const Eigen::VectorXd phi =
            table.change.transpose() *
            Eigen::Map<const Eigen::VectorXd>((areSlopes ? slope : value).data(), table.space.size);
        for (std::size_t a = 0; a < all.size(); ++a) {
            all[a].x.push_back(tau);
            all[a].y.push_back(phi(static_cast<Eigen::Index>(a)));
        }
    }
    for (std::size_t a = 0; a < all.size(); ++a)
        all[a].part = a + 1 == all.size() ? "from 0 to 1" : "inside " + std::to_string(a + 1);
    return all;
}

std::vector<std::string> stepFacts(const Table<double>& table, const Settings& space) {
    const Eigen::VectorXd K = kineticValues(table);
    std::vector<std::string> facts{
        std::to_string(table.space.size) + " functions, " + std::to_string(table.nodes()) +
            (table.nodes() == 1 ? " node" : " nodes"),
        "K from " + shortNumber(K.minCoeff(), 3) + " to " + shortNumber(K.maxCoeff(), 3)};
    if (const Value* typed = space.find("functions"); typed && typed->isArray())
        facts.push_back("σ " + shortNumber(typedSpace(space).sigma, 2));
    return facts;
}

}  // namespace extremal
