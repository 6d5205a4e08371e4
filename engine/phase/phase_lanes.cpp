// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/phase_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes.hpp"
#include "engine/core/algebra/largest_lane.hpp"
#include "engine/solve/correction_size.hpp"

namespace extremal {
namespace {

struct Changes {
    int rows, columns;
    const double *now, *before;
    double *moved, *size;  ///< by column: the largest difference, and the largest of both
};

double largestOfEight(Lanes v) { return largestLane(v.lane.data()); }

void changesOf(const Changes& c) {
    const auto magnitude = [](double v) { return __builtin_fabs(v); };
    for (int k = 0; k < c.columns; ++k) {
        double moved = 0, size = 0, sum[8] = {};
        for (int i = k * c.rows; i < (k + 1) * c.rows; i += 8) {
            const Lanes now = Lanes::load(c.now + i), before = Lanes::load(c.before + i),
                        difference = (now - before).map(magnitude);
            moved = larger(moved, largestOfEight(difference));
            size = larger(size, largestOfEight(now.map(magnitude)));
            size = larger(size, largestOfEight(before.map(magnitude)));
            (Lanes::load(sum) + difference).store(sum);
        }
        for (int l = 1; l < 8; ++l) sum[0] += sum[l];  // sees what comparisons do not
        c.moved[k] = std::isfinite(sum[0]) ? moved : std::numeric_limits<double>::infinity();
        c.size[k] = size;
    }
}

/// With the last row repeated.
Eigen::MatrixXd padded(const Eigen::MatrixXd& of, Eigen::Index rows) {
    Eigen::MatrixXd made = of.row(of.rows() - 1).replicate(rows, 1);
    made.topRows(of.rows()) = of;
    return made;
}

}  // namespace

PhaseLanes::PhaseLanes(const PhaseMechanics& mechanics, const PhaseCell& cell)
    : H_(mechanics), sums_(nodeSums()) {
    const Eigen::Index rows = (cell.nodes() + 7) / 8 * 8;
    A_ = scaledA_ = padded(cell.A, rows);
    B_ = scaledB_ = padded(cell.B, rows);
    fromStart_ = padded(cell.fromStart, rows);
    place_ = times_ = padded(cell.place, rows);
    Q_ = P_ = Matrix::Zero(rows, d());
    gradients_ = next_ = Matrix::Zero(rows, 2 * d());
    moved_ = size_ = Eigen::VectorXd::Zero(2 * d());
}

void PhaseLanes::start(const Eigen::Ref<const Matrix>& K, const Eigen::Ref<const Matrix>& F) {
    const Eigen::Index n = K.rows(), more = rows() - n;
    gradients_.topLeftCorner(n, d()) = -F;
    gradients_.topRightCorner(n, d()) = K;
    for (Eigen::Index i = 0; i < more; ++i) gradients_.row(n + i) = gradients_.row(n - 1);
}

void PhaseLanes::setStep(double h) {
    h_ = h;
    scaledA_ = h * A_;
    scaledB_ = -h * B_;
}

double PhaseLanes::sweep(double t, double h, const double* q0, const double* p0) {
    if (h != h_) setStep(h);
    const int n = static_cast<int>(A_.cols());
    for (int k = 0; k < d(); ++k) {
        Q_.col(k).setConstant(q0[k]);
        P_.col(k) = p0[k] * fromStart_;
    }
    sums_.product(
        {scaledA_.data(), rows(), gradients_.col(d()).data(), rows(), Q_.data(), rows(), rows(), d(), n});
    sums_.product({scaledB_.data(), rows(), gradients_.data(), rows(), P_.data(), rows(), rows(), d(), n});
    if (H_.isTimeDependent)
        times_ = (h * place_).array() + t;
    else
        times_.setConstant(t);
    H_.gradients(H_.model.get(), times_.data(), rows(), Q_.data(), P_.data(), next_.data());
    const double size = change(h, q0, p0);
    gradients_.swap(next_);
    return size;
}

double PhaseLanes::change(double h, const double* q0, const double* p0) {
    static const auto measure = ForThisMachine<&changesOf>::call();
    measure({rows(), 2 * d(), next_.data(), gradients_.data(), moved_.data(), size_.data()});
    double worst = 0;
    for (int k = 0; k < 2 * d(); ++k)
        worst = std::max(worst, relativeCorrection(std::abs(h) * moved_(k), std::abs(h) * size_(k),
                                                   k < d() ? p0[k] : q0[k - d()]));
    return worst;
}

void PhaseLanes::rates(Eigen::Ref<Matrix> K, Eigen::Ref<Matrix> F) const {
    K = gradients_.topRightCorner(K.rows(), d());
    F = -gradients_.topLeftCorner(F.rows(), d());
}

}  // namespace extremal
