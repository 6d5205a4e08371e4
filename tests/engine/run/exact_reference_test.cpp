// SPDX-License-Identifier: GPL-3.0-or-later
/// Exact solutions against quadruple precision, where a parameter of their formula goes to a limit: how far
/// off they are, and that they say so.
#include <QTest>

#include <boost/multiprecision/float128.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "engine/run/reference/reference.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/quadruple_motion.hpp"
#include "tests/tools/test.hpp"

namespace extremal::exact_reference_test {
namespace {

using Number = boost::multiprecision::float128;
using Numbers = std::vector<Number>;

/// An equation of motion, and a step that the extrapolation takes to full precision.
struct Motion {
    std::function<void(const Number& t, const Numbers& x, Numbers& dx)> rate;
    std::function<double(const Numbers& x)> step;
};

/// JSON with apostrophes in place of quotes.
ResolvedScene sceneOf(const std::string& model, const std::string& start, double end,
                      const std::string& scheme = "'baseline':'rk4'") {
    QString text = QString::fromStdString("{'extremal':1,'model':" + model + ",'initial':" + start +
                                          ",'time':{'end':" + std::to_string(end) + "},'schemes':[{" +
                                          scheme + ",'step':0.01}]}");
    const ReadScene read = readScene(text.replace('\'', '"').toStdString());
    if (!read.errors.empty())
        qFatal("%s: %s", read.errors[0].pointer.c_str(), read.errors[0].message.c_str());
    return *read.resolved;
}

/// theta'' = -g/l sin theta, with the doubles of the scene.
Motion pendulum(double m, double l, double g) {
    return {[=](const Number&, const Numbers& x, Numbers& dx) {
                dx[0] = x[1] / (Number(m) * l * l);
                dx[1] = -Number(m) * g * l * sin(x[0]);
            },
            [=](const Numbers& x) {
                return 0.4 / (std::sqrt(g / l) + std::abs(static_cast<double>(x[1])) / (m * l * l));
            }};
}
Motion kepler(double mu) {
    return {[=](const Number&, const Numbers& x, Numbers& dx) {
                const Number r2 = x[0] * x[0] + x[1] * x[1], w = -mu / (r2 * sqrt(r2));
                dx[0] = x[2];
                dx[1] = x[3];
                dx[2] = w * x[0];
                dx[3] = w * x[1];
            },
            [=](const Numbers& x) {
                const auto r2 = static_cast<double>(x[0] * x[0] + x[1] * x[1]);
                const auto v2 = static_cast<double>(x[2] * x[2] + x[3] * x[3]);
                return std::min(0.12 * std::sqrt(r2 * std::sqrt(r2) / mu), 0.1 * std::sqrt(r2 / v2));
            }};
}
/// A charge of mass m in B = (0, 0, B) and E = (E, 0, 0), A = (-y, x, 0) B/2, by its momenta.
Motion charge(double B, double E, double m) {
    return {[=](const Number&, const Numbers& x, Numbers& dx) {
                const Number half = Number(B) / 2, vx = (x[3] + half * x[1]) / m,
                             vy = (x[4] - half * x[0]) / m;
                dx[0] = vx;
                dx[1] = vy;
                dx[2] = x[5] / m;
                dx[3] = half * vy + E;
                dx[4] = -half * vx;
                dx[5] = 0;
            },
            [=](const Numbers&) { return 0.5 / (B / m + 0.1); }};
}

/// Attitude q' = q (0, Omega)/2 and momentum Pi' = Pi x Omega; the momentum in space stays.
Motion freeBody(const std::array<double, 3>& I) {
    return {[=](const Number&, const Numbers& x, Numbers& dx) {
                const Number a = x[4] / I[0], b = x[5] / I[1], c = x[6] / I[2];
                dx[0] = (-x[1] * a - x[2] * b - x[3] * c) / 2;
                dx[1] = (x[0] * a + x[2] * c - x[3] * b) / 2;
                dx[2] = (x[0] * b + x[3] * a - x[1] * c) / 2;
                dx[3] = (x[0] * c + x[1] * b - x[2] * a) / 2;
                dx[4] = x[5] * c - x[6] * b;
                dx[5] = x[6] * a - x[4] * c;
                dx[6] = x[4] * b - x[5] * a;
                dx[7] = dx[8] = dx[9] = 0;
            },
            [](const Numbers&) { return 0.4; }};
}

struct Found {
    double error = 0, promised = 0;
    std::string type;
};
/// The largest error of the coordinates at times spread over the run.
Found judged(const ResolvedScene& scene, const Motion& motion) {
    constexpr int samples = 200;
    const Reference reference = makeReference(scene, {});
    Found found{0, reference.info.estimatedError, reference.info.type};
    const ExactSolution solution = reference.make();
    const ErrorMeasure measure = errorMeasure(*scene.system, scene.initial);
    Numbers truth(scene.initial.x.begin(), scene.initial.x.end());
    std::vector<double> x(truth.size()), y(x), values(measure.columns.size());
    Number t = scene.scene.start.value;
    for (int k = 1; k <= samples; ++k) {
        const double until =
            scene.scene.start.value + (scene.scene.end.value - scene.scene.start.value) * k / samples;
        while (t < until) {
            const double step = motion.step(truth);
            const Number H = until - t > step ? Number(step) : Number(until - t);
            truth = extrapolatedStep(motion.rate, t, truth, H);
            t = H < step ? Number(until) : Number(t + H);
        }
        solution(until, x);
        std::transform(truth.begin(), truth.end(), y.begin(),
                       [](const Number& v) { return static_cast<double>(v); });
        measure.evaluate(x.data(), y.data(), values.data());
        found.error = std::max(found.error, values[0]);
    }
    return found;
}

std::string text(double x) { return QString::number(x, 'g', 17).toStdString(); }

}  // namespace

class ExactReferenceTest : public QObject {
    Q_OBJECT
private slots:
    void pendulumsNearTheSeparatrix_data() {
        QTest::addColumn<double>("theta");
        QTest::addColumn<double>("p");
        QTest::addColumn<double>("g");
        const double separatrix = 2 * std::cos(0.5), pi = 3.141592653589793;
        QTest::newRow("well below") << 1.0 << 0.5 << 1.0;
        QTest::newRow("3.14") << 3.14 << 0.0 << 1.0;
        QTest::newRow("3.1415926") << 3.1415926 << 0.0 << 1.0;
        QTest::newRow("-3.1415926, g = 9.81") << -3.1415926 << 0.0 << 9.81;
        QTest::newRow("two turns away") << 3.1415926 - 4 * pi << 0.0 << 1.0;
        QTest::newRow("the double next to pi") << pi << 0.0 << 1.0;
        QTest::newRow("just oscillating") << 1.0 << separatrix * (1 - 1e-9) << 1.0;
        QTest::newRow("just turning") << 1.0 << separatrix * (1 + 1e-9) << 1.0;
        QTest::newRow("just turning, backwards") << -0.3 << -2 * std::cos(0.15) * (1 + 1e-12) << 1.0;
        QTest::newRow("almost on it") << 1.0 << separatrix << 1.0;
        QTest::newRow("from below, 1e-13") << 0.0 << 2 - 1e-13 << 1.0;
        QTest::newRow("falls through the top") << 3.0 << -0.15 << 1.0;
        QTest::newRow("tiny") << 1e-9 << 1e-10 << 1.0;
        QTest::newRow("fast") << 0.5 << 50.0 << 1.0;
    }
    void pendulumsNearTheSeparatrix() {
        QFETCH(double, theta);
        QFETCH(double, p);
        QFETCH(double, g);
        const ResolvedScene scene = sceneOf("{'type':'pendulum','m':1,'l':1,'g':" + text(g) + "}",
                                            "{'q':[" + text(theta) + "],'p':[" + text(p) + "]}", 40);
        const Found found = judged(scene, pendulum(1, 1, g));
        qInfo("%s: off by %.2e, promised %.2e", QTest::currentDataTag(), found.error, found.promised);
        QCOMPARE(found.type, "exact");
        QVERIFY(found.error < found.promised);
        if (p == 0) QVERIFY(found.error < 1e-13);  // measured: 4e-14 next to pi
    }
    void orbitsNearTheParabola_data() {
        QTest::addColumn<double>("x");
        QTest::addColumn<double>("px");
        QTest::addColumn<double>("py");
        QTest::addColumn<double>("end");
        const double escape = std::sqrt(2.0);
        QTest::newRow("e = 0.6") << 0.4 << 0.0 << 2.0 << 50.0;
        QTest::newRow("e = 0.89") << 1.0 << 0.0 << std::sqrt(1.89) << 50.0;
        QTest::newRow("e = 0.91") << 1.0 << 0.0 << std::sqrt(1.91) << 50.0;
        QTest::newRow("e = 0.95") << 0.05 << 0.0 << std::sqrt(1.95 / 0.05) << 13.0;
        QTest::newRow("e = 0.998, from the aphelion") << 1.998 << 0.0 << std::sqrt(0.002 / 1.998) << 13.0;
        QTest::newRow("1.4142") << 1.0 << 0.0 << 1.4142 << 50.0;
        QTest::newRow("escape (1 - 1e-9)") << 1.0 << 0.0 << escape * (1 - 1e-9) << 50.0;
        QTest::newRow("escape") << 1.0 << 0.0 << escape << 50.0;
        QTest::newRow("escape (1 + 1e-9)") << 1.0 << 0.0 << escape * (1 + 1e-9) << 50.0;
        QTest::newRow("escape (1 + 1e-4)") << 1.0 << 0.0 << escape * (1 + 1e-4) << 50.0;
        QTest::newRow("towards the sun, parabola") << 10.0 << -0.4 << 0.2 << 50.0;
        QTest::newRow("towards the sun, hyperbola") << 10.0 << -0.6 << -0.2 << 50.0;
        QTest::newRow("hyperbola") << 1.0 << 0.3 << 3.0 << 50.0;
        QTest::newRow("hyperbola, e = 99") << 1.0 << 0.0 << 10.0 << 50.0;
    }
    void orbitsNearTheParabola() {
        QFETCH(double, x);
        QFETCH(double, px);
        QFETCH(double, py);
        QFETCH(double, end);
        const ResolvedScene scene = sceneOf(
            "{'type':'kepler'}", "{'q':[" + text(x) + ",0],'p':[" + text(px) + "," + text(py) + "]}", end);
        const Found found = judged(scene, kepler(1));
        qInfo("%s: off by %.2e, promised %.2e", QTest::currentDataTag(), found.error, found.promised);
        QCOMPARE(found.type, "exact");
        QVERIFY(found.error < found.promised);
        QVERIFY(found.error < 1e-12);  // measured: at most 1.3e-13, where the orbit comes to r = 150
    }
    void chargesInWeakAndStrongFields_data() {
        QTest::addColumn<double>("B");
        QTest::addColumn<double>("E");
        for (const double B : {0.0, 1e-300, 1e-12, 1e-9, 1e-5, 0.05, 0.5, 20.0})
            for (const double E : {0.0, 0.3}) QTest::addRow("B = %g, E = %g", B, E) << B << E;
    }
    void chargesInWeakAndStrongFields() {
        QFETCH(double, B);
        QFETCH(double, E);
        const std::string half = text(B) + "/2'";
        const ResolvedScene scene =
            sceneOf("{'type':'charged-particle','m':2,'vector_potential':['-y*" + half + ",'x*" + half +
                        ",'0'],'scalar_potential':'-x*" + text(E) + "'}",
                    "{'q':[1,-0.4,0.2],'p':[0.3,0.7,0.1]}", 50);
        const Found found = judged(scene, charge(B, E, 2));
        qInfo("%s: off by %.2e, promised %.2e", QTest::currentDataTag(), found.error, found.promised);
        QCOMPARE(found.type, "exact");
        QVERIFY(found.error < found.promised);
        QVERIFY(found.error < 2e-13);  // measured: at most 6.1e-14, where the charge comes to x = 190
    }
    void freeBodiesNearTheSeparatrix_data() {
        QTest::addColumn<QString>("inertia");
        QTest::addColumn<QString>("momentum");
        QTest::newRow("tumbling") << "[1,2,3]"
                                  << "[0.5,0.2,0.8]";
        QTest::newRow("about the middle axis") << "[1,2,3]"
                                               << "[0.01,1,0.01]";
        QTest::newRow("closer") << "[1,2,3]"
                                << "[1e-6,1,1e-6]";
        QTest::newRow("closest") << "[1,2,3]"
                                 << "[1e-12,1,1e-12]";
        QTest::newRow("symmetric") << "[1,1,2]"
                                   << "[0.3,0.2,0.8]";
        QTest::newRow("nearly symmetric") << "[1,1.000000001,2]"
                                          << "[0.3,0.2,0.8]";
        QTest::newRow("thin rod") << "[1e-6,1,1]"
                                  << "[1e-6,0.4,0.3]";
    }
    void freeBodiesNearTheSeparatrix() {
        QFETCH(QString, inertia);
        QFETCH(QString, momentum);
        const ResolvedScene scene = sceneOf(
            "{'type':'rigid-body','inertia':" + inertia.toStdString() + "}",
            "{'attitude':[1,0,0,0],'momentum':" + momentum.toStdString() + "}", 40, "'scheme':'lie-1'");
        const std::vector<double> I = scene.scene.model.numbers("inertia");
        const Found found = judged(scene, freeBody({I[0], I[1], I[2]}));
        qInfo("%s (%s): off by %.2e, promised %.2e", QTest::currentDataTag(), found.type.c_str(), found.error,
              found.promised);
        QVERIFY(found.error < found.promised);
    }
};

EXTREMAL_TEST(ExactReferenceTest)
}  // namespace extremal::exact_reference_test

#include "exact_reference_test.moc"
