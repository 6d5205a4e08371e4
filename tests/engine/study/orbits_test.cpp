// SPDX-License-Identifier: GPL-3.0-or-later
/// Orbits that close, against periods computed by other routes.
#include <QTest>

#include <boost/math/special_functions/ellint_1.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/orbits/orbit_request.hpp"
#include "engine/study/orbits/periodic_orbit.hpp"
#include "tests/tools/pointer_of.hpp"
#include "tests/tools/test.hpp"

namespace extremal::orbits_test {
namespace {

constexpr double pi = std::numbers::pi;

ResolvedScene sceneOf(const std::string& text) {
    const ReadScene read = readScene(text);
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return *read.resolved;
}

std::string textOf(const std::string& model, const std::string& initial, const std::string& scheme,
                   const std::string& end = "20") {
    return R"({"extremal":1,"model":)" + model + R"(,"initial":)" + initial + R"(,"time":{"end":)" + end +
           R"(},"schemes":[)" + scheme + "]}";
}

/// The straight orbit of Hénon and Heiles, `part` away from the energy 1/12, with 48 steps.
ResolvedScene straight(double part = 0) {
    return sceneOf(textOf(R"({"type":"henon-heiles"})",
                          R"({"q":[0,0],"p":[0,)" + std::to_string((1 + part) * std::sqrt(1. / 6)) + "]}",
                          R"({"step":0.14378424198625,"scheme":"galerkin-gauss-4"})"));
}
/// Its period: 2 int dy / sqrt(2 E - y^2 + 2 y^3 / 3) between the two smaller roots of the cubic, which is an
/// elliptic integral.
double straightPeriod(double E) {
    // y^3 - 3/2 y^2 + 3 E = 0, y = 1/2 + r cos a: r = 1, cos 3 a = 1 - 12 E.
    const double a = std::acos(1 - 12 * E) / 3;
    const double high = 0.5 + std::cos(a), middle = 0.5 + std::cos(a - 2 * pi / 3),
                 low = 0.5 + std::cos(a + 2 * pi / 3);
    const double k = std::sqrt((middle - low) / (high - low));
    return 2 * std::sqrt(1.5) * 2 * boost::math::ellint_1(k) / std::sqrt(high - low);
}

const char* const pendulum = R"({"type":"pendulum","m":1,"l":1,"g":1})";
const char* const gauss8 = R"({"step":0.1,"scheme":"galerkin-gauss-4"})";
/// V = 1 - cos: from rest at the angle a.
double pendulumPeriod(double a) { return 4 * boost::math::ellint_1(std::sin(a / 2)); }

std::string messageOf(const ResolvedScene& scene, const OrbitRequest& request) {
    try {
        const OrbitAnswer answer = seekOrbit(scene, request);
        return answer.problem;
    } catch (const InvalidScene& e) {
        return e.problems().front().pointer + ": " + e.problems().front().message;
    }
}

}  // namespace

class OrbitsTest : public QObject {
    Q_OBJECT
private slots:
    void theStraightOrbitHasItsDigits() {
        // 3 % off in momentum and in the period.
        const OrbitAnswer answer = seekOrbit(straight(0.03), {.period = "6.7", .energy = 1. / 12});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        const PeriodicOrbit& orbit = *answer.orbit;
        QVERIFY(std::abs(straightPeriod(1. / 12) - 6.901643615339) < 1e-12);  // published
        QVERIFY(std::abs(orbit.period - 6.901643615340) < 2e-12);             // 1e-12 with 47 steps
        QVERIFY(orbit.gap < 4e-15);
        QVERIFY(std::abs(orbit.trace - 2 - 1.322086765878) < 1e-9);
        QVERIFY(std::abs(orbit.energy - 1. / 12) < 1e-15);
        QVERIFY(std::abs(answer.periodBias) < 3e-12);
        QCOMPARE(answer.stability, OrbitStability::elliptic);
    }
    /// A wrong tangent map gives the same orbit, by more steps: each gap is the square of the one before.
    void newtonsMethodIsQuadratic() {
        const OrbitAnswer answer = seekOrbit(straight(0.03), {.period = "6.7", .energy = 1. / 12});
        const std::vector<double>& closes = answer.closes;
        QVERIFY2(closes.size() <= 7, std::to_string(closes.size()).c_str());
        for (std::size_t k = 1; k < closes.size(); ++k)
            QVERIFY(closes[k] <= 20 * closes[k - 1] * closes[k - 1] + 1e-14);
    }
    void theFamilyOfTheStraightOrbitReachesItsEnd() {
        const OrbitAnswer answer =
            seekOrbit(straight(), {.period = "6.9", .follow = "energy=0.125", .points = 10});
        QVERIFY2(answer.family.end.empty(), answer.family.end.c_str());
        for (const OrbitRow& row : answer.family.rows)
            QVERIFY(std::abs(row.orbit.period - straightPeriod(row.value)) < 2e-11);
        const OrbitRow& last = answer.family.rows.back();
        QCOMPARE(last.value, 0.125);
        QVERIFY(std::abs(last.orbit.period - 7.543259412675) < 1e-11);
        QVERIFY(std::abs(last.orbit.trace - 2 + 1.086944346488) < 1e-8);
    }
    void pendulumsOfAllAmplitudes() {
        const ResolvedScene scene = sceneOf(textOf(pendulum, R"({"q":[0.5],"p":[0]})", gauss8));
        const OrbitAnswer answer = seekOrbit(scene, {.follow = "energy=0.95", .points = 12});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        QVERIFY2(answer.family.end.empty(), answer.family.end.c_str());
        for (const OrbitRow& row : answer.family.rows) {
            const double angle = std::acos(-row.value);  // E = -cos(angle)
            QVERIFY(std::abs(row.orbit.period / pendulumPeriod(angle) - 1) < 1e-7);
        }
    }
    void aTurningPendulumClosesAfterATurn() {
        const ResolvedScene scene = sceneOf(textOf(pendulum, R"({"q":[0],"p":[3]})", gauss8));
        // E = 9/2 - 1, k = 2 / 3: T = 2 K(k) k.
        const double exact = 2 * boost::math::ellint_1(2. / 3) * 2. / 3;
        const OrbitAnswer answer = seekOrbit(scene, {.period = "2.4"});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        QVERIFY(std::abs(answer.orbit->period - exact) < 1e-9);
    }
    void anEquationAlongAConstraintHasTheSameOrbit() {
        const ResolvedScene scene = sceneOf(textOf(
            R"({"type":"lagrangian","coordinates":["x","y"],"lagrangian":"(x_t^2+y_t^2)/2-y",
                "constraints":{"rod":"x^2+y^2-1"}})",
            R"s({"q":["sin(1)","-cos(1)"],"v":[0,0]})s", gauss8));
        const OrbitAnswer answer = seekOrbit(scene, {});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        QVERIFY(std::abs(answer.orbit->period - pendulumPeriod(1)) < 1e-9);
        QCOMPARE(answer.orbit->multipliers.size(), std::size_t{2});
    }
    void vanDerPolsCycle() {
        const ResolvedScene scene =
            sceneOf(textOf(R"({"type":"lagrangian","coordinates":["x"],"lagrangian":"x_t^2/2-x^2/2",
                               "forces":{"x":"(1-x^2)*x_t"}})",
                           R"({"q":[2],"p":[0]})", R"({"step":0.05,"scheme":"galerkin-gauss-4"})"));
        const OrbitAnswer answer = seekOrbit(scene, {});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        const PeriodicOrbit& orbit = *answer.orbit;
        QCOMPARE(answer.kind, OrbitKind::dissipative);
        // Andersen and Geer 1982.
        QVERIFY(std::abs(orbit.period - 6.6632868593231) < 1e-10);
        // One multiplier is 1; the logarithm of the other is the integral of the divergence (Liouville), by
        // the trapezoidal rule, which is spectral here.
        OrbitEquations equations(std::make_shared<const ResolvedScene>(scene), 0, answer.steps);
        std::vector<State> nodes;
        QVERIFY(equations.follow(guessOf(orbit), nodes) == Outcome::converged);
        double sum = 0;
        for (std::size_t k = 1; k < nodes.size(); ++k) sum += 1 - nodes[k].x[0] * nodes[k].x[0];
        const double other = std::exp(sum * orbit.period / static_cast<double>(answer.steps));
        QVERIFY(std::abs(orbit.multipliers[0] - 1.0) < 1e-9);
        QVERIFY(std::abs(orbit.multipliers[1] - other) < 1e-9);
        QCOMPARE(answer.stability, OrbitStability::attracting);
    }
    void predatorsAndPreyComeBack() {
        const ResolvedScene scene =
            sceneOf(textOf(R"s({"type":"phase-space","variables":["x","y"],"one_form":{"x":"log(y)/x"},
                               "hamiltonian":"x-log(x)+y-2*log(y)"})s",
                           R"({"x":[1.5,2.5]})", gauss8));
        const OrbitAnswer answer = seekOrbit(scene, {});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        QVERIFY(answer.orbit->gap < 1e-13);
        QVERIFY(std::abs(answer.periodBias) < 1e-8);
    }
    /// A resonance that bends over: between its two turns there are three motions of one drive.
    void theFamilyGoesRoundItsTurns() {
        const ResolvedScene scene =
            sceneOf(textOf(R"s({"type":"lagrangian","coordinates":["x"],"parameters":{"omega":0.5},
                       "lagrangian":"x_t^2/2-x^2/2-x^4/4+0.3*x*cos(omega*t)","forces":{"x":"-0.1*x_t"}})s",
                           R"({"q":[0.4],"p":[0]})", R"({"step":0.1,"scheme":"galerkin-gauss-3"})"));
        const OrbitAnswer answer =
            seekOrbit(scene, {.period = "2*pi/omega", .follow = "/model/parameters/omega=2.2", .points = 30});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        QCOMPARE(answer.kind, OrbitKind::forced);
        QVERIFY2(answer.family.end.empty(), answer.family.end.c_str());
        int turns = 0, unstable = 0;
        for (const OrbitRow& row : answer.family.rows) {
            turns += row.mark == "turns" ? 1 : 0;
            unstable += row.stability == OrbitStability::unstable ? 1 : 0;
            QVERIFY(row.orbit.gap < 1e-10);
            QVERIFY(std::abs(row.orbit.period * row.value - 2 * pi) < 1e-12);
            // Liouville: the product of the multipliers is exp(-c T) up to the error of the scheme.
            const auto product = row.orbit.multipliers[0] * row.orbit.multipliers[1];
            QVERIFY(std::abs(product / std::exp(-0.1 * row.orbit.period) - 1.0) < 1e-5);
        }
        QCOMPARE(turns, 2);
        QVERIFY(unstable > 0);
    }
    void theSceneOfAnOrbitRunsAndComesBack() {
        const OrbitAnswer answer = seekOrbit(straight(0.03), {.period = "6.7", .energy = 1. / 12});
        const ReadScene read = readScene(answer.scene);
        QVERIFY(read.errors.empty());
        const Comparison comparison = run(read.scene);
        const SchemeResult& result = *comparison.schemes.front();
        QCOMPARE(result.summary.steps, answer.steps);
        for (const char* name : {"q.x", "q.y", "p.x", "p.y"}) {
            const std::span<const double> column = result.trajectory[name];
            QVERIFY(column.size() > 1);
            QVERIFY(std::abs(column.back() - column.front()) < 1e-14);
        }
    }
    void whatCannotBeIsSaid_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("period");
        QTest::addColumn<QString>("hold");
        QTest::addColumn<QString>("follow");
        QTest::addColumn<QString>("message");
        const auto row = [](const char* name, const std::string& text, const char* period, const char* hold,
                            const char* follow, const char* message) {
            QTest::newRow(name) << QString::fromStdString(text) << period << hold << follow << message;
        };
        const std::string swing = R"({"q":[1],"p":[0]})";
        row("steps by a tolerance", textOf(pendulum, swing, R"({"tolerance":1e-8,"baseline":"dopri5"})"), "",
            "", "", "--scheme: \"dopri5\" has steps");
        row("at rest", textOf(pendulum, R"({"q":[0],"p":[0]})", gauss8), "6", "", "",
            "/initial: the start is at rest");
        row("no return", textOf(pendulum, swing, gauss8, "2"), "", "", "",
            "--period: the motion of the scene does not come back");
        row("a body",
            textOf(R"({"type":"rigid-body","inertia":[1,2,3]})", R"({"omega":[0.1,1,0.1]})",
                   R"({"step":0.1,"scheme":"lie-2"})"),
            "6", "", "", "/model/type: periodic orbits are sought of states in coordinates");
        const std::string driven =
            textOf(R"s({"type":"lagrangian","coordinates":["x"],"lagrangian":"x_t^2/2-x^2+x*cos(t)"})s",
                   swing, gauss8);
        row("no period of the drive", driven, "5", "", "", "--period: the equations change with time");
        row("energy held where there is none", driven, "2*pi", "energy", "", "--hold: the equations change");
        row("a family along no energy", driven, "2*pi", "", "energy=2", "--follow: no energy is kept");
        row("an unknown hold", textOf(pendulum, swing, gauss8), "", "angle", "", "--hold: must be energy or");
        row("a family along nothing", textOf(pendulum, swing, gauss8), "", "", "/model/nonsense=2",
            "--follow: /model/nonsense is not in the scene");
        row("an expression without a value", textOf(pendulum, swing, gauss8), "2*pi/nonsense", "", "",
            "--period: ");
    }
    void whatCannotBeIsSaid() {
        QFETCH(QString, text);
        QFETCH(QString, period);
        QFETCH(QString, hold);
        QFETCH(QString, follow);
        QFETCH(QString, message);
        OrbitRequest request;
        request.period = period.toStdString();
        request.hold = hold.toStdString();
        request.follow = follow.toStdString();
        const std::string said = messageOf(sceneOf(text.toStdString()), request);
        QVERIFY2(said.starts_with(message.toStdString()), said.c_str());
    }
    void aMotionThatDoesNotCloseSaysHowNearItCame() {
        const ResolvedScene scene =
            sceneOf(textOf(pendulum, R"({"q":[1],"p":[0]})", R"({"step":0.1,"baseline":"rk4"})"));
        const OrbitAnswer answer = seekOrbit(scene, {});
        // RK4 loses energy at each turn: there is no orbit, and the gap says so.
        QVERIFY(!answer.isFound());
        QVERIFY2(answer.problem.starts_with("the motion closes to"), answer.problem.c_str());
    }
};

EXTREMAL_TEST(OrbitsTest)

}  // namespace extremal::orbits_test

#include "orbits_test.moc"
