// SPDX-License-Identifier: GPL-3.0-or-later
/// Optimal controls of discrete motions (study/gradient/steering.hpp) against closed forms, and their orders.
#include <QTest>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/gradient/steering.hpp"
#include "tests/tools/pointer_of.hpp"
#include "tests/tools/test.hpp"

namespace extremal::steering_test {
namespace {

ResolvedScene sceneOf(const std::string& lagrangian, const std::string& initial, double end, int degree,
                      int steps, const std::string& more = {}) {
    const ReadScene read =
        readScene(R"({"extremal":1,"model":{"type":"lagrangian","coordinates":["x"],"lagrangian":")" +
                      lagrangian + R"(","controls":{"u":"0"})" + more + R"(},"initial":)" + initial +
                      R"(,"time":{"end":1},"schemes":[{"scheme":"galerkin-gauss-)" + std::to_string(degree) +
                      R"(","step":1}],"reference":{"type":"none"}})",
                  {{"/time/end", Value(end)}, {"/schemes/0/step", Value(end / steps)}});
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return *read.resolved;
}

const std::string fromRest = R"({"q":[0],"p":[0]})";

/// The oscillator x'' = -x + u from (1, 0) to rest in T: with the Gramian W of (cos t, sin t) the least
/// control is -(b(t).W^-1 x_0)-like: u = a sin t + b cos t, in closed form.
struct OscillatorToRest {
    double a, b, J;
    explicit OscillatorToRest(double T) {
        // x_0 + int_0^T (-sin t, cos t) u dt = 0, the state in the frame that turns with the oscillator.
        const double s = T / 2 - std::sin(2 * T) / 4, c = T / 2 + std::sin(2 * T) / 4,
                     m = std::sin(T) * std::sin(T) / 2;
        // -a s - b m = -1, a m + b c = 0.
        const double D = s * c - m * m;
        a = c / D;
        b = -m / D;
        J = (a * a * s + 2 * a * b * m + b * b * c) / 2;
    }
    double operator()(double t) const { return a * std::sin(t) + b * std::cos(t); }
};

ResolvedScene preset(const char* id, const std::vector<Override>& changes = {}) {
    const Preset* const found = findPreset(id);
    if (!found) qFatal("%s", id);
    const ReadScene read = readScene(std::string(found->json), changes);
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return *read.resolved;
}

/// The largest difference of controls from others, which are polynomials through so many points on each step.
double apart(const StudyTable& controls, const StudyTable& others, double step, std::size_t points) {
    double largest = 0;
    for (const Value::Array& row : controls.rows) {
        const double t = row[0].asNumber();
        const std::size_t first = points * static_cast<std::size_t>(t / step);
        const auto timeOf = [&](std::size_t i) { return others.rows[first + i][0].asNumber(); };
        for (std::size_t c = 1; c < row.size(); ++c) {
            double there = 0;
            for (std::size_t i = 0; i < points; ++i) {
                double part = others.rows[first + i][c].asNumber();
                for (std::size_t j = 0; j < points; ++j)
                    if (j != i) part *= (t - timeOf(j)) / (timeOf(i) - timeOf(j));
                there += part;
            }
            largest = std::max(largest, std::abs(row[c].asNumber() - there));
        }
    }
    return largest;
}

double errorOf(const StudyTable& controls, const auto& exact) {
    double largest = 0;
    for (const Value::Array& row : controls.rows)
        largest = std::max(largest, std::abs(row[1].asNumber() - exact(row[0].asNumber())));
    return largest;
}

}  // namespace

class SteeringTest : public QObject {
    Q_OBJECT
private slots:
    /// From rest at 0 to rest at 1 in a unit of time: J = 6 and u = 6 - 12 t, whose costates are -(6 - 12 t)
    /// of the momentum and -12 of the place.
    void theDoubleIntegratorIsExact() {
        const SteeringAnswer answer =
            steer(sceneOf("x_t^2/2+u*x", fromRest, 1, 2, 8), {{}, "", "u^2/2", {"x-1", "p_x"}, {}, ""});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        const double off = errorOf(answer.controls, [](double t) { return 6 - 12 * t; });
        qInfo("J - 6 = %.1e, u off by %.1e, multipliers %.15g, %.15g; %d iterations", answer.cost - 6, off,
              answer.multipliers[0], answer.multipliers[1], answer.iterations);
        QVERIFY(std::abs(answer.cost - 6) < 1e-13);
        QVERIFY(off < 1e-12);
        QVERIFY(std::abs(answer.multipliers[0] + 12) < 1e-11 && std::abs(answer.multipliers[1] - 6) < 1e-11);
        // -u = costate of the momentum, at nodes.
        for (const Value::Array& row : answer.states.rows)
            QVERIFY(std::abs(row[4].asNumber() + 6 - 12 * row[0].asNumber()) < 1e-11);
    }
    /// Of which every 71st state is kept.
    void longRunsHaveStatesAtAllNodes() {
        constexpr int steps = 5000;
        const SteeringAnswer answer =
            steer(sceneOf("x_t^2/2+u*x", fromRest, 1, 1, steps), {{}, "", "u^2/2", {"x-1", "p_x"}, {}, ""});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        QCOMPARE(answer.states.rows.size(), std::size_t(steps + 1));
        double place = 0, momentum = 0, costate = 0;
        for (const Value::Array& row : answer.states.rows) {
            const double t = row[0].asNumber();
            place = std::max(place, std::abs(row[1].asNumber() - t * t * (3 - 2 * t)));
            momentum = std::max(momentum, std::abs(row[2].asNumber() - 6 * t * (1 - t)));
            costate = std::max(costate, std::abs(row[4].asNumber() + 6 - 12 * t));
        }
        qInfo("J - 6 = %.1e; x off by %.1e, p by %.1e, its costate by %.1e", answer.cost - 6, place, momentum,
              costate);
        QVERIFY(std::abs(answer.cost - 6) < 1e-6 && place < 1e-7 && momentum < 1e-7 && costate < 1e-6);
    }
    void forcesDoTheSame() {
        const SteeringAnswer answer = steer(sceneOf("x_t^2/2", fromRest, 1, 2, 8, R"(,"forces":{"x":"u"})"),
                                            {{"u"}, "", "u^2/2", {"x-1", "p_x"}, {}, ""});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        QVERIFY(std::abs(answer.cost - 6) < 1e-12);
    }
    /// J of order 2 s, u at the nodes of order s + 1.
    void costAndControlsHaveTheirOrders_data() {
        QTest::addColumn<int>("degree");
        for (const int degree : {1, 2, 3}) QTest::addRow("Gauss %d", degree) << degree;
    }
    void costAndControlsHaveTheirOrders() {
        QFETCH(int, degree);
        const OscillatorToRest exact(3);
        double J[2], u[2];
        const int coarse = degree == 3 ? 6 : 12;
        for (const int i : {0, 1}) {
            const SteeringAnswer answer =
                steer(sceneOf("x_t^2/2-x^2/2+u*x", R"({"q":[1],"p":[0]})", 3, degree, coarse << i),
                      {{}, "", "u^2/2", {"x", "p_x"}, {}, ""});
            QVERIFY2(answer.isFound(), answer.problem.c_str());
            J[i] = std::abs(answer.cost - exact.J);
            u[i] = errorOf(answer.controls, exact);
        }
        const double orderOfJ = std::log2(J[0] / J[1]), orderOfU = std::log2(u[0] / u[1]);
        qInfo("J = %.12f: errors %.1e, %.1e, order %.2f; u %.1e, %.1e, order %.2f", exact.J, J[0], J[1],
              orderOfJ, u[0], u[1], orderOfU);
        QVERIFY(std::abs(orderOfJ - 2 * degree) < 0.1);
        QVERIFY(std::abs(orderOfU - (degree + 1)) < 0.1);
    }
    /// The costates of the indirect method at the end: of the momentum -u(3), of the place u'(3).
    void multipliersAreTheCostatesAtTheEnd() {
        const OscillatorToRest exact(3);
        const SteeringAnswer answer =
            steer(preset("oscillator-to-rest"), {{}, "", "u^2/2", {"x", "p_x"}, {}, "Gauss 3"});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        const double ofPlace = exact.a * std::cos(3) - exact.b * std::sin(3),
                     ofMomentum = -exact.a * std::sin(3) - exact.b * std::cos(3);
        qInfo("J off by %.1e, costates by %.1e, %.1e", answer.cost - exact.J, answer.multipliers[0] - ofPlace,
              answer.multipliers[1] - ofMomentum);
        QVERIFY(std::abs(answer.cost - exact.J) < 1e-10);
        QVERIFY(std::abs(answer.multipliers[0] - ofPlace) < 1e-9);
        QVERIFY(std::abs(answer.multipliers[1] - ofMomentum) < 1e-9);
    }
    /// The motion and the costates at the start, taken on by the equations of the indirect method (here by
    /// the classical Runge-Kutta method), arrive where the discrete motion does, with its multipliers.
    void costatesSolveTheIndirectEquations() {
        const SteeringAnswer answer = steer(
            preset("orbit-raising"), {{}, "", "(ur^2+us^2)/2", {"r-1.5", "p_r", "p_phi-sqrt(1.5)"}, {}, ""});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        using Eight = std::array<double, 8>;  // r, phi, p_r, p_phi, and their costates
        const auto f = [](const Eight& y) {
            const double r = y[0], p = y[3], us = -r * y[7], r3 = r * r * r;
            return Eight{y[2],
                         p / (r * r),
                         p * p / r3 - 1 / (r * r) - y[6],
                         r * us,
                         2 * y[5] * p / r3 + y[6] * (3 * p * p / (r3 * r) - 2 / r3) - y[7] * us,
                         0,
                         -y[4],
                         -2 * y[6] * p / r3 - y[5] / (r * r)};
        };
        Eight y{};
        for (std::size_t i = 0; i < 8; ++i) y[i] = answer.states.rows.front()[i + 1].asNumber();
        constexpr int steps = 4000;
        constexpr double h = 4.0 / steps;
        const auto plus = [](Eight a, const Eight& b, double c) {
            for (std::size_t i = 0; i < 8; ++i) a[i] += c * b[i];
            return a;
        };
        for (int k = 0; k < steps; ++k) {
            const Eight a = f(y), b = f(plus(y, a, h / 2)), c = f(plus(y, b, h / 2)), d = f(plus(y, c, h));
            for (std::size_t i = 0; i < 8; ++i) y[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
        }
        const double misses[] = {y[0] - 1.5,
                                 y[2],
                                 y[3] - std::sqrt(1.5),
                                 y[4] - answer.multipliers[0],
                                 y[5],
                                 y[6] - answer.multipliers[1],
                                 y[7] - answer.multipliers[2]};
        double largest = 0;
        for (const double miss : misses) largest = std::max(largest, std::abs(miss));
        qInfo("J = %.12f, multipliers %.9f, %.9f, %.9f; the indirect equations arrive within %.1e",
              answer.cost, answer.multipliers[0], answer.multipliers[1], answer.multipliers[2], largest);
        QVERIFY(largest < 1e-8);
    }
    /// On nonlinear problems, one of them a mechanism: J of order 2 s, u at the nodes of order s + 1 against
    /// Gauss 5.
    void ordersOfPresets_data() {
        QTest::addColumn<QString>("id");
        QTest::addColumn<double>("step");
        QTest::addColumn<QString>("over");
        QTest::addColumn<QStringList>("ends");
        QTest::newRow("orbit") << "orbit-raising" << 0.125 << "(ur^2+us^2)/2"
                               << QStringList{"r-1.5", "p_r", "p_phi-sqrt(1.5)"};
        QTest::newRow("crane") << "crane" << 0.05 << "u^2/2" << QStringList{"X-2", "x-2", "p_X", "p_x"};
    }
    void ordersOfPresets() {
        QFETCH(QString, id);
        QFETCH(double, step);
        QFETCH(QString, over);
        QFETCH(QStringList, ends);
        SteeringRequest request;
        request.over = over.toStdString();
        for (const QString& end : ends) request.conditions.push_back(end.toStdString());
        const auto found = [&](int degree, double h) {
            Value scheme{Value::Object{}};
            scheme.set("scheme", "galerkin-gauss-" + std::to_string(degree));
            scheme.set("step", h);
            return steer(preset(id.toLatin1().constData(), {{"/schemes", Value(Value::Array{scheme})}}),
                         request);
        };
        const SteeringAnswer reference = found(5, step);
        QVERIFY2(reference.isFound(), reference.problem.c_str());
        for (const int degree : {1, 2, 3}) {
            double J[2], u[2];
            for (const int i : {0, 1}) {
                // The first order shows at shorter steps.
                const SteeringAnswer answer = found(degree, (degree == 1 ? 0.5 : 2) * step / (1 << i));
                QVERIFY2(answer.isFound(), answer.problem.c_str());
                J[i] = std::abs(answer.cost - reference.cost);
                u[i] = apart(answer.controls, reference.controls, step, 5);
            }
            const double orderOfJ = std::log2(J[0] / J[1]), orderOfU = std::log2(u[0] / u[1]);
            qInfo("Gauss %d: J off by %.1e, %.1e, order %.2f; u by %.1e, %.1e, order %.2f", degree, J[0],
                  J[1], orderOfJ, u[0], u[1], orderOfU);
            QVERIFY(std::abs(orderOfJ - 2 * degree) < 0.1);
            QVERIFY(std::abs(orderOfU - (degree + 1)) < 0.1);
        }
    }
    /// What presets have as controls is what is found for them.
    void presetsAreTheirAnswers_data() {
        QTest::addColumn<QString>("over");
        QTest::addColumn<QStringList>("ends");
        QTest::addColumn<double>("cost");
        QTest::newRow("double-integrator") << "u^2/2" << QStringList{"x-1", "p_x"} << 6.0;
        QTest::newRow("oscillator-to-rest") << "u^2/2" << QStringList{"x", "p_x"} << 0.31851504811747;
        QTest::newRow("swing-up") << "u^2/2" << QStringList{"theta-pi", "p_theta"} << 1.2125905957214;
        QTest::newRow("orbit-raising")
            << "(ur^2+us^2)/2" << QStringList{"r-1.5", "p_r", "p_phi-sqrt(1.5)"} << 0.0143836612787;
        QTest::newRow("crane") << "u^2/2" << QStringList{"X-2", "x-2", "p_X", "p_x"} << 2.3596612673473;
    }
    void presetsAreTheirAnswers() {
        QFETCH(QString, over);
        QFETCH(QStringList, ends);
        QFETCH(double, cost);
        const ResolvedScene scene = preset(QTest::currentDataTag());
        SteeringRequest request;
        request.over = over.toStdString();
        for (const QString& end : ends) request.conditions.push_back(end.toStdString());
        const SteeringAnswer answer = steer(scene, request);
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        QVERIFY2(std::abs(answer.cost - cost) < 1e-10, std::to_string(answer.cost).c_str());
        const Value document = toValue(scene.scene);
        double off = 0;
        for (std::size_t c = 1; c < answer.controls.columns.size(); ++c) {
            const Value* const control =
                document.find("model")->find("controls")->find(answer.controls.columns[c]);
            QVERIFY(control && control->find("table"));
            const Value& table = *control->find("table");
            QCOMPARE(table.asArray().size(), answer.controls.rows.size());
            for (std::size_t i = 0; i < answer.controls.rows.size(); ++i)
                off = std::max(off, std::abs(table.asArray()[i].asArray()[1].asNumber() -
                                             answer.controls.rows[i][c].asNumber()));
        }
        QVERIFY2(off < 1e-8, std::to_string(off).c_str());
    }
    /// With |u| <= 5: u is 5, then a line, then -5. With b = 3/5 the line is 5 (1 - 2 t)/sqrt(b), and
    /// J = 25/2 (1 - 2/3 sqrt(b)).
    void boundsAreKept() {
        const double root = std::sqrt(0.6), J = 12.5 * (1 - 2 * root / 3);
        const SteeringAnswer answer = steer(sceneOf("x_t^2/2+u*x", fromRest, 1, 2, 100),
                                            {{}, "", "u^2/2", {"x-1", "p_x"}, {"u=-5:5"}, ""});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        const double off =
            errorOf(answer.controls, [&](double t) { return std::clamp(5 * (1 - 2 * t) / root, -5.0, 5.0); });
        qInfo("J off by %.1e, u by %.1e, %d at bounds, %d iterations", answer.cost - J, off, answer.atBounds,
              answer.iterations);
        QVERIFY(std::abs(answer.cost - J) < 1e-4);
        QVERIFY(off < 0.02);
        QVERIFY(answer.atBounds > 30 && answer.atBounds < 60);
        for (const Value::Array& row : answer.controls.rows) QVERIFY(std::abs(row[1].asNumber()) <= 5);
        QVERIFY(!steer(sceneOf("x_t^2/2+u*x", fromRest, 1, 2, 100),
                       {{}, "", "u^2/2", {"x-1", "p_x"}, {"u=-3:3"}, ""})
                     .isFound());
    }
    /// No control is the least where the motion ends as wanted by itself.
    void nothingIsToBeDone() {
        const SteeringAnswer answer =
            steer(sceneOf("x_t^2/2+u*x", fromRest, 1, 2, 8), {{}, "", "u^2/2", {"x", "p_x"}, {}, ""});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        QCOMPARE(answer.cost, 0.0);
    }
    void whatCannotBeMetIsRefused() {
        const ResolvedScene scene = sceneOf("x_t^2/2+u*x", fromRest, 1, 2, 8);
        const auto refused = [&](const SteeringRequest& request) {
            return pointerOf([&] { (void)steer(scene, request); });
        };
        QCOMPARE(refused({{"v"}, "", "u^2", {}, {}, ""}), std::string("--control"));
        QCOMPARE(refused({{}, "", "", {}, {}, ""}), std::string("--over"));
        QCOMPARE(refused({{}, "", "u^2", {"y"}, {}, ""}), std::string("--end"));
        QCOMPARE(refused({{}, "y", "u^2", {}, {}, ""}), std::string("--of"));
        QCOMPARE(refused({{}, "", "u^2", {}, {"u=1"}, ""}), std::string("--bounds"));
        QCOMPARE(refused({{}, "", "u^2", {}, {"u=1:0"}, ""}), std::string("--bounds"));
        QCOMPARE(refused({{}, "", "u^2", {}, {"v=0:1"}, ""}), std::string("--bounds"));
        QCOMPARE(refused({{}, "", "u^2", {}, {}, "missing"}), std::string("--scheme"));
        const SteeringAnswer twice = steer(scene, {{}, "", "u^2/2", {"x-1", "2*x-2"}, {}, ""});
        QVERIFY(!twice.isFound());
    }
    /// From hanging to standing in T = 5; J by shooting on the costates (indirect method).
    void aPendulumIsSwungUp() {
        const SteeringAnswer answer = steer(sceneOf("x_t^2/2+cos(x)+u*x", fromRest, 5, 5, 40),
                                            {{}, "", "u^2/2", {"x-pi", "p_x"}, {}, ""});
        QVERIFY2(answer.isFound(), answer.problem.c_str());
        qInfo("J = %.13f, multipliers %.7f, %.7f; %d iterations, %d products", answer.cost,
              answer.multipliers[0], answer.multipliers[1], answer.iterations, answer.products);
        QVERIFY(std::abs(answer.cost - 1.2125905957214) < 1e-11);
    }
    /// Full torque B one way until theta = (2/B + pi)/2, then the other, arrives at rest after
    /// int dtheta / sqrt(2 (work - 1 + cos theta)): five seconds for B = 0.83041. What is next above is
    /// found.
    void itIsSwungUpBetweenBoundsThatAllowIt() {
        const auto with = [](const char* bounds) {
            return steer(sceneOf("x_t^2/2+cos(x)+u*x", fromRest, 5, 5, 40),
                         {{}, "", "u^2/2", {"x-pi", "p_x"}, {bounds}, ""});
        };
        double last = 1.2125905957214;
        for (const char* bounds : {"u=-0.95:0.95", "u=-0.9:0.9", "u=-0.84:0.84"}) {
            const SteeringAnswer answer = with(bounds);
            QVERIFY2(answer.isFound(), answer.problem.c_str());
            QVERIFY(answer.cost > last && answer.miss < 1e-12);
            last = answer.cost;
        }
        QVERIFY(!with("u=-0.82:0.82").isFound());
    }
};

EXTREMAL_TEST(SteeringTest)

}  // namespace extremal::steering_test

#include "steering_test.moc"
