// SPDX-License-Identifier: GPL-3.0-or-later
#include <QTest>

#include <cmath>
#include <numbers>

#include "engine/core/text/expression.hpp"
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
        row("max(1, 3, 2) + 10*min(4, 2, 7, 3)", 23);
        row("max(k, 2)/k + min(-1, k)", 0);
        row("heaviside(-2) + 10*heaviside(0) + 100*step(3)", 105);
        row("if(2 < 3, 4, 5) + if(2 > 3, 10, 20)", 24);
        row("if(k, 1, log(-1))", 1);
        row("piecewise(1 > 2, 1, 2 >= 2, 7, 9)", 7);
        row("piecewise(1 > 2, 1, 2 > 2, 7, 9)", 9);
        row("(1 < 2) + 10*(1 <= 1) + 100*(1 == 2) + 1000*(1 != 2) + 2*(1 > 1) + 3*(2 >= 3)", 1011);
        row("(1 < 2 && 2 < 3) + 10*(1 < 2 && 3 < 2) + 100*(2 < 1 || 1 < 2) + 1000*(2 < 1 || 3 < 2)", 101);
        row("if(1 > 2 || 3 > 2 && 1 > 2, 5, 6)", 6);
        row("mod(7, 3) + 10*mod(-7, 3) + 100*mod(7.5, 2)", 171);
        row("floor(-1.5) + 10*ceil(-1.5) + 100*round(2.5) + 1000*round(-2.5)", -2712);
        row("ln(5) - log(5) + log10(1000)", 3);
        row("erf(0.5) + erfc(0.5)", 1);
        row("erfc(10)*1e45", 2.088487583762545e0);
        row("hypot(3, 4) + hypot(1, 2, 2)", 8);
        row("asinh(sinh(2)) + acosh(cosh(3)) + atanh(tanh(0.5))", 5.5);
        row("pow(2, 3)^2 + pow(2, -1)", 64.5);
        row("table(0.5; 0, 0; 1, 2; 3, -2)", 1);
        row("table(2; 0, 0; 1, 2; 3, -2) + table(-1; 0, 5; 1, 2) + table(9; 0, 5; 1, 2)", 7);
        row("table(1; 0, 0; 1, 2; 3, -2)", 2);
        row("spline(1; 0, 0; 1, 2; 3, -2) + spline(0; 0, 4; 1, 2)", 6);
        row("spline(5; 0, 1; 1, 3) + spline(-1; 0, 1; 1, 3)", 10);  // two points: the line through them
        row("table(pi; 0, 0; 2*pi, sqrt(4))", 1);
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
        row("max(1)", "needs at least two arguments for max at 5");
        row("max()", "has \")\" where a number, a name or \"(\" should be at 4");
        row("if(1, 2)", "needs three arguments for if at 7");
        row("if(1, 2, 3, 4)", "needs three arguments for if at 10");
        row("mod(1, 2, 3)", "needs two arguments for mod at 8");
        row("piecewise(1, 2)", "needs at least three arguments for piecewise at 14");
        row("piecewise(1, 2, 3, 4)", "has no last value for piecewise at 0");
        row("1 < 2 < 3", "has a chain of comparisons at 6");
        row("2 = 3", "has \"=\" where an operator should be at 2");
        row("table(1)", "needs at least two points for table at 7");
        row("table(1;)", "needs at least two points for table at 8");
        row("table(1; 0, 0)", "needs at least two points for table at 13");
        row("table(1, 2; 0, 0)", "needs at least two points for table at 7");
        row("table(1; 0, 0; 0, 1)", "has points of table that are not in ascending order at 15");
        row("spline(1; 0, 0; 2, 1; 1, 3)", "has points of spline that are not in ascending order at 22");
        row("table(1; 0, 0; 1)", "has \")\" where the value of a point: \",\" should be at 16");
        row("table(1; 0, 0; k, 1)", "has the name \"k\" in a point of table, which are numbers at 15");
        row("table(1; 0, 0; 1, log(0))", "has a point of table that is not finite at 18");
        row("table(1; 0, 0; 1, 1", "has a bracket that is not closed at 5");
        row("floor", "has an unknown name \"floor\" at 0");
        row("floor 2", "has \"2\" where an operator should be at 6");
    }
    void errorsNameThePlace() {
        QFETCH(QString, text);
        QFETCH(QString, error);
        QCOMPARE(errorOf(text.toStdString()), error);
    }

    void namesOfLaterFunctionsMayStillBeNames() {
        for (const std::string& function : expressionFunctions()) {
            const bool isFirst =
                std::string(" sin cos tan asin acos atan atan2 sinh cosh tanh exp log sqrt abs sign stumpff ")
                    .find(" " + function + " ") != std::string::npos;
            QCOMPARE(nameProblem(function).empty(), !isFirst);
            if (isFirst) continue;
            const double value = evaluate(parseExpression("2*" + function + " + max(" + function + ", 9)"),
                                          [&](std::string_view name) -> std::optional<double> {
                                              return name == function ? std::optional(5.0) : std::nullopt;
                                          });
            QCOMPARE(value, 19.0);
        }
        QCOMPARE(withNameReplaced("max + max(max, 1) + max (2, max)", "max", "M"),
                 std::string("M + max(M, 1) + max (2, M)"));
        QCOMPARE(withNameReplaced("k*(x + k)", "k", "c"), std::string("c*(x + c)"));
    }
    void argumentsThatAreAcceptedAreSaid() {
        for (const std::string& function : expressionFunctions()) {
            std::string call = function + "(";
            for (const char c : argumentsOf(function))
                call += c == '@' ? std::string("0.5") : std::string(1, c);
            QVERIFY2(std::isfinite(valueOf(call + ")")) || function == "acosh" || function == "stumpff",
                     call.c_str());
        }
    }
    void whatIsNotANumberStaysSo() {
        for (const char* text :
             {"max(1, log(-1))", "max(log(-1), 1)", "min(log(-1), 1)", "min(1, log(-1))", "sign(log(-1))",
              "heaviside(log(-1))", "if(log(-1) < 1, 2, 3)", "log(-1) == 1", "log(-1) != 1",
              "(log(-1) < 1) || 1 < 2", "table(log(-1); 0, 0; 1, 1)", "spline(log(-1); 0, 0; 1, 1; 2, 1)",
              "floor(log(-1))", "mod(log(-1), 2)"})
            QVERIFY2(std::isnan(valueOf(text)), text);
    }
    void splinesAreSmoothAndNatural() {
        const std::vector<double> x{-1, 0, 0.5, 2, 3}, y{1, 0, 2, -1, 1};
        const Interpolant spline(Interpolant::Kind::cubic, x, y);
        for (std::size_t k = 0; k < x.size(); ++k) {
            const double before = std::nextafter(x[k], -9.0);
            QVERIFY(std::abs(spline.at(x[k]) - y[k]) < 1e-14);
            for (int order = 0; order <= 2; ++order)  // measured: 4e-15 of at most 14
                QVERIFY(std::abs(spline.at(x[k], order) - spline.at(before, order)) < 1e-13);
        }
        QVERIFY(std::abs(spline.at(-1.0, 2)) + std::abs(spline.at(3.0, 2)) < 1e-14);
        QCOMPARE(spline.at(5.0), spline.at(3.0) + 2 * spline.at(3.0, 1));
        const double third = spline.at(1.0, 3);
        QVERIFY(std::abs((spline.at(1.2, 2) - spline.at(0.8, 2)) / 0.4 - third) < 1e-12);
    }

    void lengthAndDepthAreLimited() {
        QCOMPARE(valueOf(std::string(200, '(') + "1" + std::string(200, ')')), 1.0);
        QVERIFY(errorOf(std::string(201, '(') + "1").startsWith("is nested deeper than 200"));
        QVERIFY(errorOf(std::string(9000, '-') + "1").startsWith("is nested deeper than 200"));
        std::string branches = "piecewise(";
        for (int i = 0; i < 99; ++i) branches += "2 < 1, 3, ";
        QCOMPARE(valueOf(branches + "4)"), 4.0);
        for (int i = 0; i < 99; ++i) branches += "2 < 1, 3, ";
        QVERIFY(errorOf(branches + "4)").startsWith("is nested deeper than 200"));
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
