// SPDX-License-Identifier: GPL-3.0-or-later
/// What the rates at the nodes of the next step may be: those of the last step, continued as polynomials, and
/// what such a guess was off by in the steps before, continued as well.
///
/// With g_k = ahead X_{k-1}, the offsets o_k = X_k - g_k and their backward differences D^j o_k, the guess
/// for X_{k+1} is
///     g_{k+1} + sum_{j < r} D^j o_k,
/// whose order in the step grows with r. For X_k that guess would have been off by D^r o_k: r is the first
/// one with a smaller one than the next. Where steps are long for the motion, that is 0.
///
/// X: K and F, node i and coordinate j at (i, j).
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>

#include "engine/core/algebra/lanes.hpp"
#include "engine/core/algebra/small_product.hpp"
#include "engine/core/text/archive.hpp"

namespace extremal {

template <int D>
class NodeGuess {
public:
    using Nodes = Eigen::Matrix<double, Eigen::Dynamic, D>;

    explicit NodeGuess(const Eigen::MatrixXd& ahead, int dimension) : sums_(nodeSums()) {
        const Eigen::Index nodes = ahead.rows();
        ahead_ = Eigen::MatrixXd::Zero(inWholeLanes(nodes), nodes);
        ahead_.topRows(nodes) = ahead;
        first_.K = first_.F = older_.K = older_.F = Nodes::Zero(nodes, dimension);
        differences_.fill(first_);
    }

    /// The next step does not follow on the last one.
    void forget() {
        known_ = order_ = 0;
        isMade_ = false;
    }
    /// Of the rates of the last step to a guess for the next one.
    void make(const Nodes& K, const Nodes& F, Nodes& nextK, Nodes& nextF) {
        continueRates(K, first_.K);
        continueRates(F, first_.F);
        isMade_ = true;
        nextK = first_.K;
        nextF = first_.F;
        for (std::size_t j = 0; j < order_; ++j) {
            nextK += differences_[j].K;
            nextF += differences_[j].F;
        }
    }
    /// The rates that the step has come to.
    void learn(const Nodes& K, const Nodes& F) {
        if (!isMade_) return forget();
        isMade_ = false;
        newer_.K = K - first_.K;
        newer_.F = F - first_.F;
        const double scaleK = size(K), scaleF = size(F);
        double off = size(newer_.K) / scaleK + size(newer_.F) / scaleF;
        bool isShrinking = true;
        order_ = 0;
        for (std::size_t j = 0; j < differences_.size(); ++j) {
            older_.swap(differences_[j]);
            differences_[j].swap(newer_);
            if (j == known_ || j + 1 == differences_.size()) break;
            newer_.K = differences_[j].K - older_.K;
            newer_.F = differences_[j].F - older_.F;
            if (!isShrinking) continue;
            const double next = size(newer_.K) / scaleK + size(newer_.F) / scaleF;
            isShrinking = next < off;
            if (isShrinking) order_ = j + 1;
            off = next;
        }
        if (known_ < differences_.size()) ++known_;
    }
    void checkpoint(Archive& archive) {
        for (Rates& each : differences_) archive(each.K, each.F);
        archive(known_, order_);
    }

private:
    /// ahead X
    void continueRates(const Nodes& X, Nodes& to) const {
        const int n = static_cast<int>(X.rows()), rows = static_cast<int>(ahead_.rows());
        to.setZero();
        sums_.product({ahead_.data(), rows, X.data(), n, to.data(), n, n, static_cast<int>(X.cols()), n});
    }
    struct Rates {
        Nodes K, F;
        void swap(Rates& other) {
            K.swap(other.K);
            F.swap(other.F);
        }
    };
    template <class Values>
    static double size(const Values& values) {
        return values.cwiseAbs().sum() + 1e-300;
    }

    NodeSums sums_;
    Eigen::MatrixXd ahead_;              ///< rows beyond the nodes are 0
    Rates first_;                        ///< the guess of the step that is being made, with r = 0
    std::array<Rates, 5> differences_;   ///< D^j o of the last step
    Rates newer_, older_;                ///< while they are renewed
    std::size_t known_ = 0, order_ = 0;  ///< how many of them, and r
    bool isMade_ = false;
};

}  // namespace extremal
