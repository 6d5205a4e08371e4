// SPDX-License-Identifier: GPL-3.0-or-later
/// Functions of tau in quadruple precision: each function of expressions has its value and its derivative.
#include <QTest>

#include <boost/multiprecision/float128.hpp>

#include <cmath>

#include "engine/core/algebra/long_numbers.hpp"
#include "engine/core/text/formulas.hpp"
#include "tests/tools/test.hpp"

namespace extremal::formulas_test {
namespace {

struct At {
    Quad value, slope;
};
At at(const EvaluatedFormulas<Quad>& f, const Quad& tau) {
    At result;
    f(tau, {&result.value, 1}, {&result.slope, 1});
    return result;
}

}  // namespace

class FormulasTest : public QObject {
    Q_OBJECT
private slots:
    void everyFunctionHasItsDerivative_data() {
        QTest::addColumn<QString>("text");
        // Different arguments, each of which moves.
        const QStringList parts{"(0.3 + tau/3)", "(tau^2 + 0.7)", "(0.9 - tau)"};
        for (const std::string& function : expressionFunctions()) {
            QString arguments;
            int k = 0;
            for (const char c : argumentsOf(function))
                arguments += c == '@' ? parts[k++ % 3] : QString(QChar(c));
            if (function == "stumpff") arguments = "3, tau^2 + 0.7";
            if (function == "acosh") arguments = "1.3 + tau";
            const QString text = QString::fromStdString(function) + "(" + arguments + ")";
            QTest::newRow(qPrintable(text)) << text;
        }
        for (const char* text :
             {"if(tau < 0.3, log(-tau), tau^3)", "(tau <= 0.5)*tau",
              "piecewise(tau > 1, 1, tau != 0, tau^2, 3)", "max(tau, 0.1, tau^2) - min(tau, 0.1)",
              "(tau > 0.1 && tau < 0.9 || tau == 7)*exp(tau)", "table(tau; 0, 1; 0.5, 3; 1, -1)",
              "mod(7*tau, 0.9)"})
            QTest::newRow(text) << text;
    }
    void everyFunctionHasItsDerivative() {
        QFETCH(QString, text);
        const Expression expression = parseExpression(text.toStdString());
        const EvaluatedFormulas<Quad> f({{expression}, {}, {}});
        const EvaluatedFormulas<Hundred> longer({{expression}, {}, {}});
        for (const double tau : {0.4371, 0.6183}) {
            const At here = at(f, tau);
            const double plain = evaluate(expression, [tau](std::string_view) { return tau; });
            QVERIFY2(std::abs(static_cast<double>(here.value) - plain) <= 4e-15 * (1 + std::abs(plain)),
                     qPrintable(QString::number(plain)));
            const Quad h = 1e-8;
            const Quad difference = (at(f, tau + h).value - at(f, tau - h).value) / (2 * h);
            QVERIFY2(abs(difference - here.slope) <= 1e-13 * (1 + abs(here.slope)),
                     qPrintable(QString::number(static_cast<double>(difference - here.slope))));
            Hundred value, slope;
            longer(Hundred(tau), {&value, 1}, {&slope, 1});
            QVERIFY(std::abs(static_cast<double>(value) - static_cast<double>(here.value)) <=
                    1e-15 * (1 + std::abs(plain)));
            QVERIFY(std::abs(static_cast<double>(slope) - static_cast<double>(here.slope)) <=
                    1e-15 * (1 + std::abs(static_cast<double>(slope))));
        }
    }
};

EXTREMAL_TEST(FormulasTest)

}  // namespace extremal::formulas_test

#include "formulas_test.moc"
