// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/observe/modified_energy.hpp"

#include <limits>

namespace extremal {

ModifiedEnergyWindow::ModifiedEnergyWindow(ModifiedEnergyForm form, int r, int d, double h)
    : form_(form),
      d_(static_cast<std::size_t>(d)),
      h_(h),
      weight_(static_cast<std::size_t>(r)),
      ring_(static_cast<std::size_t>(2 * r + 1)) {
    double ratio = 1;  // (r!)^2 / ((r-j)! (r+j)!)
    for (int j = 1; j <= r; ++j) {
        ratio *= static_cast<double>(r - j + 1) / (r + j);
        weight_[static_cast<std::size_t>(j - 1)] = (j % 2 == 1 ? ratio : -ratio) / j;
    }
    for (Node& node : ring_) {
        node.q.resize(d_);
        node.p.resize(d_);
    }
}

double ModifiedEnergyWindow::next(const double* q, const double* p, double action) {
    const Node* before = count_ > 0 ? &at(count_ - 1) : nullptr;
    double change = 0;  // of q.p
    for (std::size_t i = 0; i < d_ && before; ++i) change += q[i] * p[i] - before->q[i] * before->p[i];
    Node& node = ring_[static_cast<std::size_t>(count_) % ring_.size()];
    node.q.assign(q, q + d_);
    node.p.assign(p, p + d_);
    node.action = action;
    node.beta = 2 * action - change;
    ++count_;
    const auto r = static_cast<long long>(weight_.size());
    if (count_ < 2 * r + 1) return std::numeric_limits<double>::quiet_NaN();

    const long long n = count_ - 1 - r;
    const Node& centre = at(n);
    const bool isLegendre = form_ == ModifiedEnergyForm::legendre;
    double sum = 0, integral = 0;
    for (long long j = 1; j <= r; ++j) {
        const Node &after = at(n + j), &earlier = at(n - j), &inner = at(n - j + 1);
        const double w = weight_[static_cast<std::size_t>(j - 1)];
        integral += isLegendre ? after.action + inner.action : after.beta + inner.beta;
        double terms = -integral;
        for (std::size_t i = 0; i < d_; ++i) {
            terms += centre.p[i] * (after.q[i] - earlier.q[i]);
            if (!isLegendre) terms -= centre.q[i] * (after.p[i] - earlier.p[i]);
        }
        sum += w * terms;
    }
    return sum / (isLegendre ? h_ : 2 * h_);
}

}  // namespace extremal
