// SPDX-License-Identifier: GPL-3.0-or-later
/// Wave functions with a Dirichlet boundary: the box by its sines, harmonic levels, revival, norm, reversal,
/// what is refused, and the squared differentiation matrix that loses the norm.
#include <QTest>

#include <numbers>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/family/wave/wave.hpp"
#include "engine/model/wave/basis/eigen.hpp"
#include "engine/model/wave/basis/interval.hpp"
#include "engine/model/wave/spectrum.hpp"
#include "tests/laws/waves.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::wave_interval_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double left = -1, length = pi, hbar = 0.8, mass = 1.3;

System between(int modes, const Value& potential = "free") {
    return systemNamed("schrodinger", {{"modes", static_cast<double>(modes)},
                                       {"potential", potential},
                                       {"hbar", hbar},
                                       {"m", mass},
                                       {"domain", Value::Array{left, left + length}},
                                       {"boundary", "dirichlet"}});
}

double levelOfBox(int n) { return hbar * hbar * pi * pi * n * n / (2 * mass * length * length); }

/// Six sines with phases of their own, and their exact motion.
Complex boxWave(double x, double t) {
    Complex sum = 0;
    double norm = 0;
    for (int n = 1; n <= 6; ++n) {
        const double weight = 1.0 / (1 + std::abs(n - 3));
        norm += weight * weight;
        sum += weight * std::polar(1.0, 0.7 * n - levelOfBox(n) * t / hbar) *
               std::sin(n * pi * (x - left) / length);
    }
    return sum * std::sqrt(2 / length / norm);
}

State boxState(const System& system, double t) {
    const Hamiltonian& h = *system.hamiltonian();
    std::vector<Complex> psi, c(h.x().size());
    for (const double x : h.x()) psi.push_back(boxWave(x, t));
    h.toCoefficients(psi.data(), c.data());
    const double* numbers = reinterpret_cast<const double*>(c.data());
    return {t, 0, {numbers, numbers + 2 * c.size()}};
}

double normOf(const System& system, const State& state) {
    return std::sqrt(squaredNorm(coefficients(state.x.data()), system.hamiltonian()->size()));
}

State run(const System& system, int degree, const State& start, double T, int n) {
    const auto integrator = makeIntegrator(system, wavePair(degree), {start.t, T / n});
    const auto end = after(*integrator, start, n);
    return end ? *end : State{};
}

/// Largest difference from the sines at the nodes.
double errorAtNodes(const System& system, const State& state, double t) {
    double worst = 0;
    for (int j = 0; j < system.hamiltonian()->size(); ++j)
        worst = std::max(worst, std::abs(atNode(system, state, j) -
                                         boxWave(system.hamiltonian()->x()[static_cast<std::size_t>(j)], t)));
    return worst;
}

template <class F>
std::string refusal(F&& f) {
    try {
        f();
    } catch (const InvalidScene& e) {
        return e.problems()[0].pointer + ": " + e.problems()[0].message + " (" + e.problems()[0].hint + ")";
    }
    return {};
}

}  // namespace

class WaveIntervalTest : public QObject {
    Q_OBJECT
private slots:
    void theBasisIsOrthonormalAndHoldsPolynomials() {
        const Interval& I = *Interval::of(20);
        const Eigen::MatrixXd one = I.values * I.weights.asDiagonal() * I.values.transpose();
        QVERIFY((one - Eigen::MatrixXd::Identity(20, 20)).cwiseAbs().maxCoeff() < 1e-13);
        // (1 - y^2) y^3 has the integral of its square 2 (1/7 - 2/9 + 1/11), and its derivative 3y^2 - 5y^4.
        const Eigen::VectorXd u = ((1 - I.nodes.array().square()) * I.nodes.array().cube()).matrix();
        const Eigen::VectorXd c = I.factor * u, slope = I.slopes.transpose() * c;
        QVERIFY(std::abs(c.squaredNorm() - 2 * (1.0 / 7 - 2.0 / 9 + 1.0 / 11)) < 1e-15);
        const Eigen::ArrayXd y = I.points.array();
        QVERIFY((slope.array() - 3 * y.square() + 5 * y.square().square()).abs().maxCoeff() < 1e-12);
        // y^3 - y^5 = T_1/8 - T_3/16 - T_5/16.
        const Eigen::VectorXd a = I.coefficient * c;
        QVERIFY(std::abs(a(1) - 1.0 / 8) < 1e-14 && std::abs(a(3) + 1.0 / 16) < 1e-14 &&
                std::abs(a(5) + 1.0 / 16) < 1e-14);
        QVERIFY(std::abs(a(0)) < 1e-14 && a.tail(15).cwiseAbs().maxCoeff() < 1e-14);
    }

    void levelsOfTheBoxAndOfTheOscillator() {
        const auto box = Eigenstates::of(between(48).hamiltonian());
        for (int n = 1; n <= 12; ++n) {
            const double off = box->energies()[static_cast<std::size_t>(n - 1)] / levelOfBox(n) - 1;
            QVERIFY2(std::abs(off) < 1e-11, qPrintable(QString("level %1 off by %2").arg(n).arg(off)));
        }
        double before = 1;
        for (const int modes : {47, 63, 95}) {
            const System system = systemNamed("schrodinger", {{"modes", static_cast<double>(modes)},
                                                              {"potential", "harmonic"},
                                                              {"domain", Value::Array{-10.0, 10.0}},
                                                              {"boundary", "dirichlet"}});
            double worst = 0;
            for (int n = 0; n < 10; ++n)
                worst = std::max(
                    worst,
                    std::abs(Eigenstates::of(system.hamiltonian())->energies()[static_cast<std::size_t>(n)] -
                             n - 0.5));
            qInfo("%d modes: %.2g", modes, worst);
            QVERIFY(worst < before);
            before = worst / 100;
        }
        QVERIFY(before < 1e-14);  // 6.6e-2, 3.3e-6, 1.6e-14 measured
    }

    void errorFallsSpectrallyInSpace() {
        double before = 1;
        for (const int modes : {10, 14, 18, 22, 26}) {
            const System system = between(modes);
            const State start = boxState(system, 0);
            const double error = errorAtNodes(system, run(system, 8, start, 1, 40), 1);
            qInfo("%d modes: %.2g", modes, error);
            QVERIFY(error < before);
            before = error / (modes < 26 ? 8 : 1);
        }
        QVERIFY(before < 1e-11);  // 6.6e-13 measured
    }

    void orderInTimeIsTwiceTheDegree_data() {
        QTest::addColumn<int>("degree");
        for (const int s : {1, 2, 3, 4, 6}) QTest::addRow("degree %d", s) << s;
    }
    void orderInTimeIsTwiceTheDegree() {
        QFETCH(int, degree);
        const System system = between(32);
        const State start = boxState(system, 0);
        const auto errorOf = [&](int n) { return errorAtNodes(system, run(system, degree, start, 1, n), 1); };
        const double order = timeOrder(errorOf, degree < 2 ? 1e-7 : 1e-10);
        QVERIFY(std::isfinite(order));
        qInfo("order %.3f", order);
        QVERIFY(std::abs(order - 2 * degree) < 0.06 * degree);  // 2.00, 4.00, 6.00, 7.97, 11.67
    }

    void everyDegreeAgreesWithTheSines() {
        const System system = between(32);
        const State start = boxState(system, 0);
        for (int s = 5; s <= 16; ++s) {
            const double error = errorAtNodes(system, run(system, s, start, 1, 40), 1);
            QVERIFY2(error < 1e-11, qPrintable(QString("degree %1: %2").arg(s).arg(error)));
        }
    }

    void theBoxComesBack() {
        const System system = between(40);
        const State start = boxState(system, 0);
        const double T = 4 * mass * length * length / (pi * hbar);
        const State end = run(system, 16, start, T, 200), half = run(system, 16, start, T / 2, 100);
        const double back = waveDistance(end, start);
        // At half the time the mirror image, with the other sign.
        double mirrored = 0;
        for (int j = 0; j < 40; ++j)
            mirrored = std::max(mirrored, std::abs(atNode(system, half, j) + atNode(system, start, 39 - j)));
        qInfo("back by %.2g, mirrored by %.2g", back, mirrored);
        QVERIFY(back < 1e-10 && mirrored < 1e-10);  // 8e-13 and 4e-13 measured
        // Teeth: a hundredth of the time later it is another wave function.
        QVERIFY(waveDistance(run(system, 16, start, 1.01 * T, 200), start) > 0.1);
    }

    void normStaysAndTimeRunsBack() {
        const System system = between(64, "3*x^2 - x");
        const State start = boxState(system, 0);
        QVERIFY(std::abs(normOf(system, start) - 1) < 1e-14);
        for (const int s : {1, 2, 8, 16}) {
            const auto there = makeIntegrator(system, wavePair(s), {0, 0.05});
            State state = start;
            double worst = 0;
            for (int k = 0; k < 2000; ++k) {
                QVERIFY(advance(*there, state).outcome == Outcome::converged);
                worst = std::max(worst, std::abs(normOf(system, state) - normOf(system, start)));
            }
            const double energy =
                std::abs(system.energy(0, state.x.data()) / system.energy(0, start.x.data()) - 1);
            const auto back = makeIntegrator(system, wavePair(s), {state.t, -0.05});
            state.node = 0;
            const auto again = after(*back, state, 2000);
            QVERIFY(again.has_value());
            qInfo("degree %d: norm %.2g, energy %.2g, there and back %.2g", s, worst, energy,
                  waveDistance(*again, start));
            // 6e-14, 8e-14 and 2e-12 measured.
            QVERIFY(worst < 5e-13 && energy < 1e-12 && waveDistance(*again, start) < 2e-11);
        }
    }
    void collocationInSpaceLosesTheNorm() {
        // Teeth: the midpoint rule with -D^2/2 at the nodes, from the same sines, judged by the same mass
        // matrix.
        constexpr int n = 32;
        const System system = between(n);
        const Interval& I = system.hamiltonian()->interval();
        const Eigen::MatrixXd D = chebyshev::differentiation(chebyshev::extrema(n + 1)) * (2 / length);
        const Eigen::MatrixXd H = -hbar * hbar / (2 * mass) * (D * D).block(1, 1, n, n);
        const Eigen::MatrixXcd forward = Eigen::MatrixXcd::Identity(n, n) + Complex(0, 0.025 / hbar) * H;
        const Eigen::MatrixXcd map = dense::solve<Complex>(forward, forward.conjugate());
        // A narrow packet near a wall: there the two operators differ most.
        Eigen::VectorXcd u(n);
        for (int j = 0; j < n; ++j)
            u(j) = std::exp(-40 * std::pow(I.nodes(j) + 0.8, 2)) * std::polar(1.0, 30 * I.nodes(j));
        u /= (I.factor * u).norm();
        double worst = 0;
        Eigen::VectorXcd c = I.factor * u;
        State state{0, 0, {reinterpret_cast<double*>(c.data()), reinterpret_cast<double*>(c.data()) + 2 * n}};
        const auto own = makeIntegrator(system, wavePair(1), {0, 0.05});
        for (int k = 0; k < 200; ++k) {
            u = map * u;
            worst = std::max(worst, std::abs((I.factor * u).norm() - 1));
            QVERIFY(advance(*own, state).outcome == Outcome::converged);
        }
        qInfo("norm off by %.2g, by our form %.2g", worst, normOf(system, state) - 1);
        QVERIFY(worst > 0.01 && std::abs(normOf(system, state) - 1) < 1e-13);
    }

    void meanValuesFollowEhrenfest() {
        // d<x>/dt = <p>/m, by differences of the exact motion; the ends push, so <p> is not kept.
        const System system = between(48);
        const State start = boxState(system, 0);
        const auto exact = system.exact(start);
        std::vector<Complex> work(48), slope(48);
        const auto position = [&](double t) {
            State s = start;
            exact(t, s.x);
            return nodeMeans(*system.hamiltonian(), coefficients(s.x.data()), work.data()).x;
        };
        const double d = 1e-3;
        State now = start;
        exact(0.4, now.x);
        const double velocity =
            (8 * (position(0.4 + d) - position(0.4 - d)) - (position(0.4 + 2 * d) - position(0.4 - 2 * d))) /
            (12 * d);
        const double momentum = meanMomentum(*system.hamiltonian(), coefficients(now.x.data())).x;
        qInfo("m d<x>/dt = %.12g, <p> = %.12g", mass * velocity, momentum);
        QVERIFY(std::abs(mass * velocity - momentum) < 1e-9);  // 4e-11 measured, the differences' own
        QVERIFY(std::abs(momentum - meanMomentum(*system.hamiltonian(), coefficients(start.x.data())).x) >
                0.01);
        // Current and position by the sines: Im(conj psi psi_x) by differences, <x> by a fine midpoint rule.
        const double middle = left + length / 2, e = 1e-3;
        const Complex derivative = (8.0 * (boxWave(middle + e, 0.4) - boxWave(middle - e, 0.4)) -
                                    (boxWave(middle + 2 * e, 0.4) - boxWave(middle - 2 * e, 0.4))) /
                                   (12 * e);
        const double current = hbar / mass * (std::conj(boxWave(middle, 0.4)) * derivative).imag();
        QVERIFY(std::abs(currentInTheMiddle(*system.hamiltonian(), coefficients(now.x.data()), work.data(),
                                            slope.data()) -
                         current) < 1e-9);
        double mean = 0;
        for (int k = 0; k < 1000; ++k) {
            const double x = left + length * (k + 0.5) / 1000;
            mean += length / 1000 * x * std::norm(boxWave(x, 0.4));
        }
        QVERIFY(std::abs(position(0.4) - mean) < 1e-5);
    }

    void picturesBetweenTheNodesAreTheWaveFunction() {
        const System system = between(30);
        const State start = boxState(system, 0);
        std::vector<double> values(60);
        system.field.sample(start.x.data(), values.data());
        const EvenSamples even = evenSamples(*system.hamiltonian(), values.data(), 256);
        double worst = 0;
        for (std::size_t j = 0; j < even.x.size(); ++j)
            worst = std::max(worst, std::abs(Complex(even.re[j], even.im[j]) - boxWave(even.x[j], 0)));
        qInfo("between the nodes %.2g", worst);
        QCOMPARE(even.x.size(), std::size_t{258});
        QVERIFY(worst < 1e-13);
        // The coefficients of the view `spectrum` sum up to it.
        double sum = 0;
        for (int k = 0; k <= 31; ++k)
            sum += chebyshevCoefficient(*system.hamiltonian(), coefficients(start.x.data()), k).real() *
                   std::cos(k * std::acos(0.3));
        QVERIFY(std::abs(sum - boxWave(left + 0.65 * length, 0).real()) < 1e-12);
        // A packet on the interval is one packet, not the sum of its copies on a circle.
        Settings given;
        given.keys.emplace_back(
            "psi", Value::Object{{"packet", "gaussian"}, {"centre", left + 0.2}, {"width", 0.4}});
        given.keys.emplace_back("normalise", true);
        const State packet{0, 0, system.start(given, 0)};
        QVERIFY(std::abs(atNode(system, packet, 29)) < 1e-3 && !system.caution(packet.x.data()).empty());
    }

    void otherRoutesAgree() {
        const System system = between(32, "4*sin(x)");
        const State start = boxState(system, 0);
        State exact = start;
        system.exact(start)(0.5, exact.x);
        // The series in H knows nothing of eigenstates.
        for (const char* id : {"chebyshev-propagation", "crank-nicolson"}) {
            const BaselineEntry* entry = findBaseline(id);
            const auto integrator = entry->make(system, {0.0005, {}, 0, defaultsOf(entry->item)});
            const auto end = after(*integrator, start, 1000);
            QVERIFY(end.has_value());
            qInfo("%s: %.2g", id, waveDistance(*end, exact));
            QVERIFY(waveDistance(*end, exact) < (id[1] == 'h' ? 1e-10 : 1e-4));
        }
        QVERIFY(spectrumTail(*system.hamiltonian(), coefficients(start.x.data())) < 1e-7);
        QVERIFY(system.caution(start.x.data()).empty());
        QVERIFY(!between(8).caution(boxState(between(8), 0).x.data()).empty());
    }

    void whatNeedsWavesOnACircleIsRefused() {
        const System system = between(32);
        for (const char* id : {"strang", "srkn-14a", "leapfrog", "spectral-collocation"}) {
            const BaselineEntry* entry = findBaseline(id);
            const std::string text = refusal([&] {
                entry->make(system, {0.01, {}, 0, defaultsOf(entry->item)});
            });
            QVERIFY2(text.starts_with("/baseline") && text.find("dirichlet") != std::string::npos,
                     text.c_str());
        }
        for (const char* solver : {"banded", "krylov"})
            QVERIFY(refusal([&] {
                        makeIntegrator(system, wavePair(2, solver), {0, 0.01});
                    }).starts_with("/solver/method"));
        Discretization three = wavePair(1);
        three.space.keys[2].second = "three-level";
        three.quadrature = {"exact", {}, {}};
        QVERIFY(refusal([&] { makeWaveIntegrator(system, three, 0.01); }).starts_with("/space/form"));
        QVERIFY(refusal([] { between(513); }).starts_with("/modes"));
        QVERIFY(refusal([] { between(32, "x*sin(t)"); }).starts_with("/potential"));
        QVERIFY(refusal([] { between(32, "1/(x + 1)"); }).starts_with("/potential"));
        for (const char* packet : {"plane-wave", "periodic-gaussian"}) {
            Settings given;
            given.keys.emplace_back("psi", Value::Object{{"packet", packet}});
            given.keys.emplace_back("normalise", true);
            QVERIFY(refusal([&] { system.start(given, 0); }).starts_with("/psi/packet"));
        }
    }
};

EXTREMAL_TEST(WaveIntervalTest)
}  // namespace extremal::laws::wave_interval_test

#include "wave_interval_test.moc"
