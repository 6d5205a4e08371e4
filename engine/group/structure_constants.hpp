// SPDX-License-Identifier: GPL-3.0-or-later
/// The structure constants of an algebra, kept sparse, and what brackets they make:
///
///     [E_i, E_j] = sum_k c_ijk E_k,   bracket(x, y) = [x, y] = ad_x y,   coadjoint(x, m) = ad_x^T m.
///
/// Vectors are of any type of Eigen's columns, and results of the type of the last argument.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace extremal {

class StructureConstants {
public:
    struct Bracket {
        int i, j, k;  ///< i < j: [E_i, E_j] has `value` E_k in it
        double value;
    };

    explicit StructureConstants(int dimension = 0) : ofBasis_(static_cast<std::size_t>(dimension)) {}

    void add(const Bracket& b) {
        brackets_.push_back(b);
        ofBasis_[static_cast<std::size_t>(b.i)].push_back({b.k, b.j, b.value});
        ofBasis_[static_cast<std::size_t>(b.j)].push_back({b.k, b.i, -b.value});
    }
    const std::vector<Bracket>& brackets() const { return brackets_; }

    template <class V>
    V bracket(const V& x, const V& y) const {
        V r = V::Zero(y.size());
        for (const Bracket& b : brackets_) r(b.k) += b.value * (x(b.i) * y(b.j) - x(b.j) * y(b.i));
        return r;
    }
    template <class V>
    V coadjoint(const V& x, const V& m) const {
        V r = V::Zero(m.size());
        for (const Bracket& b : brackets_) {
            const double of = b.value * m(b.k);
            r(b.j) += x(b.i) * of;
            r(b.i) -= x(b.j) * of;
        }
        return r;
    }
    /// ad of the basis vector k, times y.
    template <class V>
    V bracketOfBasis(int k, const V& y) const {
        V r = V::Zero(y.size());
        for (const Entry& e : ofBasis_[static_cast<std::size_t>(k)]) r(e.row) += e.value * y(e.column);
        return r;
    }
    /// ad of the basis vector k transposed, times m.
    template <class V>
    V coadjointOfBasis(int k, const V& m) const {
        V r = V::Zero(m.size());
        for (const Entry& e : ofBasis_[static_cast<std::size_t>(k)]) r(e.column) += e.value * m(e.row);
        return r;
    }
    /// An upper bound of the row-sum norms of ad_x and its transpose.
    template <class V>
    double adNorm(const V& x) const {
        V rows = V::Zero(x.size()), columns = V::Zero(x.size());
        for (const Bracket& b : brackets_) {
            const double first = std::abs(b.value * x(b.i)), second = std::abs(b.value * x(b.j));
            rows(b.k) += first + second;
            columns(b.j) += first;
            columns(b.i) += second;
        }
        return std::max(rows.maxCoeff(), columns.maxCoeff());
    }

private:
    struct Entry {
        int row, column;
        double value;
    };
    std::vector<Bracket> brackets_;
    std::vector<std::vector<Entry>> ofBasis_;  ///< ad of each basis vector
};

}  // namespace extremal
