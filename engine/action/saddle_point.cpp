#include "engine/action/saddle_point.hpp"

#include <span>
#include <utility>

namespace extremal {

SaddlePoint::SaddlePoint(Mechanics<double> mechanics, const Table<double>& table, double h, int elements)
    : mechanics_(std::move(mechanics)),
      h_(h),
      elements_(elements),
      node_(table.node),
      weight_(table.weight),
      one_(table.lift),
      rise_(table.change.col(table.change.cols() - 1)) {
    const int n = table.space.size;
    const auto size = static_cast<std::size_t>(n);
    std::vector<double> value(size), slope(size);
    const auto sample = [&](double tau) { table.space.evaluate(tau, value, slope); };
    value_.resize(table.nodes(), n);
    slope_.resize(table.nodes(), n);
    for (int i = 0; i < table.nodes(); ++i) {
        sample(table.node(i));
        value_.row(i) = Eigen::Map<const Eigen::RowVectorXd>(value.data(), n);
        slope_.row(i) = Eigen::Map<const Eigen::RowVectorXd>(slope.data(), n);
    }
    sample(0);
    start_ = Eigen::Map<const Eigen::VectorXd>(value.data(), n);
    sample(1);
    end_ = Eigen::Map<const Eigen::VectorXd>(value.data(), n);
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
    Eigen::VectorXd q(d), v(d), g(2 * d);
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> H(2 * d, 2 * d);
    double L = 0;
    for (int k = 0; k < elements_; ++k) {
        const int z = elementOffset(k), before = multiplierOffset(k), after = multiplierOffset(k + 1);
        const auto Z = Eigen::Map<const Eigen::MatrixXd>(x.data() + z, d, n);
        for (int i = 0; i < node_.size(); ++i) {
            q = Z * value_.row(i).transpose();
            v = Z * slope_.row(i).transpose() / h_;
            mechanics_.jet(mechanics_.model.get(), t0 + (k + node_(i)) * h_, q.data(), v.data(), &L, g.data(),
                           H.data());
            const double b = weight_(i);
            for (int a = 0; a < n; ++a)
                gradient.segment(z + a * d, d) +=
                    b * (h_ * value_(i, a) * g.head(d) + slope_(i, a) * g.tail(d));
            if (!hessian) continue;
            for (int a = 0; a < n; ++a)
                for (int c = 0; c < n; ++c)
                    hessian->block(z + a * d, z + c * d, d, d) +=
                        b * (h_ * value_(i, a) * value_(i, c) * H.topLeftCorner(d, d) +
                             value_(i, a) * slope_(i, c) * H.topRightCorner(d, d) +
                             slope_(i, a) * value_(i, c) * H.bottomLeftCorner(d, d) +
                             slope_(i, a) * slope_(i, c) / h_ * H.bottomRightCorner(d, d));
        }
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
