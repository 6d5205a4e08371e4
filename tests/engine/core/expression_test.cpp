#include <QTest>

#include <cmath>
#include <numbers>

#include "engine/core/expression.hpp"
#include "tests/tools/test.hpp"

namespace extremal::expression_test {

namespace {

double valueOf(const std::string& text) {
    return evaluate(parseExpression(text), [](std::string_view name) -> std::optional<double> {
        if (name == "k") return 1e4;
        if (name == "x_t") return 3;
        return {};
    });
}

QString errorOf(const std::string& text) {
    try {
        valueOf(text);
        return "no error";
    } catch (const ExpressionError& e) {
        return QString::fromUtf8(e.what()) + " at " + QString::number(e.position);
    }
}

}  // namespace

class ExpressionTest : public QObject {
    Q_OBJECT
private slots:
    void arithmeticFollowsTheGrammar_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<double>("value");
        const auto row = [](const char* text, double value) { QTest::newRow(text) << text << value; };
        row("1+2*3", 7);
        row("(1 + 2)*3", 9);
        row("2-3-4", -5);
        row("64/4/2", 8);
        row("2^3^2", 512);  // to the right
        row("-2^2", -4);    // tighter than the sign
        row("2^-1", 0.5);
        row("2*-3", -6);
        row("--2", 2);
        row("-2^-2^2", -std::pow(2, -std::pow(2, 2)));
        row("1e3+.5e1", 1005);
        row("0.05*sqrt(1e4/k)", 0.05);
        row("sin(pi/2) + cos(0) + atan2(1, 1)*4/pi", 3);
        row("sign(-3) + abs(-2) + sign(0)", 1);
        row("exp(log(5)) + tan(0) + sinh(0) + cosh(0) + tanh(0)", 6);
        row(" x_t\t* 2 ", 6);
        row("asin(1) - acos(0)", 0);
    }
    void arithmeticFollowsTheGrammar() {
        QFETCH(QString, text);
        QFETCH(double, value);
        QVERIFY(std::abs(valueOf(text.toStdString()) - value) < 1e-14 * (1 + std::abs(value)));
    }

    void errorsNameThePlace_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("error");
        const auto row = [](const char* text, const char* error) { QTest::newRow(text) << text << error; };
        row("", "is empty at 0");
        row("1+", "ends where a number, a name or \"(\" is missing at 2");
        row("2 3", "has \"3\" where an operator should be at 2");
        row("(1+2", "has a bracket that is not closed at 0");
        row("1)", "has \")\" where an operator should be at 1");
        row("sqr(2)", "has no function \"sqr\" at 0");
        row("sin 2", "needs brackets after the function sin at 0");
        row("atan2(1)", "needs two arguments for atan2 at 7");
        row("sin(1, 2)", "needs one argument for sin at 5");
        row("1.2.3", "has \".\" where an operator should be at 3");
        row("2k", "has \"k\" where an operator should be at 1");
        row("1e999", "has a number that does not fit a double at 0");
        row("2*kk", "has an unknown name \"kk\" at 2");
        row("2*\u03b8", "has \"\u03b8\" where a number, a name or \"(\" should be at 2");
        row("0x10", "has \"x\" where an operator should be at 1");
    }
    void errorsNameThePlace() {
        QFETCH(QString, text);
        QFETCH(QString, error);
        QCOMPARE(errorOf(text.toStdString()), error);
    }

    void lengthAndDepthAreLimited() {
        QCOMPARE(valueOf(std::string(200, '(') + "1" + std::string(200, ')')), 1.0);
        QVERIFY(errorOf(std::string(201, '(') + "1").startsWith("is nested deeper than 200"));
        QVERIFY(errorOf(std::string(9000, '-') + "1").startsWith("is nested deeper than 200"));
        std::string longSum = "1";
        while (longSum.size() < 9998) longSum += "+1";
        QCOMPARE(valueOf(longSum), 5000.0);
        QVERIFY(errorOf(longSum + "+1").startsWith("is 10001 characters long"));
    }

    void theCaretStandsBelowThePlace() {
        QCOMPARE(caretLines("2*kk", 2), std::string("    2*kk\n      ^"));
        QCOMPARE(caretLines("\u03b8+)", 3), std::string("    \u03b8+)\n      ^"));
        const std::string shown = caretLines(std::string(500, '1') + "?" + std::string(500, '1'), 500);
        const auto lineEnd = shown.find('\n');
        QCOMPARE(shown[shown.rfind('^') - lineEnd - 1], '?');
    }

    void namesAreListedOnce() {
        const auto names = parseExpression("k*m + sin(k) + pi").names();
        QCOMPARE(names, (std::vector<std::string>{"k", "m"}));
    }
};

EXTREMAL_TEST(ExpressionTest)
}  // namespace extremal::expression_test

#include "expression_test.moc"
