// SPDX-License-Identifier: GPL-3.0-or-later
/// Baselines on constraints: RATTLE by another route, what is kept, and what drifts.
#include <QTest>

#include <cmath>

#include "engine/baseline/catalog.hpp"
#include "tests/engine/mechanism/mechanisms.hpp"
#include "tests/tools/test.hpp"

namespace extremal::constrained_baselines_test {
namespace {

using mechanism_test::sphericalPendulum;

std::unique_ptr<Integrator> make(const mechanism_test::Mechanical& of, const std::string& id, double step,
                                 double alpha = 20) {
    BaselineOptions options;
    options.step = step;
    options.settings.type = id;
    if (id == "baumgarte") options.settings.keys.emplace_back("alpha", alpha);
    return findBaseline(id)->make(of.system, options);
}

struct Kept {
    Outcome outcome = Outcome::converged;
    State end;
    double value = 0, rate = 0, energy = 0, momentum = 0;  ///< largest |g|, |dg/dt|, |dE|, |dL_z|
};
Kept run(const mechanism_test::Mechanical& of, Integrator& integrator, int steps) {
    Kept kept;
    State& s = kept.end = of.start;
    integrator.begin(s);
    Mechanism mechanism(of.system.parts);
    const auto& L = of.system.mechanics();
    const auto energy = [&] { return L.energy(L.model.get(), s.t, s.x.data(), s.x.data() + L.dimension); };
    const auto momentum = [&] { return L.dimension == 3 ? s.x[0] * s.x[4] - s.x[1] * s.x[3] : 0.0; };
    const double firstEnergy = energy(), firstMomentum = momentum();
    Eigen::VectorXd v(L.dimension);
    for (int i = 0; i < steps; ++i) {
        kept.outcome = advance(integrator, s).outcome;
        if (kept.outcome != Outcome::converged) return kept;
        L.velocity(L.model.get(), s.t, s.x.data(), s.x.data() + L.dimension, v.data());
        kept.value = std::max(kept.value, mechanism.largestValue(s.t, s.x.data()));
        kept.rate = std::max(kept.rate, mechanism.largestRate(s.t, s.x.data(), v.data()));
        kept.energy = std::max(kept.energy, std::abs(energy() - firstEnergy));
        kept.momentum = std::max(kept.momentum, std::abs(momentum() - firstMomentum));
    }
    return kept;
}

class ConstrainedBaselinesTest : public QObject {
    Q_OBJECT
private slots:
    /// Degree 1 with the trapezoid, solved as one system of equations, is RATTLE: measured 6e-14.
    void rattleIsDegreeOneWithTheTrapezoid() {
        for (const auto& of :
             {sphericalPendulum(), mechanism_test::doublePendulum(), mechanism_test::winch()}) {
            const auto rattle = make(of, "rattle", 0.01);
            const Kept kept = run(of, *rattle, 200);
            QCOMPARE(kept.outcome, Outcome::converged);
            const auto other = mechanism_test::run(of, "trapezoidal", 2, 200);
            const auto apart = mechanism_test::distance(kept.end, other.state);
            qInfo("apart by %.1e in q, %.1e in p", apart.q, apart.p);
            QVERIFY(apart.q < 1e-12 && apart.p < 1e-12);
            QVERIFY(kept.value < 1e-14 && kept.rate < 1e-14);
        }
    }

    /// The same places, and momenta that are off.
    void shakeHasThePlacesOfRattle() {
        const auto of = sphericalPendulum();
        const Kept rattle = run(of, *make(of, "rattle", 0.01), 400),
                   shake = run(of, *make(of, "shake", 0.01), 400);
        const auto apart = mechanism_test::distance(rattle.end, shake.end);
        qInfo("apart by %.1e in q, %.1e in p; |dg/dt| %.1e", apart.q, apart.p, shake.rate);
        QVERIFY(apart.q < 1e-11);
        QVERIFY(apart.p > 1e-3 && shake.rate > 1e-3);
        QVERIFY(shake.value < 1e-14);
    }

    /// The table of the handbook: spherical pendulum, h = 0.01, to t = 1000 there and to t = 100 here.
    void whatIsKept_data() {
        QTest::addColumn<QString>("id");
        QTest::addColumn<double>("value");       // |g| at most
        QTest::addColumn<double>("leastDrift");  // |dE| at least
        QTest::addColumn<double>("mostDrift");
        QTest::addColumn<double>("momentum");  // |dL_z| at most
        QTest::newRow("rk4") << "rk4" << 1e-2 << 1e-4 << 1e-1 << 1e-5;
        QTest::newRow("baumgarte") << "baumgarte" << 1e-6 << 1e-6 << 1e-3 << 1e-6;
        QTest::newRow("rk4-projected") << "rk4-projected" << 1e-15 << 1e-7 << 1e-4 << 1e-5;
        QTest::newRow("ggl-bdf2") << "ggl-bdf2" << 1e-14 << 1e-2 << 1.0 << 1e-1;
        QTest::newRow("rattle") << "rattle" << 1e-15 << 1e-4 << 1e-3 << 1e-12;
    }
    void whatIsKept() {
        QFETCH(QString, id);
        QFETCH(double, value);
        QFETCH(double, leastDrift);
        QFETCH(double, mostDrift);
        QFETCH(double, momentum);
        const auto of = sphericalPendulum();
        const Kept kept = run(of, *make(of, id.toStdString(), 0.01), 10'000);
        QCOMPARE(kept.outcome, Outcome::converged);
        qInfo("|g| %.2e, |dg/dt| %.2e, |dE| %.2e, |dL_z| %.2e", kept.value, kept.rate, kept.energy,
              kept.momentum);
        QVERIFY(kept.value <= value);
        QVERIFY(kept.energy >= leastDrift && kept.energy <= mostDrift);
        QVERIFY(kept.momentum <= momentum);
    }

    /// A step that is too long for the feedback: h alpha = 3.
    void aStrongFeedbackBlowsUp() {
        const auto of = sphericalPendulum();
        const Kept kept = run(of, *make(of, "baumgarte", 0.01, 300), 30);
        QVERIFY(kept.outcome != Outcome::converged || kept.value > 1e3 || !std::isfinite(kept.value));
    }

    void orders_data() {
        QTest::addColumn<QString>("id");
        QTest::addColumn<int>("order");
        QTest::newRow("rattle") << "rattle" << 2;
        QTest::newRow("rk4-projected") << "rk4-projected" << 4;
        QTest::newRow("baumgarte") << "baumgarte" << 4;
        QTest::newRow("ggl-bdf2") << "ggl-bdf2" << 2;
    }
    void orders() {
        QFETCH(QString, id);
        QFETCH(int, order);
        const auto of = sphericalPendulum();
        const auto exact = mechanism_test::run(of, "galerkin-gauss-4", 1, 400).state;
        double errors[2];
        for (int k = 0; k < 2; ++k) {
            const int steps = 400 << k;
            const auto end = run(of, *make(of, id.toStdString(), 1.0 / steps), steps).end;
            const auto apart = mechanism_test::distance(exact, end);
            errors[k] = apart.q + apart.p;
        }
        const double measured = std::log2(errors[0] / errors[1]);
        qInfo("errors %.2e, %.2e; order %.2f", errors[0], errors[1], measured);
        QVERIFY(std::abs(measured - order) < 0.2);
    }
};

EXTREMAL_TEST(ConstrainedBaselinesTest)
}  // namespace
}  // namespace extremal::constrained_baselines_test
#include "constrained_baselines_test.moc"
