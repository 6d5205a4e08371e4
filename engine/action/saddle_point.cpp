// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/action/saddle_point.hpp"

#include <span>
#include <utility>

namespace extremal {

SaddlePoint::SaddlePoint(Mechanics<double> mechanics, const Table<double>& table, double h, int elements)
    : kernel_(std::move(mechanics), table, ElementBasis::space),
      h_(h),
      elements_(elements),
      one_(table.lift),
      rise_(table.change.col(table.change.cols() - 1)) {
    std::vector<double> value(static_cast<std::size_t>(table.space.size)), slope(value.size());
    const auto traceAt = [&](double tau) -> Eigen::VectorXd {
        table.space.evaluate(tau, value, slope);
        return Eigen::Map<const Eigen::VectorXd>(value.data(), table.space.size);
    };
    start_ = traceAt(0);
    end_ = traceAt(1);
}

std::vector<UnknownBlock> SaddlePoint::blocks() const {
    std::vector<UnknownBlock> all;
    for (int k = 0; k <= elements_; ++k) {
        all.push_back({multiplierOffset(k), dimension(), true, k});
        if (k < elements_) all.push_back({elementOffset(k), elementSize(), false, k});
    }
    return all;
}

bool SaddlePoint::assemble(double t0, const Eigen::VectorXd& q0, const Eigen::VectorXd& qN,
                           const Eigen::VectorXd& x, Eigen::VectorXd& gradient,
                           Eigen::MatrixXd* hessian) const {
    const int d = dimension(), n = functions();
    gradient = Eigen::VectorXd::Zero(size());
    if (hessian) *hessian = Eigen::MatrixXd::Zero(size(), size());
    ElementDerivatives<double> element;
    const DerivativeOrder order = hessian ? DerivativeOrder::second : DerivativeOrder::first;
    for (int k = 0; k < elements_; ++k) {
        const int z = elementOffset(k), before = multiplierOffset(k), after = multiplierOffset(k + 1);
        if (!kernel_.evaluate(t0 + k * h_, h_, x.segment(z, elementSize()), order, element)) return false;
        gradient.segment(z, elementSize()) = element.gradient;
        if (hessian) hessian->block(z, z, elementSize(), elementSize()) = element.hessian;
        // Continuity, and what the multipliers do to stationarity.
        for (int a = 0; a < n; ++a)
            for (int j = 0; j < d; ++j) {
                const int row = z + a * d + j;
                gradient(row) += start_(a) * x(before + j) - end_(a) * x(after + j);
                gradient(before + j) += start_(a) * x(row);
                gradient(after + j) -= end_(a) * x(row);
                if (!hessian) continue;
                (*hessian)(row, before + j) = (*hessian)(before + j, row) = start_(a);
                (*hessian)(row, after + j) = (*hessian)(after + j, row) = -end_(a);
            }
    }
    gradient.head(d) -= q0;
    gradient.tail(d) += qN;
    return gradient.allFinite() && (!hessian || hessian->allFinite());
}

Eigen::VectorXd SaddlePoint::broken(const Eigen::MatrixXd& nodes) const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(size());
    for (int k = 0; k < elements_; ++k)
        Eigen::Map<Eigen::MatrixXd>(x.data() + elementOffset(k), dimension(), functions()) =
            nodes.col(k) * one_.transpose() + (nodes.col(k + 1) - nodes.col(k)) * rise_.transpose();
    return x;
}

}  // namespace extremal
