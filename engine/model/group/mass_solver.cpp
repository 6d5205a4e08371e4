// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/group/mass_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/core/algebra/elimination.hpp"
#include "engine/core/algebra/sparse.hpp"

namespace extremal::groups {
namespace {

constexpr int few = 48;  ///< coordinates that are eliminated as a full matrix

}  // namespace

MassSolver::MassSolver(const Couplings& on, const std::vector<std::pair<int, int>>& coupled) {
    std::vector<int> first(static_cast<std::size_t>(on.parts()));  // of the set of each factor
    std::iota(first.begin(), first.end(), 0);
    const auto at = [&](int p) -> int& { return first[static_cast<std::size_t>(p)]; };
    const auto root = [&](int p) {
        while (at(p) != p) p = at(p) = at(at(p));
        return p;
    };
    for (const auto& [p, q] : coupled) at(root(std::max(p, q))) = root(std::min(p, q));
    std::vector<std::vector<int>> sets(first.size());
    for (int i = 0; i < on.dimension(); ++i) sets[static_cast<std::size_t>(root(on.partOf(i)))].push_back(i);
    for (std::vector<int>& each : sets)
        if (!each.empty()) sets_.push_back({std::move(each), {}});
    for (Set& set : sets_) {
        const int n = static_cast<int>(set.coordinates.size());
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const int row = set.coordinates[static_cast<std::size_t>(i)],
                          column = set.coordinates[static_cast<std::size_t>(j)];
                if (on.areCoupled(on.partOf(row), on.partOf(column)))
                    set.entries.push_back({i, j, on.place(row, column)});
            }
        const std::size_t rows = set.coordinates.size(), full = n <= few ? rows * rows : 0;
        matrix_.resize(std::max(matrix_.size(), full));
        right_.resize(std::max(right_.size(), rows));
    }
}

void MassSolver::solve(const double* masses, double* b) {
    for (const Set& set : sets_) {
        const auto n = static_cast<int>(set.coordinates.size());
        Eigen::Map<Eigen::VectorXd> x(right_.data(), n);
        for (int i = 0; i < n; ++i) x(i) = b[set.coordinates[static_cast<std::size_t>(i)]];
        if (n <= few) {
            Eigen::Map<Eigen::MatrixXd> M(matrix_.data(), n, n);
            M.setZero();
            for (const Entry& e : set.entries) M(e.row, e.column) = masses[e.place];
            eliminate(n, M.data(), x.data());
        } else {
            std::vector<Eigen::Triplet<double>> entries;
            for (const Entry& e : set.entries) entries.emplace_back(e.row, e.column, masses[e.place]);
            Eigen::SparseMatrix<double> M(n, n);
            M.setFromTriplets(entries.begin(), entries.end());
            Eigen::VectorXd solution;
            if (solveSparse(M, Eigen::VectorXd(x), solution) == Outcome::converged)
                x = solution;
            else
                x.setConstant(std::nan(""));
        }
        for (int i = 0; i < n; ++i) b[set.coordinates[static_cast<std::size_t>(i)]] = x(i);
    }
}

}  // namespace extremal::groups
