// SPDX-License-Identifier: GPL-3.0-or-later
#include <QTest>

#include <cmath>

#include "engine/core/switching.hpp"
#include "tests/tools/test.hpp"

namespace extremal::switching_test {
namespace {

double valueAt(const Expression& e, double x) {
    return evaluate(e, [x](std::string_view name) {
        return name == "x" ? std::optional(x) : name == "k" ? std::optional(2.0) : std::nullopt;
    });
}

QString listed(const char* text) {
    QStringList all;
    for (const SwitchingFunction& s : switchingFunctions(parseExpression(text)))
        all << QString::fromStdString(s.function.text) + (s.mayJump ? " jump" : " kink");
    return all.join("; ");
}

}  // namespace

class SwitchingTest : public QObject {
    Q_OBJECT
private slots:
    void everyKinkAndJumpHasItsFunction() {
        QCOMPARE(listed("x^2 + sin(x)/log(x)"), QString());
        QCOMPARE(listed("abs(x - 1) + abs(x - 1)*2 + sign(x)"), QString("x - 1 kink; x jump"));
        QCOMPARE(listed("abs(x) + heaviside(x)"), QString("x jump"));
        QCOMPARE(listed("abs(x) + if(0 < x, 1, 2) + max(k*x, 0)"), QString("x jump; k*x kink"));
        QCOMPARE(listed("max(x, k, 3)"), QString("x - k kink; max(x, k) - 3 kink"));
        QCOMPARE(listed("if(x > 1 && k*x <= 3, x, -x)"), QString("1 - x jump; k*x - 3 jump"));
        QCOMPARE(listed("floor(2*x) + round(x) + mod(x, k + 1)"),
                 QString("sin(pi*(2*x)) jump; cos(pi*x) jump; sin(pi*x/(k + 1)) jump"));
        QCOMPARE(listed("table(x^2; -1, 0; 0.5, 3) + spline(x; 0, 0; 1, 1; 2, 3)"),
                 QString("x^2 + 1 kink; x^2 - 0.5 kink"));
        QCOMPARE(listed("abs(3) + max(1, 2)"), QString());
        QCOMPARE(listed("abs(spline(x; 0, 0; 1, 1) - if(x < 1, ln(x), 2))"),
                 QString("x - 1 jump; spline(x; 0, 0; 1, 1) - if(x < 1, log(x), 2) kink"));
    }
    /// Between two changes of sign of its switching functions an expression has no kink and no jump: its
    /// second differences are small.
    void betweenTheSwitchesTheExpressionIsSmooth() {
        for (const char* text : {"abs(x - 0.3)*x", "max(x, x^2, 0.2)", "if(x < 0.7, x, x^2)", "mod(3*x, 0.7)",
                                 "table(x; 0.1, 3; 0.4, -2; 0.9, 1)", "floor(5*x) + ceil(x*x*3) + round(3*x)",
                                 "spline(x; 0.1, 3; 0.4, -2; 0.9, 1)", "sign(x - 0.5)*heaviside(x - 0.25)"}) {
            const Expression e = parseExpression(text);
            const auto switches = switchingFunctions(e);
            const double h = 1e-4;
            int kinks = 0;
            for (double x = 1.234e-5; x < 1; x += h) {
                const double bend = valueAt(e, x - h) - 2 * valueAt(e, x) + valueAt(e, x + h);
                bool changes = false;
                for (const SwitchingFunction& s : switches)
                    changes = changes || valueAt(s.function, x - h) * valueAt(s.function, x + h) <= 0;
                if (!changes) QVERIFY2(std::abs(bend) < 1e-5, text);
                kinks += changes && std::abs(bend) > 1e-5;
            }
            QCOMPARE(kinks > 0, !switches.empty());
        }
    }
    void whatIsWrittenIsReadAgain() {
        for (const char* text : {"-(x - 1)^2*k/(x + 3)", "2^-x - (k - (x - 1))", "x < k && (x > 3 || k == x)",
                                 "if(x != 1, table(x; -1, 2; 3, 0.1), min(x, k, 7))", "pi*erf(x)^(k/2)"}) {
            const Expression e = parseExpression(text);
            const Expression again = parseExpression(writtenPart(e, static_cast<int>(e.nodes.size()) - 1));
            for (const double x : {0.3, 1.7, -2.5}) QCOMPARE(valueAt(again, x), valueAt(e, x));
        }
    }
};

EXTREMAL_TEST(SwitchingTest)

}  // namespace extremal::switching_test

#include "switching_test.moc"
