// SPDX-License-Identifier: GPL-3.0-or-later
/// Exact solutions against an independent route: Fehlberg 7(8) under tight control.
#include <QTest>

#include <cmath>

#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::exact_test {

class ExactTest : public QObject {
    Q_OBJECT
private slots:
    void exactSolutionsAgreeWithATightIntegration_data() {
        QTest::addColumn<QString>("model");
        QTest::addColumn<QList<double>>("start");
        QTest::addColumn<double>("parameter");  // k, g or mu
        const double separatrix = 2 * std::cos(0.5);
        QTest::newRow("oscillator") << "harmonic-oscillator" << QList<double>{0.7, -0.4} << 3.0;
        QTest::newRow("libration") << "pendulum" << QList<double>{1, 0.5} << 1.0;
        QTest::newRow("libration, going down") << "pendulum" << QList<double>{-2.5, -0.1} << 1.0;
        QTest::newRow("tiny libration") << "pendulum" << QList<double>{1e-5, 0} << 1.0;
        QTest::newRow("rotation") << "pendulum" << QList<double>{1, 2.2} << 1.0;
        QTest::newRow("rotation backwards") << "pendulum" << QList<double>{-1, -3} << 1.0;
        QTest::newRow("some turns away") << "pendulum" << QList<double>{13, 0.3} << 1.0;
        QTest::newRow("close to the separatrix") << "pendulum" << QList<double>{1, separatrix - 1e-3} << 1.0;
        QTest::newRow("ellipse") << "kepler" << QList<double>{0.4, 0, 0, 2} << 1.0;
        QTest::newRow("ellipse, clockwise, other mu")
            << "kepler" << QList<double>{0.3, 0.5, 0.9, -1.1} << 1.7;
        QTest::newRow("circle") << "kepler" << QList<double>{1, 0, 0, 1} << 1.0;
        QTest::newRow("parabola") << "kepler" << QList<double>{1, 0, 0, std::sqrt(2.0)} << 1.0;
        QTest::newRow("hyperbola") << "kepler" << QList<double>{1, 0.2, 0.3, 1.9} << 1.0;
    }
    void exactSolutionsAgreeWithATightIntegration() {
        QFETCH(QString, model);
        QFETCH(QList<double>, start);
        QFETCH(double, parameter);
        const std::string id = model.toStdString();
        const char* key = id == "kepler" ? "mu" : id == "pendulum" ? "g" : "k";
        const System system = laws::systemNamed(id, {{key, parameter}});
        State state{0.3, 0, {start.begin(), start.end()}};
        const ExactSolution exact = system.exact(state);
        QVERIFY(exact);
        std::vector<double> x(state.x.size());
        exact(state.t, x);
        QVERIFY(laws::distance(x, state.x, 0, x.size()) < 1e-13);
        for (const double end : {1.0, 4.0, 12.0}) {
            State s = state;
            const auto code = findBaseline("fehlberg78")->make(system, {0, s, 1e-14, {}});
            while (s.t < end) QVERIFY(code->advance(s, end).outcome == Outcome::converged);
            exact(end, x);
            const double difference = laws::distance(x, s.x, 0, x.size());
            QVERIFY2(difference < 2e-11, qPrintable(QString("%1 at t = %2").arg(difference).arg(end)));
        }
        exact(state.t, x);  // back again: a warm start must not matter
        QVERIFY(laws::distance(x, state.x, 0, x.size()) < 1e-13);
    }
    void manyTimesAreAsGoodAsOneByOne() {
        // Kepler's solution turns the anomaly from time to time; it must not drift from one made for that
        // time alone.
        const System kepler = laws::systemNamed("kepler");
        const ExactSolution solution = kepler.exact(laws::keplerStart);
        for (const double spacing : {0.0005, 0.005, 0.3}) {  // the last: too far apart to march
            std::vector<double> t(509), x(4 * t.size()), y(4);
            double worst = 0;
            for (int block = 0; block < 40; ++block) {
                for (std::size_t i = 0; i < t.size(); ++i)
                    t[i] = spacing * static_cast<double>(static_cast<std::size_t>(block) * t.size() + i);
                solution(t, x.data(), 4);
                for (std::size_t i = 0; i < t.size(); ++i) {
                    solution(t[i], y);
                    for (std::size_t c = 0; c < 4; ++c)
                        worst = std::max(worst, std::abs(x[4 * i + c] - y[c]));
                }
            }
            qInfo("%g: %.2e", spacing, worst);
            // Round-off of t in Kepler's equation times the sensitivity 1/(1 - e)^2 = 6; measured 1e-14,
            // 5e-14, 0.
            QVERIFY(worst < 1e-15 * (10 + t.back()));
        }
    }
    void someOrbitsHaveNone() {
        const System kepler = laws::systemNamed("kepler");
        QVERIFY(!kepler.exact({0, 0, {1, 0, 0.5, 0}}));  // through the centre
        QVERIFY(!laws::systemNamed("spring-pendulum").exact);
    }
};

EXTREMAL_TEST(ExactTest)
}  // namespace extremal::exact_test

#include "exact_test.moc"
