// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/basis/interval.hpp"

#include <Eigen/Cholesky>

#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

#include "engine/quadrature/rule.hpp"

namespace extremal {
namespace {

/// Barycentric weights of these points.
double weightOf(int j, int N) { return (j % 2 == 0 ? 1.0 : -1.0) * (j == 0 || j == N ? 0.5 : 1.0); }

/// (k, j): Chebyshev coefficient k of the cardinal polynomial of node j.
Eigen::MatrixXd coefficientsOfCardinals(int N) {
    Eigen::MatrixXd T(N + 1, N + 1);
    for (int k = 0; k <= N; ++k)
        for (int j = 0; j <= N; ++j) {
            const double ends = (k == 0 || k == N ? 0.5 : 1.0) * (j == 0 || j == N ? 0.5 : 1.0);
            // Node j is -cos(pi j/N).
            T(k, j) =
                (k % 2 == 0 ? 2.0 : -2.0) / N * ends * std::cos(std::numbers::pi * ((k * j) % (2 * N)) / N);
        }
    return T;
}

}  // namespace

namespace chebyshev {

Eigen::VectorXd extrema(int N) {
    Eigen::VectorXd x(N + 1);
    for (int j = 0; j <= N; ++j) x(j) = std::sin(std::numbers::pi * (2 * j - N) / (2.0 * N));
    return x;
}

Eigen::MatrixXd cardinals(const Eigen::VectorXd& points, const Eigen::VectorXd& nodes) {
    const auto N = static_cast<int>(nodes.size()) - 1;
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(points.size(), N + 1);
    for (Eigen::Index i = 0; i < points.size(); ++i) {
        Eigen::Index same = -1;
        double sum = 0;
        for (int j = 0; j <= N; ++j) {
            const double d = points(i) - nodes(j);
            if (d == 0) {
                same = j;
                break;
            }
            values(i, j) = weightOf(j, N) / d;
            sum += values(i, j);
        }
        if (same >= 0) {
            values.row(i).setZero();
            values(i, same) = 1;
        } else {
            values.row(i) /= sum;
        }
    }
    return values;
}

Eigen::MatrixXd differentiation(const Eigen::VectorXd& nodes) {
    const auto N = static_cast<int>(nodes.size()) - 1;
    Eigen::MatrixXd D(N + 1, N + 1);
    for (int i = 0; i <= N; ++i) {
        double sum = 0;
        for (int j = 0; j <= N; ++j) {
            if (i == j) continue;
            // The difference of two sines as a product keeps the digits near the ends.
            const double a = std::numbers::pi * (2 * i - N) / (2.0 * N),
                         b = std::numbers::pi * (2 * j - N) / (2.0 * N);
            D(i, j) = weightOf(j, N) / weightOf(i, N) / (2 * std::cos((a + b) / 2) * std::sin((a - b) / 2));
            sum += D(i, j);
        }
        D(i, i) = -sum;
    }
    return D;
}

}  // namespace chebyshev

Interval::Interval(int n) {
    const int N = n + 1;
    const Eigen::VectorXd all = chebyshev::extrema(N);
    const Rule<double> rule = clenshawCurtis<double>(2 * N + 1);
    nodes = all.segment(1, n);
    // Every second point is a node, to the bit.
    points = chebyshev::extrema(2 * N);
    weights = 2 * Eigen::Map<const Eigen::VectorXd>(rule.b.data(), 2 * N + 1);
    const Eigen::MatrixXd cardinals = chebyshev::cardinals(points, all);
    const Eigen::MatrixXd slope = cardinals * chebyshev::differentiation(all);
    const Eigen::MatrixXd phi = cardinals.middleCols(1, n), dphi = slope.middleCols(1, n);
    const Eigen::MatrixXd M = phi.transpose() * weights.asDiagonal() * phi;
    factor = Eigen::LLT<Eigen::MatrixXd, Eigen::Upper>(M).matrixU();
    inverse = factor.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(n, n));
    const auto lower = factor.transpose().triangularView<Eigen::Lower>();
    values = lower.solve(phi.transpose());
    slopes = lower.solve(dphi.transpose());
    const Eigen::MatrixXd K = slopes * weights.asDiagonal() * slopes.transpose();
    kinetic = (K + K.transpose()) / 2;
    coefficient = coefficientsOfCardinals(N).middleCols(1, n) * inverse;
}

std::shared_ptr<const Interval> Interval::of(int n) {
    static std::mutex mutex;
    static std::map<int, std::shared_ptr<const Interval>> known;
    const std::lock_guard lock(mutex);
    if (known.size() >= 8 && !known.contains(n)) known.clear();
    auto& interval = known[n];
    if (!interval) interval = std::make_shared<const Interval>(n);
    return interval;
}

void multiply(const Eigen::MatrixXd& A, const std::complex<double>* v, std::complex<double>* out) {
    for (Eigen::Index i = 0; i < A.rows(); ++i) out[i] = 0;
    double* o = reinterpret_cast<double*>(out);
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
        const double re = v[j].real(), im = v[j].imag();
        const double* column = A.data() + j * A.rows();
        for (Eigen::Index i = 0; i < A.rows(); ++i) {
            o[2 * i] += column[i] * re;
            o[2 * i + 1] += column[i] * im;
        }
    }
}

}  // namespace extremal
