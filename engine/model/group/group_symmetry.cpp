// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/group/group_symmetry.hpp"

#include <cmath>
#include <random>

#include "engine/core/algebra/dense.hpp"

namespace extremal::groups {
namespace {

using Vector = MatrixGroup::Vector;

constexpr int probes = 12;
constexpr double roundOff = 1e-11;  ///< a slope that is round-off, relative to what it is a sum of

/// Columns in reduced echelon form, entries of round-off removed.
Eigen::MatrixXd echelon(Eigen::MatrixXd columns) {
    Eigen::Index done = 0;
    for (Eigen::Index row = 0; row < columns.rows() && done < columns.cols(); ++row) {
        Eigen::Index best = 0;
        const double largest = columns.row(row).tail(columns.cols() - done).cwiseAbs().maxCoeff(&best);
        if (largest < 1e-8) continue;
        columns.col(done).swap(columns.col(done + best));
        columns.col(done) /= columns(row, done);
        for (Eigen::Index k = 0; k < columns.cols(); ++k)
            if (k != done) columns.col(k) -= columns(row, k) * columns.col(done);
        ++done;
    }
    return columns.unaryExpr([](double v) { return std::abs(v) < 1e-9 ? 0 : v; });
}

/// The null space of a matrix A given as A^T A.
Eigen::MatrixXd nullSpaceOf(const Eigen::MatrixXd& squares, double threshold) {
    const dense::SymmetricEigen<double> eigen = dense::symmetricEigen<double>(squares);
    Eigen::Index count = 0;
    while (count < squares.rows() && eigen.values(count) < threshold) ++count;
    return echelon(eigen.vectors.leftCols(count));
}

}  // namespace

Eigen::MatrixXd keptDirections(const GroupMechanics& mechanics) {
    const MatrixGroup& group = *mechanics.group;
    const int d = group.dimension();
    if (mechanics.isInvariant) return Eigen::MatrixXd::Identity(d, d);
    std::mt19937 random(1788);
    std::normal_distribution<double> normal;
    const auto vector = [&] {
        Vector v(d);
        for (int i = 0; i < d; ++i) v(i) = normal(random);
        return v;
    };
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(d, d);
    // Each probe tells of one direction; of many factors a few more than directions do.
    int found = 0;
    const int wanted = std::min(probes * d, 2 * d + 24 * probes);
    for (int attempt = 0; attempt < 8 * wanted && found < wanted; ++attempt) {
        const MatrixGroup::Entries g =
            group.product(group.exponential(0.7 * vector()), group.exponential(vector()));
        const Vector eta = vector();
        Vector m(d), f(d);
        double value = 0;
        mechanics.gradient(mechanics.model.get(), g.data(), eta.data(), &value, m.data(), f.data());
        if (!f.allFinite()) continue;
        Vector sums;
        const Vector row = group.inSpace(g, f, &sums);
        const double scale = sums.norm();
        ++found;
        if (scale > 0) squares.selfadjointView<Eigen::Lower>().rankUpdate(row, 1 / (scale * scale));
    }
    squares.triangularView<Eigen::StrictlyUpper>() = squares.transpose();
    if (found == 0) return Eigen::MatrixXd(d, 0);
    return nullSpaceOf(squares, roundOff * found);
}

std::vector<Casimir> quadraticCasimirs(const MatrixGroup& group) {
    std::vector<Casimir> all;
    for (const MatrixGroup::Factor& f : group.factors()) {
        const int d = f.d, size = d * (d + 1) / 2;
        std::vector<Eigen::MatrixXd> units;
        for (int i = 0; i < d; ++i)
            for (int j = 0; j <= i; ++j) {
                Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(d, d);
                Q(i, j) = Q(j, i) = 1;
                units.push_back(Q);
            }
        Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(size, size), A(d * d, size);
        double largest = 0;
        for (int k = 0; k < d; ++k) {
            Eigen::MatrixXd ad(d, d);
            for (int j = 0; j < d; ++j)
                ad.col(j) = f.constants.bracketOfBasis(k, Eigen::VectorXd(Eigen::VectorXd::Unit(d, j)));
            for (int u = 0; u < size; ++u) {
                const Eigen::MatrixXd& Q = units[static_cast<std::size_t>(u)];
                const Eigen::MatrixXd image = ad.lazyProduct(Q) + Q.lazyProduct(ad.transpose());
                A.col(u) = Eigen::Map<const Eigen::VectorXd>(image.data(), d * d);
            }
            squares += dense::product<double>(A.transpose(), A);
            largest = std::max(largest, ad.squaredNorm());
        }
        const Eigen::MatrixXd basis = nullSpaceOf(squares, 1e-10 * std::max(largest, 1.0));
        for (Eigen::Index k = 0; k < basis.cols(); ++k) {
            Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(d, d);
            for (int u = 0; u < size; ++u) Q += basis(u, k) * units[static_cast<std::size_t>(u)];
            all.push_back({f.coordinate, Q});
        }
    }
    return all;
}

}  // namespace extremal::groups
