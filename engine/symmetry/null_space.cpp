// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/symmetry/null_space.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/algebra/dense.hpp"
#include "engine/symmetry/jumps.hpp"

namespace extremal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Index = Eigen::Index;

/// Where the unknowns are: b, A, tau0, tau1, c, then the terms of F. It is the order of pivots.
class Unknowns {
public:
    explicit Unknowns(int d) : d_(d) {
        for (int power = 0; power <= 1; ++power)
            for (int i = 0; i < d; ++i) {
                terms_.push_back({i, -1, -1, power, 1});
                for (int j = i; j < d; ++j) terms_.push_back({i, j, -1, power, 1});
            }
        if (d <= 3)
            for (int i = 0; i < d; ++i)
                for (int j = i; j < d; ++j)
                    for (int k = j; k < d; ++k) terms_.push_back({i, j, k, 0, 1});
        for (int power = 1; power <= 3; ++power) terms_.push_back({-1, -1, -1, power, 1});
    }
    Index size() const { return firstTerm() + static_cast<Index>(terms_.size()); }

    /// The coefficient of every unknown in the condition at a state.
    void fillRow(const SampledState& s, Eigen::Ref<VectorXd> row) const {
        const auto at = [](const std::vector<double>& v, int i) { return v[static_cast<std::size_t>(i)]; };
        double vp = 0;
        for (int i = 0; i < d_; ++i) {
            const double force = at(s.gradient, i), momentum = at(s.gradient, d_ + i);
            vp += momentum * at(s.v, i);
            row[i] = force;
            for (int j = 0; j < d_; ++j) row[d_ + i * d_ + j] = force * at(s.q, j) + momentum * at(s.v, j);
            row[tau() + 2 + i] = force * s.t + momentum;
        }
        row[tau()] = s.Lt;
        row[tau() + 1] = s.Lt * s.t + s.L - vp;
        for (std::size_t n = 0; n < terms_.size(); ++n)
            row[firstTerm() + static_cast<Index>(n)] =
                -terms_[n].rateAlong(s.t, s.q.data(), s.v.data()) - terms_[n].rateInTime(s.t, s.q.data());
    }
    /// The same in the condition that a jump stays where it is.
    void fillRow(const Jump& jump, Eigen::Ref<VectorXd> row) const {
        fillRow(SampledState{jump.t, jump.q, jump.v, 0, jump.st, jump.gradient}, row);
        row.tail(row.size() - firstTerm()).setZero();
    }
    Symmetry symmetryOf(const VectorXd& u) const {
        Symmetry s;
        s.dimension = d_;
        s.b.assign(u.data(), u.data() + d_);
        s.A.assign(u.data() + d_, u.data() + d_ + d_ * d_);
        s.tau0 = u[tau()];
        s.tau1 = u[tau() + 1];
        s.c.assign(u.data() + tau() + 2, u.data() + tau() + 2 + d_);
        for (std::size_t n = 0; n < terms_.size(); ++n) {
            GaugeTerm term = terms_[n];
            term.coefficient = u[firstTerm() + static_cast<Index>(n)];
            if (term.coefficient != 0) s.F.push_back(term);
        }
        return s;
    }

private:
    Index tau() const { return d_ + d_ * d_; }
    Index firstTerm() const { return tau() + 2 + d_; }

    int d_;
    std::vector<GaugeTerm> terms_;  ///< with coefficient 1
};

/// M <- R M C with positive diagonal R and C, so that the maximum of every row and column is near 1. Returns
/// C.
VectorXd equilibrate(MatrixXd& M) {
    VectorXd scales = VectorXd::Ones(M.cols());
    for (int sweep = 0; sweep < 6; ++sweep) {
        for (Index i = 0; i < M.rows(); ++i)
            if (const double most = M.row(i).cwiseAbs().maxCoeff(); most > 0) M.row(i) /= std::sqrt(most);
        for (Index j = 0; j < M.cols(); ++j)
            if (const double most = M.col(j).cwiseAbs().maxCoeff(); most > 0) {
                M.col(j) /= std::sqrt(most);
                scales[j] /= std::sqrt(most);
            }
    }
    return scales;
}

/// Columns N <- reduced echelon form, pivots in the order of the rows. Returns the pivots. Entries below
/// `small` are dropped.
std::vector<Index> echelon(MatrixXd& N, double small) {
    constexpr double leastPivot = 1e-5;
    std::vector<Index> pivots;
    Index done = 0;
    for (Index row = 0; row < N.rows() && done < N.cols(); ++row) {
        Index best = done;
        for (Index k = done; k < N.cols(); ++k)
            if (std::abs(N(row, k)) > std::abs(N(row, best))) best = k;
        if (std::abs(N(row, best)) < leastPivot) continue;
        N.col(done).swap(N.col(best));
        N.col(done) /= N(row, done);
        for (Index k = 0; k < N.cols(); ++k)
            if (k != done) N.col(k) -= N(row, k) * N.col(done);
        pivots.push_back(row);
        ++done;
    }
    for (Index k = 0; k < N.cols(); ++k) {
        const double most = N.col(k).cwiseAbs().maxCoeff();
        for (double& entry : N.col(k))
            if (std::abs(entry) < small * most) entry = 0;
    }
    return pivots;
}

}  // namespace

std::vector<Symmetry> symmetriesOnSamples(const System& system, const StateSampler& from,
                                          const std::vector<Jump>& jumps) {
    constexpr double exact = 1e-12, almost = 1e-6;
    const int d = system.dimension();
    const Unknowns unknowns(d);
    StateSampler sampler = from;
    const Index m = unknowns.size(), random = 3 * m + 20, rows = random + sampler.statesAtLandmarks() / 2,
                all = rows + static_cast<Index>(jumps.size());
    MatrixXd M(all, m);
    VectorXd row(m);
    SampledState state;
    for (Index i = 0; i < rows; ++i) {
        const bool isRandom = i < random;
        if (isRandom && !sampler.next(state)) return {};
        if (isRandom || sampler.nextAtLandmarks(state))
            unknowns.fillRow(state, row);
        else
            row.setZero();
        M.row(i) = row;
    }
    for (Index i = rows; i < all; ++i) {
        unknowns.fillRow(jumps[static_cast<std::size_t>(i - rows)], row);
        M.row(i) = row;
    }
    const VectorXd scales = equilibrate(M);
    if (!M.allFinite()) return {};
    const auto [sigma, V] = dense::rightSingular(dense::triangleOf(M));
    const double limit = exact * (system.mechanics().isTimeDependent ? 100 : 1);
    std::vector<Symmetry> found;
    Index first = m;  // of the null space
    while (first > 0 && sigma[first - 1] < limit * sigma[0]) --first;
    const double gap = first > 0 ? sigma[first - 1] / sigma[0] : 1;
    MatrixXd N = V.rightCols(m - first);
    const std::vector<Index> pivots = echelon(N, std::max(1e-12, 1e-14 / std::max(gap, 1e-12)));
    for (Index k = 0; k < N.cols(); ++k) found.push_back(unknowns.symmetryOf(N.col(k).cwiseProduct(scales)));

    Index firstNear = first;
    while (firstNear > 0 && sigma[firstNear - 1] < almost * sigma[0]) --firstNear;
    MatrixXd near = V.middleCols(firstNear, first - firstNear);
    for (Index k = 0; k < near.cols(); ++k)
        for (std::size_t n = 0; n < pivots.size(); ++n)
            near.col(k) -= near(pivots[n], k) * N.col(static_cast<Index>(n));
    if (near.cols() > 0) echelon(near, 1e-5);
    for (Index k = 0; k < near.cols(); ++k) {
        found.push_back(unknowns.symmetryOf(near.col(k).cwiseProduct(scales)));
        found.back().defect = sigma[firstNear] / sigma[0];
    }
    return found;
}

}  // namespace extremal
