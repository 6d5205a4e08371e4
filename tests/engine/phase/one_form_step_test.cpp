// SPDX-License-Identifier: GPL-3.0-or-later
/// One-forms on phase space: exactly symplectic steps of order 2s where half of the variables is free of the
/// form, as it is typed or in another gauge, and what collocation on the equations of motion makes of the
/// same motion.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/integrator/variation/with_variations.hpp"
#include "engine/model/first_order/one_form.hpp"
#include "engine/phase/naive_one_form.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/other_routes.hpp"
#include "tests/tools/tangent.hpp"
#include "tests/tools/test.hpp"

namespace extremal::one_form_step_test {
namespace {

struct Motion {
    System system;
    State start;
};

System typedForm(Value::Array names, Value::Object form, const char* hamiltonian) {
    return laws::systemNamed("phase-space", {{"variables", Value(std::move(names))},
                                             {"parameters", Value(Value::Object{})},
                                             {"one_form", Value(std::move(form))},
                                             {"hamiltonian", hamiltonian}});
}

/// A charge without mass in a magnetic field that grows with the distance: theta = (1 + r^2)/2 (-y dx + x
/// dy), and the same with d chi taken off, so that y has no velocity.
Motion massless(bool hasPlane) {
    const State start{0, 0, {0.6, 0.4}};
    if (hasPlane) return {typedForm({"x", "y"}, {{"x", "-y - 2*x^2*y - 2/3*y^3"}}, "cos(x) + sin(y)"), start};
    return {typedForm({"x", "y"}, {{"x", "-(1+x^2+y^2)/2*y"}, {"y", "(1+x^2+y^2)/2*x"}}, "cos(x) + sin(y)"),
            start};
}

/// Two of them on a plane each, with no half of the variables that the form could be free of.
Motion withoutPlane() {
    return {typedForm({"a", "b", "c", "d"},
                      {{"a", "-(1+a^2+b^2)/2*b + .1*c*d"},
                       {"b", "(1+a^2+b^2)/2*a + .05*c^2"},
                       {"c", "-(1+c^2+d^2)/2*d + .1*a*b"},
                       {"d", "(1+c^2+d^2)/2*c + .1*a*b"}},
                      "cos(a) + sin(b) + cos(c) + sin(d) + .1*a*c"),
            {0, 0, {0.6, 0.4, 0.3, -0.2}}};
}

/// Henon and Heiles in variables y with p = P(q, y).
Motion henonHeiles() {
    const std::string P1 = "(y1*(1+.8*q2) + y2^3/2)", P2 = "(y2*(1+.6*q1) + .4*y1^2)";
    return {typedForm({"q1", "q2", "y1", "y2"}, {{"q1", P1.c_str()}, {"q2", P2.c_str()}},
                      ("(" + P1 + "^2 + " + P2 + "^2)/2 + (q1^2+q2^2)/2 + q1^2*q2 - q2^3/3").c_str()),
            {0, 0, {0.05, -0.2, 0.3, 0.15}}};
}

Discretization gaussPair(int s, int nodes) {
    return laws::polynomialPair(s, {"gauss", {{"nodes", static_cast<double>(nodes)}}, {}});
}

std::unique_ptr<Integrator> cell(const Motion& of, int s, double h) {
    return makeIntegrator(of.system, gaussPair(s, s), {0, h});
}
std::unique_ptr<Integrator> onEquations(const Motion& of, int s, double h) {
    return findBaseline("gauss-collocation")
        ->make(of.system, {h, of.start, 0, {"gauss-collocation", {{"stages", static_cast<double>(s)}}, {}}});
}

State ending(const Motion& of, Integrator& integrator, int steps) {
    const auto found = laws::after(integrator, of.start, steps);
    if (!found) qFatal("a step failed");
    return *found;
}
State byRungeKutta(const Motion& of, double end) { return endByRungeKutta(of.system, of.start, end); }

/// max |M^T Om_1 M - Om_0| of the first steps.
double defect(const Motion& of, Integrator& integrator, int steps) {
    double worst = 0;
    State s = of.start;
    for (int k = 0; k < steps; ++k) {
        const State before = s;
        if (advance(integrator, s).outcome != Outcome::converged) qFatal("a step failed");
        const auto M = tangentMap(integrator);
        if (!M) qFatal("no tangent map");
        worst = std::max(worst, formDefect(SymplecticForm(of.system), before.x.data(), s.x.data(), *M));
    }
    return worst;
}

/// Mean energy errors of the first and of the last tenth of a run.
std::pair<double, double> tenths(const Motion& of, Integrator& integrator, int steps) {
    const EnergyFunction energy = energyOf(of.system);
    const double start = energy(0, of.start.x.data());
    State s = of.start;
    std::pair<double, double> means{0, 0};
    for (int k = 0; k < steps; ++k) {
        if (advance(integrator, s).outcome != Outcome::converged) qFatal("a step failed");
        const double error = (energy(0, s.x.data()) - start) / (steps / 10);
        if (k < steps / 10) means.first += error;
        if (k >= steps - steps / 10) means.second += error;
    }
    return means;
}

}  // namespace

class OneFormStepTest : public QObject {
    Q_OBJECT
private slots:
    void orders_data() {
        QTest::addColumn<bool>("hasPlane");
        QTest::addColumn<int>("degree");
        QTest::addColumn<int>("nodes");
        for (int s = 1; s <= 3; ++s) {
            QTest::addRow("free of the form, G(%d) of %d", s, s) << true << s << s;
            QTest::addRow("free of the form, G(%d) of %d", s + 1, s) << true << s << s + 1;
            QTest::addRow("in another gauge, G(%d) of %d", s, s) << false << s << s;
            QTest::addRow("in another gauge, G(%d) of %d", s + 1, s) << false << s << s + 1;
        }
    }
    void orders() {
        QFETCH(bool, hasPlane);
        QFETCH(int, degree);
        QFETCH(int, nodes);
        const Motion of = massless(hasPlane);
        const State reference = byRungeKutta(of, 4);
        const int steps = 32;
        const Discretization d = gaussPair(degree, nodes);
        const auto errorWith = [&](int n) {
            const auto integrator = makeIntegrator(of.system, d, {0, 4.0 / n});
            return largestDifference(ending(of, *integrator, n), reference);
        };
        const double fine = errorWith(2 * steps), order = std::log2(errorWith(steps) / fine);
        qInfo("error %.1e, order %.2f", fine, order);
        QVERIFY(std::abs(order - 2 * degree) < 0.25);
        QVERIFY(describe(d, of.system).claims.isSymplectic);
    }
    void theFormIsKeptWhereHalfIsFreeOfIt() {
        for (int s = 1; s <= 3; ++s) {
            const Motion free = massless(true), whole = massless(false), none = withoutPlane();
            const double kept = defect(free, *cell(free, s, 0.2), 20),
                         alsoKept = defect(whole, *cell(whole, s, 0.2), 20),
                         lost = defect(whole, *onEquations(whole, s, 0.2), 20),
                         alsoLost = defect(none, *cell(none, s, 0.2), 20);
            qInfo("s = %d: %.0e, %.0e, on the equations %.1e, %.1e", s, kept, alsoKept, lost, alsoLost);
            QVERIFY(kept <= 1e-13 && alsoKept <= 1e-13);
            QVERIFY(std::min(lost, alsoLost) > (s == 1 ? 1e-5 : s == 2 ? 1e-9 : 1e-13));
        }
    }
    /// Two ways to one scheme where no half is free of the form.
    void withoutSuchAHalfItIsCollocation() {
        const Motion of = withoutPlane();
        QVERIFY(!of.system.part<OneForm>().hasPlane());
        QVERIFY(!describe(gaussPair(2, 2), of.system).claims.isSymplectic);
        for (int s = 1; s <= 3; ++s)
            QVERIFY(largestDifference(ending(of, *cell(of, s, 0.1), 20),
                                      ending(of, *onEquations(of, s, 0.1), 20)) < 1e-13);
    }
    /// d chi is taken off by the program, and by hand.
    void theGaugeIsThatByHand() {
        const Motion byHand = massless(true), found = massless(false);
        QVERIFY(found.system.part<OneForm>().gauged && !byHand.system.part<OneForm>().gauged);
        for (int s = 1; s <= 3; ++s)
            QVERIFY(largestDifference(ending(byHand, *cell(byHand, s, 0.2), 50),
                                      ending(found, *cell(found, s, 0.2), 50)) < 1e-13);
    }
    /// Henon and Heiles again, with the differential of a function of all variables added to the form.
    void gaugesOfFourVariables() {
        const Motion plain = henonHeiles();
        const std::string P1 = "(y1*(1+.8*q2) + y2^3/2)", P2 = "(y2*(1+.6*q1) + .4*y1^2)";
        const auto inGauge = [&](const char* d1, const char* d2, const char* d3, const char* d4) {
            return Motion{
                typedForm({"y1", "q1", "q2", "y2"},
                          {{"q1", (P1 + d1).c_str()}, {"q2", (P2 + d2).c_str()}, {"y1", d3}, {"y2", d4}},
                          ("(" + P1 + "^2 + " + P2 + "^2)/2 + (q1^2+q2^2)/2 + q1^2*q2 - q2^3/3").c_str()),
                {0, 0, {0.3, 0.05, -0.2, 0.15}}};
        };
        // chi = q1 q2 y1^2 y2, and q1 y1 / (1 + q2^2) + sin(q1) y2
        const Motion first = inGauge("+q2*y1^2*y2", "+q1*y1^2*y2", "2*q1*q2*y1*y2", "q1*q2*y1^2"),
                     second = inGauge("+y1/(1+q2^2)+cos(q1)*y2", "-2*q2*q1*y1/(1+q2^2)^2", "q1/(1+q2^2)",
                                      "sin(q1)");
        const State there = ending(plain, *cell(plain, 2, 0.2), 50);
        const State expected{0, 0, {there.x[2], there.x[0], there.x[1], there.x[3]}};
        for (const Motion& of : {first, second}) {
            QVERIFY(of.system.part<OneForm>().gauged);
            QVERIFY(largestDifference(ending(of, *cell(of, 2, 0.2), 50), expected) < 1e-13);
        }
    }
    /// What the rule of 12 nodes is not exact for is not called symplectic.
    void whatCannotBeIntegratedStaysAsItIs() {
        const Motion of{
            typedForm({"x", "y"}, {{"x", "-y + cos(7*x*y)/9"}, {"y", "sin(7*x*y)/9"}}, "(x^2+y^2)/2"),
            {0, 0, {0.6, 0.4}}};
        QVERIFY(!of.system.part<OneForm>().hasPlane());
    }
    /// Over 2000 steps; what collocation does to the area is bounded, and far from round-off.
    void areasAreKeptWhereTheFormIs() {
        const auto largestArea = [](const Motion& of, std::unique_ptr<Integrator> scheme) {
            const auto integrator = withVariations(std::move(scheme), of.system, {.map = true}, {}, 0);
            const auto known = integrator->quantities();
            const auto place = std::find_if(known.begin(), known.end(),
                                            [](const Quantity& each) { return each.name == "area"; });
            if (place == known.end()) qFatal("no area");
            std::vector<double> values(known.size());
            double worst = 0;
            State s = of.start;
            integrator->begin(s);
            for (int k = 0; k < 2000; ++k) {
                if (advance(*integrator, s).outcome != Outcome::converged) qFatal("a step failed");
                integrator->measure(s, values.data());
                worst = std::max(worst, std::abs(values[static_cast<std::size_t>(place - known.begin())]));
            }
            return worst;
        };
        for (int s = 1; s <= 2; ++s) {
            const Motion free = massless(true), whole = massless(false);
            const double kept = largestArea(free, cell(free, s, 0.2)),
                         lost = largestArea(whole, onEquations(whole, s, 0.2));
            qInfo("s = %d: %.0e, on the equations %.1e", s, kept, lost);
            QVERIFY(kept <= 1e-11);
            QVERIFY(lost > (s == 1 ? 1e-4 : 1e-8));
        }
    }
    /// All variables continuous: p leaves theta(x) in the first step, and goes on doing so.
    void whatIsNaiveLeavesTheForm() {
        const Motion of = massless(false);
        const double least[] = {1e-4, 1e-4, 1e-7};
        for (int s = 1; s <= 3; ++s) {
            const auto naive = makeNaiveOneForm(of.system.part<OneForm>(), s, false, 0.2);
            State state = of.start;
            double first = 0, worst = 0;
            for (int k = 0; k < 100; ++k) {
                QVERIFY(advance(*naive, state).outcome == Outcome::converged);
                double off = 0;
                naive->measure(state, &off);
                if (k == 0) first = off;
                worst = std::max(worst, off);
            }
            qInfo("s = %d: |p - theta| %.1e after one step, at most %.1e in 100", s, first, worst);
            QVERIFY(worst > least[s - 1]);
        }
    }
    /// The standard projection has the order, and an energy that drifts.
    void projectionsDrift() {
        const Motion of = massless(false);
        const State reference = byRungeKutta(of, 4);
        for (int s = 1; s <= 2; ++s) {
            const auto errorWith = [&](int n) {
                const auto projected = makeNaiveOneForm(of.system.part<OneForm>(), s, true, 4.0 / n);
                return largestDifference(ending(of, *projected, n), reference);
            };
            // The error changes its sign on the way: over three halvings.
            const double order = std::log2(errorWith(16) / errorWith(128)) / 3;
            const auto means = tenths(of, *makeNaiveOneForm(of.system.part<OneForm>(), s, true, 0.2), 100000);
            qInfo("s = %d: order %.2f, mean energy errors %.1e and %.1e", s, order, means.first,
                  means.second);
            QVERIFY(std::abs(order - 2 * s) < 0.4);
            QVERIFY(std::abs(means.second) > 5 * std::abs(means.first));
        }
    }
    void energyDriftsOnTheEquationsAlone() {
        const Motion of = henonHeiles();
        const int steps = 100000;
        for (int s = 1; s <= 3; ++s) {
            const double h = s == 1 ? 0.1 : 0.2;
            const auto kept = tenths(of, *cell(of, s, h), steps),
                       lost = tenths(of, *onEquations(of, s, h), steps);
            qInfo("s = %d: %.2e to %.2e; on the equations %.1e to %.1e", s, kept.first, kept.second,
                  lost.first, lost.second);
            QVERIFY(std::abs(kept.second - kept.first) <= 0.01 * std::abs(kept.first));
            QVERIFY(std::abs(lost.second) > 10 * std::abs(lost.first));
        }
    }
    /// In (q, p = P(q, y)) it is the Hamiltonian's own cell.
    void itIsTheCellInCanonicalVariables() {
        const Motion of = henonHeiles();
        const Motion canonical{laws::systemNamed("henon-heiles"), {}};
        for (int s = 1; s <= 3; ++s) {
            const State there = ending(of, *cell(of, s, 0.2), 50);
            const auto momenta = [](const std::vector<double>& x) {
                return std::vector{x[0], x[1], x[2] * (1 + .8 * x[1]) + x[3] * x[3] * x[3] / 2,
                                   x[3] * (1 + .6 * x[0]) + .4 * x[2] * x[2]};
            };
            Motion start{canonical.system, {0, 0, momenta(of.start.x)}};
            const State here = ending(start, *cell(start, s, 0.2), 50);
            QVERIFY(largestDifference({0, 0, momenta(there.x)}, here) < 1e-13);
        }
    }
    /// An affine P is inverted at once, with gradients at all nodes together; Newton's method finds the same
    /// y at each node, and is what other forms have.
    void affineMomentaMakeTheStepsOfAllOthers_data() {
        QTest::addColumn<Value::Object>("form");
        QTest::addColumn<bool>("isAffine");
        const auto row = [](const char* name, const Value::Object& form, bool isAffine) {
            QTest::newRow(name) << form << isAffine;
        };
        row("unlike strengths", {{"a", "1.3*b"}, {"c", "-.4*d"}}, true);
        row("mixed, and in the places", {{"a", "2*b+.3*d+.7*c-.2*a+.1"}, {"c", "b-d+.5*a"}}, true);
        row("in another gauge", {{"a", "b+d/5"}, {"b", "-a/2+d"}, {"c", "d+.2*b"}, {"d", "b+.6*c"}}, true);
        row("with a curved differential", {{"a", "b+2*a*c"}, {"c", "d+a^2"}}, false);
        row("not constant", {{"a", "b*(1+c^2)"}, {"c", "d"}}, false);
    }
    void affineMomentaMakeTheStepsOfAllOthers() {
        QFETCH(Value::Object, form);
        QFETCH(bool, isAffine);
        const System together =
            typedForm({"a", "b", "c", "d"}, form, "(b^2+d^2)/2 + cos(a) + sin(c)*b + .1*exp(a*d)/(1+c^2)");
        System apart = together;
        OneForm byNewton = apart.part<OneForm>();
        QVERIFY(byNewton.hasPlane());
        QCOMPARE(byNewton.isAffine, isAffine);
        byNewton.isAffine = false;
        apart.parts.set(byNewton);
        const State start{0, 0, {0.6, 0.4, 0.3, -0.2}};
        for (const int s : {1, 2, 4, 9})
            for (const Discretization& d :
                 {gaussPair(s, s), laws::polynomialPair(s, {"lobatto", {{"nodes", s + 1.0}}, {}})}) {
                const auto one = makeIntegrator(together, d, {0, 0.1}),
                           other = makeIntegrator(apart, d, {0, 0.1});
                const State here = ending({together, start}, *one, 20),
                            there = ending({apart, start}, *other, 20);
                QVERIFY(largestDifference(here, there) < 2e-14);
                const Eigen::MatrixXd M = *tangentMap(*one), N = *tangentMap(*other);
                QVERIFY((M - N).cwiseAbs().maxCoeff() < 1e-13);
                std::vector<double> x(4), y(4);
                one->denseOutput(0.3, x);
                other->denseOutput(0.3, y);
                QVERIFY(largestDifference({0, 0, x}, {0, 0, y}) < 2e-14);
            }
    }
    void tangentMapsAreThoseOfDifferences() {
        for (const Motion& of : {massless(true), massless(false), withoutPlane(), henonHeiles()}) {
            const auto integrator = cell(of, 2, 0.2);
            State s = of.start;
            QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
            const Eigen::MatrixXd M = *tangentMap(*integrator);
            const auto step = [&](const State& from) { return laws::after(*cell(of, 2, 0.2), from, 1); };
            const auto differences = differencedMap(of.system, step, of.start, of.start.x.size(), 3e-3);
            QVERIFY((M - *differences).cwiseAbs().maxCoeff() < 1e-10);
        }
    }
    /// A guiding centre in a tokamak: 2000 steps of the banana orbit.
    void guidingCentre() {
        const char* const R = "(1+r*cos(th))";
        const std::string S = "sqrt(1+r^2/4)", x = "(r*cos(th))";
        std::string series = "1/2";
        for (int k = 1; k <= 10; ++k)
            series += (k % 2 == 1 ? "-" : "+") + x + "^" + std::to_string(k) + "/" + std::to_string(k + 2);
        const Motion of{typedForm({"r", "th", "zeta", "u"},
                                  {{"th", ("r^2*(" + series + ") + u*r^2/(2*" + S + ")").c_str()},
                                   {"zeta", ("-r^2/4 + u*" + std::string(R) + "/" + S).c_str()}},
                                  ("u^2/2 + 2.25e-6*" + S + "/" + R).c_str()),
                        {0, 0, {0.05, 0, 0, 4.306e-4}}};
        QCOMPARE(of.system.momenta.size(), std::size_t(1));  // of zeta
        const EnergyFunction energy = energyOf(of.system);
        const double H = energy(0, of.start.x.data()),
                     P = of.system.momenta[0].value(of.start.x.data(), nullptr);
        for (int s = 1; s <= 3; ++s) {
            const auto integrator = cell(of, s, 1000);
            State state = of.start;
            double worstH = 0, worstP = 0;
            for (int k = 0; k < 2000; ++k) {
                QVERIFY(advance(*integrator, state).outcome == Outcome::converged);
                worstH = std::max(worstH, std::abs(energy(0, state.x.data()) / H - 1));
                worstP = std::max(worstP, std::abs(of.system.momenta[0].value(state.x.data(), nullptr) - P));
            }
            qInfo("s = %d: dH/H %.1e, P_zeta %.0e", s, worstH, worstP);
            QVERIFY(worstH <= (s == 1 ? 5e-5 : s == 2 ? 1e-7 : 3e-10));
            QVERIFY(worstP <= 1e-15);
        }
    }
    void messages() {
        const auto messageOf = [](Value::Array names, Value::Object form) -> std::string {
            try {
                const System system = typedForm(std::move(names), std::move(form), "x^2 + y^2");
                findModel("phase-space")->checkInitial({}, system, {0, 0, {1, 1}});
            } catch (const InvalidScene& e) {
                return e.problems().front().pointer + ": " + e.problems().front().message;
            }
            return {};
        };
        QVERIFY(messageOf({"x", "y", "z"}, {{"x", "y"}}).find("even number") != std::string::npos);
        QVERIFY(messageOf({"x", "y"}, {{"x", "x^2"}}).find("move together") != std::string::npos);
        QVERIFY(messageOf({"x", "y"}, {{"x", "3*x"}}).find("move together") != std::string::npos);
        QVERIFY(messageOf({"x", "y"}, {{"z", "x"}}).starts_with("/one_form/z"));
        QCOMPARE(messageOf({"x", "y"}, {{"x", "y"}}), std::string());
    }
};

EXTREMAL_TEST(OneFormStepTest)
}  // namespace extremal::one_form_step_test

#include "one_form_step_test.moc"
