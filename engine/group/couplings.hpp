// SPDX-License-Identifier: GPL-3.0-or-later
/// Matrices over the coordinates of a product of groups that couple only some of its factors.
///
/// Factor p has the coordinates from first(p) on, size(p) of them. A matrix has the blocks (p, p), and (p, q)
/// and (q, p) where p and q are coupled: each a small matrix, column after column, one after the other in an
/// array of entries() numbers. Where there is one factor that is the matrix itself.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace extremal {

class Couplings {
public:
    using Block = Eigen::Map<Eigen::MatrixXd>;
    using ConstBlock = Eigen::Map<const Eigen::MatrixXd>;
    struct Pair {
        int p, q;
        std::size_t place;       ///< of the first entry of block (p, q)
        std::size_t transposed;  ///< of block (q, p)
    };

    Couplings() = default;
    /// The sizes of the factors and the couplings of two different ones, in any order.
    Couplings(const std::vector<int>& sizes, std::vector<std::pair<int, int>> coupled) : sizes_(sizes) {
        int at = 0;
        for (int p = 0; p < parts(); ++p) {
            first_.push_back(at);
            for (int i = 0; i < size(p); ++i) partOf_.push_back(p);
            at += size(p);
            coupled.emplace_back(p, p);
        }
        for (std::size_t k = coupled.size(); k-- > 0;)
            coupled.emplace_back(coupled[k].second, coupled[k].first);
        std::sort(coupled.begin(), coupled.end());
        coupled.erase(std::unique(coupled.begin(), coupled.end()), coupled.end());
        for (const auto& [p, q] : coupled) {
            pairs_.push_back({p, q, entries_, 0});
            entries_ += static_cast<std::size_t>(size(p) * size(q));
        }
        for (Pair& pair : pairs_) pair.transposed = find(pair.q, pair.p).place;
    }

    int parts() const { return static_cast<int>(sizes_.size()); }
    int dimension() const { return static_cast<int>(partOf_.size()); }
    int size(int p) const { return sizes_[static_cast<std::size_t>(p)]; }
    int first(int p) const { return first_[static_cast<std::size_t>(p)]; }
    int partOf(int coordinate) const { return partOf_[static_cast<std::size_t>(coordinate)]; }
    std::size_t entries() const { return entries_; }
    const std::vector<Pair>& pairs() const { return pairs_; }
    /// Couplings of two different factors, each once.
    std::vector<std::pair<int, int>> coupled() const {
        std::vector<std::pair<int, int>> found;
        for (const Pair& pair : pairs_)
            if (pair.p < pair.q) found.emplace_back(pair.p, pair.q);
        return found;
    }
    bool areCoupled(int p, int q) const { return search(p, q) != nullptr; }
    /// Throws std::logic_error where the two are not coupled.
    const Pair& find(int p, int q) const {
        const Pair* const found = search(p, q);
        if (!found) throw std::logic_error("a block of factors that are not coupled");
        return *found;
    }
    /// Where the entry (row, column) of the matrix is.
    std::size_t place(int row, int column) const {
        const int p = partOf(row), q = partOf(column);
        return find(p, q).place + static_cast<std::size_t>((column - first(q)) * size(p) + (row - first(p)));
    }

    Block block(double* values, const Pair& pair) const {
        return {values + pair.place, size(pair.p), size(pair.q)};
    }
    ConstBlock block(const double* values, const Pair& pair) const {
        return {values + pair.place, size(pair.p), size(pair.q)};
    }
    /// Block (q, p) of a pair (p, q).
    ConstBlock opposite(const double* values, const Pair& pair) const {
        return {values + pair.transposed, size(pair.q), size(pair.p)};
    }
    /// Products of the matrix, and of the transposed one, with a vector.
    Eigen::VectorXd times(const double* values, const Eigen::VectorXd& x) const {
        Eigen::VectorXd y = Eigen::VectorXd::Zero(dimension());
        for (const Pair& pair : pairs_)
            y.segment(first(pair.p), size(pair.p)) +=
                block(values, pair).lazyProduct(x.segment(first(pair.q), size(pair.q)));
        return y;
    }
    Eigen::VectorXd transposedTimes(const double* values, const Eigen::VectorXd& x) const {
        Eigen::VectorXd y = Eigen::VectorXd::Zero(dimension());
        for (const Pair& pair : pairs_)
            y.segment(first(pair.q), size(pair.q)) +=
                block(values, pair).transpose().lazyProduct(x.segment(first(pair.p), size(pair.p)));
        return y;
    }
    /// The matrix with all its zeros.
    Eigen::MatrixXd whole(const double* values) const {
        Eigen::MatrixXd r = Eigen::MatrixXd::Zero(dimension(), dimension());
        for (const Pair& pair : pairs_)
            r.block(first(pair.p), first(pair.q), size(pair.p), size(pair.q)) = block(values, pair);
        return r;
    }

private:
    const Pair* search(int p, int q) const {
        const auto found =
            std::lower_bound(pairs_.begin(), pairs_.end(), std::pair(p, q),
                             [](const Pair& a, const auto& b) { return std::pair(a.p, a.q) < b; });
        return found == pairs_.end() || found->p != p || found->q != q ? nullptr : &*found;
    }

    std::vector<int> sizes_, first_, partOf_;
    std::vector<Pair> pairs_;  ///< in order
    std::size_t entries_ = 0;
};

}  // namespace extremal
