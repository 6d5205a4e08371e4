// SPDX-License-Identifier: GPL-3.0-or-later
/// Profiles on knots that are unknowns: derivatives of the element, the tables of best errors and energies,
/// what stationarity in the knots makes equal and what it does not.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/family/free_knot/free_knots.hpp"
#include "engine/family/free_knot/knots.hpp"
#include "engine/model/typed/typed_function.hpp"
#include "tests/tools/test.hpp"

namespace extremal::knots_test {
namespace {

std::shared_ptr<const typed::TypedFunction> density(const char* text) {
    return std::make_shared<const typed::TypedFunction>(text, "", std::vector<std::string>{"u", "x"},
                                                        std::vector<std::pair<std::string, double>>{});
}

StaticProblem kink(const char* W) {
    StaticProblem p;
    p.left = -10;
    p.right = 10;
    p.uLeft = 4 * std::atan(std::exp(-10.0));
    p.uRight = 4 * std::atan(std::exp(10.0));
    p.W = density(W);
    p.resolution = 0.1;
    return p;
}
StaticProblem approximation(const char* W) {
    StaticProblem p;
    p.stiffness = 0;
    p.isHeld = false;
    p.W = density(W);
    p.resolution = 0.0025;
    return p;
}
StaticProblem steep() { return approximation("(u-tanh((x-0.3337)/0.01))^2/2"); }
StaticProblem jump() {
    StaticProblem p = approximation("(u-(1+sign(x-0.4))/2)^2/2");
    p.jumps = {0.4};
    return p;
}

double errorOf(const StaticProblem& problem, int elements, Knots knots) {
    const KnotProfile found = findProfile(problem, elements, knots);
    return found.outcome == Outcome::converged ? std::sqrt(2 * found.total()) : NAN;
}

double spreadOf(const KnotProfile& p) {
    const auto [low, high] = std::minmax_element(p.atRight.begin(), p.atRight.end());
    return *high - *low;
}
/// The largest difference of the derivatives from both sides of a knot.
double imbalanceOf(const KnotProfile& p) {
    double most = 0;
    for (std::size_t e = 1; e < p.elements(); ++e)
        most = std::max(most, std::abs(p.atRight[e - 1] - p.atLeft[e]));
    return most;
}

}  // namespace

class KnotsTest : public QObject {
    Q_OBJECT
private slots:
    void elementKnowsItsDerivatives() {
        const StaticProblem problem = kink("(1+0.4*sin(x))*(1-cos(u))");
        const double z[4] = {1.1, 0.3, 2.4, 1.2};
        const StaticElement own = staticElement(problem, z);
        double worst = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            constexpr double d = 1e-5;
            double low[4], high[4];
            std::copy_n(z, 4, low);
            std::copy_n(z, 4, high);
            low[k] -= d;
            high[k] += d;
            const StaticElement a = staticElement(problem, low), b = staticElement(problem, high);
            worst = std::max(worst, std::abs((b.energy - a.energy) / (2 * d) - own.gradient[k]));
            for (std::size_t j = 0; j < 4; ++j)
                worst =
                    std::max(worst, std::abs((b.gradient[j] - a.gradient[j]) / (2 * d) - own.hessian[j][k]));
        }
        qInfo("off by %.1e", worst);
        QVERIFY(worst < 1e-8);  // differences: 1e-10
    }
    void steepProfileIsThatOfTheTable_data() {
        QTest::addColumn<int>("elements");
        QTest::addColumn<double>("equal");
        QTest::addColumn<double>("arclength");
        QTest::addColumn<double>("density");
        QTest::addColumn<double>("best");
        QTest::newRow("4") << 4 << 2.668e-1 << 2.855e-2 << 1.374e-2 << 1.071e-2;
        QTest::newRow("8") << 8 << 1.679e-1 << 7.007e-3 << 2.684e-3 << 2.018e-3;
        QTest::newRow("16") << 16 << 8.973e-2 << 6.093e-3 << 5.549e-4 << 4.728e-4;
        // from here on the limit (int |u_xx|^(2/5))^(5/2) / (sqrt(720) n^2)
        QTest::newRow("32") << 32 << 3.901e-2 << 2.660e-3 << 1.261e-4 << 0.1188 / 1024;
        QTest::newRow("64") << 64 << 1.046e-2 << 7.801e-4 << 3.049e-5 << 0.1188 / 4096;
    }
    /// tanh((x - 0.3337)/0.01) on [0, 1]: errors in L2 of best approximations, found by another program.
    void steepProfileIsThatOfTheTable() {
        QFETCH(int, elements);
        QFETCH(double, equal);
        QFETCH(double, arclength);
        QFETCH(double, density);
        QFETCH(double, best);
        const StaticProblem problem = steep();
        const double a = errorOf(problem, elements, Knots::equal),
                     b = errorOf(problem, elements, Knots::arclength),
                     c = errorOf(problem, elements, Knots::density),
                     d = errorOf(problem, elements, Knots::free);
        qInfo("%.4e %.4e %.4e %.4e, n^2 error %.4f", a, b, c, d, d * elements * elements);
        QVERIFY(std::abs(a / equal - 1) < 0.002);
        QVERIFY(std::abs(b / arclength - 1) < 0.002);
        QVERIFY(std::abs(c / density - 1) < 0.002);
        QVERIFY(std::abs(d / best - 1) < (elements > 16 ? 0.03 : 0.002));
    }
    void kinkAtRestIsThatOfTheTable_data() {
        QTest::addColumn<int>("nodes");
        QTest::addColumn<double>("equal");
        QTest::addColumn<double>("best");
        QTest::newRow("7") << 7 << 0.847 << 7.6e-2;
        QTest::newRow("15") << 15 << 0.172 << 2.06e-2;
        QTest::newRow("31") << 31 << 0.0428 << 5.38e-3;
        QTest::newRow("63") << 63 << 0.0108 << 1.377e-3;
    }
    /// Energy above 8 with so many knots inside, and the horizontal momentum of the elements.
    void kinkAtRestIsThatOfTheTable() {
        QFETCH(int, nodes);
        QFETCH(double, equal);
        QFETCH(double, best);
        const StaticProblem problem = kink("1-cos(u)");
        const KnotProfile given = findProfile(problem, nodes + 1, Knots::equal),
                          free = findProfile(problem, nodes + 1, Knots::free);
        const double excess = free.total() - 8, constant = excess * (nodes + 1) * (nodes + 1);
        qInfo("equal %.4e, free %.4e: n^2 (E - 8) = %.3f; spread %.1e, of equal ones %.1e", given.total() - 8,
              excess, constant, spreadOf(free), spreadOf(given));
        QCOMPARE(free.outcome, Outcome::converged);
        QVERIFY(std::abs((given.total() - 8) / equal - 1) < 0.005);
        QVERIFY(std::abs(excess / best - 1) < 0.01);
        QVERIFY(spreadOf(free) < 1e-10);  // 1e-12 at most
        QVERIFY(spreadOf(given) > 5e-3);  // 0.4 .. 8e-3
        if (nodes == 31) QVERIFY(constant > 5.2 && constant < 5.75);
    }
    void whereTheEnergyDependsOnThePlaceNothingIsEqual() {
        const KnotProfile found = findProfile(kink("(1+0.4*sin(x))*(1-cos(u))"), 16, Knots::free);
        qInfo("spread %.3f, imbalance of a knot %.1e", spreadOf(found), imbalanceOf(found));
        QCOMPARE(found.outcome, Outcome::converged);
        QVERIFY(spreadOf(found) > 0.2);  // 0.32
        QVERIFY(imbalanceOf(found) < 1e-8);
    }
    /// A domain of 1e16 periods has no profile that could be found: the search ends, and says so.
    void searchesAreBounded() {
        StaticProblem problem = kink("(1+0.4*sin(x))*(1-cos(u))");
        problem.left = -1e16;
        problem.resolution = 0.005 * problem.length();
        const KnotProfile fine = fineProfile(problem), found = findProfile(problem, 16, Knots::free, fine);
        qInfo("%lld and %lld iterations", fine.cost.iterations, found.cost.iterations);
        QVERIFY(found.outcome != Outcome::converged);
        QVERIFY(found.cost.iterations < 10000);  // 20534 without a bound
    }
    void densitiesCostFewIterations() {
        const KnotProfile fine = fineProfile(steep());
        qInfo("%lld iterations", fine.cost.iterations);
        QCOMPARE(fine.outcome, Outcome::converged);
        QVERIFY(fine.cost.iterations < 20);  // 9, on all levels together
    }
    void denseOutputIsTheLineBetweenTheKnots() {
        const auto profile = std::make_shared<const KnotProfile>(findProfile(steep(), 4, Knots::equal));
        const auto integrator = makeFreeKnots(profile);
        State state = knotStart(*profile);
        for (std::size_t e = 0; e < profile->elements(); ++e) {
            QCOMPARE(integrator->advance(state, 1).outcome, Outcome::converged);
            QCOMPARE(state.x[0], profile->u[e + 1]);
            double x[4];
            for (const double tau : {0.0, 0.25, 1.0}) {
                integrator->denseOutput(tau, x);
                QCOMPARE(x[0], (1 - tau) * profile->u[e] + tau * profile->u[e + 1]);
            }
        }
    }
    void knotsOfAJumpMeet() {
        const StaticProblem problem = jump();
        for (const int n : {8, 16, 32, 64}) {
            const double scaled = errorOf(problem, n, Knots::equal) * std::sqrt(n);
            qInfo("%d equal: %.3f", n, scaled);
            QVERIFY(scaled > 0.2 && scaled < 0.39);  // 0.38 at most, by the place of the jump in its element
        }
        const KnotProfile free = findProfile(problem, 3, Knots::free);
        const double error = std::sqrt(2 * free.total()), least = std::sqrt(leastKnotDistance / 12);
        qInfo("3 free: %.4e", error);
        QVERIFY(std::abs(error / least - 1) < 0.01);
        QCOMPARE(std::count(free.hasMet.begin(), free.hasMet.end(), true), 1);
    }
};

EXTREMAL_TEST(KnotsTest)
}  // namespace extremal::knots_test

#include "knots_test.moc"
