// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/action/combined_table.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace extremal {

Table<double> combined(const std::vector<Table<double>>& parts, std::size_t kinetic) {
    Table<double> all = parts[kinetic];
    struct Place {
        std::size_t part;
        Eigen::Index row;
    };
    std::vector<Place> places;
    for (std::size_t r = 0; r < parts.size(); ++r)
        for (Eigen::Index i = 0; i < parts[r].node.size(); ++i) places.push_back({r, i});
    std::stable_sort(places.begin(), places.end(), [&](const Place& a, const Place& b) {
        return parts[a.part].node(a.row) < parts[b.part].node(b.row);
    });
    const auto n = static_cast<Eigen::Index>(places.size());
    for (auto* vector : {&all.node, &all.weight, &all.kineticWeight})
        *vector = Table<double>::Vector::Zero(n);
    for (auto* matrix : {&all.value, &all.derivative, &all.testValue, &all.testDerivative})
        *matrix = Table<double>::Matrix::Zero(n, all.change.cols());
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto& [r, row] = places[static_cast<std::size_t>(i)];
        const Table<double>& from = parts[r];
        all.node(i) = from.node(row);
        all.weight(i) = from.weight(row);
        if (r == kinetic) all.kineticWeight(i) = from.weight(row);
        all.value.row(i) = from.value.row(row);
        all.derivative.row(i) = from.derivative.row(row);
        all.testValue.row(i) = from.testValue.row(row);
        all.testDerivative.row(i) = from.testDerivative.row(row);
        all.part.push_back(static_cast<int>(r));
    }
    std::vector<Rule<double>> rules;
    for (const Table<double>& part : parts) rules.push_back(part.rule);
    all.upTo = [rules = std::move(rules), places](const double& tau, std::span<double> share) {
        std::vector<std::vector<double>> own;
        for (const Rule<double>& rule : rules) {
            own.emplace_back(rule.c.size());
            partialWeights<double>(rule, tau, own.back());
        }
        for (std::size_t i = 0; i < places.size(); ++i)
            share[i] = own[places[i].part][static_cast<std::size_t>(places[i].row)];
    };
    return all;
}

}  // namespace extremal
