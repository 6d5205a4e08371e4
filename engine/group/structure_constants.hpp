// SPDX-License-Identifier: GPL-3.0-or-later
/// The structure constants of an algebra, kept sparse, and what brackets they make:
///
///     [E_i, E_j] = sum_k c_ijk E_k,   bracket(x, y) = [x, y] = ad_x y,   coadjoint(x, m) = ad_x^T m.
///
/// Vectors are of any type of Eigen's columns, and results of the type of the last argument, which may be a
/// matrix kept by rows: each of its columns is then taken by itself.
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

    template <class V, class M>
    M bracket(const V& x, const M& y) const {
        M r = M::Zero(y.rows(), y.cols());
        addBracket(1, x, y, r);
        return r;
    }
    template <class V, class M>
    M coadjoint(const V& x, const M& m) const {
        M r = M::Zero(m.rows(), m.cols());
        addCoadjoint(1, x, m, r);
        return r;
    }
    /// r += scale [x, y].
    template <class V, class M>
    void addBracket(double scale, const V& x, const M& y, M& r) const {
        for (const Bracket& b : brackets_) {
            const double size = scale * b.value;
            addRow(size * x(b.i), y, b.j, r, b.k);
            addRow(-size * x(b.j), y, b.i, r, b.k);
        }
    }
    /// r += scale ad_x^T m.
    template <class V, class M>
    void addCoadjoint(double scale, const V& x, const M& m, M& r) const {
        for (const Bracket& b : brackets_) {
            const double size = scale * b.value;
            addRow(size * x(b.i), m, b.k, r, b.j);
            addRow(-size * x(b.j), m, b.k, r, b.i);
        }
    }
    /// r += ad_x^T m of each column x of a matrix.
    template <class V, class M>
    void addCoadjointBy(const M& x, const V& m, M& r) const {
        for (const Bracket& b : brackets_) {
            const double of = b.value * m(b.k);
            addRow(of, x, b.i, r, b.j);
            addRow(-of, x, b.j, r, b.i);
        }
    }
    /// The matrices of ad_x, and of x -> ad_x^T m, added to one.
    template <class V, class M>
    void addMatrix(const V& x, M& r) const {
        for (const Bracket& b : brackets_) {
            r(b.k, b.j) += b.value * x(b.i);
            r(b.k, b.i) -= b.value * x(b.j);
        }
    }
    template <class V, class M>
    void addCoadjointMatrix(double scale, const V& m, M& r) const {
        for (const Bracket& b : brackets_) {
            const double of = scale * b.value * m(b.k);
            r(b.j, b.i) += of;
            r(b.i, b.j) -= of;
        }
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
    template <class M>
    static void addRow(double scale, const M& from, int row, M& to, int into) {
        if constexpr (M::ColsAtCompileTime == 1) {
            to(into) += scale * from(row);
        } else {
            static_assert(M::IsRowMajor);
            const Eigen::Index n = from.cols();
            const double* const source = from.data() + row * n;
            double* const target = to.data() + into * n;
            for (Eigen::Index k = 0; k < n; ++k) target[k] += scale * source[k];
        }
    }
    struct Entry {
        int row, column;
        double value;
    };
    std::vector<Bracket> brackets_;
    std::vector<std::vector<Entry>> ofBasis_;  ///< ad of each basis vector
};

}  // namespace extremal
