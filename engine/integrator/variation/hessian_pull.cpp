// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/variation/hessian_pull.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace extremal {

HessianPull::HessianPull(Mechanics<double> mechanics, std::optional<Force> force, int held)
    : mechanics_(std::move(mechanics)),
      force_(std::move(force)),
      d_(mechanics_.dimension - held),
      held_(held) {
    const int all = mechanics_.dimension;
    q_ = v_ = forces_ = Eigen::VectorXd::Zero(all);
    gradient_ = tested_ = pulled_ = Eigen::VectorXd::Zero(2 * all);
}

void HessianPull::beginStep(int columns) {
    known_ = 0;
    byHeld_.resize(held_, columns);
}
void HessianPull::setHeld(std::span<const double> values, const double* tests, std::size_t stride) {
    std::copy(values.begin(), values.end(), q_.data() + d_);
    tests_ = tests;
    stride_ = stride;
}

void HessianPull::begin(int column) {
    column_ = column;
    byHeld_.col(column).setZero();
    if (tests_) std::copy_n(tests_ + static_cast<std::size_t>(column) * stride_, held_, tested_.data() + d_);
}

/// Nodes are asked for in their order at first.
const HessianPull::Rows& HessianPull::derivativesAt(const Node& node) {
    const auto place = static_cast<std::size_t>(node.index);
    if (place < known_) return derivatives_[place];
    assert(place == known_);
    const int all = mechanics_.dimension;
    if (place == derivatives_.size()) derivatives_.emplace_back(Rows::Zero(2 * all, 2 * all));
    ++known_;
    std::copy_n(node.q, d_, q_.data());
    std::copy_n(node.v, d_, v_.data());
    double value = 0;
    if (node.isOfForce)
        force_->first(force_->model.get(), node.t, q_.data(), v_.data(), forces_.data(),
                      derivatives_[place].data());
    else
        mechanics_.jet(mechanics_.model.get(), node.t, q_.data(), v_.data(), &value, gradient_.data(),
                       derivatives_[place].data());
    return derivatives_[place];
}

void HessianPull::hessian(const Node& node, double* to) {
    const int all = mechanics_.dimension;
    const Rows& whole = derivativesAt(node);
    for (int i = 0; i < 2 * d_; ++i) {
        const double* const row = whole.data() + (i < d_ ? i : i + all - d_) * 2 * all;
        to = std::copy_n(row, d_, to);
        to = std::copy_n(row + all, d_, to);
    }
}

void HessianPull::add(const Node& node, const double* eta, const double* rate, double* byQ, double* byV) {
    const int all = mechanics_.dimension;
    const Rows& derivatives = derivativesAt(node);
    std::copy_n(eta, d_, tested_.data());
    std::copy_n(rate, d_, tested_.data() + all);
    // Of a force the rows of q alone: held coordinates feel none.
    if (node.isOfForce)
        pulled_.noalias() = derivatives.topRows(d_).transpose() * tested_.head(d_);
    else
        pulled_.noalias() = derivatives.transpose() * tested_;
    for (int k = 0; k < d_; ++k) {
        byQ[k] += node.weight * pulled_(k);
        byV[k] += node.weight * pulled_(all + k);
    }
    byHeld_.col(column_) += node.weight * pulled_.segment(d_, held_);
}

}  // namespace extremal
