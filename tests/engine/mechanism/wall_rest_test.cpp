// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies at rest on walls: they slide as a constraint lets them, and leave where the wall would have to
/// pull, at places and times that are known otherwise.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/scene/write/codec.hpp"
#include "tests/engine/mechanism/mechanisms.hpp"
#include "tests/tools/test.hpp"

namespace extremal::wall_rest_test {
namespace {

using mechanism_test::distance;
using mechanism_test::Ending;
using mechanism_test::Mechanical;
using mechanism_test::run;
using mechanism_test::startAt;
using mechanism_test::typedWith;

constexpr double g = 9.81;
const char* const weight = "(x_t^2+y_t^2)/2 - 9.81*y";

Value wall(const std::string& gap, double restitution) {
    return Value::Object{{"gap", gap}, {"restitution", restitution}};
}

/// Times at which a body has come to rest or has left a wall: impacts without an impulse.
struct Watched {
    std::vector<Impact> changes;
    State end;
    bool isDone = true;
};
Watched watch(const Mechanical& of, const std::string& scheme, double end, int steps) {
    const auto integrator = makeIntegrator(of.system, *namedScheme(scheme), {0, end / steps});
    Watched w;
    w.end = of.start;
    for (int i = 0; i < steps && w.isDone; ++i) {
        w.isDone = advance(*integrator, w.end).outcome == Outcome::converged;
        for (const Impact& impact : integrator->impacts())
            if (impact.impulse == 0) w.changes.push_back(impact);
    }
    return w;
}

}  // namespace

class WallRestTest : public QObject {
    Q_OBJECT
private slots:
    /// A body that starts in a bowl slides as it does under the constraint.
    void aBodySlidesAsUnderAConstraint() {
        const std::vector<double> q{0.7, 0.49}, v{0, 0};
        const Mechanical resting =
            startAt(typedWith({"x", "y"}, weight, {{"walls", Value::Object{{"bowl", "y - x^2"}}}}), q, v);
        const Mechanical held = startAt(
            typedWith({"x", "y"}, weight, {{"constraints", Value::Object{{"bowl", "y - x^2"}}}}), q, v);
        for (const char* scheme : {"galerkin-gauss-1", "galerkin-gauss-2", "galerkin-lobatto-2"}) {
            const Ending a = run(resting, scheme, 5, 100), b = run(held, scheme, 5, 100);
            QVERIFY(a.outcome == Outcome::converged);
            qInfo("%s: q %.1e, p %.1e", scheme, distance(a.state, b.state).q, distance(a.state, b.state).p);
            QVERIFY(distance(a.state, b.state).q < 1e-12 && distance(a.state, b.state).p < 1e-12);
            QVERIFY(std::abs(a.state.x[1] - a.state.x[0] * a.state.x[0]) < 1e-14);
        }
    }
    /// On a slope, after its impacts: s'' = g sin a along it.
    void aBallComesToRestOnASlope() {
        const double s = 0.389418, c = 0.921061, unit = std::hypot(s, c);
        const std::string gap = "0.389418*x + 0.921061*y";
        const Mechanical of =
            startAt(typedWith({"x", "y"}, weight, {{"walls", Value::Object{{"slope", wall(gap, 0.5)}}}}),
                    {0, 1}, {0, 0});
        const Watched w = watch(of, "galerkin-gauss-2", 6, 120);
        QVERIFY(w.isDone);
        QCOMPARE(w.changes.size(), std::size_t{1});
        const double across = (s * w.end.x[0] + c * w.end.x[1]) / unit,
                     along = (c * w.end.x[0] - s * w.end.x[1]) / unit;
        const double slid = (-s + g * s * 36 / 2) / unit;
        qInfo("still %.1e too early, across %.1e, along %.1e", 3 * std::sqrt(2 / g) - w.changes[0].t, across,
              along - slid);
        QVERIFY(std::abs(w.changes[0].t - 3 * std::sqrt(2 / g)) < 1e-9);
        QVERIFY(std::abs(across) < 1e-12 && std::abs(along - slid) < 1e-11);
    }
    /// From the top of a ball with the speed v it leaves at the height (2 + v^2/g)/3.
    void itLeavesABallAtAKnownHeight_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("order");
        QTest::addColumn<int>("steps");
        QTest::newRow("midpoint") << "galerkin-gauss-1" << 2 << 40;
        QTest::newRow("Gauss 2") << "galerkin-gauss-2" << 4 << 20;
        QTest::newRow("Gauss 3") << "galerkin-gauss-3" << 6 << 10;
        QTest::newRow("Lobatto 2") << "galerkin-lobatto-2" << 4 << 20;
    }
    void itLeavesABallAtAKnownHeight() {
        QFETCH(QString, scheme);
        QFETCH(int, order);
        QFETCH(int, steps);
        const double v = 1;
        const Mechanical of = startAt(
            typedWith({"x", "y"}, weight, {{"walls", Value::Object{{"ball", "x^2+y^2-1"}}}}), {0, 1}, {v, 0});
        const double y = (2 + v * v / g) / 3, x = std::sqrt(1 - y * y);
        const double speed = std::sqrt(v * v + 2 * g * (1 - y));
        // The time to there: the integral of d(angle) / angle', by many midpoints.
        double left = 0;
        const int parts = 2000000;
        for (int i = 0; i < parts; ++i) {
            const double angle = std::acos(y) * (i + 0.5) / parts;
            left += std::acos(y) / parts / std::sqrt(v * v + 2 * g * (1 - std::cos(angle)));
        }
        const double end = 0.7, t = end - left;
        const double exact[] = {x + speed * y * t, y - speed * x * t - g * t * t / 2, speed * y,
                                -speed * x - g * t};
        double q[2]{}, p[2]{};
        for (const double many : {1.0, 1.1, 1.2, 1.3, 1.4})
            for (const int halvings : {0, 1}) {
                const Watched w =
                    watch(of, scheme.toStdString(), end, static_cast<int>(steps * many) << halvings);
                QVERIFY(w.isDone);
                QCOMPARE(w.changes.size(), std::size_t{2});
                q[halvings] = std::hypot(q[halvings], w.end.x[0] - exact[0], w.end.x[1] - exact[1]);
                p[halvings] = std::hypot(p[halvings], w.end.x[2] - exact[2], w.end.x[3] - exact[3]);
            }
        const double ofQ = std::log2(q[0] / q[1]), ofP = std::log2(p[0] / p[1]);
        qInfo("errors of q %.1e, of p %.1e; orders %.2f, %.2f", q[1], p[1], ofQ, ofP);
        QVERIFY(std::abs(ofQ - order) < 0.5 && std::abs(ofP - order) < 0.5);
    }
    /// A control that grows lifts a body off the table when it is as large as the weight.
    void aControlLiftsIt() {
        const Value::Object parts{{"walls", Value::Object{{"table", wall("y", 0.3)}}},
                                  {"forces", Value::Object{{"y", "4*t"}}}};
        const Mechanical of = startAt(typedWith({"y"}, "y_t^2/2 - 9.81*y", parts), {0}, {0});
        const Watched w = watch(of, "galerkin-gauss-2", 4, 33);
        QVERIFY(w.isDone);
        QCOMPARE(w.changes.size(), std::size_t{2});
        const double lifted = g / 4, t = 4 - lifted;
        qInfo("leaves %.1e too late", w.changes[1].t - lifted);
        QVERIFY(std::abs(w.changes[1].t - lifted) < 1e-12);
        QVERIFY(std::abs(w.end.x[0] - 4 * t * t * t / 6) < 1e-10);
        QVERIFY(std::abs(w.end.x[1] - 4 * t * t / 2) < 1e-10);
    }
    /// A table that shakes lets the body go when it falls faster than the body does.
    void aTableThatShakes() {
        const Mechanical of =
            startAt(typedWith({"y"}, "y_t^2/2 - 9.81*y",
                              {{"walls", Value::Object{{"table", wall("y - 0.5*sin(6*t)", 0)}}}}),
                    {0}, {3});
        const auto integrator = makeIntegrator(of.system, *namedScheme("galerkin-gauss-3"), {0, 0.01});
        State s = of.start;
        std::vector<double> changes;
        while (changes.size() < 2 && s.t < 1) {
            QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
            for (const Impact& impact : integrator->impacts()) changes.push_back(impact.t);
        }
        QVERIFY(changes.size() >= 2);
        const double lifted = std::asin(g / (0.5 * 36)) / 6;  // 0.5 * 36 sin(6 t) = g
        qInfo("leaves %.1e too late", changes[1] - lifted);
        QVERIFY(std::abs(changes[1] - lifted) < 1e-8);
    }
    /// In a corner it rests on two walls, leaves the one that a force pulls it from, and stays on the other.
    void aCorner() {
        const Value::Object parts{
            {"walls", Value::Object{{"floor", wall("y", 0.5)}, {"side", wall("x", 0.5)}}},
            {"forces", Value::Object{{"x", "3*(t-1)"}}}};
        const Mechanical of = startAt(typedWith({"x", "y"}, weight, parts), {0, 0}, {0, 0});
        const Watched w = watch(of, "galerkin-gauss-2", 2, 30);
        QVERIFY(w.isDone);
        QCOMPARE(w.changes.size(), std::size_t{3});
        QCOMPARE(w.changes[2].wall, 1);
        QVERIFY(std::abs(w.changes[2].t - 1) < 1e-12);
        QVERIFY(std::abs(w.end.x[0] - 0.5) < 1e-12 && std::abs(w.end.x[1]) < 1e-14);
    }
    /// Two walls that say the same of a body: it rests on one of them.
    void twoWallsInOnePlace() {
        const Value::Object parts{{"walls", Value::Object{{"a", wall("y", 0.5)}, {"b", wall("2*y", 0.5)}}}};
        const Mechanical of = startAt(typedWith({"x", "y"}, weight, parts), {0, 0}, {1, 0});
        const Ending r = run(of, "galerkin-gauss-2", 3, 30);
        QVERIFY(r.outcome == Outcome::converged);
        QVERIFY(std::abs(r.state.x[0] - 3) < 1e-13 && std::abs(r.state.x[1]) < 1e-14);
    }
    /// A pendulum that falls onto a table: a constraint of its own and the wall.
    /// A ball on a spring below a bar leaves the floor so slowly that only the dense output goes back into
    /// it. Each step ends at its node, and is of its order: the search was repeated a thousand times, and its
    /// end was taken for the node.
    void leavingSlowlyEndsAtTheNode() {
        const ReadScene read =
            readScene(std::string_view(R"json({"extremal":1,"model":{"type":"mechanism","gravity":9.81,
            "points":{"A":{"at":[0,1],"fixed":true},"B":{"body":"bar","at":[-0.707106781187,0]},
                      "C":{"body":"bar","at":[0.707106781187,0]},"D":{"mass":1,"at":[1.5,0]}},
            "bodies":{"bar":{"mass":1,"inertia":0.1666667,"at":[0.5,0.5],"angle":-0.785398163397448}},
            "pins":{"pin":{"from":"B","to":"A"}},"springs":{"s":{"from":"C","to":"D","stiffness":100}},
            "dampers":{"d":{"from":"C","to":"D","damping":1}},
            "walls":{"floor":{"through":[0.5,-0.5],"normal":[0,1],"restitution":0.5}}},
            "time":{"end":2},"schemes":[{"label":"G2","step":0.02,"scheme":"galerkin-gauss-2"}]})json"));
        QVERIFY(read.resolved);
        const auto end = [&](int steps) {
            const auto integrator =
                makeIntegrator(*read.resolved->system, *namedScheme("galerkin-gauss-2"), {0, 2.0 / steps});
            State state = read.resolved->initial;
            long long evaluations = 0;
            for (int i = 0; i < steps; ++i) {
                const StepReport report = advance(*integrator, state);
                if (report.outcome != Outcome::converged) return Ending{report.outcome, state};
                evaluations += report.cost.evaluations;
            }
            qInfo("%d steps: t = %.17g, %lld evaluations", steps, state.t, evaluations);
            // With a matrix that is kept, 11 to 63 of them a step.
            return Ending{evaluations < 100LL * steps ? Outcome::converged : Outcome::stepBudget, state};
        };
        const Ending coarse = end(100), fine = end(400), exact = end(2000);
        for (const Ending* each : {&coarse, &fine, &exact}) {
            QVERIFY(each->outcome == Outcome::converged);
            QCOMPARE(each->state.t, 2.0);
        }
        const auto a = distance(coarse.state, exact.state), b = distance(fine.state, exact.state);
        qInfo("q %.1e %.1e, p %.1e %.1e: orders %.2f %.2f", a.q, b.q, a.p, b.p, std::log2(a.q / b.q) / 2,
              std::log2(a.p / b.p) / 2);
        QVERIFY(std::log2(a.q / b.q) / 2 > 3.5 && std::log2(a.p / b.p) / 2 > 3.5);
    }
    void aRodThatComesToRest() {
        const Value::Object parts{{"constraints", Value::Object{{"rod", "x^2+y^2-1"}}},
                                  {"walls", Value::Object{{"table", wall("y + 0.5", 0.4)}}}};
        const Mechanical of = startAt(typedWith({"x", "y"}, weight, parts), {1, 0}, {0, 0});
        double missing[2];
        for (const int halvings : {0, 1}) {
            const Ending r = run(of, "galerkin-gauss-2", 5, 250 << halvings);
            QVERIFY(r.outcome == Outcome::converged);
            QVERIFY(std::abs(r.state.x[1] + 0.5) < 1e-12 && std::abs(r.state.x[3]) < 1e-12);
            // All its energy but that of the height of the table is lost in impacts and in coming to rest.
            missing[halvings] = std::abs(-g * 0.5 - r.work);
        }
        qInfo("balance %.1e, %.1e", missing[0], missing[1]);
        QVERIFY(missing[1] < 1e-7 && missing[0] > 10 * missing[1]);
    }
};

EXTREMAL_TEST(WallRestTest)
}  // namespace extremal::wall_rest_test
#include "wall_rest_test.moc"
