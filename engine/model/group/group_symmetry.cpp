// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/group/group_symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>

#include "engine/core/algebra/dense.hpp"

namespace extremal::groups {
namespace {

using Vector = MatrixGroup::Vector;

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

/// The null space of a matrix A given as A^T A, by columns that are orthonormal.
Eigen::MatrixXd nullSpaceOf(const Eigen::MatrixXd& squares, double threshold) {
    const dense::SymmetricEigen<double> eigen = dense::symmetricEigen<double>(squares);
    Eigen::Index count = 0;
    while (count < squares.rows() && eigen.values(count) < threshold) ++count;
    return eigen.vectors.leftCols(count);
}

/// The row dL/dg . (zeta g) = sum_p r_p . zeta_p vanishes at all states where it does at one and does not
/// change as one factor after another moves; and when factor q moves r_p changes for q and its neighbours
/// alone. So each factor has rows of few entries, and factors that share none move together. The null space
/// is cut down as the factors come in, neighbours first: in a chain it never has more dimensions than that of
/// a few factors, and the whole takes time in proportion to their number.
class SymmetrySearch {
public:
    explicit SymmetrySearch(const GroupMechanics& on)
        : on_(on), couplings_(*on.couplings), near_(static_cast<std::size_t>(couplings_.parts())) {
        for (const Couplings::Pair& pair : couplings_.pairs()) near_[at(pair.p)].push_back(pair.q);
        rows_.resize(near_.size());
        found_.resize(near_.size());
        for (std::size_t q = 0; q < near_.size(); ++q) {
            int entries = 0;
            for (const int p : near_[q]) entries += couplings_.size(p);
            rows_[q] = Eigen::MatrixXd::Zero(2 * entries + extra, entries);
        }
    }

    Eigen::MatrixXd directions() {
        for (const std::vector<int>& together : apart()) probe(together);
        probe({});
        if (whole_.rows() == 0 || std::find(found_.begin(), found_.end(), 0) != found_.end())
            return {couplings_.dimension(), 0};
        std::vector<int> missing;
        for (const std::vector<int>& near : near_) missing.push_back(static_cast<int>(near.size()));
        std::vector<Eigen::Index> all;
        for (const int p : order()) {
            add(p);
            for (const int q : near_[at(p)])
                if (--missing[at(q)] == 0) cut(rows_[at(q)].topRows(found_[at(q)]), coordinatesNear(q));
        }
        for (Eigen::Index i = 0; i < couplings_.dimension(); ++i) all.push_back(i);
        cut(whole_, all);
        return echelon(basis_);
    }

private:
    static constexpr int extra = 24;  ///< probes more than unknowns
    struct Row {
        Vector value, sums;
        bool isFinite = false;
    };
    struct Place {
        MatrixGroup::Entries g;
        Vector eta;
    };
    static std::size_t at(int p) { return static_cast<std::size_t>(p); }

    /// Sets of factors of which no two have a neighbour in common.
    std::vector<std::vector<int>> apart() const {
        std::vector<std::vector<int>> sets;
        std::vector<std::set<int>> taken;
        for (int q = 0; q < couplings_.parts(); ++q) {
            const std::vector<int>& near = near_[at(q)];
            std::size_t k = 0;
            while (k < sets.size() &&
                   std::any_of(near.begin(), near.end(), [&](int p) { return taken[k].contains(p); }))
                ++k;
            if (k == sets.size()) {
                sets.emplace_back();
                taken.emplace_back();
            }
            sets[k].push_back(q);
            taken[k].insert(near.begin(), near.end());
        }
        return sets;
    }
    /// All factors, each next to one that comes before where there is one.
    std::vector<int> order() const {
        std::vector<int> all;
        std::vector<bool> isIn(near_.size(), false);
        for (int first = 0; first < couplings_.parts(); ++first) {
            if (isIn[at(first)]) continue;
            isIn[at(first)] = true;
            all.push_back(first);
            for (std::size_t k = all.size() - 1; k < all.size(); ++k)
                for (const int q : near_[at(all[k])])
                    if (!isIn[at(q)]) {
                        isIn[at(q)] = true;
                        all.push_back(q);
                    }
        }
        return all;
    }
    std::vector<Eigen::Index> coordinatesNear(int q) const {
        std::vector<Eigen::Index> all;
        for (const int p : near_[at(q)])
            for (int i = 0; i < couplings_.size(p); ++i) all.push_back(couplings_.first(p) + i);
        return all;
    }

    Vector vector() {
        Vector v(couplings_.dimension());
        for (Eigen::Index i = 0; i < v.size(); ++i) v(i) = normal_(random_);
        return v;
    }
    Place place() {
        const MatrixGroup& group = *on_.group;
        return {group.product(group.exponential(0.7 * vector()), group.exponential(vector())), vector()};
    }
    Row rowAt(const Place& place) const {
        Vector m(couplings_.dimension()), f(couplings_.dimension());
        double value = 0;
        on_.gradient(on_.model.get(), place.g.data(), place.eta.data(), &value, m.data(), f.data());
        Row row;
        row.value = on_.group->inSpace(place.g, f, &row.sums);
        row.isFinite = f.allFinite();
        return row;
    }
    /// Rows of the factors as they move together from one state to another; of no factors, whole rows at a
    /// few states.
    void probe(const std::vector<int>& together) {
        Eigen::Index wanted = together.empty() ? extra / 2 : 0;
        for (const int q : together) wanted = std::max(wanted, rows_[at(q)].rows());
        for (Eigen::Index attempt = 0, found = 0; attempt < 8 * wanted && found < wanted; ++attempt) {
            const Place from = place();
            const Row before = rowAt(from);
            if (together.empty()) {
                if (!before.isFinite) continue;
                ++found;
                whole_.conservativeResize(found, couplings_.dimension());
                whole_.row(found - 1) = scaled(before.value, before.sums.norm()).transpose();
                continue;
            }
            const Place to = place();
            Place moved = from;
            for (const int q : together) {
                const GroupFactor& f = on_.group->factors()[at(q)];
                moved.g.segment(f.entry, f.n * f.n) = to.g.segment(f.entry, f.n * f.n);
                moved.eta.segment(f.coordinate, f.d) = to.eta.segment(f.coordinate, f.d);
            }
            const Row after = rowAt(moved);
            bool isDone = true;
            for (const int q : together) {
                keep(q, before, after);
                isDone = isDone && found_[at(q)] == rows_[at(q)].rows();
            }
            if (isDone) break;
        }
    }
    void keep(int q, const Row& before, const Row& after) {
        if (found_[at(q)] == rows_[at(q)].rows()) return;
        const std::vector<Eigen::Index> near = coordinatesNear(q);
        const Vector change = after.value(near) - before.value(near);
        const double scale = std::hypot(before.sums(near).norm(), after.sums(near).norm());
        if (std::isfinite(scale)) rows_[at(q)].row(found_[at(q)]++) = scaled(change, scale).transpose();
    }
    static Vector scaled(const Vector& row, double by) { return by > 0 ? Vector(row / by) : row; }

    /// The coordinates of factor p, on which there is no condition yet.
    void add(int p) {
        const Eigen::Index before = basis_.cols();
        basis_.conservativeResize(couplings_.dimension(), before + couplings_.size(p));
        basis_.rightCols(couplings_.size(p)).setZero();
        for (int i = 0; i < couplings_.size(p); ++i) basis_(couplings_.first(p) + i, before + i) = 1;
    }
    /// Leaves the part of the basis on which the rows, entries of which belong to these coordinates, are 0.
    void cut(const Eigen::MatrixXd& rows, const std::vector<Eigen::Index>& coordinates) {
        if (rows.rows() == 0) return;
        std::vector<Eigen::Index> active, others;
        for (Eigen::Index k = 0; k < basis_.cols(); ++k)
            (basis_.col(k)(coordinates).isZero(0) ? others : active).push_back(k);
        if (active.empty()) return;
        const Eigen::MatrixXd own = basis_(coordinates, active), images = dense::product<double>(rows, own);
        const Eigen::MatrixXd left = dense::product<double>(
            basis_(Eigen::all, active), nullSpaceOf(dense::product<double>(images.transpose(), images),
                                                    roundOff * static_cast<double>(rows.rows())));
        const Eigen::MatrixXd kept = basis_(Eigen::all, others);
        basis_.resize(couplings_.dimension(), kept.cols() + left.cols());
        basis_ << kept, left;
    }

    const GroupMechanics& on_;
    const Couplings& couplings_;
    std::vector<std::vector<int>> near_;  ///< of each factor, itself and those coupled with it
    std::vector<Eigen::MatrixXd> rows_;   ///< of each factor, over the coordinates of near_
    std::vector<Eigen::Index> found_;
    Eigen::MatrixXd whole_, basis_;
    std::mt19937 random_{1788};
    std::normal_distribution<double> normal_;
};

}  // namespace

Eigen::MatrixXd keptDirections(const GroupMechanics& mechanics) {
    const int d = mechanics.dimension();
    if (mechanics.isInvariant) return Eigen::MatrixXd::Identity(d, d);
    return SymmetrySearch(mechanics).directions();
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
        const Eigen::MatrixXd basis = echelon(nullSpaceOf(squares, 1e-10 * std::max(largest, 1.0)));
        for (Eigen::Index k = 0; k < basis.cols(); ++k) {
            Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(d, d);
            for (int u = 0; u < size; ++u) Q += basis(u, k) * units[static_cast<std::size_t>(u)];
            all.push_back({f.coordinate, Q});
        }
    }
    return all;
}

}  // namespace extremal::groups
