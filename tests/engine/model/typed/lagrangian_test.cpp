// SPDX-License-Identifier: GPL-3.0-or-later
/// What a typed Lagrangian means: its derivatives, what is recognised in it, and what is refused.
#include <QTest>

#include <cmath>
#include <thread>

#include "engine/core/problem.hpp"
#include "engine/model/typed/symbolic.hpp"
#include "engine/model/typed/typeset.hpp"
#include "tests/engine/model/typed/typed.hpp"
#include "tests/tools/jacobian.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::lagrangian_test {
namespace {

/// The problem of a Lagrangian in x with parameters k = 2 and n = 2, or an empty one.
Problem problemOf(const std::string& lagrangian, Value::Array coordinates = {"x"},
                  Value::Object parameters = {{"k", 2}, {"n", 2}}) {
    try {
        typedSystem(std::move(coordinates), std::move(parameters), lagrangian);
        return {};
    } catch (const InvalidScene& e) {
        return e.problems().front();
    }
}

struct Jet2 {
    double value = 0;
    std::vector<double> gradient, hessian;
};
Jet2 jetAt(const System& s, double t, std::vector<double> q, std::vector<double> v) {
    const auto n = 2 * q.size();
    Jet2 j{0, std::vector<double>(n), std::vector<double>(n * n)};
    s.mechanics().jet(s.mechanics().model.get(), t, q.data(), v.data(), &j.value, j.gradient.data(),
                      j.hessian.data());
    return j;
}

}  // namespace

class LagrangianTest : public QObject {
    Q_OBJECT
private slots:
    void derivativesAreThoseOfDifferences_data() {
        QTest::addColumn<QString>("term");
        for (const char* term :
             {"sin(x*y_t)",
              "cos(x + 2*y)",
              "tan(x/2)",
              "asin(x/3)",
              "acos(y/3)",
              "atan(x*y)",
              "atan2(y, x)",
              "sinh(x - y)",
              "cosh(x_t)",
              "tanh(x*y)",
              "exp(-x^2)",
              "log(x + 3)",
              "sqrt(x^2 + y^2)",
              "abs(x)*y",
              "sign(x)*y_t^2",
              "x^3*y^-2",
              "x^-1.5",
              "(x + 3)^1.7",
              "x^y",
              "2^(x*y)",
              "1/(1 + x^2)^2.5",
              "x_t^4",
              "dot(x)*y*t",
              "asinh(x*y)",
              "acosh(x + y)",
              "atanh(x*y/2)",
              "log10(x + y)",
              "ln(x*y)*pow(y, 3)",
              "erf(x*y) + erfc(x - y)",
              "hypot(x, y, x_t)",
              "floor(x + y + 0.4)*x^2 + ceil(x*y)*y^2 + round(x_t)*x + heaviside(y - x)*x*y",
              "mod(x^2 + y, 1.5)*y",
              "max(x^2, y) + min(x*y, y^3, 7)",
              "if(x < y, x*y^2, log(-x))",
              "if(x > y && y > 0 || x == 5, log(-x), sin(x*y))",
              "piecewise(x > 1, log(-x), y >= 5, log(-y), x^2*y)",
              "(x <= y)*x^3*y",
              "max(if(x < y, x*y, 7), y^2)^2",
              "table(x*y; 0, 1; 0.5, 3; 2, -1)*y",
              "spline(x + y; 0, 1; 1, 3; 3, -1; 4, 2)*x + spline(-x*y; 0, 0; 1, 1)",
              "t^2*x",
              "((x + y)*(x - y) + 1)^3/7",
              "x^(n + 1)",
              "pi*x^2",
              "(x + 1)*(y + 1)*(x + 2)*(y + 2)*(x + 3)*(y + 3)*(x + 4)*(y + 4)*(x + 5)*(y + 5)*(x + 6)*(y + "
              "6)*(x+7)",
              "sin(sin(x+1)+cos(y+2)+sin(x+3)+cos(y+4)+sin(x+5)+cos(y+6)+sin(x+7)+cos(y+8)+sin(x+9)+cos(y+10)"
              "+sin(x+11)+cos(y+12)+sin(x+13)+cos(y*x+14)+sin(x+15)+cos(y+16)+sin(x_t+17)+cos(y+18))^2"})
            QTest::newRow(term) << term;
    }
    void derivativesAreThoseOfDifferences() {
        QFETCH(QString, term);
        const std::string L = "x_t^2/2 + y_t^2 + " + term.toStdString();
        const System s = typedSystem({"x", "y"}, {{"n", 2}}, L);
        const std::vector<double> at = {0.7, 1.3, 0.4, -0.6};
        auto jet = [&](const std::vector<double>& z) { return jetAt(s, 0.3, {z[0], z[1]}, {z[2], z[3]}); };
        const Jet2 here = jet(at);
        const Expression expression = parseExpression(L);
        // The value by the interpreter of number expressions, which knows nothing of the tape; dot(x) written
        // out.
        if (!term.contains("dot")) {
            const double expected = evaluate(expression, [&](std::string_view name) -> std::optional<double> {
                if (name == "n") return 2;
                return name == "x"     ? at[0]
                       : name == "y"   ? at[1]
                       : name == "x_t" ? at[2]
                       : name == "y_t" ? at[3]
                                       : 0.3;
            });
            QVERIFY(std::abs(here.value - expected) < 1e-14 * std::max(1.0, std::abs(expected)));
        }
        constexpr double delta = 1e-2;  // differences of order 6
        constexpr std::array<double, 3> c = centralDifferences;
        double largest = 1;
        for (const double h : here.hessian) largest = std::max(largest, std::abs(h));
        for (const double g : here.gradient) largest = std::max(largest, std::abs(g));
        for (std::size_t i = 0; i < 4; ++i) {
            double slope = 0;
            std::vector<double> row(4, 0);
            for (int k = 1; k <= 3; ++k)
                for (const int sign : {1, -1}) {
                    std::vector<double> z = at;
                    z[i] += sign * k * delta;
                    const Jet2 there = jet(z);
                    slope += sign * c[static_cast<std::size_t>(k - 1)] * there.value / delta;
                    for (std::size_t j = 0; j < 4; ++j)
                        row[j] += sign * c[static_cast<std::size_t>(k - 1)] * there.gradient[j] / delta;
                }
            QVERIFY2(std::abs(slope - here.gradient[i]) < 1e-8 * largest,
                     qPrintable(QString("gradient %1").arg(i)));
            for (std::size_t j = 0; j < 4; ++j)
                QVERIFY2(std::abs(row[j] - here.hessian[i * 4 + j]) < 1e-8 * largest,
                         qPrintable(QString("hessian %1 %2").arg(i).arg(j)));
        }
    }
    void kinksHaveDerivativeZeroAtZero() {
        const System s = typedSystem({"x"}, {}, "x_t^2/2 + abs(x) + 3*sign(x)*x_t");
        const Jet2 j = jetAt(s, 0, {0}, {1});
        QCOMPARE(j.gradient[0], 0.0);
        QCOMPARE(j.hessian[0], 0.0);
        QCOMPARE(jetAt(s, 0, {-2}, {1}).gradient[0], -1.0);
        QCOMPARE(jetAt(s, 0, {-2}, {1}).gradient[1], 1.0 - 3.0);
    }
    void integerPowersAreSmoothAtZero() {
        // A parameter as exponent, and products of powers: no 0/0.
        for (const char* term : {"x^n", "x^3/x*1", "(3*x)^n/9", "x^(2*n - 2)"}) {
            const System s = typedSystem({"x"}, {{"n", 2}}, std::string("x_t^2/2 + ") + term);
            const Jet2 j = jetAt(s, 0, {0}, {0});
            QCOMPARE(j.gradient[0], 0.0);
            QCOMPARE(j.hessian[0], 2.0);
        }
        const System s = typedSystem({"x"}, {{"n", 1}}, "x_t^2/2 + x^n");
        QCOMPARE(jetAt(s, 0, {0}, {0}).gradient[0], 1.0);
        QCOMPARE(jetAt(s, 0, {0}, {0}).hessian[0], 0.0);
    }
    /// A product with 0 would make a NaN of the branch that is not taken.
    void branchesThatAreNotTakenDoNotMatter() {
        const System s = typedSystem({"x"}, {{"k", 2}}, "x_t^2/2 - if(x > 0, k*x*log(x), x^2)");
        const Jet2 j = jetAt(s, 0, {-0.5}, {1});
        QCOMPARE(j.value, 0.5 - 0.25);
        QCOMPARE(j.gradient[0], 1.0);
        QCOMPARE(j.hessian[0], -2.0);
        QCOMPARE(jetAt(s, 0, {0.5}, {1}).gradient[0], -2 * (std::log(0.5) + 1));
        // Of max and min the first argument counts where both are equal.
        const System kinks = typedSystem({"x"}, {}, "x_t^2/2 + max(2*x, 3*x) + min(5*x, 7*x)");
        QCOMPARE(jetAt(kinks, 0, {0}, {0}).gradient[0], 2.0 + 5.0);
        QCOMPARE(jetAt(kinks, 0, {1}, {0}).gradient[0], 3.0 + 5.0);
        QCOMPARE(jetAt(kinks, 0, {-1}, {0}).gradient[0], 2.0 + 7.0);
    }
    /// Parameters and coordinates that have such names mean what they meant before there were the functions.
    void namesOfFunctionsMayBeParametersAndCoordinates() {
        const System s = typedSystem({"max", "floor"}, {{"step", 3}, {"if", 5}},
                                     "max_t^2/2 + floor_t^2/2 - step*max^2 - if*floor + max(max, floor)");
        const Jet2 j = jetAt(s, 0, {2, 1}, {1, 1});
        QCOMPARE(j.value, 1 - 12 - 5 + 2.0);
        QCOMPARE(j.gradient[0], -12.0 + 1);
        QCOMPARE(j.gradient[1], -5.0);
        QCOMPARE(problemOf("x_t^2 - floor*x").hint,
                 std::string("as a function it needs brackets: floor(...)"));
    }
    void equationsHaveBranchesAndTables() {
        typed::Formula formula{{"x"}, {{"k", 2}}, "x_t^2/2 - if(x <= k, max(x, k), table(t; 0, 1; 1, 2)*x)"};
        QCOMPARE(typed::equationLines(formula, typed::TextForm::plain).front(),
                 std::string("x″ + if(x ≤ k, if(x < k, 0, 1), table t) = 0"));
        formula.text = "x_t^2/2 - spline(x; 0, 0; 1, 1) - (x < k)*x";
        QCOMPARE(typed::equationLines(formula, typed::TextForm::rich).front(),
                 std::string("<i>x</i>″ + (<i>x</i> &lt; <i>k</i>) + spline′ <i>x</i> = 0"));
    }
    void separableLagrangiansAreRecognised() {
        const auto isSeparable = [](const char* L) {
            return typedSystem({"x", "y"}, {{"m", 2}}, L).mechanics().isSeparable;
        };
        QVERIFY(isSeparable("m*x_t^2/2 + 3*y_t^2 - sin(x*y)*t"));
        QVERIFY(isSeparable("(x_t + y_t)^2 + (x_t - y_t)^2 - x"));
        QVERIFY(!isSeparable("x_t^2 + y_t^2 + x*y_t"));
        QVERIFY(!isSeparable("x_t^2 + y_t^2 + t*y_t"));
        QVERIFY(!isSeparable("x_t^2 + y_t^2 + 3*y_t"));
        QVERIFY(!isSeparable("x_t^2 + (1 + x^2)*y_t^2"));
        QVERIFY(!isSeparable("x_t^2 + y_t^2 + x_t*y_t"));
        QVERIFY(!isSeparable("t*x_t^2 + x_t^2 + y_t^2"));
        QVERIFY(!isSeparable("x_t^2 + y_t^2 + x*sign(y_t)"));
        QVERIFY(!isSeparable("x_t^2 + y_t^2 + if(x_t > 1, x, y)"));
        const System s = typedSystem({"x", "y"}, {{"m", 2}}, "m*x_t^2/2 + 3*y_t^2 - sin(x*y)*t");
        QCOMPARE(s.mechanics().masses[0], 2.0);
        QCOMPARE(s.mechanics().masses[1], 6.0);
        double f[2];
        const double q[2] = {0.5, 0.25};
        s.mechanics().force(s.mechanics().model.get(), 2, q, f);
        QCOMPARE(f[0], -2 * 0.25 * std::cos(0.125));
        QVERIFY(s.mechanics().isTimeDependent);
    }
    void cyclicCoordinatesHaveMomenta() {
        const auto momentaOf = [](const char* L, Value::Object parameters = {}) {
            QStringList names;
            for (const MomentumMap& m : typedSystem({"r", "phi", "z"}, std::move(parameters), L).momenta)
                names << QString::fromStdString(m.name);
            return names;
        };
        QCOMPARE(momentaOf("(r_t^2 + r^2*phi_t^2 + z_t^2)/2 + 1/r"), (QStringList{"phi", "z"}));
        QCOMPARE(momentaOf("(r_t^2 + r^2*phi_t^2 + z_t^2)/2 + 1/r - z"), QStringList{"phi"});
        QCOMPARE(momentaOf("(r_t^2 + r^2*phi_t^2 + z_t^2)/2 + 1/r - g*z", {{"g", 0}}),
                 (QStringList{"phi", "z"}));
        QCOMPARE(momentaOf("(r_t^2 + r^2*phi_t^2 + z_t^2)/2 + (z+1)*(z-1) - z^2"),
                 (QStringList{"r", "phi", "z"}).mid(1));
    }
    void eightNodesTogetherAreThoseOneByOne_data() { derivativesAreThoseOfDifferences_data(); }
    void eightNodesTogetherAreThoseOneByOne() {
        QFETCH(QString, term);
        const System s = typedSystem({"x", "y"}, {{"n", 2}}, "x_t^2/2 + y_t^2 + " + term.toStdString());
        const auto& m = s.mechanics();
        constexpr int nodes = 16;
        std::vector<double> t(nodes), q(2 * nodes), v(2 * nodes), g(4 * nodes), h(16 * nodes), f(2 * nodes);
        for (int i = 0; i < nodes; ++i) {
            const auto at = static_cast<std::size_t>(i);
            t[at] = 0.1 * i;
            q[at] = 0.7 + 0.02 * i;
            q[at + nodes] = 1.3 - 0.01 * i;
            v[at] = 0.4 - 0.03 * i;
            v[at + nodes] = -0.6 + 0.05 * i;
        }
        m.gradients(m.model.get(), t.data(), nodes, q.data(), v.data(), g.data());
        m.hessians(m.model.get(), t.data(), nodes, q.data(), v.data(), h.data());
        QCOMPARE(m.forces != nullptr, m.isSeparable);
        if (m.forces) m.forces(m.model.get(), t.data(), nodes, q.data(), f.data());
        for (std::size_t i = 0; i < nodes; ++i) {
            const Jet2 one = jetAt(s, t[i], {q[i], q[i + nodes]}, {v[i], v[i + nodes]});
            double largest = 1;
            for (const double each : one.gradient) largest = std::max(largest, std::abs(each));
            for (const double each : one.hessian) largest = std::max(largest, std::abs(each));
            for (std::size_t k = 0; k < 4; ++k)
                QVERIFY(std::abs(g[k * nodes + i] - one.gradient[k]) <= 1e-14 * largest);
            for (std::size_t k = 0; k < 16; ++k)
                QVERIFY(std::abs(h[k * nodes + i] - one.hessian[k]) <= 1e-14 * largest);
            for (std::size_t k = 0; k < 2 && m.forces; ++k)
                QVERIFY(std::abs(f[k * nodes + i] - one.gradient[k]) <= 1e-14 * largest);
        }
    }
    void theLegendreTransformIsInverted() {
        // Diagonal, full, and not quadratic in the velocities (a relativistic particle).
        for (const char* L : {"x_t^2*(1 + y^2)/2 + y_t^2 + 3*x*y_t", "x_t^2 + y_t^2 + cos(x)*x_t*y_t + x_t",
                              "-4*sqrt(4 - x_t^2 - y_t^2) + x", "cosh(x_t) + y_t^2 + y_t^4/4"}) {
            const System s = typedSystem({"x", "y"}, {}, L);
            const auto& m = s.mechanics();
            const double q[2] = {0.4, -0.7}, v[2] = {0.9, -0.3};
            double g[4], found[2];
            m.gradient(m.model.get(), 0, q, v, g);
            QVERIFY(m.velocity(m.model.get(), 0, q, g + 2, found));
            QVERIFY(std::abs(found[0] - v[0]) < 2e-15 && std::abs(found[1] - v[1]) < 2e-15);
            const Jet2 j = jetAt(s, 0, {q[0], q[1]}, {v[0], v[1]});
            QVERIFY(std::abs(m.energy(m.model.get(), 0, q, g + 2) - (g[2] * v[0] + g[3] * v[1] - j.value)) <
                    1e-14);
        }
        // Newton's method from rest overshoots the speed of light.
        const System fast = typedSystem({"x", "y"}, {}, "-4*sqrt(4 - x_t^2 - y_t^2) + x");
        for (const double speed : {1.5, 1.9, 1.99, 1.9999, 1.999999}) {
            const auto& m = fast.mechanics();
            const double q[2] = {0.4, -0.7}, v[2] = {0.8 * speed, -0.6 * speed};
            double g[4], found[2];
            m.gradient(m.model.get(), 0, q, v, g);
            QVERIFY(m.velocity(m.model.get(), 0, q, g + 2, found));
            QVERIFY(std::abs(found[0] - v[0]) < 1e-14 && std::abs(found[1] - v[1]) < 1e-14);
        }
        // L has no curvature at rest, or no value there.
        for (const char* text : {"x_t^4/4 - x^2/2", "abs(x_t)^3/3", "x_t*log(x_t)", "x_t^6",
                                 "x_t^4/4 + x^2*x_t^3/10", "abs(x_t)^1.5"}) {
            const System hard = typedSystem({"x"}, {}, text);
            const auto& m = hard.mechanics();
            for (const double speed : {1e-3, 0.2, 1.0, 3.0, 50.0}) {
                const double q = 0.3;
                double g[2], found = 0;
                m.gradient(m.model.get(), 0, &q, &speed, g);
                QVERIFY2(m.velocity(m.model.get(), 0, &q, g + 1, &found), text);
                QVERIFY2(std::abs(found - speed) < 1e-9 * speed, text);  // of 1e-3, 1e-14 of the momentum
            }
        }
        // Where no velocity has this momentum it says so.
        const System bounded = typedSystem({"x"}, {}, "atan(x_t)*x_t + x_t^2/1e6 - x_t^4");
        double v = 0;
        const double q = 0, p = 1e9;
        (void)bounded.mechanics().velocity(bounded.mechanics().model.get(), 0, &q, &p, &v);
    }
    void mistakesAreShownWhereTheyAre_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("message");
        QTest::addColumn<int>("caret");
        QTest::addColumn<QString>("hint");
        QTest::newRow("nearest name") << "x_t^2 + kk*x"
                                      << "has an unknown name \"kk\"" << 8 << "did you mean \"k\"?";
        QTest::newRow("nearest velocity") << "x_tt^2"
                                          << "has an unknown name \"x_tt\"" << 0 << "did you mean \"x_t\"?";
        QTest::newRow("dot of a parameter")
            << "dot(k)^2"
            << "has dot(...) of something other than a coordinate" << 0 << "coordinates: x";
        QTest::newRow("unknown function") << "x_t^2 + sine(x)"
                                          << "has no function \"sine\"" << 8 << "did you mean \"sin\"?";
        QTest::newRow("open bracket") << "x_t^2 + (x"
                                      << "has a bracket that is not closed" << 8 << "";
        QTest::newRow("constant pole") << "x_t^2 + x/(2 - 2)"
                                       << "divides by zero" << 9 << "";
        QTest::newRow("arguments") << "x_t^2 + if(x, 1)"
                                   << "needs three arguments for if" << 15 << "";
        QTest::newRow("empty table") << "x_t^2 + table(x)"
                                     << "needs at least two points for table" << 15
                                     << "write table(x; 0, 0; 1, 2), points x, y after semicolons";
        QTest::newRow("table with a name") << "x_t^2 + table(x; 0, 0; k, 1)"
                                           << "has the name \"k\" in a point of table, which are numbers"
                                           << 23 << "scale the whole: F*table(x/X; 0, 0; 1, 1)";
        QTest::newRow("unsorted table") << "x_t^2 + spline(x; 1, 0; 0, 1)"
                                        << "has points of spline that are not in ascending order" << 24
                                        << "each x greater than the one before it";
        QTest::newRow("infinite constant") << "x_t^2 + 9^9^9^9*x"
                                           << "is not finite here: inf" << 11 << "";
    }
    void mistakesAreShownWhereTheyAre() {
        QFETCH(QString, text);
        QFETCH(QString, message);
        QFETCH(int, caret);
        QFETCH(QString, hint);
        const Problem problem = problemOf(text.toStdString());
        QCOMPARE(problem.pointer, std::string("/lagrangian"));
        const QStringList lines = QString::fromStdString(problem.message).split('\n');
        QCOMPARE(lines.size(), 3);
        QCOMPARE(lines[0], message);
        QCOMPARE(lines[1], "    " + text);
        QCOMPARE(lines[2].indexOf('^'), 4 + caret);
        QCOMPARE(QString::fromStdString(problem.hint), hint);
    }
    void degenerateLagrangiansAreRefused() {
        QVERIFY(problemOf("x_t*x").message.find("no square of x_t") != std::string::npos);
        QVERIFY(problemOf("(x_t + y_t)^2 - x*y", {"x", "y"}).message.find("singular matrix") !=
                std::string::npos);
        QVERIFY(problemOf("x_t^2 - y^2", {"x", "y"}).message.find("no square of y_t") != std::string::npos);
        QVERIFY(problemOf("x_t^2 - 1e-20*y_t^2", {"x", "y"}).message.empty());  // small, but regular
    }
    void namesAreChecked() {
        QCOMPARE(problemOf("x_t^2", {"x", "x"}).pointer, std::string("/coordinates/1"));
        QCOMPARE(problemOf("x_t^2", {"x"}, {{"x", 1}}).pointer, std::string("/parameters/x"));
        for (const char* wrong : {"t", "pi", "sin", "y_t", "1x", "", "a b", "é", "x-y"})
            QCOMPARE(problemOf("x_t^2", {"x", wrong}).pointer, std::string("/coordinates/1"));
        QCOMPARE(problemOf("dot^2 + x_t^2 + dot(dot)^2", {"x", "dot"}).message, std::string());
        Value::Array many;
        std::string L;
        for (int i = 0; i < 65; ++i) {
            many.emplace_back("q" + std::to_string(i));
            L += (i ? "+q" : "q") + std::to_string(i) + "_t^2";
        }
        QCOMPARE(problemOf(L, many).message, std::string());
        for (int i = 65; i < 2001; ++i) many.emplace_back("q" + std::to_string(i));
        QCOMPARE(problemOf(L, many).message, std::string("has 2001 names, the limit is 2000"));
    }
    void nothingTakesLong_data() {
        QTest::addColumn<QString>("text");
        const auto nest = [](QString inner, const char* form, int times) {
            for (int i = 0; i < times; ++i) inner = QString(form).arg(inner);
            return "x_t^2 + " + inner;
        };
        const auto join = [](int n, auto&& part, const char* glue) {
            QStringList parts;
            for (int i = 0; i < n; ++i) parts << part(i);
            return "x_t^2 + " + parts.join(glue);
        };
        QTest::newRow("x^x to the left") << nest("x", "(%1^x)", 190);
        QTest::newRow("x^x to the right") << nest("x", "x^(%1)", 95);
        QTest::newRow("exponentials") << nest("x", "exp(%1)", 190);
        QTest::newRow("tangents") << nest("x", "tan(%1*x)", 190);
        QTest::newRow("tower of powers") << nest("(1.7*x+3)", "(%1^59+1)", 180);
        QTest::newRow("large power") << "x_t^2 + (1.1*x)^1000000 + (2*x)^-999999999 + (3/7*x)^1234567.5";
        QTest::newRow("rationals") << nest("x", "(1.37*%1+x/7)", 190);
        QTest::newRow("product") << join(
            1000, [](int i) { return QString("(x+%1)").arg(i); }, "*");
        QTest::newRow("product of velocities") << join(
            900, [](int i) { return QString("(x_t+%1)").arg(i); }, "*");
        QTest::newRow("sum") << join(
            4900, [](int) { return QString("x"); }, "+");
        QTest::newRow("maxima") << nest("x", "max(%1, x^2)", 190);
        QTest::newRow("choices") << nest("x", "if(%1 > 1, x*%1, 3)", 8);
        QTest::newRow("chain of conditions") << join(
                                                    900, [](int i) { return QString("x > %1").arg(i); }, "&&")
                                                        .replace("x_t^2 +", "x_t^2 + x*(") +
                                                    ")";
        QTest::newRow("quotients") << nest("x", "(1/(x+%1))", 190);
    }
    /// Whatever the formula, its derivatives are found or refused: without the limit of time, this test would
    /// not end if the work grew exponentially with the length of the formula. Measured: at most 1 s.
    void nothingTakesLong() {
        QFETCH(QString, text);
        constexpr double hours = 1e4;
        const typed::Formula formula{{"x"}, {{"k", 2}, {"n", 2}}, text.toStdString()};
        try {
            QVERIFY(typed::differentiate(formula, {}, hours));
        } catch (const ExpressionError&) {
        }
        (void)problemOf(text.toStdString());
    }
    void whatTakesTooLongIsGivenUp() {
        // 64 coordinates inside each other: the Hessian alone has millions of parts.
        typed::Formula formula{{}, {}, ""};
        std::string nest = "q0";
        for (int i = 0; i < 64; ++i) {
            formula.coordinates.push_back("q" + std::to_string(i));
            formula.text += "q" + std::to_string(i) + "_t^2+";
        }
        for (int i = 1; i < 190; ++i)
            nest = "tan(" + nest + "+q" + std::to_string(i % 64) + "*q" + std::to_string(7 * i % 64) + ")";
        formula.text += nest;
        const auto message = [&](double work) {
            try {
                (void)typed::differentiate(formula, {}, work);
                return std::string();
            } catch (const ExpressionError& e) {
                return std::string(e.what());
            }
        };
        QVERIFY2(message(0).starts_with("takes more than 0 operations to differentiate"), message(0).c_str());
        QCOMPARE(message(5e9), message(0));  // remembered: nothing is tried again
    }
    void whatWasDifferentiatedIsRemembered() {
        const typed::Formula formula{{"x"}, {{"k", 2}}, "x_t^2/2 - k*x^4 - 0.125*x"};
        const auto first = typed::differentiate(formula);
        QVERIFY(first && typed::differentiate(formula) == first);
    }
    void manyThreadsShareOneSystem() {
        const System s = typedSpringPendulum();
        const auto run = [&s] {
            const auto integrator = makeIntegrator(s, polynomialPair(2, {"gauss", {}, {}}), {0, 0.001});
            return after(*integrator, {0, 0, {0.05, 1, 0, 0}}, 2000)->x;
        };
        const std::vector<double> alone = run();
        std::vector<std::vector<double>> found(4);
        {
            std::vector<std::jthread> threads;
            for (auto& f : found) threads.emplace_back([&f, &run] { f = run(); });
        }
        for (const auto& f : found) QVERIFY(f == alone);
    }
    void equationsAreTypeset() {
        const typed::Formula pendulum{{"theta1"},
                                      {{"m", 1}, {"l", 2}, {"g", 9.81}, {"omega_0", 1}},
                                      "m/2*l^2*theta1_t^2 + m*g*l*cos(theta1) - 0.5*omega_0^2*theta1^2"};
        const auto plain = typed::equationLines(pendulum, typed::TextForm::plain);
        QCOMPARE(QString::fromStdString(plain.at(0)), QString("m l² θ₁″ + m l g sin θ₁ + ω₀² θ₁ = 0"));
        const auto rich = typed::equationLines(pendulum, typed::TextForm::rich);
        QVERIFY(rich.at(0).starts_with("<i>m</i> <i>l</i><sup>2</sup> <i>θ</i><sub>1</sub>″"));
        QCOMPARE(typed::symbolOf("omega_0"), std::string("ω₀"));
        QCOMPARE(typed::symbolOf("x12"), std::string("x₁₂"));
        QCOMPARE(typed::symbolOf("speed"), std::string("speed"));
    }
};

EXTREMAL_TEST(LagrangianTest)
}  // namespace extremal::laws::lagrangian_test

#include "lagrangian_test.moc"
