// SPDX-License-Identifier: GPL-3.0-or-later
/// Rigid bodies at the extremes: near the separatrix, moments of inertia ten powers of ten apart, a million
/// radians a second, steps far too long. The answer is right or the outcome says that there is none; energy
/// does not tell which.
#include <QTest>

#include <algorithm>

#include "tests/laws/bodies.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::hard_bodies_test {
namespace {

/// Errors at the end of a run; `hasFailed` where the run ended in an outcome.
struct Run {
    double attitude = 0, momentum = 0, energy = 0;
    Outcome outcome = Outcome::converged;
};
Run runOf(const System& system, const Three& Pi, const Discretization& discretization, double T, int n) {
    Run r;
    const State start = bodyState(Pi);
    const EnergyFunction energy = energyOf(system);
    const auto integrator = makeIntegrator(system, discretization, {0, T / n});
    State s = start;
    for (int k = 0; k < n; ++k) {
        r.outcome = advance(*integrator, s).outcome;
        if (r.outcome != Outcome::converged) return r;
        r.energy = std::max(r.energy, std::abs(energy(0, s.x.data()) / energy(0, start.x.data()) - 1));
    }
    // Where the closed form loses digits there is none: degree 8 at a tenth of the step then.
    std::vector<double> x(10);
    if (const ExactSolution exact = system.exact(start))
        exact(s.t, x);
    else
        x = after(*makeIntegrator(system, liePair(8), {0, T / (10.0 * n)}), start, 10LL * n).value().x;
    r.attitude = attitudeError(s.x, {x[0], x[1], x[2], x[3]});
    r.momentum = momentumError(s.x, {x[4], x[5], x[6]}) / std::hypot(Pi[0], Pi[1], Pi[2]);
    return r;
}
Three momentumOf(const Three& inertia, const Three& rate) {
    return {inertia[0] * rate[0], inertia[1] * rate[1], inertia[2] * rate[2]};
}

}  // namespace

class HardBodiesTest : public QObject {
    Q_OBJECT
private slots:
    void nearTheSeparatrixTheFlipComesInTime() {
        for (const int degree : {3, 4}) {
            const double early = errorsOf(separatrix(), 1, liePair(degree), 200).attitude;
            const double late = errorsOf(separatrix(), 2, liePair(degree), 400).attitude;
            qInfo("degree %d: %.1e at t = 50, after one flip; %.1e at t = 100", degree, early, late);
            QVERIFY(early <= (degree == 4 ? 1e-13 : 2e-10));
            QVERIFY(late <= 1e-9);  // the last bit of the start moves the end by 1e-10
        }
        // The law can fail: the scheme of order 2 is late.
        QVERIFY(errorsOf(separatrix(), 1, liePair(1), 200).attitude > 1e-3);
    }

    void momentsTenPowersApart_data() {
        QTest::addColumn<double>("first");
        QTest::addColumn<double>("second");
        QTest::addColumn<double>("third");
        const auto add = [](const char* name, double a, double b, double c) {
            QTest::addRow("%s", name) << a << b << c;
        };
        add("rod 1e-4", 1e-4, 1, 1);
        add("rod 1e-8", 1e-8, 1, 1);
        add("rod 1e-10", 1e-10, 1, 1);
        add("rod 1e-4 that is not round", 1e-4, 1, 1 + 1e-4);
        add("rod along the last axis", 1, 1, 1e-10);
        add("symmetric but for 1e-10", 1, 1 + 1e-10, 2);
    }
    void momentsTenPowersApart() {
        QFETCH(double, first);
        QFETCH(double, second);
        QFETCH(double, third);
        const Three inertia{first, second, third}, rate{0.5, 0.3, 0.8};
        const System system = freeBody(inertia);
        const Three Pi = momentumOf(inertia, rate);
        const double ratio = std::max({first, second, third}) / std::min({first, second, third});
        for (const int degree : {3, 4, 8}) {
            const Run r = runOf(system, Pi, liePair(degree), 10, 400);
            qInfo("degree %d: %s, attitude %.1e, momentum %.1e, energy %.1e", degree,
                  std::string(name(r.outcome)).c_str(), r.attitude, r.momentum, r.energy);
            QVERIFY(r.outcome == Outcome::converged);
            // The momentum of the light axis is a small difference: the last bits of the others are 1 / ratio
            // of it.
            QVERIFY(r.attitude < (degree == 3 ? 1e-9 : 1e-11) + 100 * ratio * 2.2e-16);
        }
    }

    void bodiesThatSpinThemselvesUpEndInOutcomes() {
        // Not round, these turn at 1e6 rad/s and more before the first step is over: there is no answer at
        // this step.
        for (const Three& inertia : {Three{1e-10, 1, 1.1}, Three{1, 1, 1e10}, Three{1e-10, 1e-5, 1}})
            for (const int degree : {1, 2, 3, 4, 8}) {
                const Run r =
                    runOf(freeBody(inertia), momentumOf(inertia, {0.5, 0.3, 0.8}), liePair(degree), 10, 400);
                qInfo("%g, %g, %g, degree %d: %s", inertia[0], inertia[1], inertia[2], degree,
                      std::string(name(r.outcome)).c_str());
                QVERIFY(r.outcome != Outcome::converged);
            }
        // At steps that follow the spin there is: 1e-6, 1, 1.1 reaches 1e4 rad/s.
        const Three inertia{1e-6, 1, 1.1};
        const Run r = runOf(freeBody(inertia), momentumOf(inertia, {0.5, 0.3, 0.8}), liePair(4), 0.2, 4000);
        qInfo("1e-6, 1, 1.1 at short steps: %s, attitude %.1e", std::string(name(r.outcome)).c_str(),
              r.attitude);
        QVERIFY(r.outcome == Outcome::converged);
        QVERIFY(r.attitude < 1e-6);
    }

    void aMillionRadiansASecond_data() {
        QTest::addColumn<double>("first");
        QTest::addColumn<double>("rate");
        QTest::addRow("about the first axis of 1, 2, 3") << 1.0 << 1e6;
        QTest::addRow("of a thin rod about itself") << 1e-4 << 1e6;
        QTest::addRow("of a thin rod about itself, the other way") << 1e-4 << -1e6;
    }
    void aMillionRadiansASecond() {
        QFETCH(double, first);
        QFETCH(double, rate);
        const Three inertia{first, 2, 3};
        const System system = freeBody(inertia);
        const Three Pi = momentumOf(inertia, {rate, 0.3, 0.8});
        for (const int degree : {1, 2, 3, 4}) {
            const Run r = runOf(system, Pi, liePair(degree), 1e-3, 2000);
            qInfo("degree %d: %s, attitude %.1e, energy %.1e", degree, std::string(name(r.outcome)).c_str(),
                  r.attitude, r.energy);
            QVERIFY(r.outcome == Outcome::converged);
            if (degree >= 3) QVERIFY(r.attitude < 1e-6);
        }
        // Steps that turn it by 5 to a million radians: an outcome, never a number.
        for (const int degree : {1, 2, 3, 4, 8})
            for (const double h : {8e-6, 1e-4, 1e-2, 1.0}) {
                const Run r = runOf(system, Pi, liePair(degree), 4 * h, 4);
                QVERIFY2(r.outcome != Outcome::converged,
                         qPrintable(QString("degree %1, h = %2").arg(degree).arg(h)));
            }
    }

    void energySaysNothingAboutTheAttitudeOfAThinRod() {
        // The preset's body and step: energy to round-off at every degree, attitude wrong by radians at
        // degree 1.
        const System system = thinRod().system();
        const Run one = runOf(system, thinRod().start, liePair(1), 10, 100);
        const Run three = runOf(system, thinRod().start, liePair(3), 10, 100);
        const Run four = runOf(system, thinRod().start, liePair(4), 10, 100);
        qInfo("energy %.1e, %.1e, %.1e; attitude %.1e, %.1e, %.1e", one.energy, three.energy, four.energy,
              one.attitude, three.attitude, four.attitude);
        QVERIFY(std::max({one.energy, three.energy, four.energy}) < 1e-13);
        QVERIFY(one.attitude > 0.5);
        QVERIFY(three.attitude < 1e-5);
        QVERIFY(four.attitude < 1e-8);
        // For a body of even moments the energy of degree 1 does tell.
        const Run even = runOf(standard().system(), standard().start, liePair(1), 10, 100);
        QVERIFY(even.energy > 1e-6);
    }
    void errorsOfThinRodsGrowWithTheRatioOfTheirMoments() {
        // Times 10 from each ratio to the next with degree 1; not with Moser-Veselov.
        double last = 0;
        for (const double e : {1e-1, 1e-2, 1e-3, 1e-4}) {
            const System system = freeBody({e, 1, 1});
            const Three Pi{e * std::cos(1.1), 0, std::sin(1.1)};
            const Run lie = runOf(system, Pi, liePair(1), 1, 50);
            const auto dmv = findBaseline("moser-veselov")
                                 ->make(system, {0.02, {}, 0, {"moser-veselov", {{"order", 2.0}}, {}}});
            State start = bodyState(Pi);
            std::vector<double> x(10);
            system.exact(start)(1, x);
            const double other = attitudeError(after(*dmv, start, 50)->x, {x[0], x[1], x[2], x[3]});
            qInfo("I_1 = %g: degree 1 %.1e, Moser-Veselov %.1e", e, lie.attitude, other);
            if (last > 0) QVERIFY(lie.attitude > 5 * last);
            QVERIFY(other < 1e-4);
            last = lie.attitude;
        }
    }
};

EXTREMAL_TEST(HardBodiesTest)
}  // namespace extremal::laws::hard_bodies_test

#include "hard_bodies_test.moc"
