// SPDX-License-Identifier: GPL-3.0-or-later
/// Typed rules: the same step as the rule they retype, degree and symmetry found, predicted orders and limits
/// of stability, and an error for each misuse.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/family/table_of.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/scene_steps.hpp"
#include "tests/tools/test.hpp"

namespace extremal::typed_rule_test {
namespace {

ReadScene read(const std::string& rule, int degree = 3, double h = 0.1) {
    return readScene(
        "{\"extremal\": 1, \"model\": {\"type\": \"kepler\"}, \"initial\": {\"q\": [0.4, 0], \"p\": [0, "
        "2]},\n        \"time\": {\"end\": 1}, \"schemes\": [{\"step\": " +
        formatNumber(h) + ", \"space\": {\"type\": \"polynomial\", \"degree\": " + std::to_string(degree) +
        "}, \"quadrature\": " + rule + "}]}");
}

std::string nodes(const std::string& nodes, const std::string& weights = "") {
    return "{\"type\": \"nodes\", \"nodes\": [" + nodes + "]" +
           (weights.empty() ? "" : ", \"weights\": [" + weights + "]") + "}";
}

double fromGauss(const std::string& rule) {
    return tests::apart(tests::after(read(rule), 1),
                        tests::after(read("{\"type\": \"gauss\", \"nodes\": 3}"), 1));
}

}  // namespace

class TypedRuleTest : public QObject {
    Q_OBJECT
private slots:
    void retypedGaussGivesItsStep() {
        const double formulas = fromGauss(nodes("\"(5-sqrt(15))/10\", \"1/2\", \"(5+sqrt(15))/10\"",
                                                "\"5/18\", \"4/9\", \"5/18\"")),
                     left = fromGauss(nodes("\"(5-sqrt(15))/10\", \"1/2\", \"(5+sqrt(15))/10\"")),
                     sixteen = fromGauss(nodes("0.1127016653792583, 0.5, 0.8872983346207417")),
                     eight = fromGauss(nodes("0.11270167, 0.5, 0.88729833")),
                     four = fromGauss(nodes("0.1127, 0.5, 0.8873"));
        qInfo("formulas %.1e, without weights %.1e, 16 digits %.1e, 8 digits %.1e, 4 digits %.1e", formulas,
              left, sixteen, eight, four);
        QVERIFY(formulas < 1e-15 && left < 1e-15 && sixteen < 1e-15);
        QVERIFY(eight > 1e-13 && eight < 1e-7);
        QVERIFY(four > 1e-9 && four < 1e-4);
    }
    void ordersAndLimitsAreThoseOfTheRule_data() {
        QTest::addColumn<QString>("rule");
        QTest::addColumn<int>("degree");
        QTest::addColumn<int>("order");
        QTest::addColumn<double>("limit");
        const auto row = [](const char* name, const std::string& rule, int degree, int order, double limit) {
            QTest::newRow(name) << QString::fromStdString(rule) << degree << order << limit;
        };
        row("Simpson", nodes("0, 0.5, 1", "\"1/6\", \"2/3\", \"1/6\""), 2, 4, 2.83);
        row("Boole", nodes("0, 0.25, 0.5, 0.75, 1"), 4, 6, 3.12);
        row("thirds", nodes("\"1/3\", \"2/3\""), 2, 2, 1.50);
        row("closed Newton-Cotes 7", nodes("0, \"1/6\", \"1/3\", \"1/2\", \"2/3\", \"5/6\", 1"), 6, 6, 2.55);
        // Roots of x P_n and of the Stieltjes polynomial of P_n; Kronrod 3 is Gauss 3.
        row("Kronrod 3", nodes("\"(1-sqrt(3/5))/2\", 0.5, \"(1+sqrt(3/5))/2\""), 2, 4, 3.16);
        row("Kronrod 5",
            nodes("\"(1-sqrt(6/7))/2\", \"(1-sqrt(1/3))/2\", 0.5, \"(1+sqrt(1/3))/2\", \"(1+sqrt(6/7))/2\""),
            4, 8, 3.14);
        const std::string outer = "sqrt(5/9+sqrt(40/297))", inner = "sqrt(5/9-sqrt(40/297))",
                          gauss3 = "sqrt(3/5)";
        std::string seven;
        for (const std::string& x : {"-" + outer, "-" + gauss3, "-" + inner, std::string("+0"), "+" + inner,
                                     "+" + gauss3, "+" + outer})
            seven += (seven.empty() ? "\"(1" : ", \"(1") + x + ")/2\"";
        row("Kronrod 7", nodes(seven), 4, 8, 3.14);
        row("closed Newton-Cotes 9", nodes("0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1"), 8, 6, 3.14);
    }
    void ordersAndLimitsAreThoseOfTheRule() {
        QFETCH(QString, rule);
        QFETCH(int, degree);
        QFETCH(int, order);
        QFETCH(double, limit);
        const ReadScene scene = read(rule.toStdString(), degree, 0.01);
        QVERIFY2(scene.errors.empty(), scene.errors.empty() ? "" : scene.errors[0].message.c_str());
        const Properties& p = scene.resolved->schemes[0].properties;
        QCOMPARE(p.claims.order, order);
        QVERIFY2(std::abs(p.stabilityLimit - limit) < 0.006, qPrintable(QString::number(p.stabilityLimit)));
        QVERIFY(p.claims.isSymmetric);
    }
    void negativeWeightsAreNamed() {
        const ReadScene scene = read(nodes("0.25, 0.5, 0.75"), 3, 0.01);
        QVERIFY(scene.errors.empty());
        QCOMPARE(scene.resolved->schemes[0].claims.order, 4);
        const Table<double> table = tableOf(scene.scene.schemes[0].space, scene.scene.schemes[0].quadrature);
        const Eigen::VectorXd K = kineticValues(table);
        // The functions of a built-in space are orthonormal to some percent.
        QVERIFY2(std::abs(K(0) + 0.31) < 0.03 && std::abs(K(2) - 1) < 0.1,
                 qPrintable(QString("%1 to %2").arg(K(0)).arg(K(2))));
        QVERIFY(std::any_of(scene.warnings.begin(), scene.warnings.end(), [](const Problem& p) {
            return p.message.find("negative weight -0.333") != std::string::npos;
        }));
    }
    void fewDigitsAreNamed() {
        const ReadScene scene = read(nodes("0.1127, 0.5, 0.8873"), 2, 0.01);
        QVERIFY(std::any_of(scene.warnings.begin(), scene.warnings.end(), [](const Problem& p) {
            return p.message.find("degree 5 to ") != std::string::npos &&
                   p.message.find("write (5-sqrt(15))/10") != std::string::npos;
        }));
    }
    void misuseIsNamedWithTheRemedy_data() {
        QTest::addColumn<QString>("rule");
        QTest::addColumn<QString>("place");
        QTest::addColumn<QString>("message");
        QTest::addColumn<QString>("hint");
        const auto row = [](const char* name, const std::string& rule, const char* place, const char* message,
                            const char* hint) {
            QTest::newRow(name) << QString::fromStdString(rule) << place << message << hint;
        };
        row("sum 2", nodes("0, 0.5, 1", "\"1/3\", \"4/3\", \"1/3\""), "/schemes/0/quadrature/weights",
            "must sum to 1, got 2", "halve the weights");
        row("other sum", nodes("0, 0.5, 1", "0.1, 0.5, 0.1"), "/schemes/0/quadrature/weights",
            "must sum to 1, got 0.7", "leave them out");
        row("count", nodes("0, 0.5, 1", "0.5, 0.5"), "/schemes/0/quadrature/weights",
            "one for each of the 3 nodes", "leave them out");
        row("outside", nodes("-0.5, 0.5"), "/schemes/0/quadrature/nodes/0", "from 0 to 1, got -0.5",
            "(1+x)/2");
        row("descending", nodes("0.5, 0.2"), "/schemes/0/quadrature/nodes/1", "must be greater", "ascending");
        row("equal", nodes("0.5, 0.5"), "/schemes/0/quadrature/nodes/1", "must be greater", "different");
        row("none", nodes(""), "/schemes/0/quadrature/nodes", "1 to 64 nodes", "for example");
        row("infinite", nodes("\"1/0\""), "/schemes/0/quadrature/nodes/0", "not finite", "");
        row("name", nodes("\"x/2\""), "/schemes/0/quadrature/nodes/0", "unknown name", "");
        row("missing", "{\"type\": \"nodes\"}", "/schemes/0/quadrature/nodes", "is required", "");
    }
    void misuseIsNamedWithTheRemedy() {
        QFETCH(QString, rule);
        QFETCH(QString, place);
        QFETCH(QString, message);
        QFETCH(QString, hint);
        const ReadScene scene = read(rule.toStdString());
        QVERIFY(!scene.errors.empty());
        const Problem& found = scene.errors.front();
        const QString what = tests::unlike(found, place, message, hint);
        QVERIFY2(what.isEmpty(), qPrintable(what));
    }
};

EXTREMAL_TEST(TypedRuleTest)

}  // namespace extremal::typed_rule_test

#include "typed_rule_test.moc"
