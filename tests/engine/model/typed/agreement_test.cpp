// SPDX-License-Identifier: GPL-3.0-or-later
/// A typed Lagrangian and the built-in system are the same system: derivatives, steps and long runs agree to
/// round-off, although one is differentiated symbolically and the other by forward numbers.
#include <QTest>

#include <algorithm>
#include <random>

#include "tests/engine/model/typed/typed.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::agreement_test {
namespace {

struct Twins {
    QString name;
    System typed, builtIn;
    Discretization discretization;
    double h;
    State start;  ///< of the regular motion
    double runTolerance;
};

Discretization newtonPair(int degree) {
    Discretization discretization = polynomialPair(degree, {"gauss", {}, {}});
    discretization.solver.type = "newton";
    return discretization;
}

const std::vector<Twins>& twins() {
    static const std::vector<Twins> all = {
        {"Kepler", typedKepler(), systemNamed("kepler"), newtonPair(3), 0.05, keplerStart, 1e-9},
        {"spring pendulum",
         typedSpringPendulum(),
         systemNamed("spring-pendulum"),
         newtonPair(3),
         0.001,
         {0, 0, {0.05, 1, 0, 0}},
         1e-11},
        {"double pendulum",
         typedDoublePendulum(),
         systemNamed("double-pendulum"),
         newtonPair(3),
         0.01,
         {0, 0, {0.3, 0.2, 0, 0}},
         1e-11},
    };
    return all;
}

/// q and v (or p) away from collisions.
std::vector<double> randomNumbers(std::mt19937& random, const System& builtIn) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<double> x;
    for (int i = 0; i < 2 * builtIn.dimension(); ++i) x.push_back(uniform(random));
    if (builtIn.id == "kepler") x[0] += x[0] > 0 ? 0.3 : -0.3;
    if (builtIn.id == "spring-pendulum") x[0] *= 0.5;
    return x;
}

std::vector<double> jetOf(const System& system, const std::vector<double>& x) {
    const int d = system.dimension();
    const auto n = static_cast<std::size_t>(2 * d);
    const auto& m = system.mechanics();
    std::vector<double> all(1 + n + n * n);
    m.jet(m.model.get(), 0.3, x.data(), x.data() + d, &all[0], &all[1], &all[1 + n]);
    return all;
}

double largestDifference(const std::vector<double>& a, const std::vector<double>& b) {
    double difference = 0, scale = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        difference = std::max(difference, std::abs(a[i] - b[i]));
        scale = std::max(scale, std::abs(a[i]));
    }
    return difference / scale;
}

double jetDifference(const System& a, const System& b) {
    std::mt19937 random(5);
    double worst = 0;
    for (int i = 0; i < 10000; ++i) {
        const auto x = randomNumbers(random, b);
        worst = std::max(worst, largestDifference(jetOf(a, x), jetOf(b, x)));
    }
    return worst;
}

}  // namespace

class AgreementTest : public QObject {
    Q_OBJECT

    static void addTwins() {
        QTest::addColumn<int>("which");
        for (std::size_t i = 0; i < twins().size(); ++i)
            QTest::newRow(qPrintable(twins()[i].name)) << static_cast<int>(i);
    }
    static const Twins& current() {
        const int which = *static_cast<const int*>(QTest::qData("which", QMetaType::Int));
        return twins()[static_cast<std::size_t>(which)];
    }

private slots:
    void jetsAgree_data() { addTwins(); }
    void jetsAgree() {
        const double worst = jetDifference(current().typed, current().builtIn);
        qInfo("%.2e", worst);  // 1.0e-15, 9.1e-17
        QVERIFY(worst < 1e-13);
    }
    void gradientEnergyAndFlowAgreeWithTheJet_data() { addTwins(); }
    void gradientEnergyAndFlowAgreeWithTheJet() {
        const System &a = current().typed, &b = current().builtIn;
        const auto n = static_cast<std::size_t>(2 * a.dimension());
        const auto d = static_cast<std::size_t>(a.dimension());
        std::mt19937 random(6);
        for (int i = 0; i < 1000; ++i) {
            const auto x = randomNumbers(random, b);
            std::vector<double> g(n), ga(n), gb(n);
            const auto all = jetOf(a, x);
            a.mechanics().gradient(a.mechanics().model.get(), 0.3, x.data(), x.data() + d, g.data());
            QVERIFY(largestDifference(
                        std::vector<double>(all.begin() + 1, all.begin() + 1 + static_cast<long>(n)), g) <
                    1e-14);
            QVERIFY(a.mechanics().flow(a.mechanics().model.get(), 0.3, x.data(), x.data() + d, ga.data(),
                                       ga.data() + d));
            QVERIFY(b.mechanics().flow(b.mechanics().model.get(), 0.3, x.data(), x.data() + d, gb.data(),
                                       gb.data() + d));
            QVERIFY(largestDifference(ga, gb) < 1e-14);
            const double ea = a.mechanics().energy(a.mechanics().model.get(), 0.3, x.data(), x.data() + d);
            const double eb = b.mechanics().energy(b.mechanics().model.get(), 0.3, x.data(), x.data() + d);
            QVERIFY(std::abs(ea - eb) < 1e-12 * std::max(1.0, std::abs(eb)));
        }
        QCOMPARE(a.mechanics().isSeparable, b.mechanics().isSeparable);
        QVERIFY(!a.mechanics().isTimeDependent);
    }
    void stepsAgree_data() { addTwins(); }
    void stepsAgree() {
        const Twins& t = current();
        const auto a = makeIntegrator(t.typed, t.discretization, {0, t.h}),
                   b = makeIntegrator(t.builtIn, t.discretization, {0, t.h});
        std::mt19937 random(7);
        double worst = 0;
        for (int i = 0; i < 10000; ++i) {
            const State start{0, 0, randomNumbers(random, t.builtIn)};
            const auto x = after(*a, start, 1), y = after(*b, start, 1);
            if (!x || !y) QFAIL("a step failed");
            worst = std::max(worst, largestDifference(y->x, x->x));
        }
        qInfo("%.2e", worst);  // 4.1e-16, 1.2e-15
        QVERIFY(worst < 1e-12);
    }
    void longRunsAgree_data() { addTwins(); }
    void longRunsAgree() {
        const Twins& t = current();
        const auto a = makeIntegrator(t.typed, t.discretization, {0, t.h}),
                   b = makeIntegrator(t.builtIn, t.discretization, {0, t.h});
        State x = t.start, y = t.start;
        double worst = 0;
        for (int i = 0; i < 10000; ++i) {
            QCOMPARE(advance(*a, x).outcome, Outcome::converged);
            QCOMPARE(advance(*b, y).outcome, Outcome::converged);
            worst = std::max(worst, distance(x.x, y.x, 0, t.typed.coordinates.size()));
        }
        qInfo("%.2e", worst);  // 2.7e-12, 4.7e-15
        QVERIFY(worst < t.runTolerance);
    }
    void anotherLagrangianIsSeenToDiffer() {
        // Teeth: a relative change of 1e-12 in one coefficient is noticed.
        const System other =
            typedSystem({"x", "y"}, {{"mu", 1 + 1e-12}}, "(x_t^2 + y_t^2)/2 + mu/sqrt(x^2 + y^2)");
        QVERIFY(jetDifference(other, systemNamed("kepler")) > 1e-13);
    }
};

EXTREMAL_TEST(AgreementTest)
}  // namespace extremal::laws::agreement_test

#include "agreement_test.moc"
