// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/group/second_derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/core/algebra/dense.hpp"

namespace extremal::groups {

using Vector = MatrixGroup::Vector;

SecondDerivatives::SecondDerivatives(const GroupMechanics& on, const double* g, const Vector& eta,
                                     bool hasForces)
    : m(on.dimension()), f(on.dimension()), couplings_(on.couplings.get()) {
    for (std::vector<double>* const each : {&M, &N, &S}) each->assign(couplings_->entries(), 0);
    if (hasForces)
        on.jet(on.model.get(), g, eta.data(), &L, m.data(), f.data(), M.data(), N.data(), S.data());
    else
        on.jet(on.model.get(), g, eta.data(), &L, m.data(), nullptr, M.data(), nullptr, nullptr);
}

bool SecondDerivatives::isFinite() const {
    return std::isfinite(L) && m.allFinite() &&
           std::all_of(M.begin(), M.end(), [](double v) { return std::isfinite(v); });
}

std::vector<std::vector<int>> SecondDerivatives::coupledByM(const std::vector<int>& leftOut) const {
    // The number of the set that a factor is in, brought to a root.
    std::vector<int> root(static_cast<std::size_t>(couplings_->parts()));
    std::iota(root.begin(), root.end(), 0);
    const auto of = [&](int p) {
        while (root[static_cast<std::size_t>(p)] != p) {
            int& up = root[static_cast<std::size_t>(p)];
            p = up = root[static_cast<std::size_t>(up)];
        }
        return p;
    };
    for (const Couplings::Pair& pair : couplings_->pairs())
        if (!couplings_->block(M.data(), pair).isZero(0))
            root[static_cast<std::size_t>(of(pair.p))] = of(pair.q);
    std::vector<std::vector<int>> sets(root.size());
    for (int i = 0; i < couplings_->dimension(); ++i)
        if (std::find(leftOut.begin(), leftOut.end(), i) == leftOut.end())
            sets[static_cast<std::size_t>(of(couplings_->partOf(i)))].push_back(i);
    std::erase_if(sets, [](const std::vector<int>& set) { return set.empty(); });
    return sets;
}

Eigen::MatrixXd SecondDerivatives::partOf(const std::vector<double>& of, const std::vector<int>& rows,
                                          const std::vector<int>& columns) const {
    Eigen::MatrixXd r(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
    for (Eigen::Index i = 0; i < r.rows(); ++i)
        for (Eigen::Index j = 0; j < r.cols(); ++j) {
            const int row = rows[static_cast<std::size_t>(i)], column = columns[static_cast<std::size_t>(j)];
            r(i, j) = couplings_->areCoupled(couplings_->partOf(row), couplings_->partOf(column))
                          ? of[couplings_->place(row, column)]
                          : 0;
        }
    return r;
}

double SecondDerivatives::largestRatio(const std::vector<int>& leftOut) const {
    std::vector<int> all(static_cast<std::size_t>(couplings_->dimension()));
    std::iota(all.begin(), all.end(), 0);
    double largest = 0;
    for (const std::vector<int>& set : coupledByM(leftOut)) {
        const Eigen::MatrixXd ratio = dense::solve<double>(partOf(M, set, set), partOf(S, set, all));
        const double here = ratio.cwiseAbs().rowwise().sum().maxCoeff();
        if (!std::isfinite(here)) return here;
        largest = std::max(largest, here);
    }
    return largest;
}

std::pair<double, Vector> SecondDerivatives::leastInertia(const std::vector<int>& leftOut) const {
    double smallest = std::numeric_limits<double>::infinity(), largest = 0;
    Vector direction;
    for (const std::vector<int>& set : coupledByM(leftOut)) {
        const dense::SymmetricEigen<double> eigen = dense::symmetricEigen<double>(partOf(M, set, set));
        Eigen::Index least = 0;
        const double here = eigen.values.cwiseAbs().minCoeff(&least);
        largest = std::max(largest, eigen.values.cwiseAbs().maxCoeff());
        if (here >= smallest) continue;
        smallest = here;
        direction = Vector::Zero(couplings_->dimension());
        direction(set) = eigen.vectors.col(least) / eigen.vectors.col(least).cwiseAbs().maxCoeff();
    }
    return {largest > 0 ? smallest / largest : 0, direction};
}

}  // namespace extremal::groups
