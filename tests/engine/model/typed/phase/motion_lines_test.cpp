// SPDX-License-Identifier: GPL-3.0-or-later
/// Equations of motion of typed Hamiltonians, one-forms and brackets, by hand and against the flow.
#include <QTest>

#include <string>

#include "engine/core/problem.hpp"
#include "engine/model/typed/phase/motion_lines.hpp"
#include "engine/scene/read/json.hpp"
#include "tests/tools/test.hpp"

namespace extremal::motion_lines_test {
namespace {

Settings modelOf(const char* json) { return settingsOf(parseJson(json)); }

/// The lines of a model, joined.
std::string plain(const char* json) {
    std::string text;
    for (const std::string& line : typed::motionLines(modelOf(json), typed::TextForm::plain))
        text += (text.empty() ? "" : "; ") + line;
    return text;
}

constexpr const char* massless = R"json({"type": "phase-space", "variables": ["x", "y"], "parameters": {},
    "one_form": {"x": "-(1 + x^2)*y", "y": "x"}, "hamiltonian": {"a": "cos(x)", "b": "sin(y)"}})json";

}  // namespace

class MotionLinesTest : public QObject {
    Q_OBJECT
private slots:
    void hamiltonians() {
        QCOMPARE(plain(R"json({"type": "hamiltonian", "coordinates": ["x"], "parameters": {"k": 2},
                     "hamiltonian": {"kinetic": "sqrt(1 + p_x^2)", "well": "k*x^2/2 - x*sin(t)"}})json"),
                 std::string("x′ = p_x / √(p_x² + 1); p_x′ = sin t − k x"));
        // Linear in p: there is no Lagrangian.
        QCOMPARE(plain(R"json({"type": "hamiltonian", "coordinates": ["x"], "parameters": {},
                     "hamiltonian": "p_x*x^2"})json"),
                 std::string("x′ = x²; p_x′ = −2 x p_x"));
    }
    /// Om_xy = d_x theta_y - d_y theta_x = 1 + 1 + x^2.
    void oneForms() { QCOMPARE(plain(massless), std::string("(x² + 2) y′ = −sin x; (x² + 2) x′ = −cos y")); }
    void variablesWithoutAVelocity() {
        QCOMPARE(plain(R"json({"type": "phase-space", "variables": ["x", "y"], "parameters": {},
                     "one_form": {"x": "log(y)/x"}, "hamiltonian": "y - log(y) + x - 0.5*log(x)"})json"),
                 std::string("y′ / (x y) = 1 / (2 x) − 1; x′ / (x y) = −1 / y + 1"));
    }
    void brackets() {
        QCOMPARE(
            plain(R"json({"type": "poisson", "variables": ["x", "y", "z"], "parameters": {"a": 1, "b": 2},
                     "bracket": {"x,y": "-z", "y,z": "-x", "z,x": "-y"},
                     "hamiltonian": "(a*x^2 + b*y^2 + z^2)/2"})json"),
            std::string("x′ = y z − b y z; y′ = a x z − x z; z′ = b x y − a x y"));
    }
    void texHasTheSameEquations() {
        QCOMPARE(typed::texOfMotion(modelOf(R"json({"type": "hamiltonian", "coordinates": ["theta"],
                     "parameters": {}, "hamiltonian": "p_theta^2/2 - cos(theta)"})json")),
                 std::string("\\begin{align*}\n"
                             "  \\dot{\\theta} &= p_{\\theta} \\\\\n"
                             "  \\dot{p}_{\\theta} &= -\\sin \\theta\n"
                             "\\end{align*}\n"));
    }
    void lagrangiansHaveTheirReactions() {
        QCOMPARE(plain(R"json({"type": "lagrangian", "coordinates": ["x", "y"], "parameters": {"l": 1},
                     "lagrangian": "(x_t^2 + y_t^2)/2", "constraints": {"rod": "x^2 + y^2 - l^2"}})json"),
                 std::string("x″ = 2 λ x; y″ = 2 λ y; x² − l² + y² = 0"));
    }
    void othersHaveNone() {
        QVERIFY(!typed::hasMotionLines(modelOf(R"json({"type": "kepler"})json")));
        QVERIFY(plain(R"json({"type": "kepler"})json").empty());
        QVERIFY(typed::texOfMotion(modelOf(R"json({"type": "kepler"})json")).empty());
    }
    void whatCannotBeReadIsRefused() {
        QVERIFY_THROWS_EXCEPTION(InvalidScene,
                                 plain(R"json({"type": "poisson", "variables": ["x", "y"], "parameters": {},
                                     "bracket": {"x,q": "1"}, "hamiltonian": "x"})json"));
    }
};

EXTREMAL_TEST(MotionLinesTest)
}  // namespace extremal::motion_lines_test

#include "motion_lines_test.moc"
