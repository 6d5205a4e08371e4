// SPDX-License-Identifier: GPL-3.0-or-later
/// Free motion between kicks: the free motion against the closed form by elliptic functions, and orders in
/// attitude and momentum against solutions with 32 digits and against Lie group schemes.
#include <QTest>

#include <cmath>
#include <string>
#include <vector>

#include "engine/family/free_motion/free_body.hpp"
#include "engine/family/scheme.hpp"
#include "engine/model/body/free_body_motion.hpp"
#include "tests/laws/bodies.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::free_motion_test {
namespace {

using laws::Four;
using laws::Three;

BodyMotion<double> motionOf(const State& s) {
    BodyMotion<double> m;
    m.q << s.x[0], s.x[1], s.x[2], s.x[3];
    m.momentum << s.x[4], s.x[5], s.x[6];
    return m;
}

struct Apart {
    double attitude = 0, momentum = 0;
};
Apart apart(const std::vector<double>& x, const std::vector<double>& y) {
    return {laws::attitudeError(x, {y[0], y[1], y[2], y[3]}), laws::momentumError(x, {y[4], y[5], y[6]})};
}

Discretization knots(const std::string& id) {
    return {{"free-motion", {{"knots", id}}, {}}, {"auto", {}, {}}, {}};
}

/// The state at t after n steps.
State after(const System& system, const State& start, const Discretization& d, double t, int n) {
    State state = start;
    const auto integrator = makeIntegrator(system, d, {start.t, t / n});
    for (int i = 0; i < n; ++i)
        if (advance(*integrator, state).outcome != Outcome::converged) return {};
    return state;
}

}  // namespace

class FreeMotionTest : public QObject {
    Q_OBJECT
private slots:
    void freeMotionIsThatOfEllipticFunctions_data() {
        QTest::addColumn<double>("I1");
        QTest::addColumn<double>("I2");
        QTest::addColumn<double>("I3");
        QTest::newRow("1, 2, 3") << 1.0 << 2.0 << 3.0;
        QTest::newRow("symmetric about 3") << 1.0 << 1.0 << 0.5;
        QTest::newRow("symmetric about 1") << 2.0 << 1.3 << 1.3;
        QTest::newRow("symmetric about 2") << 0.7 << 2.0 << 0.7;
        QTest::newRow("ball") << 1.5 << 1.5 << 1.5;
        QTest::newRow("nearly symmetric") << 1.0 << 1.0 + 1e-9 << 0.5;
    }
    /// Also backwards, over short and long times, and in pieces.
    void freeMotionIsThatOfEllipticFunctions() {
        QFETCH(double, I1);
        QFETCH(double, I2);
        QFETCH(double, I3);
        const State start = laws::bodyState({0.4, 0.9, -0.7}, {0.5, 0.5, -0.5, 0.5});
        const ExactSolution exact = freeBodyMotion({I1, I2, I3}, start);
        const FreeBody body({I1, I2, I3, 0, 0, 0});
        double worst = 0, pieces = 0;
        for (const double t : {1e-3, 0.1, 0.7, 3.0, 20.0, -0.1, -5.0}) {
            std::vector<double> known(10);
            exact(t, known);
            BodyMotion<double> once = motionOf(start), twice = once;
            body.move(once, t);
            body.move(twice, 0.3 * t);
            body.move(twice, 0.7 * t);
            for (const auto& [m, error] : {std::pair{&once, &worst}, {&twice, &pieces}}) {
                const std::vector<double> x{m->q(0),        m->q(1),        m->q(2),       m->q(3),
                                            m->momentum(0), m->momentum(1), m->momentum(2)};
                const Apart d = apart(x, known);
                *error = std::max({*error, d.attitude, d.momentum});
            }
        }
        qInfo("%.1e, in pieces %.1e", worst, pieces);
        QVERIFY(worst < 2e-13 && pieces < 2e-13);
    }
    /// Of a body whose moments are nearly equal the series is the closed form.
    void theSeriesIsTheClosedForm() {
        const FreeBody closed({1, 1, 0.5, 0, 0, 0}), series({1, 1 + 1e-15, 0.5, 0, 0, 0});
        QVERIFY(closed.isSymmetric() && !series.isSymmetric());
        BodyMotion<double> a = motionOf(laws::bodyState({0.4, 0.9, -1.7})), b = a;
        closed.move(a, 1.3);
        series.move(b, 1.3);
        QVERIFY((a.q - b.q).norm() < 1e-14);
        QVERIFY((a.momentum - b.momentum).norm() < 1e-14);
    }

    void theOrderIsThatOfTheTable_data() {
        QTest::addColumn<QString>("id");
        QTest::addColumn<int>("order");
        QTest::addColumn<int>("steps");
        QTest::newRow("strang") << "strang" << 2 << 200;
        QTest::newRow("suzuki-4") << "suzuki-4" << 4 << 100;
        QTest::newRow("blanes-moan-s6") << "blanes-moan-s6" << 4 << 50;
        QTest::newRow("srkn-6b") << "srkn-6b" << 4 << 200;
        QTest::newRow("blanes-moan-s10") << "blanes-moan-s10" << 6 << 50;
        QTest::newRow("srkn-11b") << "srkn-11b" << 6 << 32;
        QTest::newRow("srkn-14a") << "srkn-14a" << 6 << 32;
        QTest::newRow("srkn-19a") << "srkn-19a" << 8 << 36;
        QTest::newRow("srkn-19b") << "srkn-19b" << 8 << 36;
    }
    /// A symmetric top, whose state at t = 10 is known to 32 digits, and one with unlike moments.
    void theOrderIsThatOfTheTable() {
        QFETCH(QString, id);
        QFETCH(int, order);
        QFETCH(int, steps);
        const Discretization d = knots(id.toStdString());
        QCOMPARE(describe(d).claims.order, order);
        const laws::KnownBody& top = laws::top();
        const System unlike = laws::heavyTop({1, 1.4, 0.6}, {0.3, 0.1, 1});
        const State start = laws::bodyState(top.start);
        const State fine = after(unlike, start, *namedScheme("lie-8"), 10, 200);
        QVERIFY(!fine.x.empty());
        for (const bool isKnown : {true, false}) {
            const laws::Known& at = top.at[1];
            std::vector<double> h, attitude, momentum;
            // Errors of order 8 are near round-off after few steps.
            for (const int n : order == 8 ? std::array{steps, 5 * steps / 4, 3 * steps / 2}
                                          : std::array{steps, 2 * steps, 4 * steps}) {
                const State end = after(isKnown ? top.system() : unlike, start, d, 10, n);
                QVERIFY(!end.x.empty());
                const Apart error =
                    isKnown ? Apart{laws::attitudeError(end.x, at.q), laws::momentumError(end.x, at.Pi)}
                            : apart(end.x, fine.x);
                qInfo("%s, %d steps: %.2e, %.2e", isKnown ? "symmetric" : "unlike", n, error.attitude,
                      error.momentum);
                h.push_back(-std::log(n));
                attitude.push_back(std::log(error.attitude));
                momentum.push_back(std::log(error.momentum));
            }
            qInfo("orders %.2f, %.2f", slope(h, attitude), slope(h, momentum));
            QVERIFY(std::abs(slope(h, attitude) - order) < 0.25);
            QVERIFY(std::abs(slope(h, momentum) - order) < 0.25);
        }
    }
    /// An orbit with spin on SE(3): order 4, the total angular momentum to round-off; with kicks that weigh a
    /// thousandth too much neither.
    void bodiesThatMoveThroughSpace() {
        const System system = laws::systemNamed(
            "rigid-body-se3", {{"inertia", Value(Value::Array{0.01, 0.025, 0.03})},
                               {"mass", 1.0},
                               {"parameters", Value(Value::Object{{"mu", 1.0}})},
                               {"potential",
                                "-mu*mass/sqrt(x^2+y^2+z^2) + "
                                "3*mu/(2*(x^2+y^2+z^2)^(5/2))*(I1-I2)*(x*R11+y*R21+z*R31)^2"}});
        State start = laws::bodyState({0.001, 0, 0.03}, {std::cos(0.1), 0, 0, std::sin(0.1)});
        start.x.insert(start.x.end(), {1, 0, 0, 0, 1, 0});
        const State fine = after(system, start, *namedScheme("lie-6"), 4, 200);
        QVERIFY(!fine.x.empty());
        std::vector<double> h, error;
        for (const int n : {40, 80, 160}) {
            const State end = after(system, start, *namedScheme("free-motion-2"), 4, n);
            QVERIFY(!end.x.empty());
            double most = apart(end.x, fine.x).attitude;
            for (std::size_t i = 10; i < 16; ++i) most = std::max(most, std::abs(end.x[i] - fine.x[i]));
            h.push_back(-std::log(n));
            error.push_back(std::log(most));
            const auto momentum = [&](const State& s, int axis) {
                const std::size_t a = static_cast<std::size_t>((axis + 1) % 3),
                                  b = static_cast<std::size_t>((axis + 2) % 3);
                return s.x[7 + static_cast<std::size_t>(axis)] + s.x[10 + a] * s.x[13 + b] -
                       s.x[10 + b] * s.x[13 + a];
            };
            double change = 0;
            for (int axis = 0; axis < 3; ++axis)
                change = std::max(change, std::abs(momentum(end, axis) - momentum(start, axis)));
            qInfo("%d steps: %.2e, momentum %.1e", n, most, change);
            QVERIFY(change < 1e-13);
        }
        qInfo("order %.2f", slope(h, error));
        QVERIFY(std::abs(slope(h, error) - 4) < 0.2);
    }
    void aFreeBodyIsRefused() {
        const System system = laws::freeBody({1, 2, 3});
        QVERIFY(QString::fromStdString(mismatch(*namedScheme("free-motion-2"), system))
                    .contains("is its motion"));
        QVERIFY_THROWS_EXCEPTION(InvalidScene,
                                 (void)makeIntegrator(system, *namedScheme("free-motion-2"), {0, 0.1}));
        QVERIFY(isFor(*namedScheme("free-motion-2"), laws::top().system()));
    }
};

EXTREMAL_TEST(FreeMotionTest)

}  // namespace extremal::free_motion_test

#include "free_motion_test.moc"
