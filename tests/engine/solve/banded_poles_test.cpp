// SPDX-License-Identifier: GPL-3.0-or-later
/// Sums over poles by elimination from both ends against dense solves, in every lane width and for several
/// bands.
#include <QTest>

#include <Eigen/LU>

#include <random>

#include "engine/family/wave/pade.hpp"
#include "engine/solve/banded_poles.hpp"
#include "tests/tools/test.hpp"

namespace extremal::banded_poles_test {
namespace {

using Complex = std::complex<double>;

/// Kinetic-like diagonal, which grows towards the corners, or a flat one, where the corners reach everywhere.
CyclicBand makeBand(int n, int band, double growth, std::mt19937& random) {
    std::normal_distribution<double> normal;
    CyclicBand Y;
    for (int i = 0; i < n; ++i) {
        const double a = i < n / 2 ? i : i - n;
        Y.diagonal.push_back(growth * a * a + normal(random));
    }
    for (int m = 0; m < band; ++m) Y.offDiagonal.emplace_back(normal(random), normal(random));
    return Y;
}

Eigen::MatrixXcd denseOf(const CyclicBand& Y) {
    const auto n = static_cast<Eigen::Index>(Y.diagonal.size());
    Eigen::MatrixXcd A = Eigen::MatrixXcd::Zero(n, n);
    for (Eigen::Index a = 0; a < n; ++a) {
        A(a, a) += Y.diagonal[static_cast<std::size_t>(a)];
        for (std::size_t m = 0; m < Y.offDiagonal.size(); ++m) {
            const Eigen::Index b = (a + static_cast<Eigen::Index>(m) + 1) % n;
            A(b, a) += Y.offDiagonal[m];
            A(a, b) += std::conj(Y.offDiagonal[m]);
        }
    }
    return A;
}

}  // namespace

class BandedPolesTest : public QObject {
    Q_OBJECT
private slots:
    void theSumOverPolesIsThatOfDenseSolves() {
        std::mt19937 random(7);
        std::normal_distribution<double> normal;
        double worst = 0;
        for (const int n : {16, 34, 64, 256})
            for (const int band : {1, 2, 3})
                for (const double growth : {0.0, 0.01, 1.0})
                    for (const int together : {1, 2, 4}) {
                        const CyclicBand Y = makeBand(n, band, growth, random);
                        const Eigen::MatrixXcd A = denseOf(Y);
                        QVERIFY((A - A.adjoint()).norm() == 0);
                        for (const PoleGroup& g : padeGroups(4, together)) {
                            Eigen::VectorXcd v(n), sum;
                            for (Complex& x : v) x = {normal(random), normal(random)};
                            sum = g.sign * v;
                            for (std::size_t j = 0; j < g.zeta.size(); ++j) {
                                Eigen::MatrixXcd shifted = Complex(0, 1) * A;
                                shifted.diagonal().array() += g.zeta[j];
                                sum += g.residue[j] * shifted.partialPivLu().solve(v);
                            }
                            BandedPoles(Y, g.zeta, g.residue, g.sign).apply(v.data());
                            worst = std::max(worst, (v - sum).norm() / sum.norm());
                        }
                    }
        qInfo("largest relative difference %.2g", worst);
        QVERIFY(worst < 2e-12);  // 4e-14 measured for pairs, more where the residues of four cancel
    }
    void aForgottenCornerIsSeen() {
        // Teeth: the matrix without the entries that make it cyclic gives another result where the diagonal
        // is flat.
        std::mt19937 random(3);
        const CyclicBand Y = makeBand(32, 1, 0, random);
        Eigen::MatrixXcd A = Complex(0, 1) * denseOf(Y);
        const PoleGroup g = padeGroups(1, 1)[0];
        A.diagonal().array() += g.zeta[0];
        A(0, 31) = A(31, 0) = 0;
        Eigen::VectorXcd v = Eigen::VectorXcd::Ones(32);
        const Eigen::VectorXcd wrong = g.sign * v + g.residue[0] * A.partialPivLu().solve(v);
        BandedPoles(Y, g.zeta, g.residue, g.sign).apply(v.data());
        QVERIFY((v - wrong).norm() > 1e-3);
    }
};

EXTREMAL_TEST(BandedPolesTest)
}  // namespace extremal::banded_poles_test

#include "banded_poles_test.moc"
