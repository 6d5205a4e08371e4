// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/node_lanes.hpp"

#include <algorithm>

#include "engine/core/algebra/lanes.hpp"

namespace extremal {

NodeLanes::NodeLanes(const std::vector<double>& places, const MechanismCurve::Samples& at, int dimension)
    : nodes_(static_cast<int>(places.size())), d_(dimension) {
    const Eigen::Index rows = inWholeLanes(nodes_);
    const bool hasSlopes = at.slope.cols() > 0;
    places_.resize(rows);
    functions_.resize(hasSlopes ? 2 * rows : rows, at.value.cols());
    for (Eigen::Index i = 0; i < rows; ++i) {
        const Eigen::Index node = std::min<Eigen::Index>(i, nodes_ - 1);
        places_(i) = places[static_cast<std::size_t>(node)];
        functions_.row(i) = at.value.row(node);
        if (hasSlopes) functions_.row(rows + i) = at.slope.row(node);
    }
    times_ = places_;
    motion_ = Matrix::Zero(rows, 2 * d_);
    own_ = Vector::Zero(2 * d_);
}

void NodeLanes::moveTo(double t, double h, const double* q0, const Matrix& Y) {
    const auto m = static_cast<int>(Y.rows()), height = static_cast<int>(functions_.rows());
    const bool hasSlopes = height > stride();
    times_ = h * places_;
    times_.array() += t;
    for (int k = 0; k < d_; ++k) motion_.col(k).setConstant(q0[k]);
    if (hasSlopes) motion_.rightCols(d_).setZero();
    const auto product = [&](int from, int rows, double* to) {
        sums_.product({functions_.data() + from, height, Y.data(), m, to, stride(), rows, d_, m});
    };
    // Of one coordinate q and v are one column, whose sums do not wait for each other.
    if (d_ == 1) {
        product(0, height, motion_.data());
    } else {
        product(0, stride(), motion_.data());
        if (hasSlopes) product(stride(), stride(), motion_.col(d_).data());
    }
    if (hasSlopes) motion_.rightCols(d_) /= h;
}

NodeTests::NodeTests(const std::vector<double>& weights, const MechanismCurve::Samples& at) {
    const Eigen::Index m = at.value.cols(), rows = inWholeLanes(m + 1);
    value_ = slope_ = Matrix::Zero(rows, static_cast<Eigen::Index>(weights.size()));
    for (Eigen::Index i = 0; i < value_.cols(); ++i) {
        const double weight = weights[static_cast<std::size_t>(i)];
        value_.col(i).head(m) = weight * at.value.row(i).transpose();
        value_(m - 1, i) = weight * (1 - at.value(i, m - 1));
        value_(m, i) = weight;
        if (at.slope.cols() == 0) continue;
        slope_.col(i).head(m) = weight * at.slope.row(i).transpose();
        slope_(m - 1, i) *= -1;
    }
}

void NodeTests::add(const Matrix& tests, const double* data, int stride, Matrix& to) const {
    const auto rows = static_cast<int>(to.rows());
    sums_.product({tests.data(), static_cast<int>(tests.rows()), data, stride, to.data(), rows, rows,
                   static_cast<int>(to.cols()), static_cast<int>(tests.cols())});
}

NodePairs::NodePairs(const Matrix& tests, const Matrix& functions) : weighted_(tests.cols()) {
    const Eigen::Index m = functions.cols();
    if (m == 0) return;
    products_ = Matrix::Zero(inWholeLanes((m + 1) * m), tests.cols());
    for (Eigen::Index i = 0; i < tests.cols(); ++i)
        for (Eigen::Index b = 0; b < m; ++b)
            products_.col(i).segment(b * (m + 1), m + 1) = functions(i, b) * tests.col(i).head(m + 1);
}

bool NodePairs::add(const double* data, double weight, Matrix& to) {
    bool isThere = false;
    for (Eigen::Index i = 0; i < weighted_.size(); ++i) {
        weighted_(i) = weight * data[i];
        isThere |= data[i] != 0;
    }
    if (!isThere) return false;
    const auto rows = static_cast<int>(to.size()), nodes = static_cast<int>(weighted_.size());
    sums_.product({products_.data(), static_cast<int>(products_.rows()), weighted_.data(), nodes, to.data(),
                   rows, rows, 1, nodes});
    return true;
}

}  // namespace extremal
