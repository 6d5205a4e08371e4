// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/impact/impact_variation.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {

ImpactVariation::ImpactVariation(const Parts& parts) : mechanism_(parts), wall_(*parts.find<Wall>()) {
    const auto n = static_cast<std::size_t>(wall_.count());
    gaps_.resize(n);
    byTime_.resize(n);
    byPlace_.resize(n * static_cast<std::size_t>(mechanism_.dimension()));
}

bool ImpactVariation::strike(int wall, double t, const Eigen::VectorXd& x, Eigen::VectorXd& p) {
    const int d = mechanism_.dimension();
    const auto k = static_cast<std::size_t>(wall);
    const auto& L = mechanism_.mechanics();
    wall_.first(wall_.model.get(), t, x.data(), gaps_.data(), byPlace_.data(), byTime_.data());
    const Eigen::VectorXd normal = Eigen::Map<const Eigen::VectorXd>(byPlace_.data() + wall * d, d);
    Eigen::VectorXd v = Eigen::VectorXd::Zero(d);
    if (!L.velocity(L.model.get(), t, x.data(), x.data() + d, v.data())) return false;
    const double speed = normal.dot(v) + byTime_[k];
    p = x.tail(d);
    return mechanism_.strike(t, x.data(), p.data(), normal.data(), -wall_.restitution[k] * speed - byTime_[k])
        .has_value();
}

bool ImpactVariation::throughContact(VariedStep& step, int wall, const State& before, Matrix& W, Row& later) {
    const int d = mechanism_.dimension();
    const Eigen::Index columns = W.cols();
    Matrix moved = Matrix::Zero(2 * d, columns + 1);
    moved.leftCols(columns) = W;
    Row start = Row::Zero(columns + 1), length = Row::Zero(columns + 1);
    start.head(columns) = later;
    length(columns) = 1;
    if (!step.vary(moved, start, length)) return false;
    wall_.first(wall_.model.get(), before.t, before.x.data(), gaps_.data(), byPlace_.data(), byTime_.data());
    const Eigen::RowVectorXd normal =
        Eigen::Map<const Eigen::VectorXd>(byPlace_.data() + wall * d, d).transpose();
    const double byTime = byTime_[static_cast<std::size_t>(wall)],
                 speed = normal.dot(moved.col(columns).head(d)) + byTime;
    const Row more =
        -(normal * moved.topLeftCorner(d, columns) + byTime * later) / speed;  // of the step before
    W = moved.leftCols(columns) + moved.col(columns) * more;
    later += more;

    const Eigen::Map<const Eigen::VectorXd> at(before.x.data(), 2 * d);
    const double size = at.cwiseAbs().maxCoeff();
    Eigen::VectorXd p(d), sum(d);
    for (Eigen::Index c = 0; c < columns; ++c) {
        const double most = std::max(W.col(c).cwiseAbs().maxCoeff(), std::abs(later(c)));
        if (most == 0) continue;
        const double apart = 1e-3 * size / most;
        sum.setZero();
        for (const auto& [place, weight] :
             {std::pair(1, 8.0), std::pair(-1, -8.0), std::pair(2, -1.0), std::pair(-2, 1.0)}) {
            const double by = place * apart;
            if (!strike(wall, before.t + by * later(c), at + by * W.col(c), p)) return false;
            sum += weight * p;
        }
        W.col(c).tail(d) = sum / (12 * apart);
    }
    return W.allFinite();
}

bool ImpactVariation::throughImpacts(const std::vector<VariedStep*>& steps,
                                     const std::vector<Contact>& contacts, const State& end,
                                     std::span<double> W) {
    const Eigen::Index rows = 2 * mechanism_.dimension(),
                       columns = static_cast<Eigen::Index>(W.size()) / rows;
    Eigen::Map<Matrix> given(W.data(), rows, columns);
    Matrix moved = given;
    Row later = Row::Zero(columns);
    auto next = contacts.begin();
    for (std::size_t k = 0; k < steps.size(); ++k) {
        if (!steps[k]) return false;
        if (next != contacts.end() && next->pieces <= k) return false;
        if (next != contacts.end() && next->pieces == k + 1) {
            const Contact& contact = *next++;
            if (!throughContact(*steps[k], contact.wall, contact.before, moved, later)) return false;
            continue;
        }
        const bool isLast = k + 1 == steps.size();
        const Row length = isLast ? -later : Row::Zero(columns).eval();
        if (!steps[k]->vary(moved, later, length)) return false;
        if (isLast) later.setZero();
    }
    if (next != contacts.end() || !toNode(end, moved, later)) return false;
    given = moved;
    return true;
}

bool ImpactVariation::toNode(const State& at, Matrix& W, const Row& later) {
    if (later.isZero(0)) return true;
    const int d = mechanism_.dimension();
    Eigen::VectorXd flow = Eigen::VectorXd::Zero(2 * d);
    if (!mechanism_.flow(at.t, at.x.data(), at.x.data() + d, flow.data(), flow.data() + d)) return false;
    W -= flow * later;
    return true;
}

}  // namespace extremal
