// SPDX-License-Identifier: GPL-3.0-or-later
/// Typed Hamiltonians: orders in q and p of every rule, the symplectic form, names that the schemes have
/// elsewhere, and the same motion from a Lagrangian (design page "phase space", law PS1).
#include <QTest>

#include <cmath>
#include <string>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/baseline/table_method.hpp"
#include "engine/core/problem.hpp"
#include "engine/family/table_of.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/phase/phase_step.hpp"
#include "engine/tableau/tableau.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/other_routes.hpp"
#include "tests/tools/tangent.hpp"
#include "tests/tools/test.hpp"

namespace extremal::phase_step_test {
namespace {

struct Motion {
    System system;
    State start;
};

System typedHamiltonian(Value::Array names, const char* hamiltonian) {
    return laws::systemNamed("hamiltonian", {{"coordinates", Value(std::move(names))},
                                             {"parameters", Value(Value::Object{})},
                                             {"hamiltonian", hamiltonian}});
}

/// Not separable; relativistic; linear in p; Henon and Heiles.
Motion motionOf(const QString& name) {
    if (name == "H1")
        return {typedHamiltonian({"q", "r"},
                                 "(p_q^2+p_r^2)*(1+q^2/2+.3*q*r)/2 + q^2/2 + r^4/4 + r^2/2 + .2*q*r*p_q*p_r "
                                 "+ .1*p_q^3*p_r"),
                {0, 0, {0.4, -0.3, 0.2, 0.5}}};
    if (name == "H2")
        return {typedHamiltonian({"x", "y"}, "sqrt(1+p_x^2+p_y^2) - 1/sqrt(x^2+y^2+.1)"),
                {0, 0, {0.8, 0.1, 0.1, 0.6}}};
    if (name == "H3")
        return {typedHamiltonian({"x", "y"}, "p_x*(y - x*y^2) + p_y*(-sin(x) + .3*y*cos(t)) + x*y"),
                {0, 0, {0.5, 0.3, 0.7, -0.4}}};
    if (name == "five")
        return {typedHamiltonian({"a", "b", "c", "d", "e"},
                                 "(p_a^2+p_b^2+p_c^2+p_d^2+p_e^2)/2*(1+(a-e)^2/5) + a^2/2 + b^2/2 + c^2/2 + "
                                 "d^2/2 + e^2/2 + a*b*c/3 - p_d*e*b/4"),
                {0, 0, {0.3, -0.2, 0.1, 0.4, -0.1, 0.2, 0.3, -0.4, 0.1, 0.5}}};
    return {typedHamiltonian({"x", "y"}, "(p_x^2+p_y^2)/2 + (x^2+y^2)/2 + x^2*y - y^3/3"),
            {0, 0, {0.1, -0.2, 0.35, 0.2}}};
}

Settings gaussRule(int nodes) { return {"gauss", {{"nodes", static_cast<double>(nodes)}}, {}}; }
Settings lobattoRule(int nodes) { return {"lobatto", {{"nodes", static_cast<double>(nodes)}}, {}}; }

State ending(const Motion& of, const Discretization& d, int steps, double end = 2) {
    const auto integrator = makeIntegrator(of.system, d, {0, end / steps});
    const auto found = laws::after(*integrator, of.start, steps);
    if (!found) qFatal("a step failed");
    return *found;
}

State byRungeKutta(const Motion& of, double end = 2) { return endByRungeKutta(of.system, of.start, end); }

struct Distance {
    double q = 0, p = 0;
};
Distance distance(const State& a, const State& b) {
    Distance found;
    const std::size_t d = a.x.size() / 2;
    for (std::size_t i = 0; i < d; ++i) {
        found.q = std::max(found.q, std::abs(a.x[i] - b.x[i]));
        found.p = std::max(found.p, std::abs(a.x[d + i] - b.x[d + i]));
    }
    return found;
}
/// max |M^T J M - J| / max |M|^2 of the first steps.
double defect(const Motion& of, Integrator& integrator) {
    double worst = 0;
    State s = of.start;
    for (int k = 0; k < 5; ++k) {
        const State before = s;
        if (advance(integrator, s).outcome != Outcome::converged) qFatal("a step failed");
        const auto M = tangentMap(integrator);
        if (!M) qFatal("no tangent map");
        worst = std::max(worst, formDefect(SymplecticForm(of.system), before.x.data(), s.x.data(), *M) /
                                    std::pow(M->cwiseAbs().maxCoeff(), 2));
    }
    return worst;
}

/// Lobatto IIIA-IIIB with 2 or 3 stages, from their own coefficients.
Tableau lobattoPair(int stages) {
    const auto n = static_cast<Eigen::Index>(stages);
    Tableau::Matrix A(n, n), B(n, n);
    Tableau::Vector b(n);
    const auto set = [](Tableau::Matrix& M, std::vector<double> over24) {
        for (Eigen::Index i = 0; i < M.rows(); ++i)
            for (Eigen::Index j = 0; j < M.cols(); ++j)
                M(i, j) = Quad(over24[static_cast<std::size_t>(i * M.cols() + j)]) / 24;
    };
    if (stages == 2) {
        set(A, {0, 0, 12, 12});
        set(B, {12, 0, 12, 0});
        b << Quad(1) / 2, Quad(1) / 2;
    } else {
        set(A, {0, 0, 0, 5, 8, -1, 4, 16, 4});
        set(B, {4, -4, 0, 4, 8, 0, 4, 20, 0});
        b << Quad(1) / 6, Quad(2) / 3, Quad(1) / 6;
    }
    return partitionedTableau(A, B, b, b, TableauScope::any);
}

}  // namespace

class PhaseStepTest : public QObject {
    Q_OBJECT
private slots:
    void orders_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<int>("degree");
        QTest::addColumn<QString>("rule");
        QTest::addColumn<int>("nodes");
        QTest::addColumn<int>("order");
        for (const char* name : {"H1", "H2", "H3", "H4"}) {
            for (int s = 1; s <= 3; ++s) {
                QTest::addRow("%s, G(%d) of %d", name, s, s) << name << s << "gauss" << s << 2 * s;
                QTest::addRow("%s, G(%d) of %d", name, s + 1, s) << name << s << "gauss" << s + 1 << 2 * s;
                QTest::addRow("%s, L(%d) of %d", name, s + 1, s) << name << s << "lobatto" << s + 1 << 2 * s;
            }
            for (int s = 2; s <= 3; ++s)
                QTest::addRow("%s, L(%d) of %d", name, s, s) << name << s << "lobatto" << s << 2 * s - 2;
            QTest::addRow("%s, left end", name) << name << 1 << "radau" << 1 << 1;
        }
    }
    void orders() {
        QFETCH(QString, name);
        QFETCH(int, degree);
        QFETCH(QString, rule);
        QFETCH(int, nodes);
        QFETCH(int, order);
        const Motion of = motionOf(name);
        Settings quadrature{rule.toStdString(), {{"nodes", static_cast<double>(nodes)}}, {}};
        if (rule == "radau") quadrature.keys.emplace_back("end", "left");
        const Discretization d = laws::polynomialPair(degree, quadrature);
        QCOMPARE(describe(d, of.system).claims.order, order);
        // Errors of 1e-3 to 1e-11: above the round-off of the reference, and in the range of the order.
        const int steps = order == 1 ? 1280 : order == 2 ? 160 : order == 4 ? 48 : 16;
        const State reference = byRungeKutta(of);
        const Distance coarse = distance(ending(of, d, steps), reference),
                       fine = distance(ending(of, d, 2 * steps), reference);
        const double q = std::log2(coarse.q / fine.q), p = std::log2(coarse.p / fine.p);
        const auto integrator = makeIntegrator(of.system, d, {0, 0.1});
        const double form = defect(of, *integrator);
        qInfo("errors of q %.1e, of p %.1e; orders %.2f, %.2f; defect %.0e", fine.q, fine.p, q, p, form);
        QVERIFY(std::abs(q - order) < 0.2);
        QVERIFY(std::abs(p - order) < 0.2);
        QVERIFY(form <= 1e-13);
    }

    /// What the order and the defect of a scheme that is not symplectic look like, so that the law above is
    /// seen to fail: RK4 in place of a cell, and a cell whose nodes are off.
    void brokenSchemesAreSeen() {
        const Motion of = motionOf("H1");
        const auto rk4 = findBaseline("rk4")->make(of.system, {0.1, of.start, 0, {}});
        QVERIFY(defect(of, *rk4) > 1e-9);
        Table<double> moved = tableOf(laws::polynomialPair(2, gaussRule(2)).space,
                                      laws::polynomialPair(2, gaussRule(2)).quadrature);
        moved.weight(0) += 0.01;
        moved.weight(1) -= 0.01;
        const State reference = byRungeKutta(of);
        const auto errorWith = [&](int steps) {
            const auto integrator =
                makePhaseStep(of.system.part<PhaseMechanics>(), moved, 2.0 / steps, SolverPolicy{});
            return largestDifference(*laws::after(*integrator, of.start, steps), reference);
        };
        QVERIFY(std::log2(errorWith(48) / errorWith(96)) < 2);
    }

    void gaussIsCollocation_data() {
        QTest::addColumn<QString>("name");
        for (const char* name : {"H1", "H2", "H3", "H4"}) QTest::addRow("%s", name) << name;
    }
    void gaussIsCollocation() {
        QFETCH(QString, name);
        const Motion of = motionOf(name);
        for (int s = 1; s <= 4; ++s) {
            const BaselineEntry* const entry = findBaseline("gauss-collocation");
            const auto other = entry->make(
                of.system,
                {0.1, of.start, 0, {"gauss-collocation", {{"stages", static_cast<double>(s)}}, {}}});
            const State there = *laws::after(*other, of.start, 20),
                        here = ending(of, laws::polynomialPair(s, gaussRule(s)), 20);
            QVERIFY(largestDifference(here, there) < 1e-14 * 20);  // 2e-15 was measured
        }
    }
    void lobattoIsThePairOfLobatto_data() { gaussIsCollocation_data(); }
    void lobattoIsThePairOfLobatto() {
        QFETCH(QString, name);
        if (name == "H3") return;  // it depends on t, and that tableau has the nodes of its rows
        const Motion of = motionOf(name);
        for (int stages : {2, 3}) {
            const auto other = makeTableMethod(flowOf(of.system), 0.1, lobattoPair(stages));
            const State there = *laws::after(*other, of.start, 20),
                        here = ending(of, laws::polynomialPair(stages - 1, lobattoRule(stages)), 20);
            QVERIFY(largestDifference(here, there) < 1e-14 * 20);
        }
    }
    void aWastedDegreeIsOneLess() {
        const Motion of = motionOf("H1");
        for (int s : {2, 3})
            QVERIFY(largestDifference(ending(of, laws::polynomialPair(s, lobattoRule(s)), 20),
                                      ending(of, laws::polynomialPair(s - 1, lobattoRule(s)), 20)) < 2e-14);
    }
    /// Kick first.
    void theLeftEndIsSymplecticEuler() {
        const Motion of = motionOf("H1");
        const auto euler = findBaseline("symplectic-euler")->make(of.system, {0.02, of.start, 0, {}});
        const Settings left{"radau", {{"nodes", 1.0}, {"end", "left"}}, {}};
        QVERIFY(largestDifference(ending(of, laws::polynomialPair(1, left), 100),
                                  *laws::after(*euler, of.start, 100)) < 1e-13);
    }
    /// A Lagrangian with a mass that depends on the place, and its Hamiltonian: the same steps where the rule
    /// has as many nodes as the space has degrees.
    void theLagrangianOfTheSameSystem() {
        const System lagrangian = laws::systemNamed(
            "lagrangian", {{"coordinates", Value(Value::Array{"a", "b"})},
                           {"parameters", Value(Value::Object{})},
                           {"lagrangian", "a_t^2 + b_t^2/2 + a_t*b_t*cos(a-b) + 2*cos(a)+cos(b)"}});
        const System hamiltonian = typedHamiltonian(
            {"a", "b"}, "(p_a^2/2 + p_b^2 - p_a*p_b*cos(a-b))/(2 - cos(a-b)^2) - 2*cos(a) - cos(b)");
        const State start{0, 0, {0.7, -0.4, 0.3, 0.2}};
        for (int s = 1; s <= 4; ++s) {
            const Discretization d = laws::polynomialPair(s, gaussRule(s));
            const State a = ending({lagrangian, start}, d, 40), b = ending({hamiltonian, start}, d, 40);
            QVERIFY(largestDifference(a, b) < 2e-13);
        }
        // With more nodes they are two schemes of one order.
        const Discretization more = laws::polynomialPair(2, gaussRule(3));
        const double apart =
            largestDifference(ending({lagrangian, start}, more, 40), ending({hamiltonian, start}, more, 40));
        QVERIFY(apart > 1e-12 && apart < 1e-5);
    }
    /// With constant masses every rule makes the steps of the Lagrangian cell.
    void separableOnesAreThoseOfTheLagrangian() {
        const System lagrangian = laws::systemNamed("henon-heiles");
        const Motion of = motionOf("H4");
        for (int s = 1; s <= 3; ++s)
            for (const Settings& rule : {gaussRule(s), gaussRule(s + 1), lobattoRule(s + 1)}) {
                const Discretization d = laws::polynomialPair(s, rule);
                QVERIFY(largestDifference(ending({lagrangian, of.start}, d, 40), ending(of, d, 40)) < 1e-13);
            }
    }
    /// H linear in p has no Lagrangian: there is nothing that could be transformed.
    void nothingIsTransformed() {
        const Motion of = motionOf("H3");
        QVERIFY(!of.system.parts.find<Mechanical>());
        const PhaseMechanics& H = of.system.part<PhaseMechanics>();
        QVERIFY(!H.isSeparable());
        Eigen::MatrixXd second(4, 4);
        H.hessian(H.model.get(), 0.3, of.start.x.data(), of.start.x.data() + 2, second.data());
        QCOMPARE(second.bottomRightCorner(2, 2).cwiseAbs().maxCoeff(), 0.0);
        QVERIFY(!flowOf(of.system).jet);
    }
    void tangentMapsAreThoseOfDifferences_data() { gaussIsCollocation_data(); }
    void tangentMapsAreThoseOfDifferences() {
        QFETCH(QString, name);
        const Motion of = motionOf(name);
        for (const Settings& rule : {gaussRule(2), gaussRule(4), lobattoRule(3)}) {
            const Discretization d = laws::polynomialPair(2, rule);
            const auto integrator = makeIntegrator(of.system, d, {0, 0.1});
            State s = of.start;
            QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
            const Eigen::MatrixXd M = *tangentMap(*integrator);
            const auto step = [&](const State& from) -> std::optional<State> {
                const auto fresh = makeIntegrator(of.system, d, {0, 0.1});
                return laws::after(*fresh, from, 1);
            };
            const auto differences = differencedMap(of.system, step, of.start, 4, 3e-3);
            QVERIFY((M - *differences).cwiseAbs().maxCoeff() < 1e-11);
        }
    }
    /// With gradients at all nodes together, and node by node; steps of several lengths, one after the other.
    void nodesTogetherMakeTheStepsOfEachByItself_data() {
        gaussIsCollocation_data();
        QTest::newRow("five coordinates") << "five";
    }
    void nodesTogetherMakeTheStepsOfEachByItself() {
        QFETCH(QString, name);
        const Motion of = motionOf(name);
        System apart = of.system;
        PhaseMechanics oneByOne = apart.part<PhaseMechanics>();
        QVERIFY(oneByOne.gradients);
        oneByOne.gradients = nullptr;
        apart.parts.set(oneByOne);
        int sweeps = 0;
        const auto ends = [&](const System& system, const Discretization& d) {
            const auto integrator = makeIntegrator(system, d, {0, 0.05});
            State s = of.start;
            sweeps = 0;
            for (const double h : {0.05, 0.05, 0.05, 0.03, 0.03, 0.06}) {
                if (integrator->stepSize() != h) integrator->setStep(h);
                const StepReport report = integrator->advance(s, s.t + h);
                if (report.outcome != Outcome::converged) qFatal("a step failed");
                sweeps += report.cost.iterations;
            }
            return s;
        };
        for (const int s : {2, 3, 7, 8, 9, 12})
            for (const Settings& rule : {gaussRule(s), gaussRule(s + 2), lobattoRule(s + 1)}) {
                Discretization d = laws::polynomialPair(s, rule);
                const double apartBy = largestDifference(ends(of.system, d), ends(apart, d));
                QVERIFY2(apartBy < 5e-15, qPrintable(QString("s = %1: %2").arg(s).arg(apartBy)));
                // What a sweep has changed is the same: above round-off so is their number.
                d.solver = {"fixed-point", {{"tolerance", 1e-7}}, {}};
                (void)ends(of.system, d);
                const int together = sweeps;
                (void)ends(apart, d);
                QCOMPARE(sweeps, together);
            }
    }
    /// At a step where the fixed point does not contract.
    void newtonTakesWhatTheFixedPointCannot() {
        const Motion of{typedHamiltonian({"x"}, "p_x^2/2*(1+x^2/10) + 200*x^2"), {0, 0, {0.3, 1}}};
        Discretization d = laws::polynomialPair(2, gaussRule(2));
        const auto at = [&](const char* method, double h) {
            d.solver.type = method;
            const auto integrator = makeIntegrator(of.system, d, {0, h});
            return laws::after(*integrator, of.start, 5);
        };
        QVERIFY(!at("fixed-point", 0.4));
        QVERIFY(at("auto", 0.4).has_value());
        const auto small = at("fixed-point", 0.01), same = at("newton", 0.01);
        QVERIFY(small && same && largestDifference(*small, *same) < 1e-14);
    }
    /// Sweeps over nodes together go on for longer where the matrix of Newton's method is large.
    void newtonIsForWhatSweepsCostMore() {
        const Motion of = motionOf("five");
        const auto solvesWith = [&](int s, double h) {
            const auto integrator = makeIntegrator(of.system, laws::polynomialPair(s, gaussRule(s)), {0, h});
            State state = of.start;
            const StepReport report = integrator->advance(state, h);
            if (report.outcome != Outcome::converged) qFatal("a step failed");
            return report.cost.linearSolves;
        };
        QVERIFY(solvesWith(1, 2) > 0);
        QCOMPARE(solvesWith(8, 2), 0);
    }
    void denseOutputIsContinuousAndOfItsOrder() {
        const Motion of = motionOf("H1");
        const auto integrator = makeIntegrator(of.system, laws::polynomialPair(3, gaussRule(3)), {0, 0.1});
        State s = of.start;
        QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
        std::vector<double> x(4);
        for (const double tau : {1e-13, 1 - 1e-13}) {
            integrator->denseOutput(tau, x);
            const std::vector<double>& end = tau < 0.5 ? of.start.x : s.x;
            for (std::size_t i = 0; i < 4; ++i) QVERIFY(std::abs(x[i] - end[i]) < 1e-12);
        }
        integrator->denseOutput(0.37, x);
        const State inside = byRungeKutta(of, 0.037);
        for (std::size_t i = 0; i < 4; ++i) QVERIFY(std::abs(x[i] - inside.x[i]) < 1e-6);  // h^4
    }
    void messages() {
        const auto messageOf = [](const char* hamiltonian) -> std::string {
            try {
                typedHamiltonian({"x"}, hamiltonian);
            } catch (const InvalidScene& e) {
                return e.problems().front().pointer + ": " + e.problems().front().message + " (" +
                       e.problems().front().hint + ")";
            }
            return {};
        };
        const std::string velocity = messageOf("x_t^2/2 + x^2");
        QVERIFY(velocity.starts_with("/hamiltonian: ") && velocity.find("velocity x_t") != std::string::npos);
        QVERIFY(velocity.find("p_x") != std::string::npos);
        QVERIFY(messageOf("p_y^2/2").find("p_x") != std::string::npos);
    }
    void tao() {
        const Motion of = motionOf("H1");
        const State reference = byRungeKutta(of);
        for (const double order : {2.0, 4.0}) {
            const Settings keys{"tao", {{"order", order}, {"spring", 10.0}}, {}};
            const auto errorWith = [&](int steps) {
                const auto integrator =
                    findBaseline("tao")->make(of.system, {2.0 / steps, of.start, 0, keys});
                return largestDifference(*laws::after(*integrator, of.start, steps), reference);
            };
            QVERIFY(std::abs(std::log2(errorWith(800) / errorWith(1600)) - order) < 0.3);
        }
    }
};

EXTREMAL_TEST(PhaseStepTest)
}  // namespace extremal::phase_step_test

#include "phase_step_test.moc"
