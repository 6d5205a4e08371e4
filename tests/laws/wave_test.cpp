// SPDX-License-Identifier: GPL-3.0-or-later
/// The one-step schemes of wave functions: orders, what is kept, reference values, and agreement of the three
/// solvers.
#include <QTest>

#include <fstream>
#include <sstream>

#include "engine/family/wave/pade.hpp"
#include "engine/model/wave/basis/eigen.hpp"
#include "engine/model/wave/spectrum.hpp"
#include "tests/laws/allocations.hpp"
#include "tests/laws/waves.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::wave_test {
namespace {

State run(const System& system, const Discretization& discretization, const State& start, double T, int n) {
    const auto integrator = makeIntegrator(system, discretization, {start.t, T / n});
    const auto end = after(*integrator, start, n);
    return end ? *end : State{};
}

struct Norms {
    double norm = 0, energy = 0;  ///< largest changes, the energy's relative
};
/// Over n steps of a map.
template <class Step>
Norms drift(const System& system, State state, int n, Step&& step) {
    Norms worst;
    const int size = system.hamiltonian()->size();
    const double norm = std::sqrt(squaredNorm(coefficients(state.x.data()), size)),
                 E = system.energy(0, state.x.data());
    for (int k = 1; k <= n; ++k) {
        if (!step(state)) return {1, 1};
        worst.norm =
            std::max(worst.norm, std::abs(std::sqrt(squaredNorm(coefficients(state.x.data()), size)) - norm));
        if (k % 64 == 0)
            worst.energy = std::max(worst.energy, std::abs(system.energy(0, state.x.data()) / E - 1));
    }
    return worst;
}

/// Rows of "x re im".
std::vector<std::complex<double>> readReference(const char* name) {
    std::ifstream in(std::string(EXTREMAL_SOURCE_DIR "/tests/data/") + name);
    std::vector<std::complex<double>> psi;
    for (std::string line; std::getline(in, line);) {
        std::istringstream row(line);
        double x = 0, re = 0, im = 0;
        if (row >> x >> re >> im) psi.emplace_back(re, im);
    }
    return psi;
}

}  // namespace

class WaveTest : public QObject {
    Q_OBJECT
private slots:
    void zerosAreTheTabulatedOnes() {
        const auto& two = padeZeros(2);
        QVERIFY(std::abs(two[0] - std::complex<double>(3, 1.73205080756887729)) < 1e-15);
        const auto& eight = padeZeros(8);
        QVERIFY(std::abs(eight[0] - std::complex<double>(11.1757720865261704, 1.73522889070557292)) < 4e-15);
        QVERIFY(std::abs(eight[7] - std::complex<double>(5.67796789779526095, -12.7078225972097536)) < 4e-15);
        QVERIFY(std::abs(padeZeros(64)[0] - std::complex<double>(85.481943292945357, 1.7355178898121834)) <
                4e-14);
        // The turn of every degree is exp(-iy) to order 2s: |R - exp| ~ y^(2s+1).
        for (int s = 1; s <= 16; ++s) {
            const auto error = [s](double y) { return std::abs(padeTurn(s, y) - std::polar(1.0, -y)); };
            double y = 0.01;
            while (error(y) < 1e-12) y *= 1.05;
            const double order = std::log(error(1.3 * y) / error(y)) / std::log(1.3);
            QVERIFY2(std::abs(order - (2 * s + 1)) < 0.1 * (2 * s + 1), qPrintable(QString::number(order)));
        }
    }

    void orderIsTwiceTheDegree_data() {
        QTest::addColumn<int>("degree");
        for (int s = 1; s <= 8; ++s) QTest::addRow("degree %d", s) << s;
    }
    void orderIsTwiceTheDegree() {
        QFETCH(int, degree);
        // Two eigenstates: the energies of a packet reach so high that the last digits come before the order.
        const System system = systemA(64);
        const auto states = Eigenstates::of(system.hamiltonian());
        State start = startA(system);
        for (int i = 0; i < 64; ++i)
            coefficients(start.x.data())[i] = (states->coefficients(0)[static_cast<std::size_t>(i)] +
                                               states->coefficients(1)[static_cast<std::size_t>(i)]) /
                                              std::sqrt(2.0);
        State exact = start;
        system.exact(start)(1, exact.x);
        const auto errorOf = [&](int n) {
            return waveDistance(run(system, wavePair(degree, "auto", 0.0), start, 1, n), exact);
        };
        const double order = timeOrder(errorOf, degree < 3 ? 1e-9 : 1e-12);
        QVERIFY(std::isfinite(order));
        qInfo("order %.3f", order);
        QVERIFY(std::abs(order - 2 * degree) <
                0.06 * degree);  // 2.00, 4.00, .. 13.8, 15.6: round-off is near
    }

    void normAndEnergyStayForAHundredThousandSteps_data() {
        QTest::addColumn<int>("degree");
        for (const int s : {1, 2, 4, 8}) QTest::addRow("degree %d", s) << s;
    }
    void normAndEnergyStayForAHundredThousandSteps() {
        QFETCH(int, degree);
        constexpr int steps = 100000;
        const System system = systemA(64);
        const auto integrator = makeIntegrator(system, wavePair(degree, "banded"), {0, 1.0 / 64});
        const Norms worst = drift(system, startA(system), steps, [&](State& state) {
            return advance(*integrator, state).outcome == Outcome::converged;
        });
        qInfo("norm %.2g, energy %.2g", worst.norm, worst.energy);
        QVERIFY(worst.norm < 2e-16 * degree * steps);
        QVERIFY(worst.energy < 1e-10);
    }
    void aWrongResidueLosesTheNorm() {
        // Teeth: the factor 2 Re(zeta) off by a part in 10^10 shows in a thousand steps.
        const System system = systemA(64);
        const auto states = Eigenstates::of(system.hamiltonian());
        State state = startA(system);
        std::vector<std::complex<double>> turn;
        for (const double E : states->energies()) {
            const std::complex<double> w = 1.0 / std::complex<double>(2, E / 64);
            turn.push_back(4 * (1 + 1e-10) * w - 1.0);
        }
        double norm = 1;
        for (int k = 0; k < 1000; ++k) norm *= std::abs(turn[3]);
        QVERIFY(std::abs(norm - 1) > 1e-8);
    }

    void problemAHasItsReferenceValues() {
        const System system = systemA();
        const State start = startA(system);
        const Hamiltonian& h = *system.hamiltonian();
        std::vector<Complex> work(256);
        QVERIFY(std::abs(system.energy(0, start.x.data()) - 49.5471373850640867) < 2e-13);
        QVERIFY(std::abs(nodeMeans(h, coefficients(start.x.data()), work.data()).cosine -
                         0.357799236432353332) < 2e-15);
        for (const char* solver : {"banded", "dense", "krylov"}) {
            const State end = run(system, wavePair(8, solver), start, 1, 128);
            const auto reference = readReference("schrodinger_N256.txt");
            QCOMPARE(reference.size(), std::size_t{256});
            double worst = 0;
            for (int j = 0; j < 256; ++j)
                worst = std::max(worst,
                                 std::abs(atNode(system, end, j) - reference[static_cast<std::size_t>(j)]));
            const double cosine = nodeMeans(h, coefficients(end.x.data()), work.data()).cosine;
            qInfo("%s: psi %.2g", solver, worst);
            QVERIFY(worst < 1e-12);  // 4e-13 measured: the order is not exhausted at this step
            QVERIFY(std::abs(cosine - 0.473545480388719777) < 1e-13);
            QVERIFY(std::abs(meanMomentum(h, coefficients(end.x.data())).x - 5.336052021846885) < 1e-12);
        }
        // Without the phase of the gauge it is another wave function.
        const State end = run(system, wavePair(8), start, 1, 128);
        const std::complex<double> phase = std::polar(1.0, system.energy(0, start.x.data()));
        QVERIFY(std::abs(atNode(system, end, 0) * phase - readReference("schrodinger_N256.txt")[0]) > 0.1);
    }
    void moreModesGiveTheSameWaveFunction() {
        const System system = systemA(512);
        const State end = run(system, wavePair(8), startA(system), 1, 160);
        const auto reference = readReference("schrodinger_N512.txt");
        QCOMPARE(reference.size(), std::size_t{512});
        double worst = 0;
        for (int j = 0; j < 512; ++j)
            worst =
                std::max(worst, std::abs(atNode(system, end, j) - reference[static_cast<std::size_t>(j)]));
        qInfo("psi %.2g", worst);
        QVERIFY(worst < 1e-12);
    }
    void problemSHasItsReferenceValues() {
        const System system = systemS();
        const State start = startS(system);
        std::vector<Complex> work(512);
        QVERIFY(std::abs(system.energy(0, start.x.data()) - 0.765702344001459086) < 1e-14);
        const State end = run(system, wavePair(8), start, 2, 128);
        const double cosine =
            nodeMeans(*system.hamiltonian(), coefficients(end.x.data()), work.data()).cosine;
        const double momentum = meanMomentum(*system.hamiltonian(), coefficients(end.x.data())).x;
        qInfo("cos x off by %.2g, p by %.2g", cosine - 0.933818313189556394, momentum + 1.18094822084357600);
        QVERIFY(std::abs(cosine - 0.933818313189556394) < 1e-12);
        QVERIFY(std::abs(momentum + 1.18094822084357600) < 1e-12);
        QVERIFY(std::abs(atNode(system, end, 16) - std::complex<double>(0.82760771115210, 0.29547322942032)) <
                1e-11);
        QVERIFY(std::abs(atNode(system, end, 32) -
                         std::complex<double>(-1.85037903288259, 0.82096068952858)) < 1e-11);
    }

    void errorsAreThePredictedOnes() {
        const System system = systemA();
        const State start = startA(system);
        State exact = start;
        system.exact(start)(1, exact.x);
        const auto error = [&](int degree, int n, const Value& shift) {
            return waveDistance(run(system, wavePair(degree, "auto", shift), start, 1, n), exact);
        };
        QVERIFY(std::abs(error(4, 256, 0.0) / 1.57e-8 - 1) < 0.01);  // without a shift
        QVERIFY(std::abs(error(4, 128, 0.0) / 3.7e-6 - 1) < 0.02);
        QVERIFY(std::abs(error(4, 128, "mean") / 5.9e-7 - 1) < 0.02);
        QVERIFY(std::abs(error(4, 128, 70.0) / 2.8e-7 - 1) < 0.02);
        QVERIFY(error(8, 128, 0.0) < 5e-13);
    }

    void theThreeSolversAgree() {
        const System wells = waveSystem(128, "20*exp(cos(x)) - 7*sin(2*x)"),
                     lattice = waveSystem(128, "30*(cos(x) + sin(2*x))");
        for (const int degree : {1, 3, 4}) {
            const State start = startA(lattice);
            const State dense = run(lattice, wavePair(degree, "dense"), start, 1, 50);
            const double banded = waveDistance(run(lattice, wavePair(degree, "banded"), start, 1, 50), dense);
            const double fours = waveDistance(
                run(lattice, wavePair(degree, "banded", "mean", {{"tolerance", 1e-10}}), start, 1, 50),
                dense);
            const double krylov = waveDistance(run(lattice, wavePair(degree, "krylov"), start, 1, 50), dense);
            const double wide = waveDistance(run(wells, wavePair(degree, "krylov"), start, 1, 50),
                                             run(wells, wavePair(degree, "dense"), start, 1, 50));
            qInfo("degree %d: banded %.2g, fours %.2g, krylov %.2g and %.2g", degree, banded, fours, krylov,
                  wide);
            QVERIFY(banded < 2e-12 && fours < 2e-11 && krylov < 2e-12 && wide < 2e-12);
        }
    }
    void iterationsDoNotGrowWithTheModes() {
        for (const int modes : {64, 256, 2048}) {
            const System system = systemA(modes);
            State state = startA(system);
            const auto integrator =
                makeIntegrator(system, wavePair(1, "krylov", 0.0, {{"tolerance", 1e-12}}), {0, 1.0 / 64});
            int iterations = 0;
            for (int k = 0; k < 64; ++k) iterations += advance(*integrator, state).cost.iterations;
            qInfo("N = %d: %.1f iterations per step", modes, iterations / 64.0);
            QVERIFY(iterations <= 18 * 64);  // 15.5 measured at every N
        }
    }

    void fromEightModesToManyAndFromOneToTenThousandth() {
        for (const int modes : {8, 16, 1024, 65536}) {
            const System system = waveSystem(modes, "1 - cos(x)");
            const State start = waveStart(system, 2, 1, 0);
            const auto integrator = makeIntegrator(system, wavePair(4), {0, 0.01});
            const Norms worst = drift(system, start, 20, [&](State& s) {
                return advance(*integrator, s).outcome == Outcome::converged;
            });
            QVERIFY(worst.norm < 1e-13);
        }
        for (const double hbar : {1.0, 1e-2, 1e-4}) {
            const System system = waveSystem(4096, "1 - cos(x)", hbar);
            const State start = waveStart(system, 0.5 / hbar, 1.2, std::round(0.2 / hbar));
            const Discretization discretization = wavePair(8);
            const State end = run(system, discretization, start, 0.1, 200),
                        fine = run(system, discretization, start, 0.1, 400);
            qInfo("hbar %.0e: %.2g", hbar, waveDistance(end, fine));
            QVERIFY(waveDistance(end, fine) < 1e-9);
            QVERIFY(system.caution(end.x.data()).empty());
        }
        // A wave function that needs more modes than there are is called so.
        const System coarse = waveSystem(64, "1 - cos(x)", 0.01);
        QVERIFY(!coarse.caution(waveStart(coarse, 50, 1.2, 30).x.data()).empty());
    }

    void betweenTheNodesItIsAsGood() {
        const System system = systemA(64);
        State state = startA(system), exact = state, middle = state;
        const auto solution = system.exact(state);
        const auto integrator = makeIntegrator(system, wavePair(8), {0, 0.01});
        for (int k = 0; k < 5; ++k) (void)advance(*integrator, state);
        integrator->denseOutput(0.3, middle.x);
        solution(0.043, exact.x);
        QVERIFY(waveDistance(middle, exact) < 1e-10);
    }
    void aStepAllocatesNothing() {
        const System system = systemA(128);
        for (const char* solver : {"banded", "dense", "krylov"}) {
            const auto integrator = makeIntegrator(system, wavePair(4, solver), {0, 0.01});
            State state = startA(system);
            for (int k = 0; k < 3; ++k) (void)advance(*integrator, state);
            const long long before = allocations;
            for (int k = 0; k < 20; ++k) (void)advance(*integrator, state);
            QVERIFY2(allocations == before, solver);
        }
    }
};

EXTREMAL_TEST(WaveTest)
}  // namespace extremal::laws::wave_test

#include "wave_test.moc"
