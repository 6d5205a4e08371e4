// SPDX-License-Identifier: GPL-3.0-or-later
/// TeX becomes formulas that the program reads.
#include <QTest>

#include <cstring>

#include "engine/core/text/expression.hpp"
#include "tests/tools/test.hpp"
#include "ui/workspace/tex_formula.hpp"

namespace extremal::tex_formula_test {

class TexFormulaTest : public QObject {
    Q_OBJECT
private slots:
    void texIsReadAsAFormula_data() {
        QTest::addColumn<QString>("tex");
        QTest::addColumn<QString>("formula");
        const auto add = [](const char* tex, const char* formula) { QTest::newRow(tex) << tex << formula; };
        add(R"(\frac{1}{2} m \dot{x}^2 - m g l \cos\theta)", "1/2*m*x_t^2 - m*g*l*cos(theta)");
        add(R"(L = \frac12 m l^2 \dot\theta^2 + mgl\cos{\theta})", "1/2*m*l^2*theta_t^2 + m*g*l*cos(theta)");
        add(R"(\frac{m}{2}\left(\dot r^2 + r^2\dot{\varphi}^2\right) + \frac{\mu m}{r})",
            "m/2*(r_t^2 + r^2*phi_t^2) + (mu*m)/r");
        add(R"(\sin^2\theta \dot\phi^2 + \sin 2\theta_1 + \cos\omega t)",
            "sin(theta)^2*phi_t^2 + sin(2*theta1) + cos(omega*t)");
        add(R"(-mc^2\sqrt{1-\frac{\dot x^2}{c^2}}.)", "-m*c^2*sqrt(1 - (x_t^2)/(c^2))");
        add(R"(\dot{\theta}_1\dot{\theta}_2\cos(\theta_1-\theta_2))",
            "theta1_t*theta2_t*cos(theta1 - theta2)");
        add(R"(\mathcal{L} = \tfrac{1}{2}\dot{q}^{2} - V_0 e^{-x/a} + e^2, )",
            "1/2*q_t^2 - V0*exp(-x/a) + e^2");
        add(R"(\left|x\right|^3+\frac{1}{\left(x^2+y^2\right)^{1/2}})", "abs(x)^3 + 1/((x^2 + y^2)^(1/2))");
        add(R"(\omega_{\rm fast}^2 \, q \cdot 9.81)", "omega_fast^2*q*9.81");
    }
    void texIsReadAsAFormula() {
        QFETCH(QString, tex);
        QFETCH(QString, formula);
        QVERIFY(isTex(tex));
        QCOMPARE(formulaFromTex(tex), formula);
        QVERIFY(!parseExpression(formula.toStdString()).nodes.empty());
    }
    /// What cannot be understood ends, whatever it is.
    void brokenTexEnds() {
        QVERIFY(!isTex("m/2*x_t^2 - k*x^2"));
        for (const char* text : {"\\", "{", "}", "\\frac", "\\frac{", "\\dot", "x^", "x_", "\\sqrt[", "|",
                                 "\\sin", "\\left(", "\\begin{a}\\end", "^^^", "__", "\\lvert x"})
            QVERIFY(formulaFromTex(text).size() < 100);
        QVERIFY(formulaFromTex(QString(5000, '{')).size() <= 20000);
        QVERIFY(formulaFromTex(QString("\\sin").repeated(2000)).size() <= 40000);
        // Whatever may stand within itself, as often as there is room for it.
        for (const char* text : {"\\sin", "\\lvert", "\\sqrt[", "\\sqrt", "\\frac", "\\dot", "(", "[", "{",
                                 "\\sin^", "\\mathrm{sin}"}) {
            const auto times = static_cast<qsizetype>(maxExpressionLength / std::strlen(text));
            QVERIFY2(formulaFromTex(QString(text).repeated(times)).size() < 1000, text);
        }
        QCOMPARE(formulaFromTex("((((((((((x))))))))))^2"), QString("((((((((((x))))))))))^2"));
    }
};

EXTREMAL_TEST(TexFormulaTest)
}  // namespace extremal::tex_formula_test

#include "tex_formula_test.moc"
