// SPDX-License-Identifier: GPL-3.0-or-later
/// What terms cost to leave out: first order against runs without them.
#include <QTest>

#include <cmath>

#include "engine/scene/write/codec.hpp"
#include "engine/study/search/term_costs.hpp"
#include "tests/tools/test.hpp"

namespace extremal::term_costs_test {

class TermCostsTest : public QObject {
    Q_OBJECT
private slots:
    void formulasAreSplitAtTheirSigns() {
        const std::vector<std::string> wanted{"m/2*x_t^2", "-1e-3*x", "k*(a - b)*x", "-2^-3*x*-y"};
        QVERIFY(summandsOf("m/2*x_t^2 - 1e-3*x + k*(a - b)*x - 2^-3*x*-y") == wanted);
        QVERIFY(summandsOf("-x^2").size() == 1 && summandsOf("-x^2")[0] == "-x^2");
    }
    /// Of the order of magnitude of each term, from 1e-6 to the motion itself.
    void firstOrderIsWhatRemovalCosts() {
        const auto scene =
            readScene(std::string(
                          R"J({"extremal": 1, "model": {"type": "lagrangian",
            "coordinates": ["x", "y"], "parameters": {"B": 1}, "lagrangian":
            "(x_t^2+y_t^2)/2 + B/2*(x*y_t-y*x_t) - (x^2+2*y^2)/2 + 0.05*x*cos(0.7*t) + 1e-4*x^3)J"
                          R"J( - 1e-3*y*sin(20*t) - 1e-6*x^4*y^2"}, "initial": {"q": [1, 0.5], "v": [0, 0.3]},
            "time": {"end": 40}, "schemes": [{"scheme": "midpoint", "step": 0.1}]})J"))
                .resolved;
        QVERIFY(scene);
        const Metric metric = metricOf("error", false, *scene->system, scene->initial);
        const std::vector<TermCost> costs = termCosts(*scene, metric, {});
        QCOMPARE(costs.size(), std::size_t(7));
        QCOMPARE(costs[0].term, std::string("-1e-6*x^4*y^2"));
        QCOMPARE(costs[1].term, std::string("-1e-3*y*sin(20*t)"));
        for (int i = 0; i < 4; ++i) {  // the quadratic part would be too large
            qInfo("%.3e, measured %.3e", costs[i].firstOrder, costs[i].measured);
            QVERIFY(std::abs(costs[i].measured / costs[i].firstOrder - 1) < 0.01);
        }
        QVERIFY(costs[0].firstOrder < 1e-5 && costs[3].firstOrder > 0.1);
        QVERIFY(std::isnan(costs[5].measured));  // without masses there is no motion
    }
};

EXTREMAL_TEST(TermCostsTest)

}  // namespace extremal::term_costs_test

#include "term_costs_test.moc"
