// SPDX-License-Identifier: GPL-3.0-or-later
/// Collocation in time for wave functions: Gauss nodes against the factors, potentials that depend on time,
/// Chebyshev nodes.
#include <QTest>

#include "engine/family/wave/wave_collocation.hpp"
#include "tests/laws/waves.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::wave_collocation_test {
namespace {

State run(Integrator& integrator, const State& start, int n) {
    const auto end = after(integrator, start, n);
    return end ? *end : State{};
}

double normError(const System& system, const State& state) {
    return std::abs(std::sqrt(squaredNorm(coefficients(state.x.data()), system.hamiltonian()->size())) - 1);
}

std::unique_ptr<Integrator> chebyshev(const System& system, int degree, const char* nodes, double h) {
    BaselineOptions options;
    options.step = h;
    options.settings = {
        "spectral-collocation", {{"degree", static_cast<double>(degree)}, {"nodes", nodes}}, {}};
    return findBaseline("spectral-collocation")->make(system, options);
}

}  // namespace

class WaveCollocationTest : public QObject {
    Q_OBJECT
private slots:
    void atGaussNodesItIsTheSchemeInFactors() {
        const System system = systemA(64);
        const State start = startA(system);
        for (const int s : {1, 2, 5, 8}) {
            const auto whole =
                makeCollocationWave(system.hamiltonian(), 0.02, 40, gauss<double>(s), 1e-14, 600);
            const auto factors = makeIntegrator(system, wavePair(s, "dense", 40.0), {0, 0.02});
            const double apart = waveDistance(run(*whole, start, 50), run(*factors, start, 50));
            qInfo("degree %d: %.2g", s, apart);
            QVERIFY(apart < 1e-11);
        }
    }
    void ordersWithAPotentialThatDependsOnTime_data() {
        QTest::addColumn<int>("degree");
        for (const int s : {1, 2, 3, 4}) QTest::addRow("degree %d", s) << s;
    }
    void ordersWithAPotentialThatDependsOnTime() {
        QFETCH(int, degree);
        const System system = waveSystem(64, "20*(1 - cos(x - 0.3*sin(4*t)))");
        const State start = waveStart(system, 10, 1.2, 2);
        const auto best = makeIntegrator(system, wavePair(8), {0, 1.0 / 80});
        const State exact = run(*best, start, 80);
        // The same motion by a method of another kind.
        const auto splitting = findBaseline("srkn-11b")->make(system, {1.0 / 600, {}, 0, {}});
        QVERIFY(waveDistance(run(*splitting, start, 600), exact) < 1e-9);
        std::vector<double> h, e;
        double norm = 0;
        for (double n = 8; n < 4000; n = std::ceil(1.3 * n)) {
            const int steps = static_cast<int>(n);
            const auto integrator = makeIntegrator(system, wavePair(degree), {0, 1.0 / steps});
            const State end = run(*integrator, start, steps);
            const double error = waveDistance(end, exact);
            norm = std::max(norm, normError(system, end));
            if (error > 1e-2) continue;
            if (error < (degree == 1 ? 1e-5 : 1e-10)) break;
            h.push_back(-std::log(steps));
            e.push_back(std::log(error));
        }
        const auto points = static_cast<std::ptrdiff_t>(std::min<std::size_t>(4, h.size()));
        QVERIFY(points >= 3);
        for (auto* v : {&h, &e}) v->erase(v->begin(), v->end() - points);
        qInfo("order %.3f, norm %.2g", slope(h, e), norm);
        QVERIFY(std::abs(slope(h, e) - 2 * degree) < 0.3);
        QVERIFY(norm < 1e-11);
        // Frozen at the start of each step, the potential gives order 1.
    }
    void chebyshevNodes() {
        const System system = systemA(128);
        const State start = startA(system);
        State exact = start;
        system.exact(start)(0.25, exact.x);
        for (const int s : {16, 24}) {
            const State roots = run(*chebyshev(system, s, "roots", 0.25), start, 1);
            const State extrema = run(*chebyshev(system, s, "extrema", 0.25), start, 1);
            const double atRoots = waveDistance(roots, exact), atExtrema = waveDistance(extrema, exact);
            qInfo("s = %d: roots %.2g, norm %.2g; extrema %.2g, norm %.2g", s, atRoots,
                  normError(system, roots), atExtrema, normError(system, extrema));
            QVERIFY(normError(system, roots) < 1e-11);
            // Not unitary, by about the square of the error.
            QVERIFY(normError(system, extrema) > 0.05 * atExtrema * atExtrema &&
                    normError(system, extrema) < 10 * atExtrema * atExtrema);
            QVERIFY(atRoots < 3e-2 && atExtrema < 3e-2);
        }
    }
    void slabsAreShorterSteps() {
        const System system = systemA(64);
        const State start = startA(system);
        for (const char* basis : {"legendre", "chebyshev"}) {
            Discretization discretization = wavePair(16);
            discretization.space = {
                "space-time", {{"degree", 16.0}, {"time_basis", basis}, {"slabs", 4.0}}, {}};
            const auto whole = makeIntegrator(system, discretization, {0, 0.25});
            discretization.space = {
                "space-time", {{"degree", 16.0}, {"time_basis", basis}, {"slabs", 1.0}}, {}};
            const auto parts = makeIntegrator(system, discretization, {0, 0.0625});
            const State a = run(*whole, start, 3), b = run(*parts, start, 12);
            QCOMPARE(a.node, 3LL);
            QCOMPARE(a.t, 0.75);
            QVERIFY(waveDistance(a, b) < 1e-12);
            QVERIFY(normError(system, a) < 1e-11);
            // Inside the step it is the same curve.
            State inside = start, there = start;
            whole->denseOutput(0.75, inside.x);
            there = run(*makeIntegrator(system, discretization, {0, 0.0625}), start, 11);
            QVERIFY(waveDistance(inside, there) < 1e-11);
        }
        // Degree 48 in a single slab of a quarter: 6.6e-7 predicted.
        State exact = start;
        system.exact(start)(0.25, exact.x);
        Discretization long_ = wavePair(48);
        long_.space = {"space-time", {{"degree", 48.0}, {"time_basis", "legendre"}, {"slabs", 1.0}}, {}};
        const double error = waveDistance(run(*makeIntegrator(system, long_, {0, 0.25}), start, 1), exact);
        qInfo("degree 48 in one slab: %.2g", error);
        QVERIFY(error > 1e-8 && error < 1e-5);
    }
    void chebyshevNodesHaveTheOrderTheyClaim() {
        const System system = waveSystem(64, "20*(1 - cos(x))");
        const State start = waveStart(system, 10, 1.2, 2);
        State exact = start;
        system.exact(start)(1, exact.x);
        for (const char* nodes : {"extrema", "roots"})
            for (const int s : {1, 2, 3, 4}) {
                const Settings keys{
                    "spectral-collocation", {{"degree", static_cast<double>(s)}, {"nodes", nodes}}, {}};
                const int claimed = claimsOf(*findBaseline("spectral-collocation"), keys).order;
                std::vector<double> h, e;
                for (const int n : {200, 280, 400, 560}) {
                    const double error =
                        waveDistance(run(*chebyshev(system, s, nodes, 1.0 / n), start, n), exact);
                    if (error < 1e-11) break;
                    h.push_back(-std::log(n));
                    e.push_back(std::log(error));
                }
                const double order = h.size() < 2 ? 0 : slope(h, e);
                qInfo("%s, degree %d: claimed %d, measured %.2f", nodes, s, claimed, order);
                QVERIFY(order > claimed - 0.3 && order < claimed + 0.3);
            }
    }
};

EXTREMAL_TEST(WaveCollocationTest)
}  // namespace extremal::laws::wave_collocation_test

#include "wave_collocation_test.moc"
