// SPDX-License-Identifier: GPL-3.0-or-later
/// The time-independent problem: Mathieu's values by both methods, harmonic levels on an interval, Newton on
/// the KKT system.
#include <QTest>

#include <cmath>
#include <numbers>

#include "engine/core/problem.hpp"
#include "engine/model/wave/basis/convolution.hpp"
#include "engine/model/wave/basis/eigen.hpp"
#include "engine/model/wave/start/packet.hpp"
#include "engine/model/wave/start/stationary.hpp"
#include "tests/tools/test.hpp"

namespace extremal::stationary_test {
namespace {

ConvolutionProblem galerkinOf(const Hamiltonian& h) {
    return convolutionGalerkin(h.fourierBasis(), h.potentialSeries());
}

const wave::Constants units{{"hbar", 1}, {"m", 1}};

Hamiltonian onCircle(int n, const std::string& V, double mass = 1, WaveBasis basis = WaveBasis::fourier) {
    const wave::Grid circle{{0, 2 * std::numbers::pi}, n};
    return {circle, 1, mass, wave::makePotential(Value(V), "/potential", circle, units), basis};
}

/// The largest error among the first eight characteristic values of -psi'' + 2q cos(2x) psi = a psi.
double mathieuError(const Hamiltonian& h, const std::array<double, 8>& a) {
    const Eigenstates states(h);
    double worst = 0;
    for (std::size_t k = 0; k < 8; ++k) worst = std::max(worst, std::abs(states.energies()[k] - a[k]));
    return worst;
}

/// Of the oscillator with psi = 0 at -10 and 10, with polynomials of degree N.
double worstLevel(int N) {
    const wave::Grid interval{{-10, 20}, N - 1};
    const Eigenstates states(Hamiltonian(interval, 1, 1,
                                         wave::makePotential(Value("x^2/2"), "/potential", interval, units),
                                         WaveBasis::dirichlet));
    double worst = 0;
    for (std::size_t k = 0; k < 10; ++k)
        worst = std::max(worst, std::abs(states.energies()[k] - static_cast<double>(k) - 0.5));
    return worst;
}

std::shared_ptr<const Hamiltonian> inThePlane(int n, const std::string& V) {
    const wave::Grid plane{{-6, 12}, n, {-6, 12}, n};
    return std::make_shared<const Hamiltonian>(plane, 1, 1,
                                               wave::makePotential(Value(V), "/potential", plane, units));
}

}  // namespace

class StationaryTest : public QObject {
    Q_OBJECT
private slots:
    void mathieuValues_data() {
        QTest::addColumn<double>("q");
        QTest::addColumn<QList<double>>("a");
        QTest::newRow("0.5") << 0.5
                             << QList<double>{-0.1217655449410827, 0.4706543549338391, 1.466766842516056,
                                              3.979189215751357,   4.100900595560481,  9.013719838920393,
                                              9.017606927797509,   16.00831045970948};
        QTest::newRow("5") << 5.0 << QList<double>{-5.800046020851508, -5.790080598637771, 1.858187541547751,
                                                   2.099460445486665,  7.449109739529178,  9.236327713693701,
                                                   11.5488320363434,   16.64821993716978};
        QTest::newRow("25") << 25.0
                            << QList<double>{-40.25677954656679, -40.25677898468416, -21.31489969066573,
                                             -21.31486062224985, -3.522164727158296, -3.520941526621369,
                                             12.96407944432647,  12.98648995274246};
    }
    void mathieuValues() {
        QFETCH(double, q);
        QFETCH(QList<double>, a);
        std::array<double, 8> expected{};
        std::copy(a.begin(), a.end(), expected.begin());
        // hbar^2/2m = 1: the mass is 1/2. With the mass of 1 it is another equation.
        const std::string V = std::to_string(2 * q) + "*cos(2*x)";
        const double pseudo = mathieuError(onCircle(48, V, 0.5), expected),
                     galerkin = mathieuError(onCircle(48, V, 0.5, WaveBasis::convolution), expected);
        qInfo("pseudo-spectral %.2g, Galerkin %.2g", pseudo, galerkin);
        QVERIFY(pseudo < 1e-12);  // 1e-13 .. 2e-13 measured
        QVERIFY(galerkin < 1e-12);
        QVERIFY(mathieuError(onCircle(48, V, 1), expected) > 0.1);
    }
    void harmonicLevelsOnAnInterval() {
        const double coarse = worstLevel(48), middle = worstLevel(64), fine = worstLevel(96);
        qInfo("N = 48: %.2g, 64: %.2g, 96: %.2g", coarse, middle, fine);
        QVERIFY(fine < 1e-12);
        QVERIFY(coarse > 1e-3 && coarse < 0.2);   // 6.6e-2: an error that is seen
        QVERIFY(middle > 1e-7 && middle < 1e-5);  // 3.3e-6
    }
    void newtonOnTheKktSystemIsQuadratic() {
        const Hamiltonian h = onCircle(64, "50*(1 - cos(x))");
        const Eigenstates states(h);
        const double known[] = {3.50400007, 10.44774851, 17.26108516, 23.9399919};
        for (int k = 0; k < 4; ++k) {
            const double E = states.energies()[static_cast<std::size_t>(k)];
            QVERIFY(std::abs(E - known[k]) < 1e-8);
            std::vector<Complex> guess = states.coefficients(k);
            for (std::size_t j = 0; j < guess.size(); ++j)
                guess[j] += 3e-3 * std::polar(1.0, 1.0 + 3.0 * static_cast<double>(j));
            const StationaryState found = refineState(h, guess);
            QVERIFY(found.isConverged);
            std::vector<double> errors;
            for (const double e : found.history) errors.push_back(std::abs(e - E));
            qInfo("errors %.1e %.1e %.1e %.1e", errors[0], errors[1], errors[2], errors[3]);
            QVERIFY(errors[0] > 1e-3);
            QVERIFY(errors.back() < 2e-12);
            QVERIFY(errors[2] < errors[1] * errors[1] &&
                    errors[3] < 1e-11);  // 1.5e-1, 4.2e-3, 1.2e-6, 5.7e-13
            QVERIFY(std::abs(squaredNorm(found.c.data(), 64) - 1) < 1e-12);
            QVERIFY(found.residual < 1e-10);
        }
    }
    /// Levels of two coupled oscillators 3 (x^2 + y^2 + x y): frequencies 3 and sqrt(3); on 96 x 96 nodes.
    void statesOfFineGridsInThePlane() {
        const double a = 3, b = std::sqrt(3.0);
        std::vector<double> levels;
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j) levels.push_back(a * (i + 0.5) + b * (j + 0.5));
        std::sort(levels.begin(), levels.end());
        const auto h = inThePlane(96, "3*(x^2 + y^2 + x*y)");
        const Eigenstates coarse(*inThePlane(22, "3*(x^2 + y^2 + x*y)"));
        for (const int n : {0, 1, 3, 4}) {
            Value::Object psi{{"packet", "eigenstate"}, {"n", static_cast<double>(n)}};
            const auto c = wave::makePacket(psi, "/psi", true, h, units);
            const double E = h->energy(0, c.data()),
                         error = std::abs(E - levels[static_cast<std::size_t>(n)]);
            const double unrefined = std::abs(coarse.energies()[static_cast<std::size_t>(n)] -
                                              levels[static_cast<std::size_t>(n)]);
            qInfo("E%d = %.10f, error %.2g, of 22 x 22 nodes %.2g", n, E, error, unrefined);
            QVERIFY(unrefined > 10 * error);
            QVERIFY(error < 2e-13);  // 7e-15 measured, of 22 x 22 nodes 1e-3
            std::vector<Complex> image(c.size()), work(c.size());
            h->apply(h->potential().data(), c.data(), image.data(), work.data());
            double residual = 0;
            for (std::size_t i = 0; i < c.size(); ++i) residual += std::norm(image[i] - E * c[i]);
            QVERIFY(std::sqrt(residual) < 1e-7);
        }
        // One that the coarse grid knows nothing of is refused.
        QVERIFY_EXCEPTION_THROWN((void)wave::makePacket(Value::Object{{"packet", "eigenstate"}, {"n", 200.0}},
                                                        "/psi", true, h, units),
                                 InvalidScene);
    }
    void theConvolutionIsHermitianAndAgreesWhereItIsResolved() {
        for (const int n : {16, 24, 32, 64}) {
            const Hamiltonian h = onCircle(n, "20*exp(cos(x))");
            const ConvolutionProblem exact = galerkinOf(h);
            QVERIFY((exact.H - exact.H.adjoint()).norm() < 1e-12);
            QVERIFY(std::abs(exact.W(n / 2) - 0.5) < 1e-15);
            const double difference =
                std::abs(Eigenstates(onCircle(n, "20*exp(cos(x))", 1, WaveBasis::convolution)).energies()[0] -
                         Eigenstates(h).energies()[0]);
            qInfo("N = %d: ground states differ by %.2g", n, difference);
            if (n == 32) QVERIFY(difference < 1e-7);
            if (n == 64) QVERIFY(difference < 1e-12);
            if (n == 16) QVERIFY(difference > 1e-12);  // aliasing is there
        }
        // One of both rows alone, as printed, is not Hermitian.
        const Hamiltonian h = onCircle(16, "50*(1 - cos(x))");
        Eigen::MatrixXcd printed = galerkinOf(h).H;
        printed.row(8) = printed.row(8) / 2;
        printed(8, 7) = 0;
        QVERIFY((printed - printed.adjoint()).norm() > 5);
    }
};

EXTREMAL_TEST(StationaryTest)
}  // namespace extremal::stationary_test

#include "stationary_test.moc"
