// SPDX-License-Identifier: GPL-3.0-or-later
/// A discrete Lagrangian that is not invariant under rotations becomes so when it is averaged over the group:
/// the mean is
///     Lbar_d(g_0, g_1) = int_G L_d(g g_0, g g_1) dg,   int_G dg = 1
/// (Leok 2004, sec. 3.1, remark; the mean is invariant, not equivariant, and has to be divided by the volume
/// of the group).
#include <QTest>

#include <Eigen/LU>

#include <numbers>
#include <random>
#include <vector>

#include "engine/group/so3.hpp"
#include "engine/quadrature/rule.hpp"
#include "tests/tools/test.hpp"

namespace extremal::averaging_test {
namespace {

using Matrix = so3::Matrix<double>;
using Vector = so3::Vector<double>;

/// The rotation nearest to X: its orthogonal polar factor, by Newton's iteration.
Matrix nearestRotation(Matrix X) {
    for (int i = 0; i < 12; ++i) X = (X + X.inverse().transpose()) / 2;
    return X;
}

/// The action of a body at its mean rates over the two halves of a curve from g_0 to g_1. The curve is the
/// straight line between the matrices, brought to the group with a metric that prefers some axes of space:
/// smooth on all of SO(3), and not invariant.
double discreteLagrangian(const Matrix& g0, const Matrix& g1) {
    constexpr double h = 0.5;
    const Vector metric(1, 1.8, 0.6), inertia(1, 2, 3);
    const auto at = [&](double t) {
        return nearestRotation(metric.asDiagonal() * Matrix((1 - t) * g0 + t * g1));
    };
    const auto kinetic = [&](const Matrix& a, const Matrix& b) {
        const Vector rate = so3::log(Matrix(a.transpose() * b)) / (h / 2);
        return 0.5 * rate.dot(inertia.cwiseProduct(rate));
    };
    return h / 2 * (kinetic(g0, at(0.5)) + kinetic(at(0.5), g1));
}

/// The mean over SO(3) by a product rule in Euler angles: equidistant in the two angles about z, Gauss in the
/// cosine of the one about y; exact for harmonics below n.
double averaged(int n, const Matrix& g0, const Matrix& g1) {
    const Rule<double> rule = gauss<double>((n + 1) / 2);
    const auto turn = [](int axis, double angle) {
        return so3::Exponential<double, 0>(Vector::Unit(axis) * angle).rotation();
    };
    double sum = 0;
    for (std::size_t b = 0; b < rule.c.size(); ++b)
        for (int a = 0; a < n; ++a)
            for (int c = 0; c < n; ++c) {
                const double step = 2 * std::numbers::pi / n;
                const Matrix g =
                    turn(2, a * step) * turn(1, std::acos(2 * rule.c[b] - 1)) * turn(2, c * step);
                sum += rule.b[b] / (n * n) * discreteLagrangian(g * g0, g * g1);
            }
    return sum;
}

}  // namespace

class AveragingTest : public QObject {
    Q_OBJECT
private slots:
    void theMeanOverTheGroupIsInvariant() {
        std::mt19937 random(11);
        std::normal_distribution<double> normal;
        const auto rotation = [&](double size) {
            return so3::Exponential<double, 0>(
                       Vector(normal(random), normal(random), normal(random)).normalized() * size)
                .rotation();
        };
        const Matrix g0 = rotation(1), g1 = g0 * rotation(0.6);
        double before = 0, coarse = 0, after = 0;
        const double plain = discreteLagrangian(g0, g1), few = averaged(4, g0, g1),
                     many = averaged(24, g0, g1);
        for (int k = 0; k < 3; ++k) {
            const Matrix g = rotation(0.5 + k);
            before = std::max(before, std::abs(discreteLagrangian(g * g0, g * g1) / plain - 1));
            coarse = std::max(coarse, std::abs(averaged(4, g * g0, g * g1) / few - 1));
            after = std::max(after, std::abs(averaged(24, g * g0, g * g1) / many - 1));
        }
        qInfo(
            "relative defect of invariance: before %.1e, mean by 4 x 2 x 4 points %.1e, by 24 x 12 x 24 "
            "points %.1e",
            before, coarse, after);
        QVERIFY(before > 1e-3);
        QVERIFY(coarse > 1e-9);  // too few points: the law can fail
        QVERIFY(after < 1e-10);
    }
};

EXTREMAL_TEST(AveragingTest)
}  // namespace extremal::averaging_test

#include "averaging_test.moc"
