// SPDX-License-Identifier: GPL-3.0-or-later
/// Rigid bodies in space: the orders of their steps in places and momenta, the same motion as in the Lie
/// form, what joints and symmetries keep, and refusals that name the element and the remedy.
#include <Eigen/Geometry>
#include <QTest>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/model/parts/written_form.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/scene/write/typed_scene.hpp"
#include "tests/engine/mechanism/mechanisms.hpp"
#include "tests/tools/test.hpp"

namespace extremal::mechanism_test {
namespace assembly_test {

// What moc reads; it does not read texts with braces in them.
class AssemblyTest : public QObject {
    Q_OBJECT
private slots:
    /// On SO(3) in the Lie form; the mechanism converges to it with the order of its scheme.
    void aHeavyTopIsThatOfTheGroup_data();
    void aHeavyTopIsThatOfTheGroup();
    /// Two bodies whose inertia depends on both attitudes, on SO(3) x SO(3).
    void twoBodiesAreThoseOfTheProduct();
    /// Places and momenta against a Runge-Kutta code in the differentiated form.
    void ordersAreTwoS_data();
    void ordersAreTwoS();
    /// Six moments are those of three in other axes.
    void aTensorIsThatOfItsPrincipalAxes();
    /// What is flat has three columns less, and the motion of what is nearly flat.
    void aPlateIsTheLimitOfABody();
    /// Nothing turns bodies in space that are joined to each other alone: their momenta stay.
    void momentaStay();
    /// A motor on a hinge does the same as the torque of the other sign on the other side.
    void aMotorTurnsBothSides();
    void theWrittenFormIsTheSame();
    void whatIsWrongIsSaidWithItsPlace_data();
    void whatIsWrongIsSaidWithItsPlace();
};

#ifndef Q_MOC_RUN
using Vector = Eigen::Vector3d;
using Axes = Eigen::Matrix3d;

std::string textOf(const std::vector<Problem>& problems) {
    std::string all;
    for (const Problem& p : problems) all += p.pointer + ": " + p.message + " (" + p.hint + ")\n";
    return all;
}
ReadScene read(const std::string& keys, const std::string& type = "mechanism-3d") {
    return readScene(parseJson(R"({"extremal": 1, "model": {"type": ")" + type + "\", " + keys +
                               R"(}, "time": {"end": 1}, "schemes": [{"scheme": "galerkin-gauss-2",
                               "step": 0.05}]})"));
}
Mechanical mechanical(const std::string& keys) {
    const ReadScene scene = read(keys);
    if (!scene.errors.empty()) qFatal("%s", textOf(scene.errors).c_str());
    return {*scene.resolved->system, scene.resolved->initial};
}

std::string text(const Vector& v) {
    return "[" + formatNumber(v(0)) + ", " + formatNumber(v(1)) + ", " + formatNumber(v(2)) + "]";
}
Axes turned(const Vector& by) { return Eigen::AngleAxisd(by.norm(), by.normalized()).toRotationMatrix(); }
/// Of the body whose coordinates begin at `first`.
Axes attitudeIn(const State& s, std::size_t first = 0) {
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(s.x.data() + first + 3);
}

/// A chain of bars with unlike moments, let go from a bent pose with spins along what the joints allow.
/// `isFlat`: every second one is a plate.
std::string chain(int bodies, const std::string& joint, bool isFlat = false) {
    std::string list, joints;
    Vector end = Vector::Zero();
    Axes R = Axes::Identity();
    for (int k = 0; k < bodies; ++k) {
        const std::string name = "b" + std::to_string(k);
        // About the axis of the hinge in space, so that its sides agree.
        if (joint == "ball") R = turned(Vector(0.3 + 0.2 * k, 0.5 - 0.1 * k, 0.2));
        const Vector at = end + R * Vector(0.5, 0, 0);
        const Vector turn = joint == "ball" ? Vector(0.3 + 0.2 * k, 0.5 - 0.1 * k, 0.2) : Vector(0, 0, 0);
        list += std::string(k ? ", " : "") + "\"" + name + R"(": {"mass": 1.3, "inertia": )" +
                (isFlat && k % 2 ? "[0.05, 0.11, 0.16]" : "[0.05, 0.11, 0.14]") + R"(, "at": )" + text(at) +
                R"(, "attitude": )" + text(turn) + R"(, "spin": )" +
                (joint == "ball" ? text(Vector(0.4, -0.3 + 0.1 * k, 0.6)) : "[0, 0, 0.7]") + "}";
        joints +=
            std::string(k ? ", " : "") + "\"j" + std::to_string(k) + R"(": {"type": ")" + joint +
            R"(", "body": ")" + name + "\"" +
            (k ? R"(, "to": "b)" + std::to_string(k - 1) + "\"" : std::string()) + R"(, "at": )" + text(end) +
            (joint == "hinge" ? (k % 2 ? R"(, "axis": [0, 1, 0])" : R"(, "axis": [0, 0, 1])") : "") + "}";
        end += R * Vector(1, 0, 0);
    }
    return R"("gravity": 9.81, "bodies": {)" + list + R"(}, "joints": {)" + joints + "}";
}

/// The same scene with its numbers replaced.
std::string topWith(const Vector& turn, const Vector& spin) {
    const Vector at = turned(turn) * Vector(0, 0, 0.6);
    return R"("gravity": 9.81, "bodies": {"top": {"mass": 1, "inertia": [0.64, 0.7, 0.5], "at": )" +
           text(at) + R"(, "attitude": )" + text(turn) + R"(, "spin": )" + text(spin) +
           R"(}}, "joints": {"pivot": {"body": "top"}})";
}

/// The end of a run of a group system by its own step, with steps that leave round-off alone.
State byGroup(const System& system, const State& start, double end, int steps) {
    const auto integrator = makeIntegrator(system, *namedScheme("lie-4"), {0, end / steps});
    State s = start;
    for (int i = 0; i < steps; ++i)
        if (advance(*integrator, s).outcome != Outcome::converged) qFatal("the group step failed");
    return s;
}

void AssemblyTest::aHeavyTopIsThatOfTheGroup_data() {
    QTest::addColumn<int>("degree");
    QTest::addColumn<int>("steps");
    QTest::newRow("1") << 1 << 400;
    QTest::newRow("2") << 2 << 80;
    QTest::newRow("3") << 3 << 40;
}

void AssemblyTest::aHeavyTopIsThatOfTheGroup() {
    QFETCH(int, degree);
    QFETCH(int, steps);
    const Vector turn(0.6, 0.2, 0), spin(0.3, 0.1, 6);
    const ReadScene group = readScene(parseJson(
        R"({"extremal": 1, "model": {"type": "heavy-top", "inertia": [1, 1.06, 0.5], "weight": 9.81,
        "centre": [0, 0, 0.6]}, "initial": {"attitude": [)" +
        formatNumber(std::cos(turn.norm() / 2)) + ", " +
        formatNumber(std::sin(turn.norm() / 2) * turn.normalized()(0)) + ", " +
        formatNumber(std::sin(turn.norm() / 2) * turn.normalized()(1)) + R"(, 0], "omega": )" + text(spin) +
        R"(}, "time": {"end": 1}, "schemes": [{"scheme": "lie-2", "step": 0.1}]})"));
    QVERIFY2(group.errors.empty(), textOf(group.errors).c_str());
    const double end = 2;
    const State other = byGroup(*group.resolved->system, group.resolved->initial, end, 400);
    const Axes expected =
        Eigen::Quaterniond(other.x[0], other.x[1], other.x[2], other.x[3]).normalized().toRotationMatrix();
    const Vector momentum(other.x[4], other.x[5], other.x[6]);
    const Mechanical of = mechanical(topWith(turn, spin));
    double q[2], p[2];
    for (int fine = 0; fine < 2; ++fine) {
        const Ending made = run(of, "galerkin-gauss-" + std::to_string(degree), end, steps << fine);
        QVERIFY(made.outcome == Outcome::converged);
        QVERIFY(made.largestValue < 1e-13 && made.largestRate < 1e-12);
        const Axes R = attitudeIn(made.state);
        q[fine] = (R - expected).norm();
        // p of the columns are E d'; about the fixed point I omega, from m x x x' and d x p_d.
        Vector about = Vector::Zero();
        const double* const momenta = made.state.x.data() + 12;
        about += Vector(Eigen::Map<const Vector>(made.state.x.data()))
                     .cross(Vector(Eigen::Map<const Vector>(momenta)));
        const Axes P = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(momenta + 3);
        for (int j = 0; j < 3; ++j) about += Vector(R.col(j)).cross(Vector(P.col(j)));
        p[fine] = (R.transpose() * about - momentum).norm();
    }
    const double orderQ = std::log2(q[0] / q[1]), orderP = std::log2(p[0] / p[1]);
    qInfo("q %.2e %.2e (%.2f), p %.2e %.2e (%.2f)", q[0], q[1], orderQ, p[0], p[1], orderP);
    QVERIFY(std::abs(orderQ - 2 * degree) < 0.15);
    QVERIFY(std::abs(orderP - 2 * degree) < 0.15);
}

void AssemblyTest::twoBodiesAreThoseOfTheProduct() {
    const ReadScene group = readScene(parseJson(findPreset("two-bodies")->json));
    QVERIFY2(group.errors.empty(), textOf(group.errors).c_str());
    const double end = 2;
    const State other = byGroup(*group.resolved->system, group.resolved->initial, end, 200);
    const Vector upper(0.5, 0.3, 0), lower(-0.2, 0.6, 0), e3(0, 0, 1);
    const Vector joint = -turned(upper) * e3;
    const Mechanical of =
        mechanical(R"("gravity": 1, "bodies": {"upper": {"mass": 2, "inertia": [0.5, 0.7, 0.5], "at": )" +
                   text(joint / 2) + R"(, "attitude": )" + text(upper) + R"(, "spin": [0.6, 0.3, 0.4]},
        "lower": {"mass": 1, "inertia": [0.4, 0.5, 0.3], "at": )" +
                   text(joint - turned(lower) * e3 / 2) + R"(, "attitude": )" + text(lower) +
                   R"(, "spin": [-0.5, 0.2, 0.7]}}, "joints": {"hook": {"body": "upper"},
        "elbow": {"body": "lower", "to": "upper", "at": )" +
                   text(joint) + "}}");
    double error[2];
    for (int fine = 0; fine < 2; ++fine) {
        const Ending made = run(of, "galerkin-gauss-3", end, 20 << fine);
        QVERIFY(made.outcome == Outcome::converged);
        error[fine] = 0;
        for (std::size_t b = 0; b < 2; ++b) {
            const Axes expected =
                Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(other.x.data() + 9 * b);
            error[fine] = std::max(error[fine], (attitudeIn(made.state, 12 * b) - expected).norm());
        }
    }
    const double order = std::log2(error[0] / error[1]);
    qInfo("%.2e %.2e (%.2f)", error[0], error[1], order);
    QVERIFY(error[1] < 1e-6 && std::abs(order - 6) < 0.3);
}

void AssemblyTest::ordersAreTwoS_data() {
    QTest::addColumn<QString>("joint");
    QTest::addColumn<int>("bodies");
    QTest::addColumn<int>("degree");
    QTest::addColumn<double>("end");
    QTest::addColumn<int>("steps");
    for (const char* joint : {"ball", "hinge"}) {
        QTest::addRow("2, %s, 1", joint) << joint << 2 << 1 << 0.5 << 80;
        QTest::addRow("2, %s, 2", joint) << joint << 2 << 2 << 0.5 << 20;
        QTest::addRow("2, %s, 3", joint) << joint << 2 << 3 << 0.5 << 10;
        QTest::addRow("10, %s, 1", joint) << joint << 10 << 1 << 0.2 << 80;
        QTest::addRow("10, %s, 2", joint) << joint << 10 << 2 << 0.2 << 20;
        QTest::addRow("10, %s, 3", joint) << joint << 10 << 3 << 0.2 << 8;
        QTest::addRow("50, %s, 2", joint) << joint << 50 << 2 << 0.1 << 10;
    }
}

void AssemblyTest::ordersAreTwoS() {
    QFETCH(QString, joint);
    QFETCH(int, bodies);
    QFETCH(int, degree);
    QFETCH(double, end);
    QFETCH(int, steps);
    const Mechanical of = mechanical(chain(bodies, joint.toStdString(), bodies == 10));
    const MeasuredOrder m = orderOf(of, "galerkin-gauss-" + std::to_string(degree), end, steps);
    QVERIFY(m.isDone());
    qInfo("q %.1e (%.2f), p %.1e (%.2f), |g| %.1e, rate %.1e", m.error.q, m.q, m.error.p, m.p,
          m.fine.largestValue, m.fine.largestRate);
    QVERIFY(std::abs(m.q - 2 * degree) < 0.2);
    QVERIFY(std::abs(m.p - 2 * degree) < 0.2);
    QVERIFY(m.fine.largestValue < 2e-14 * bodies && m.fine.largestRate < 1e-12);
}

void AssemblyTest::aTensorIsThatOfItsPrincipalAxes() {
    const Axes turn = turned(Vector(0.4, -0.3, 0.7));
    const Vector moments(0.3, 0.5, 0.6), spin(1, 2, -1);
    const Axes I = turn * moments.asDiagonal() * turn.transpose();
    const auto scene = [&](const std::string& inertia, const Vector& by, const Vector& rate) {
        return mechanical(R"("gravity": 0, "bodies": {"b": {"mass": 2, "inertia": )" + inertia +
                          R"(, "attitude": )" + text(by) + R"(, "spin": )" + text(rate) + "}}");
    };
    const std::string six = "[" + formatNumber(I(0, 0)) + ", " + formatNumber(I(1, 1)) + ", " +
                            formatNumber(I(2, 2)) + ", " + formatNumber(I(1, 2)) + ", " +
                            formatNumber(I(0, 2)) + ", " + formatNumber(I(0, 1)) + "]";
    const Ending a = run(scene(six, Vector(0, 0, 0), spin), "galerkin-gauss-2", 1, 20),
                 b = run(scene(text(moments), Vector(0.4, -0.3, 0.7), turn.transpose() * spin),
                         "galerkin-gauss-2", 1, 20);
    QVERIFY(a.outcome == Outcome::converged && b.outcome == Outcome::converged);
    const double apart = (attitudeIn(a.state) - attitudeIn(b.state) * turn.transpose()).norm();
    qInfo("apart by %.1e", apart);
    QVERIFY(apart < 1e-12);
}

void AssemblyTest::aPlateIsTheLimitOfABody() {
    const auto scene = [](double thickness) {
        return mechanical(R"("gravity": 3, "bodies": {"b": {"mass": 2, "inertia": [0.3, 0.5, )" +
                          formatNumber(0.8 - thickness) +
                          R"j(], "attitude": [0.2, 0.3, 0.1], "spin": [1, 2, 0.5], "at": [0.5, 0, 0]}},
                          "joints": {"j": {"body": "b", "type": "universal", "axis": [0, 1, 0],
                          "second": [1, 0, 0], "damping": 0.1}},
                          "motors": {"m": {"body": "b", "axis": [0, 0, 1], "torque": "0.4*cos(t)"}})j");
    };
    const Mechanical flat = scene(0);
    QCOMPARE(flat.system.dimension(), 9);
    const Ending plate = run(flat, "galerkin-gauss-3", 1, 20);
    double apart[2];
    for (int i = 0; i < 2; ++i) {
        const Ending thin = run(scene(i ? 1e-5 : 2e-5), "galerkin-gauss-3", 1, 20);
        QVERIFY(thin.outcome == Outcome::converged);
        apart[i] = std::abs(thin.state.x[3] - plate.state.x[3]);
    }
    qInfo("apart by %.2e %.2e", apart[0], apart[1]);
    QVERIFY(apart[0] > 0 && std::abs(apart[0] / apart[1] - 2) < 0.02);
}

void AssemblyTest::momentaStay() {
    const Mechanical of = mechanical(
        R"("gravity": 0, "bodies": {"a": {"mass": 1, "inertia": [0.1, 0.2, 0.25], "spin": [1, 2, 3]},
        "b": {"mass": 2, "inertia": [0.3, 0.4, 0.5], "at": [1, 0, 0], "spin": [-1, 0.5, 1]}},
        "joints": {"j": {"body": "b", "to": "a", "at": [0.5, 0, 0]}})");
    const auto momenta = [](const State& s) {
        Eigen::Matrix<double, 6, 1> all = Eigen::Matrix<double, 6, 1>::Zero();
        for (std::size_t first = 0; first < 24; first += 12) {
            const Vector x = Eigen::Map<const Vector>(s.x.data() + first),
                         p = Eigen::Map<const Vector>(s.x.data() + 24 + first);
            all.head<3>() += p;
            all.tail<3>() += x.cross(p);
            const Axes R = attitudeIn(s, first), P = attitudeIn(s, 24 + first);
            for (int j = 0; j < 3; ++j) all.tail<3>() += Vector(R.col(j)).cross(Vector(P.col(j)));
        }
        return all;
    };
    for (const char* scheme : {"midpoint", "galerkin-gauss-2", "galerkin-lobatto-3"}) {
        const Ending made = run(of, scheme, 20, 1000);
        QVERIFY(made.outcome == Outcome::converged);
        const double change = (momenta(made.state) - momenta(of.start)).norm();
        qInfo("%s: %.1e", scheme, change);
        QVERIFY(change < 1e-12);
    }
}

void AssemblyTest::aMotorTurnsBothSides() {
    const auto scene = [](const char* motors) {
        return mechanical(
            std::string(R"("gravity": 0, "bodies": {"a": {"mass": 1, "inertia": [0.1, 0.2, 0.25]},
            "b": {"mass": 1, "inertia": [0.1, 0.2, 0.25], "at": [1, 0, 0]}},
            "joints": {"j": {"type": "hinge", "body": "b", "to": "a", "at": [0.5, 0, 0]}},)") +
            motors);
    };
    const Ending one = run(scene(R"("motors": {"m": {"joint": "j", "torque": "0.3*t"}})"), "galerkin-gauss-2",
                           1, 20),
                 two = run(scene(R"("motors": {"m": {"body": "b", "axis": [0, 0, 1], "torque": "0.3*t"},
                           "n": {"body": "a", "axis": [0, 0, -1], "torque": "0.3*t"}})"),
                           "galerkin-gauss-2", 1, 20);
    QVERIFY(one.outcome == Outcome::converged && two.outcome == Outcome::converged);
    const Distance apart = distance(one.state, two.state);
    QVERIFY(apart.q < 1e-14 && apart.p < 1e-14);
    // By symmetry each turns as far as the other, back, and the centres of mass move along x alone:
    // (I + m a^2 sin^2) theta'' + m a^2 sin cos theta'^2 = T, a = 0.5.
    const Axes R = attitudeIn(one.state, 12);
    const double angle = std::atan2(R(1, 0), R(0, 0));
    double theta = 0, omega = 0;
    constexpr int pieces = 20000;
    for (int k = 0; k < pieces; ++k) {
        const auto rate = [](double t, double x, double w) {
            const double s = std::sin(x), c = std::cos(x);
            return (0.3 * t - 0.25 * s * c * w * w) / (0.25 + 0.25 * s * s);
        };
        const double t = static_cast<double>(k) / pieces, h = 1.0 / pieces;
        const double half = omega + h / 2 * rate(t, theta, omega), middle = theta + h / 2 * omega;
        omega += h * rate(t + h / 2, middle, half);
        theta += h * half;
    }
    qInfo("angle %.12f, expected %.12f", angle, theta);
    QVERIFY(std::abs(angle - theta) < 1e-7);
}

void AssemblyTest::theWrittenFormIsTheSame() {
    const ReadScene scene = read(chain(3, "ball", true));
    QVERIFY2(scene.errors.empty(), textOf(scene.errors).c_str());
    const ReadScene typed = readScene(typedScene(*scene.resolved));
    QVERIFY2(typed.errors.empty(), textOf(typed.errors).c_str());
    const Ending a = run({*scene.resolved->system, scene.resolved->initial}, "galerkin-gauss-2", 0.2, 20),
                 b = run({*typed.resolved->system, typed.resolved->initial}, "galerkin-gauss-2", 0.2, 20);
    QVERIFY(a.outcome == Outcome::converged && b.outcome == Outcome::converged);
    QVERIFY(distance(a.state, b.state).q < 1e-12);
}

void AssemblyTest::whatIsWrongIsSaidWithItsPlace_data() {
    QTest::addColumn<QString>("keys");
    QTest::addColumn<QString>("said");
    const auto row = [](const char* what, const char* keys, const char* said) {
        QTest::newRow(what) << keys << said;
    };
    row("no body has it", R"("bodies": {"b": {"inertia": [1, 1, 3]}})",
        "/model/bodies/b/inertia: no body has these moments");
    row("a thin rod", R"("bodies": {"b": {"inertia": [1, 1, 0]}})",
        "/model/bodies/b/inertia: is that of a thin rod");
    row("not a rotation", R"("bodies": {"b": {"inertia": [1, 1, 1], "attitude": [1,0,0,0,1,0,0,0,-1]}})",
        "/model/bodies/b/attitude: is not the matrix of a rotation");
    row("no inertia", R"("bodies": {"b": {"mass": 1}})", "/model/bodies/b/inertia: is required");
    row("no such body", R"("bodies": {"b": {"inertia": [1, 1, 1]}}, "joints": {"j": {"body": "c"}})",
        "/model/joints/j/body: there is no body \"c\"");
    row("itself", R"("bodies": {"b": {"inertia": [1, 1, 1]}}, "joints": {"j": {"body": "b", "to": "b"}})",
        "/model/joints/j/to: both sides are the body b");
    row("no such joint",
        R"("bodies": {"b": {"inertia": [1, 1, 1]}}, "joints": {"j": {"body": "b", "type": "bal"}})",
        "/model/joints/j/type: there is no joint \"bal\" (did you mean \"ball\"?)");
    row("twice",
        R"("bodies": {"b": {"inertia": [1, 1, 1], "at": [1, 0, 0]}, "c": {"inertia": [1, 1, 1]}},
               "joints": {"j": {"body": "b", "to": "c"}, "k": {"body": "b", "to": "c"}})",
        "/model/joints/k: depends on the other constraints");
    row("nothing", R"("gravity": 1)", "/model/bodies: there is nothing that moves");
    row("a motor on a ball",
        R"("bodies": {"b": {"inertia": [1, 1, 1]}}, "joints": {"j": {"body": "b"}},
           "motors": {"m": {"joint": "j", "torque": 1}})",
        "/model/motors/m/joint: the joint j has no one axis");
}

void AssemblyTest::whatIsWrongIsSaidWithItsPlace() {
    QFETCH(QString, keys);
    QFETCH(QString, said);
    const std::string all = textOf(read(keys.toStdString()).errors);
    QVERIFY2(all.find(said.toStdString()) != std::string::npos, all.c_str());
}
#endif

EXTREMAL_TEST(AssemblyTest)
}  // namespace assembly_test
}  // namespace extremal::mechanism_test
#include "assembly_test.moc"
