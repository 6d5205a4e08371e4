// SPDX-License-Identifier: GPL-3.0-or-later
/// What the rates at the nodes of the next step may be: those of the last step, continued as polynomials, and
/// what such a guess has been off by in the steps before, continued as well.
///
/// With g_k = ahead X_{k-1} and the offsets o_k = X_k - g_k, the guesses for X_{k+1} are
///     g_{k+1},    g_{k+1} + o_k,    g_{k+1} + 2 o_k - o_{k-1},
/// each of one order more in the step. The one that would have been best for X_k is taken: where steps are
/// long for the motion, that is the first.
///
/// X: K and F, node i and coordinate j at (i, j).
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>

#include "engine/core/text/archive.hpp"

namespace extremal {

template <int D>
class NodeGuess {
public:
    using Nodes = Eigen::Matrix<double, Eigen::Dynamic, D>;

    NodeGuess(int nodes, int dimension) {
        for (Rates* each : {&now_, &offsets_[0], &offsets_[1], &offsets_[2]})
            each->K = each->F = Nodes::Zero(nodes, dimension);
    }

    /// The next step does not follow on the last one.
    void forget() {
        known_ = order_ = 0;
        isMade_ = false;
    }
    /// Of the rates of the last step to a guess for the next one.
    void make(const Eigen::MatrixXd& ahead, const Nodes& K, const Nodes& F, Nodes& nextK, Nodes& nextF) {
        now_.K.noalias() = ahead.lazyProduct(K);
        now_.F.noalias() = ahead.lazyProduct(F);
        isMade_ = true;
        nextK = now_.K;
        nextF = now_.F;
        if (order_ == 0) return;
        nextK += order_ * offsets_[0].K;
        nextF += order_ * offsets_[0].F;
        if (order_ == 1) return;
        nextK -= offsets_[1].K;
        nextF -= offsets_[1].F;
    }
    /// The rates that the step has come to.
    void learn(const Nodes& K, const Nodes& F) {
        if (!isMade_) return forget();
        isMade_ = false;
        offsets_[2].swap(offsets_[1]);
        offsets_[1].swap(offsets_[0]);
        offsets_[0].K = K - now_.K;
        offsets_[0].F = F - now_.F;
        known_ = known_ < 3 ? known_ + 1 : 3;
        order_ = 0;
        if (known_ < 2) return;
        const auto& [last, before, first] = offsets_;
        const double scaleK = size(K), scaleF = size(F);
        const double none = size(last.K) / scaleK + size(last.F) / scaleF,
                     one = size(last.K - before.K) / scaleK + size(last.F - before.F) / scaleF;
        if (!(one < none)) return;
        order_ = 1;
        if (known_ < 3) return;
        const double two = size(last.K - 2 * before.K + first.K) / scaleK +
                           size(last.F - 2 * before.F + first.F) / scaleF;
        if (two < one) order_ = 2;
    }
    void checkpoint(Archive& archive) {
        for (Rates& each : offsets_) archive(each.K, each.F);
        archive(known_, order_);
    }

private:
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

    Rates now_;                     ///< the first guess of the step that is being made
    std::array<Rates, 3> offsets_;  ///< of the last steps, the latest first
    int known_ = 0, order_ = 0;     ///< how many of them, and how many are used
    bool isMade_ = false;
};

}  // namespace extremal
