// SPDX-License-Identifier: GPL-3.0-or-later
/// The affine symmetries of Lagrangians whose symmetries are known, and their momenta along schemes.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/core/work.hpp"
#include "engine/family/kept_momenta.hpp"
#include "engine/model/lagrangian_terms.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/symmetry/conserved.hpp"
#include "engine/symmetry/jumps.hpp"
#include "engine/symmetry/symmetry.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::symmetry_test {
namespace {

System typed(const std::vector<std::string>& coordinates, const std::string& lagrangian) {
    Value::Array names;
    for (const std::string& name : coordinates) names.emplace_back(name);
    return laws::systemNamed(
        "lagrangian",
        {{"coordinates", names}, {"parameters", Value(Value::Object{})}, {"lagrangian", lagrangian}});
}
const std::string kinetic = "(x_t^2 + y_t^2)/2";

/// Masses 1, 2 and 1/2 in the plane.
System threeBodies() {
    return typed({"x1", "y1", "x2", "y2", "x3", "y3"},
                 "(x1_t^2 + y1_t^2)/2 + x2_t^2 + y2_t^2 + (x3_t^2 + y3_t^2)/4"
                 " + 2/sqrt((x1-x2)^2 + (y1-y2)^2) + 0.5/sqrt((x1-x3)^2 + (y1-y3)^2)"
                 " + 1/sqrt((x2-x3)^2 + (y2-y3)^2)");
}
/// A uniform field B_z = 1, or what A makes of it, in the plane x-y.
System inField(const std::string& Ax, const std::string& Ay) {
    return typed({"x", "y", "z"}, "(x_t^2 + y_t^2 + z_t^2)/2 + (" + Ax + ")*x_t + (" + Ay + ")*y_t");
}
System inUniformField() { return inField("-y/2", "x/2"); }
/// The same field with grad chi, chi = x^2 y / 2, added to A.
System inCubicGauge() { return inField("-y/2 + x*y", "x/2 + x^2/2"); }

/// Name and generator of each, "; " between them; dependent ones with a star.
std::string allOf(const System& system) {
    std::string text;
    for (const Symmetry& s : *symmetriesOf(system))
        text += (text.empty() ? "" : " | ") + std::string(s.isExact() ? "" : "almost ") + s.name + " " +
                s.generator + (s.isDependent ? " *" : "");
    return text;
}
Symmetry named(const System& system, const std::string& name) {
    for (const Symmetry& s : *symmetriesOf(system))
        if (s.name == name) return s;
    throw std::logic_error("no " + name + " in " + allOf(system));
}

/// x = (q, p) from (q, v).
std::vector<double> startOf(const System& system, std::vector<double> x) {
    std::vector<double> gradient(x.size());
    const Mechanical& m = system.mechanics();
    const auto d = static_cast<std::ptrdiff_t>(system.dimension());
    m.gradient(m.model.get(), 0, x.data(), x.data() + d, gradient.data());
    std::copy(gradient.begin() + d, gradient.end(), x.begin() + d);
    return x;
}

/// The largest change of J over a run, from (q, v).
double driftOf(const System& system, const Symmetry& s, Integrator& integrator, const std::vector<double>& x,
               int steps) {
    State state{0, 0, startOf(system, x), {}};
    const auto d = static_cast<std::size_t>(system.dimension());
    const auto J = [&] {
        return s.momentum(system.mechanics(), state.t, state.x.data(), state.x.data() + d);
    };
    const double start = J();
    double drift = 0;
    for (int k = 0; k < steps; ++k) {
        if (advance(integrator, state).outcome != Outcome::converged) throw std::logic_error("a step failed");
        drift = std::max(drift, std::abs(J() - start));
    }
    return drift;
}
double driftOf(const System& system, const std::string& name, const Discretization& d,
               const std::vector<double>& x, double step, int steps) {
    return driftOf(system, named(system, name), *makeIntegrator(system, d, {0, step}), x, steps);
}
Discretization gauss(int degree, int nodes) {
    return laws::polynomialPair(degree, {"gauss", {{"nodes", static_cast<double>(nodes)}}, {}});
}
const std::vector<double> inFieldStart{1, 0.5, 0, 0.5, 2, 0.3};
const std::vector<double> bodiesStart{1, 0, -0.5, 0.3, 0, -2, 0.1, 0.7, -0.6, -0.4, 0.4, 0.1};

}  // namespace

class SymmetryTest : public QObject {
    Q_OBJECT
private slots:
    void symmetriesAreFoundAndNamed_data() {
        QTest::addColumn<QString>("found");
        QTest::addColumn<QString>("expected");
        const auto row = [](const char* name, const System& system, const char* expected) {
            QTest::newRow(name) << QString::fromStdString(allOf(system)) << QString(expected);
        };
        const std::string aboutOrigin = "rotation.x-y x: -y, y: x", energy = " | energy t: 1";
        const std::string planet = aboutOrigin + energy;
        row("Kepler", typed({"x", "y"}, kinetic + " + 1/sqrt(x^2 + y^2)"), planet.c_str());
        // Derivatives of very different sizes at neighbouring places.
        std::string wild = "x";
        for (int level = 0; level < 5; ++level)
            wild = level % 2 == 0 ? "exp(-(" + wild + ")^2/4+y)" : "sin(" + wild + "*y+cos(" + wild + "))";
        row("a wild function", typed({"x", "y"}, kinetic + " - " + wild), "energy t: 1");
        row("Kepler in SI units",
            typed({"x", "y"}, "5.97e24*(" + kinetic + " + 1.32712440018e20/sqrt(x^2 + y^2))"),
            planet.c_str());
        row("Kepler about (5, -3)", typed({"x", "y"}, kinetic + " + 1/sqrt((x-5)^2 + (y+3)^2)"),
            "rotation.x-y x: -y - 3, y: x - 5 | energy t: 1");
        row("three bodies", threeBodies(),
            "translation.x x1: 1, x2: 1, x3: 1 | translation.y y1: 1, y2: 1, y3: 1 | "
            "rotation.x-y x1: -y1, y1: x1, x2: -y2, y2: x2, x3: -y3, y3: x3 | "
            "boost.x x1: t, x2: t, x3: t; F = x1 + 2 x2 + x3/2 | "
            "boost.y y1: t, y2: t, y3: t; F = y1 + 2 y2 + y3/2 | "
            "linear x1: y2 + y3/4, y1: -x2 - x3/4, x2: y1/2 + y2/2 + y3/4, y2: -x1/2 - x2/2 - x3/4, "
            "x3: y1/2 + y2 - y3/4, y3: -x1/2 - x2 + x3/4 * | energy t: 1");
        row("isotropic oscillator", typed({"x", "y", "z"}, "(x_t^2 + y_t^2 + z_t^2)/2 - (x^2 + y^2 + z^2)/2"),
            "rotation.x-y x: -y, y: x | rotation.x-z x: -z, z: x | rotation.y-z y: -z, z: y | energy t: 1");
        row("masses 1, 4", typed({"x", "y"}, "x_t^2/2 + 2*y_t^2 - (x^2 + 4*y^2)^2"),
            "rotation.x-y x: y, y: -x/4 | energy t: 1");
        const std::string along = "translation.z z: 1 | ", last = " | boost.z z: t; F = z | energy t: 1";
        row("uniform field, symmetric gauge", inUniformField(),
            ("translation.x x: 1; F = y/2 | translation.y y: 1; F = -x/2 | " + along + aboutOrigin + last)
                .c_str());
        row("uniform field, Landau gauge", inField("-y", "0"),
            ("translation.x x: 1 | translation.y y: 1; F = -x | " + along + aboutOrigin +
             "; F = -x^2/2 + y^2/2" + last)
                .c_str());
        row("uniform field, cubic gauge", inCubicGauge(),
            ("translation.x x: 1; F = x y + y/2 | translation.y y: 1; F = -x/2 + x^2/2 | " + along +
             aboutOrigin + "; F = x^3/2 - x y^2" + last)
                .c_str());
        row("field B = r", inField("-y*sqrt(x^2 + y^2)/3", "x*sqrt(x^2 + y^2)/3"),
            (along + aboutOrigin + last).c_str());
        row("periodic Toda chain",
            typed({"q1", "q2", "q3"}, "(q1_t^2 + q2_t^2 + q3_t^2)/2 - exp(q1-q2) - exp(q2-q3) - exp(q3-q1)"),
            "translation.q q1: 1, q2: 1, q3: 1 | boost.q q1: t, q2: t, q3: t; F = q1 + q2 + q3 | energy t: "
            "1");
        row("projectile", typed({"x", "y"}, kinetic + " - 9.81*y"),
            "translation.x x: 1 | translation.y y: 1; F = -9.81 t | boost.x x: t; F = x | "
            "boost.y y: t; F = y - 4.905 t^2 | energy t: 1");
        row("damped oscillator", typed({"q"}, "exp(0.3*t)*(q_t^2 - q^2)/2"), "time q: -3/20 q, t: 1");
        row("potential 1/r^2", typed({"x", "y"}, kinetic + " + 1/(x^2 + y^2)"),
            (aboutOrigin + " | scaling x: x, y: y, t: 2 t" + energy).c_str());
        row("Kepler in polar coordinates", typed({"r", "theta"}, "(r_t^2 + r^2*theta_t^2)/2 + 1/r"),
            "translation.theta theta: 1 | energy t: 1");
        row("spring pendulum without weight", laws::systemNamed("spring-pendulum", {{"g", 0.0}}),
            "translation.theta theta: 1 | energy t: 1");
        row("double pendulum without weight", laws::systemNamed("double-pendulum", {{"g", 0.0}}),
            "translation.theta theta1: 1, theta2: 1 | energy t: 1");
        for (const char* id : {"henon-heiles", "double-pendulum", "spring-pendulum"})
            row(id, laws::systemNamed(id), "energy t: 1");
        // Near the limits of double precision no symmetry is reported that does not exist.
        row("stiffness 1e300", laws::systemNamed("harmonic-oscillator", {{"k", 1e300}}), "");
        row("gravity 1e300", laws::systemNamed("double-pendulum", {{"g", 1e300}}), "");
        row("length 1e155", laws::systemNamed("spring-pendulum", {{"l", 1e155}}), "energy t: 1");
        row("a subnormal mass", laws::systemNamed("double-pendulum", {{"l2", 1e-155}}), "energy t: 1");
        row("forced pendulum", typed({"theta"}, "theta_t^2/2 + cos(theta) + 0.3*theta*cos(1.7*t)"), "");
    }
    void symmetriesAreFoundAndNamed() {
        QFETCH(QString, found);
        QFETCH(QString, expected);
        QCOMPARE(found, expected);
    }

    /// What lies outside the places and times where one usually looks.
    void whatIsFarAwayIsSeen_data() {
        QTest::addColumn<QString>("found");
        QTest::addColumn<QString>("expected");
        const auto row = [](const char* name, const System& system, const char* expected) {
            QTest::newRow(name) << QString::fromStdString(allOf(system)) << QString(expected);
        };
        row("pulse at t = 50", typed({"x"}, "x_t^2/2 - x^2/2 + 3*x*exp(-(t-50)^2)"), "");
        row("the same, multiplied out", typed({"x"}, "x_t^2/2 - x^2/2 + 3*x*exp(-t^2 + 100*t - 2500)"), "");
        row("sharp pulse", typed({"x"}, "x_t^2/2 - x^2/2 + x*exp(-1e4*(t-3.37)^2)"), "");
        row("parametric pulse", typed({"x"}, "x_t^2/2 - x^2/2*(1 + exp(-(t-50)^2))"), "");
        row("a time that is written and does not matter", typed({"x"}, "x_t^2/2 - x^2/2 + 0*t"),
            "energy t: 1");
        row("hill at x = 50", typed({"x"}, "x_t^2/2 - exp(-(x-50)^2)"), "energy t: 1");
        row("step at x = -300", typed({"x"}, "x_t^2/2 - tanh((x+300)/0.1)"), "energy t: 1");
        row("resonance", typed({"x"}, "x_t^2/2 - 1/(1 + 1e4*(x-80)^2)^4"), "energy t: 1");
        row("hill at (50, 50)", typed({"x", "y"}, kinetic + " - exp(-(x-50)^2 - (y-50)^2)"),
            "rotation.x-y x: -y + 50, y: x - 50 | energy t: 1");
        row("hill of a distance", typed({"x", "y"}, kinetic + " - exp(-(x-y-50)^2)"),
            "translation.x+y x: 1, y: 1 | boost.x+y x: t, y: t; F = x + y | energy t: 1");
        row("wall around the origin", typed({"x", "y"}, kinetic + " - exp(-(x^2 + y^2 - 2500)^2)"),
            "rotation.x-y x: -y, y: x | energy t: 1");
        row("terms",
            laws::systemNamed("lagrangian",
                              {{"coordinates", Value(Value::Array{"x"})},
                               {"lagrangian", Value(Value::Object{{"kinetic", "x_t^2/2"},
                                                                  {"far", "-exp(-(x-50)^2)"},
                                                                  {"pulse", "x*exp(-(t-90)^2)"}})}}),
            "");
    }
    void whatIsFarAwayIsSeen() {
        QFETCH(QString, found);
        QFETCH(QString, expected);
        QCOMPARE(found, expected);
    }

    /// Their derivatives are those of a free body, or of an oscillator, nearly everywhere.
    void whatMovesAJumpIsNoSymmetry_data() {
        QTest::addColumn<QString>("found");
        QTest::addColumn<QString>("expected");
        const auto row = [](const char* name, const System& system, const char* expected) {
            QTest::newRow(name) << QString::fromStdString(allOf(system)) << QString(expected);
        };
        for (const char* pulse : {"sign(t-50)", "heaviside(t-50)", "if(t<50, 1, 2)", "floor(t/100)",
                                  "table(t; 0, 0; 1, 2; 60, 3)", "mod(t, 1000)"})
            row(pulse, typed({"x"}, std::string("x_t^2/2 - x^2/2 + x*") + pulse), "");
        for (const char* step : {"sign(x-50)", "3*heaviside(x+200)", "floor(x/1000)", "if(x<1e4, 0, 1)",
                                 "round(x)", "sign(x)*if(x > 3 && x < 5, 2, 1)"})
            row(step, typed({"x"}, std::string("x_t^2/2 - ") + step), "energy t: 1");
        const std::string still = "translation.y y: 1 | boost.y y: t; F = y | energy t: 1";
        row("a wall in the plane", typed({"x", "y"}, kinetic + " - heaviside(x-7)"), still.c_str());
        row("a round wall", typed({"x", "y"}, kinetic + " - heaviside(x^2+y^2-90)"),
            "rotation.x-y x: -y, y: x | energy t: 1");
        row("a wall of a distance", typed({"x", "y"}, kinetic + " - sign(x-y-50)"),
            "translation.x+y x: 1, y: 1 | boost.x+y x: t, y: t; F = x + y | energy t: 1");
        // What has no jump after all.
        row("a kink that is none", typed({"x"}, "x_t^2/2 - sign(x)^2"),
            "translation.x x: 1 | boost.x x: t; F = x | scaling x: x, t: 2 t; F = -2 t | energy t: 1");
        row("the larger one", typed({"x", "y"}, kinetic + " - max(x, y)"),
            "translation.x+y x: 1, y: 1; F = -t | boost.x+y x: t, y: t; F = x + y - t^2/2 | energy t: 1");
    }
    void whatMovesAJumpIsNoSymmetry() {
        QFETCH(QString, found);
        QFETCH(QString, expected);
        QCOMPARE(found, expected);
    }

    void aNearSymmetryIsNoMomentum() {
        const System system = typed({"x", "y"}, "x_t^2/2 + 1.000001*y_t^2/2 + 1/sqrt(x^2 + y^2)");
        const Symmetry s = named(system, "rotation.x-y");
        QVERIFY(!s.isExact());
        QVERIFY2(s.defect > 1e-8 && s.defect < 1e-6,
                 qPrintable(QString::number(s.defect)));  // measured: 6.7e-8
        QVERIFY(!hasMomenta(system));
        QVERIFY(momentaOf(system).empty());
        QCOMPARE(symmetryText(system), "translation in time (energy), almost (" + formatNumber(s.defect, 1) +
                                           ") rotation in the plane x-y (x: y, y: -0.999999 x)");
    }

    void manyBodiesAreTriedByName() {
        const System system = laws::systemNamed("outer-solar-system");
        std::string names;
        for (const Symmetry& s : *symmetriesOf(system)) names += s.name + " ";
        QCOMPARE(names, std::string("translation.x translation.y translation.z rotation.x-y rotation.x-z "
                                    "rotation.y-z boost.x boost.y boost.z energy "));
        // Its files have the columns that they always had.
        QCOMPARE(momentaOf(system).front().name, std::string("linear.x"));
        QCOMPARE(momentaOf(system).size(), std::size_t(6));
    }

    void momentaAreColumnsOfTypedSystems() {
        const auto namesOf = [](const System& system) {
            std::string names;
            for (const ConservedMomentum& m : momentaOf(system)) names += m.name + " ";
            return names;
        };
        QCOMPARE(namesOf(typed({"x", "y"}, kinetic + " + 1/sqrt(x^2 + y^2)")), std::string("rotation.x-y "));
        QCOMPARE(namesOf(threeBodies()),
                 std::string("translation.x translation.y rotation.x-y boost.x boost.y "));
        QCOMPARE(namesOf(typed({"r", "phi"}, "(r_t^2 + r^2*phi_t^2)/2 + 1/r")), std::string("phi "));
        QCOMPARE(namesOf(inField("-y", "0")), std::string("x z translation.y rotation.x-y boost.z "));
        QVERIFY(!hasMomenta(typed({"x"}, "x_t^2/2 - x^2/2")));
    }

    void whatIsSaidToBeKeptIsKept_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<int>("nodes");
        QTest::addColumn<bool>("isLobatto");
        for (int s = 1; s <= 3; ++s)
            for (const int nodes : {s, s + 1, s + 2})
                QTest::addRow("Gauss, degree %d, %d nodes", s, nodes) << s << nodes << false;
        for (int s = 1; s <= 3; ++s) QTest::addRow("Lobatto, degree %d", s) << s << s + 1 << true;
    }
    /// Every symmetry of three systems: kept to round-off where the rule of kept.hpp says so, and not where F
    /// is of a degree that the quadrature rule misses.
    void whatIsSaidToBeKeptIsKept() {
        QFETCH(int, degree);
        QFETCH(int, nodes);
        QFETCH(bool, isLobatto);
        const Discretization d =
            isLobatto ? laws::polynomialPair(degree, {"lobatto", {{"nodes", static_cast<double>(nodes)}}, {}})
                      : gauss(degree, nodes);
        struct Motion {
            System system;
            std::vector<double> x;
            double step;
        };
        for (const Motion& motion :
             {Motion{threeBodies(), bodiesStart, 0.02}, Motion{inUniformField(), inFieldStart, 0.2},
              Motion{inField("-y", "0"), inFieldStart, 0.2}, Motion{inCubicGauge(), inFieldStart, 0.2}}) {
            for (const Symmetry& s : *symmetriesOf(motion.system)) {
                if (s.movesTime()) {
                    QVERIFY(!keeps(d, s, motion.system));
                    continue;
                }
                const double drift = driftOf(
                    motion.system, s, *makeIntegrator(motion.system, d, {0, motion.step}), motion.x, 100);
                const std::string text = s.name + ": " + formatNumber(drift, 3);
                if (keeps(d, s, motion.system))
                    QVERIFY2(drift <= 1e-13, text.c_str());  // measured: at most 2.9e-14
                else
                    QVERIFY2(drift > 1e-12, text.c_str());  // measured: at least 4.7e-12
            }
        }
    }

    void aGaugeThatIsNotQuadraticCostsTheMomentumUntilNodesAreAdded() {
        const System plain = inUniformField(), cubic = inCubicGauge();
        const auto drift = [&](const System& system, int degree, int nodes) {
            return driftOf(system, "rotation.x-y", gauss(degree, nodes), inFieldStart, 0.2, 200);
        };
        for (int s = 1; s <= 3; ++s) QVERIFY(drift(plain, s, s) <= 1e-13);  // measured: 2.7e-15 for s = 2
        QVERIFY(drift(cubic, 1, 1) > 1e-3);                                 // measured: 1.9e-2
        QVERIFY(drift(cubic, 2, 2) > 1e-6);                                 // measured: 8.8e-5
        QVERIFY(drift(cubic, 3, 3) > 1e-9);                                 // measured: 6.1e-8
        QVERIFY(drift(cubic, 1, 2) <= 1e-13);                               // measured: 2.8e-14
        QVERIFY(drift(cubic, 2, 3) <= 1e-13);                               // measured: 1.4e-14
        QVERIFY(drift(cubic, 3, 5) <= 1e-13);                               // measured: 2.8e-14
    }

    /// Of many coordinates candidates alone are tried, and a few places tell whether constraints stay: a
    /// chain of 200 links once held a reading for minutes.
    void constraintsOfLongChainsAreSeenAtAFewPlaces() {
        const System chain = *readScene(findPreset("chain-20")->json).resolved->system;
        const std::vector<Jump> relations = relationsOf(chain, false);
        QCOMPARE(relations.size(), std::size_t(16 * 20));
        // Of a rod the two balls at its ends alone.
        for (const Jump& relation : relations) {
            const auto nonzero = [](double x) { return x != 0; };
            QVERIFY(std::count_if(relation.gradient.begin(), relation.gradient.end(), nonzero) <= 4);
        }
        // A translation moves the pivot; the energy is all that is left.
        const auto found = symmetriesBesideForces(chain, false);
        QCOMPARE(found->size(), std::size_t(1));
        QVERIFY(found->front().tau0 != 0);
    }

    void rungeKuttaKeepsWhatIsLinear() {
        const System system = threeBodies();
        const auto rk4 = findBaseline("rk4")->make(system, {0.02, {0, 0, {}, {}}, 0, {}});
        const auto drift = [&](const char* name) {
            return driftOf(system, named(system, name), *rk4, bodiesStart, 200);
        };
        QVERIFY(drift("translation.x") <= 1e-14);
        QVERIFY(drift("boost.x") <= 1e-13);
        QVERIFY(drift("rotation.x-y") > 1e-10);
    }
    /// A scene is read within a budget of operations: those of a formula at many states are counted as well.
    void evaluationsAtStatesAreCounted() {
        const auto spentOn = [](const char* range) {
            const System system = laws::systemNamed(
                "lagrangian",
                {{"coordinates", Value(Value::Array{Value("x"), Value("y")})},
                 {"parameters", Value(Value::Object{})},
                 {"lagrangian", kinetic + " - sum(j, 1.." + range + ", sqrt((x - j)^2 + y^2))"}});
            const work::Account account(1e12);
            symmetriesOf(system);
            return account.spent();
        };
        const double few = spentOn("20"), many = spentOn("400");
        QVERIFY2(many > few + 1e6,  // 3.9e6
                 qPrintable(QString("%1, %2").arg(few).arg(many)));
    }
    /// Every reader of the same terms has the same ones, as making them differentiates each.
    void termsAreMadeOnce() {
        for (const char* id : {"averaged-rotations", "spring-pendulum", "fput-chain"}) {
            const ReadScene scene = readScene(findPreset(id)->json);
            QVERIFY(scene.resolved);
            const auto& mechanics = scene.resolved->system->mechanics();
            const auto first = termsOf(mechanics), again = termsOf(mechanics);
            QVERIFY2(first.size() > 1 && first.size() == again.size(), id);
            for (std::size_t k = 0; k < first.size(); ++k) QVERIFY2(first[k].model == again[k].model, id);
        }
    }
};

EXTREMAL_TEST(SymmetryTest)

}  // namespace extremal::symmetry_test

#include "symmetry_test.moc"
