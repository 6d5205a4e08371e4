// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps in blocks of what is coupled: the same motion as with full matrices, for chains, trees, loops,
/// forces and Lagrangians that are not separable; and work that grows with the number of bodies alone.
#include <QTest>

#include <cmath>
#include <numbers>

#include "engine/family/table_of.hpp"
#include "engine/mechanism/mechanism_step.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/engine/mechanism/mechanisms.hpp"
#include "tests/tools/test.hpp"

namespace extremal::mechanism_test {
namespace linked_step_test {

std::string name(const char* letter, int i) { return letter + std::to_string(i); }

/// Links of length 1 and balls of mass 1, let go at 30 degrees.
Mechanical chain(int links, const Value::Object& forces = {}) {
    Value::Array coordinates;
    Value::Object rods;
    std::string lagrangian;
    std::vector<double> q;
    for (int i = 1; i <= links; ++i) {
        const std::string x = name("x", i), y = name("y", i);
        coordinates.push_back(x);
        coordinates.push_back(y);
        lagrangian += (i > 1 ? "+(" : "(") + x + "_t^2+" + y + "_t^2)/2-9.81*" + y;
        rods.push_back({name("rod", i), i == 1 ? "x1^2+y1^2-1"
                                               : "(" + x + "-" + name("x", i - 1) + ")^2+(" + y + "-" +
                                                     name("y", i - 1) + ")^2-1"});
        q.push_back(i * std::sin(std::numbers::pi / 6));
        q.push_back(-i * std::cos(std::numbers::pi / 6));
    }
    return startAt(typed(coordinates, lagrangian, rods, forces), q, std::vector<double>(q.size(), 0.0));
}

/// Two arms of two links on a body that hangs from the origin.
Mechanical tree() {
    return startAt(typed({"a", "b", "c", "d", "e", "f", "g", "h", "i", "j"},
                         "(a_t^2+b_t^2+c_t^2+d_t^2+e_t^2+f_t^2+g_t^2+h_t^2+i_t^2+j_t^2)/2 - 9.81*(b+d+f+h+j)",
                         {{"trunk", "a^2+b^2-1"},
                          {"left", "(c-a)^2+(d-b)^2-1"},
                          {"right", "(e-a)^2+(f-b)^2-1"},
                          {"end", "(g-c)^2+(h-d)^2-1"},
                          {"tip", "(i-e)^2+(j-f)^2-1"}}),
                   {0, -1, -1, -1, 1, -1, -1, -2, 1, 0}, std::vector<double>(10, 0.0));
}

/// A four-bar and a pendulum on it: one rod closes the loop, with masses that a spring couples.
Mechanical loop() {
    return startAt(typed({"a", "b", "c", "d", "u", "w"},
                         "(a_t^2+b_t^2+2*c_t^2+2*d_t^2+u_t^2+w_t^2)/2 - 9.81*(b+2*d+w) - 5*((u-a)^2+(w-b)^2) "
                         "+ 0.1*a*c_t",
                         {{"crank", "a^2+b^2-1"},
                          {"coupler", "(c-a)^2+(d-b)^2-4"},
                          {"rocker", "(c-2)^2+d^2-2.25"},
                          {"hanger", "(u-c)^2+(w-d)^2-0.25"}},
                         {{"a", "-0.3*a_t+0.2*sin(t)"}, {"u", "-0.1*(u_t-c_t)"}}),
                   {0.2, 0.98, 2.1, 1.5, 2.1, 1.0}, {0, 0, 0, 0, 0, 0});
}

struct Comparison {
    double distance = 0;
    std::string about;
};
Comparison compare(const Mechanical& of, const std::string& scheme, double step, int steps) {
    const Discretization d = *namedScheme(scheme);
    Comparison made;
    std::vector<State> ends;
    for (const LinkedAlgebra algebra : {LinkedAlgebra::never, LinkedAlgebra::always}) {
        const auto integrator = makeMechanismStep(of.system.parts, tableOf(d.space, d.quadrature), {}, step,
                                                  SolverPolicy{}, algebra);
        State s = of.start;
        for (int i = 0; i < steps; ++i)
            if (advance(*integrator, s).outcome != Outcome::converged) qFatal("a step failed");
        ends.push_back(s);
        made.about = integrator->about();
    }
    const Distance apart = distance(ends[0], ends[1]);
    made.distance = std::max(apart.q, apart.p);
    return made;
}

class LinkedStepTest : public QObject {
    Q_OBJECT
private slots:
    /// Measured 2e-14 for chains, 1e-14 else; places are of size 20.
    void blocksAndFullMatricesAgree_data() {
        QTest::addColumn<QString>("mechanism");
        QTest::addColumn<QString>("scheme");
        for (const char* mechanism : {"chain", "damped chain", "tree", "loop", "torus", "winch"})
            for (const char* scheme :
                 {"midpoint", "galerkin-gauss-2", "galerkin-gauss-3", "galerkin-lobatto-2"})
                QTest::addRow("%s, %s", mechanism, scheme) << mechanism << scheme;
    }
    void blocksAndFullMatricesAgree() {
        QFETCH(QString, mechanism);
        QFETCH(QString, scheme);
        const Mechanical of = mechanism == "chain" ? chain(20)
                              : mechanism == "damped chain"
                                  ? chain(6, {{"x3", "-0.4*x3_t"}, {"y6", "sin(t)*x5"}})
                              : mechanism == "tree"  ? tree()
                              : mechanism == "loop"  ? loop()
                              : mechanism == "torus" ? chargeOnTorus()
                                                     : winch();
        const Comparison made = compare(of, scheme.toStdString(), 0.005, 100);
        qInfo("apart by %.1e; %s", made.distance, made.about.c_str());
        QVERIFY(made.distance < 1e-12);
        QVERIFY(!made.about.empty());
    }

    /// Where there are few coordinates, what was there before.
    void fewCoordinatesHaveAFullMatrix() {
        QVERIFY(!Mechanism(doublePendulum().system.parts).linked());
        QVERIFY(!Mechanism(sphericalPendulum().system.parts).linked());
        QVERIFY(Mechanism(chain(6).system.parts).linked());
    }
    /// Bodies in gimbals, one of which is welded to another: blocks, with a constraint in the border.
    void bodiesInSpaceHaveBlocks() {
        for (const char* preset : {"gimbal-gyroscope", "body-chain"}) {
            const ReadScene scene = readScene(findPreset(preset)->json);
            const Mechanical of{*scene.resolved->system, scene.resolved->initial};
            QVERIFY2(Mechanism(of.system.parts).linked(), preset);
            const Comparison made = compare(of, "midpoint", 0.01, 10);
            qInfo("%s: apart by %.1e; %s", preset, made.distance, made.about.c_str());
            QVERIFY(made.distance < 1e-12);
        }
    }

    /// Arithmetic, and not time: each link of a chain takes the same, whatever their number.
    void theWorkOfAChainGrowsWithItsLength() {
        const Linkage ten(*LinkedParts::of(chain(10).system.parts)),
            thirty(*LinkedParts::of(chain(30).system.parts));
        for (const int m : {1, 2, 3}) {
            const double perLink = (thirty.solver(m).work() - ten.solver(m).work()) / 20;
            // One block of 3 m, and one neighbour: n^3 / 3 + n^3 + n^3.
            QCOMPARE(perLink, 27.0 * m * m * m * 7 / 3);
        }
    }

    /// The rod that closes a loop is the border, of as many unknowns as the degree.
    void aLoopHasABorder() {
        const Linkage linkage(*LinkedParts::of(loop().system.parts));
        QCOMPARE(linkage.solver(2).blocks(), 4);
    }

    void dependentConstraintsAreNamedInChains() {
        const Mechanical of = chain(6);
        Mechanism mechanism(of.system.parts);
        QVERIFY(mechanism.linked());
        QVERIFY(mechanism.rank(0, of.start.x.data()).ratio > 1e-3);
        Value::Object rods{{"rod1", "x1^2+y1^2-1"}, {"again", "2*x1^2+2*y1^2-2"}};
        const System twice = typed({"x1", "y1", "x2", "y2"}, "(x1_t^2+y1_t^2+x2_t^2+y2_t^2)/2", rods);
        Mechanism redundant(twice.parts, LinkedAlgebra::always);
        const double q[] = {0.6, -0.8, 1, 1};
        const Mechanism::Rank rank = redundant.rank(0, q);
        QVERIFY(rank.ratio < 1e-7);
        QCOMPARE(rank.dependent, 1);
    }
};

EXTREMAL_TEST(LinkedStepTest)
}  // namespace linked_step_test
}  // namespace extremal::mechanism_test
#include "linked_step_test.moc"
