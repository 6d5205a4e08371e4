// SPDX-License-Identifier: GPL-3.0-or-later
/// Round-off has no direction: over a million steps the energy of an orbit of order 16 walks at random, and
/// nothing of it is a drift. What is left of bias, in the coefficients, the sums or the iteration that stops
/// too early, adds up step after step and is seen here long before truncation is.
#include <QTest>

#include <cmath>
#include <cstdlib>

#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::random_walk_test {
namespace {

/// Energy against time of eight orbits at H = 0.13, sampled 1000 times.
struct Walk {
    double rms = 0;
    double drift = 0;  ///< what a straight line through each has at the end, rms over the orbits
};
Walk walkOf(double tolerance, int steps) {
    const System system = systemNamed("henon-heiles");
    const auto& m = system.mechanics();
    Discretization discretization = *namedScheme("galerkin-gauss-8");
    if (tolerance > 0) discretization.solver = {"fixed-point", {{"tolerance", tolerance}}, {}};
    constexpr int orbits = 8, samples = 1000;
    Walk walk;
    for (int orbit = 0; orbit < orbits; ++orbit) {
        const double y = 0.05 + 0.03 * orbit;
        State s{0, 0, {0, y, std::sqrt(2 * (0.13 - y * y / 2 + y * y * y / 3)), 0}};
        const auto energy = [&] { return m.energy(m.model.get(), s.t, s.x.data(), s.x.data() + 2); };
        const double start = energy();
        const auto integrator = makeIntegrator(system, discretization, {0, 0.3});
        double squares = 0, slope = 0, spread = 0;
        for (int k = 1; k <= samples; ++k) {
            for (int i = 0; i < steps / samples; ++i)
                if (advance(*integrator, s).outcome != Outcome::converged) return {HUGE_VAL, HUGE_VAL};
            const double dH = energy() - start, t = double(k) / samples;
            squares += dH * dH / samples;
            slope += dH * t;
            spread += t * t;
        }
        walk.rms += squares / orbits;
        walk.drift += slope * slope / (spread * spread) / orbits;
    }
    walk.rms = std::sqrt(walk.rms);
    walk.drift = std::sqrt(walk.drift);
    return walk;
}

}  // namespace

class RandomWalkTest : public QObject {
    Q_OBJECT
private slots:
    void energyWalksAtRandom() {
        const char* longer =
            std::getenv("EXTREMAL_WALK_STEPS");  // measured for 10^7: rms 3.6e-15, drift 5.7e-15
        const int steps = longer ? std::atoi(longer) : 1000000;
        const Walk walk = walkOf(0, steps);
        const QString found = QString("rms %1, drift %2").arg(walk.rms).arg(walk.drift);
        if (longer) qInfo("%s", qPrintable(found));
        // Measured for 10^6: rms 1.1e-15, drift 1.5e-15; more for a walk of other digits.
        const double chance = 4 * std::sqrt(steps / 1e6);
        QVERIFY2(walk.rms < 1.1e-15 * chance && walk.drift < 1.5e-15 * chance, qPrintable(found));
    }
    void anIterationThatStopsEarlyDrifts() {
        const Walk walk = walkOf(1e-12, 100000);  // measured at a tenth of the steps: 3e-12
        QVERIFY2(walk.drift > 1e-13, qPrintable(QString::number(walk.drift)));
    }
};

EXTREMAL_TEST(RandomWalkTest)
}  // namespace extremal::laws::random_walk_test

#include "random_walk_test.moc"
