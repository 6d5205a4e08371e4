// SPDX-License-Identifier: GPL-3.0-or-later
/// Equations of motion with forces and reactions written out.
#include <QTest>

#include "engine/model/typed/part_equations.hpp"
#include "tests/tools/test.hpp"

namespace extremal::part_equations_test {
namespace {

typed::Formula ball() { return {{"x", "y"}, {{"g", 9.81}, {"c", 0.1}, {"l", 1}}, "(x_t^2 + y_t^2)/2 - g*y"}; }

std::string plain(const typed::PartTexts& parts, std::size_t line) {
    return typed::equationLines(ball(), parts, typed::TextForm::plain).at(line);
}

}  // namespace

class PartEquationsTest : public QObject {
    Q_OBJECT
private slots:
    void withoutPartsTheyAreThoseOfTheLagrangian() {
        QCOMPARE(typed::equationLines(ball(), {}, typed::TextForm::plain),
                 typed::equationLines(ball(), typed::TextForm::plain));
    }
    void reactionsAndForcesAreWrittenOut() {
        typed::PartTexts parts;
        parts.constraints = {{"rod", "x^2 + y^2 - l^2"}};
        parts.dissipation = "c/2*x_t^2";
        parts.forces = {{"y", "sin(t) - y"}};
        QCOMPARE(plain(parts, 0), std::string("x″ = −c x′ + 2 λ x"));
        QCOMPARE(plain(parts, 1), std::string("y″ + g = sin t − y + 2 λ y"));
        QCOMPARE(plain(parts, 2), std::string("x² − l² + y² = 0"));
        parts.constraints.emplace_back("wire", "x - y");
        parts.rolling = {{"blade", "x_t*sin(y) - y_t"}};
        QCOMPARE(plain(parts, 0), std::string("x″ = −c x′ + 2 λ_rod x + λ_wire + μ sin y"));
        QCOMPARE(plain(parts, 1), std::string("y″ + g = sin t − y + 2 λ_rod y − λ_wire − μ"));
    }
    void controlsAreNames() {
        typed::PartTexts parts;
        parts.forces = {{"x", "2*u - c*x_t"}};
        QCOMPARE(plain(parts, 0), std::string("x″ = 0"));  // u is not known
        parts.controls = {"u"};
        QCOMPARE(plain(parts, 0), std::string("x″ = −c x′ + 2 u"));
    }
    void texHasTheSameEquations() {
        typed::PartTexts parts;
        parts.constraints = {{"rod", "x^2 + y^2 - l^2"}};
        const std::string text = typed::texOfEquations(ball(), parts);
        QCOMPARE(text, std::string("\\begin{align*}\n"
                                   "  \\ddot{x} &= 2 \\lambda x \\\\\n"
                                   "  \\ddot{y} + g &= 2 \\lambda y \\\\\n"
                                   "  x^{2} - l^{2} + y^{2} &= 0\n"
                                   "\\end{align*}\n"));
    }
    void texHasFractionsAndFunctions() {
        const typed::Formula pendulum{
            {"theta1"}, {{"omega_0", 1}}, "theta1_t^2/2 + omega_0^2*cos(theta1) - 1/sqrt(1 + theta1^2)/3"};
        const std::string text = typed::texOfEquations(pendulum, {});
        QVERIFY(text.find("\\ddot{\\theta}_{1}") != std::string::npos);
        QVERIFY(text.find("\\omega_{0}^{2} \\sin \\theta_{1}") != std::string::npos);
        QVERIFY(text.find("\\frac{") != std::string::npos);
        QVERIFY(text.find("−") == std::string::npos && text.find("√") == std::string::npos);
    }
};

EXTREMAL_TEST(PartEquationsTest)
}  // namespace extremal::part_equations_test

#include "part_equations_test.moc"
