// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields over rectangles: Fourier modes with Gauss in time, and leapfrog with five points.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "engine/baseline/catalog.hpp"
#include "engine/family/field/plane_leapfrog.hpp"
#include "engine/family/scheme.hpp"
#include "engine/model/plane_field/problem.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::plane_field_test {
namespace {

constexpr double pi = std::numbers::pi;

struct Side {
    double left, right;
    int cells;
};

System plane(const char* potential, Side x, Side y) {
    return laws::systemNamed("field-2d", {{"potential", potential},
                                          {"domain", Value::Array{x.left, x.right}},
                                          {"domain_y", Value::Array{y.left, y.right}},
                                          {"cells", static_cast<double>(x.cells)},
                                          {"cells_y", static_cast<double>(y.cells)}});
}
const PlaneFieldProblem& problemOf(const System& system) { return *system.part<PlaneField>().problem; }

State startOf(const System& system, const char* u, const char* v = "0") {
    return {0, 0, system.start({"", {{"u", u}, {"u_t", v}}, {}}, 0)};
}

Discretization fourier(int degree, const Value& nodes = "same") {
    return {{"fourier-field", {{"degree", static_cast<double>(degree)}, {"nodes", nodes}}, {}},
            {"gauss", {{"nodes", static_cast<double>(degree)}, {"panels", 1.0}}, {}},
            {}};
}

/// Degree 0: leapfrog.
State after(const System& system, State state, int degree, double end, int steps,
            const Value& nodes = "same") {
    const auto integrator =
        degree > 0
            ? makeIntegrator(system, fourier(degree, nodes), {0, end / steps})
            : findBaseline("leapfrog")->make(system, {.step = end / steps, .settings = {"leapfrog", {}, {}}});
    for (int k = 0; k < steps; ++k)
        if (advance(*integrator, state).outcome != Outcome::converged) qFatal("a step failed");
    return state;
}

double largest(const State& a, const State& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.x.size(); ++i) most = std::max(most, std::abs(a.x[i] - b.x[i]));
    return most;
}

}  // namespace

class PlaneFieldTest : public QObject {
    Q_OBJECT
private slots:
    void alongAnAxisItIsTheFieldOnALine_data() {
        QTest::addColumn<int>("degree");
        QTest::newRow("Gauss 4") << 2;
        QTest::newRow("leapfrog") << 0;
    }
    void alongAnAxisItIsTheFieldOnALine() {
        QFETCH(int, degree);
        Settings model{"field",
                       {{"wave_speed", 1.0},
                        {"potential", "sine-gordon"},
                        {"mass", 1.0},
                        {"domain", Value::Array{-10.0, 10.0}},
                        {"boundary", "periodic"},
                        {"cells", 64.0}},
                       {}};
        if (degree > 0) model.keys.emplace_back("trigonometric", true);
        const System line = findModel("field")->make(model);
        const State known =
            after(line, {0, 0, line.start({"", {{"u", "3*exp(-x^2/2)"}, {"u_t", "x*exp(-x^2)"}}, {}}, 0)},
                  degree, 3, 40);
        for (const bool isAlongX : {true, false}) {
            const Side with{-10, 10, 64}, across{0, 7, 12};
            const System system = plane("sine-gordon", isAlongX ? with : across, isAlongX ? across : with);
            const State start = isAlongX ? startOf(system, "3*exp(-x^2/2)", "x*exp(-x^2)")
                                         : startOf(system, "3*exp(-y^2/2)", "y*exp(-y^2)");
            const State end = after(system, start, degree, 3, 40);
            double most = 0;
            for (std::size_t i = 0; i < 64; ++i)
                for (std::size_t j = 0; j < 12; ++j)
                    for (const std::size_t part : {0, 1})
                        most =
                            std::max(most, std::abs(end.x[part * 768 + (isAlongX ? i + 64 * j : j + 12 * i)] -
                                                    known.x[part * 64 + i]));
            qInfo("%.1e", most);
            QVERIFY(most < 1e-12);
        }
    }
    void orders_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<int>("steps");
        for (int degree = 1; degree <= 4; ++degree)
            QTest::addRow("degree %d", degree) << degree << (degree < 3 ? 32 : 16);
    }
    void orders() {
        // A nonlinear plane: phi-4 from a smooth start that is not along an axis, against degree 6.
        QFETCH(int, degree);
        QFETCH(int, steps);
        const System system = plane("phi4", {0, 2 * pi, 24}, {0, 3 * pi, 32});
        const State start = startOf(system, "0.6 + 0.3*cos(x)*sin(2*y/3)", "0.4*sin(x + 2*y/3)"),
                    known = after(system, start, 6, 4, 160);
        std::vector<double> h, q, p;
        const std::size_t n = start.x.size() / 2;
        for (const int count : {steps, 2 * steps, 4 * steps}) {
            const State end = after(system, start, degree, 4, count);
            double u = 0, v = 0;
            for (std::size_t i = 0; i < n; ++i) {
                u = std::max(u, std::abs(end.x[i] - known.x[i]));
                v = std::max(v, std::abs(end.x[n + i] - known.x[n + i]));
            }
            qInfo("%d steps: u %.2e, u_t %.2e", count, u, v);
            h.push_back(-std::log(count));
            q.push_back(std::log(u));
            p.push_back(std::log(v));
        }
        qInfo("order %.2f, %.2f", slope(h, q), slope(h, p));
        QVERIFY(std::abs(slope(h, q) - 2 * degree) < 0.25);
        QVERIFY(std::abs(slope(h, p) - 2 * degree) < 0.25);
    }
    void linearFieldsAreExactModeByMode() {
        const System system = plane("klein-gordon", {0, 2 * pi, 16}, {0, 2 * pi, 20});
        const State start = startOf(system, "cos(x + 2*y) + 0.5*sin(3*x)", "sin(y)"),
                    end = after(system, start, 4, 5, 100);
        const ExactSolution exact = system.exact(start);
        State known = start;
        exact(5, known.x);
        // cos(x + 2 y) and w^2 = 1 + 4 + 1 by hand.
        const double at = std::cos(std::sqrt(6.0) * 5) + std::sin(0.0);
        qInfo("%.2e, %.12f %.12f", largest(known, end), known.x[0], at);
        QVERIFY(largest(known, end) < 1e-9);
        QVERIFY(std::abs(known.x[0] - at) < 1e-12);
    }
    void momentumIsKeptWithExactNodesAlone() {
        const System system = plane("phi4", {0, 2 * pi, 24}, {0, 3 * pi, 20});
        std::mt19937 random(3);
        std::uniform_real_distribution<double> uniform(-1, 1);
        State start;
        for (std::size_t i = 0; i < 2 * problemOf(system).size(); ++i) start.x.push_back(uniform(random));
        const State rough = start;
        problemOf(system).removeAlternation(start.x);
        const auto change = [&](const State& from, const Value& nodes) {
            const auto before = problemOf(system).momentum(from.x.data());
            const State end = after(system, from, 2, 5, 50, nodes);
            const auto is = problemOf(system).momentum(end.x.data());
            return std::hypot(is[0] - before[0], is[1] - before[1]);
        };
        const double exact = change(start, "exact"), same = change(start, "same");
        qInfo("exact %.1e, same %.1e", exact, same);
        QVERIFY(exact < 1e-12 && same > 1e-4);
    }
    void aRingOfSineGordonShrinks() {
        // u(0, 4) of the radial equation, two meshes of which agree to 2.5e-11.
        const System system = plane("sine-gordon", {-14, 14, 96}, {-14, 14, 96});
        const State start = startOf(system, "4*atan(exp((25 - r^2)/10))");
        const auto middle = [&](int degree, int steps) {
            return after(system, start, degree, 4, steps).x[48 + 96 * 48];
        };
        const double error = middle(3, 80) - 6.157059909303, leapfrog = middle(0, 80) - 6.157059909303;
        qInfo("Fourier %.1e, leapfrog %.1e", error, leapfrog);
        QVERIFY(std::abs(error) < 1e-6);
        QVERIFY(std::abs(leapfrog) > 1e-3);
    }
    void aRingWallOfPhi4HasTheRadiusOfTheTable() {
        const System system = plane("phi4", {-20, 20, 128}, {-20, 20, 128});
        const State end = after(system, startOf(system, "tanh((r^2 - 100)/(20*sqrt(2)))"), 2, 4, 40);
        double radius = 0;
        for (std::size_t i = 64; i + 1 < 128; ++i) {
            const double a = end.x[i + 128 * 64], b = end.x[i + 1 + 128 * 64];
            if (a < 0 && b >= 0) radius = problemOf(system).x()[i] - a / (b - a) * 40 / 128;
        }
        qInfo("%.4f", radius);
        QVERIFY(std::abs(radius - 9.182) < 0.01);  // .4 R; the thin wall has 9.211
    }
    void leapfrogIsAnisotropicAsTheTableSays() {
        // -.910 along an axis and -.410 along the diagonal, in (k dx)^2/24, with c dt = .3 dx.
        const System system = plane("none", {0, 2 * pi, 64}, {0, 2 * pi, 64});
        const double dx = 2 * pi / 64, dt = 0.3 * dx;
        const auto factor = [&](const char* wave, double k) {
            const State start = startOf(system, wave), end = after(system, start, 0, dt, 1);
            const double w = std::acos(end.x[0] / start.x[0]) / dt;
            return (w / k - 1) * 24 / (k * dx * k * dx);
        };
        const double axis = factor("cos(x)", 1), diagonal = factor("cos(x + y)", std::sqrt(2.0));
        qInfo("%.4f %.4f", axis, diagonal);
        QVERIFY(std::abs(axis + 0.910) < 0.01 && std::abs(diagonal + 0.410) < 0.01);
    }
    void inOnePassThroughMemoryItIsLeapfrog_data() {
        QTest::addColumn<QString>("named");
        QTest::addColumn<QString>("typed");
        QTest::newRow("none") << "none"
                              << "0*u^2";
        QTest::newRow("klein-gordon") << "klein-gordon"
                                      << "mass^2*u^2/2";
        QTest::newRow("phi4") << "phi4"
                              << "(u^2 - 1)^2/4";
    }
    void inOnePassThroughMemoryItIsLeapfrog() {
        // Typed potentials keep their forces from step to step, over the whole rectangle.
        QFETCH(QString, named);
        QFETCH(QString, typed);
        for (const auto& [nx, ny] : {std::pair{4, 4}, {8, 6}, {10, 24}, {26, 4}, {150, 12}}) {
            const auto end = [&, nx = nx, ny = ny](const QString& potential) {
                const System system = plane(qPrintable(potential), {0, 3, nx}, {0, 2, ny});
                return after(system,
                             startOf(system, "0.7*sin(2*pi*x/3) + 0.4*cos(pi*y) + 0.1*x*y",
                                     "0.3*cos(2*pi*(x/3 + y/2)) - 0.2*x^2"),
                             0, 0.5, 50);
            };
            const double most = largest(end(named), end(typed));
            qInfo("%d x %d: %.1e", nx, ny, most);
            QVERIFY(most < 2e-14);
        }
    }
    void inOnePassWhatIsNotFiniteIsSeen() {
        const System system = plane("phi4", {0, 3, 26}, {0, 2, 6});
        for (std::size_t i = 0; i < 26 * 6; ++i) {
            State state = startOf(system, "1", "0");
            state.x[i] = 1e200;
            const auto integrator =
                findBaseline("leapfrog")->make(system, {.step = 0.01, .settings = {"leapfrog", {}, {}}});
            QCOMPARE(advance(*integrator, state).outcome, Outcome::notFinite);
        }
    }
    void theLimitOfLeapfrogIsWhereItIsSaid() {
        // Unlike steps along x and y.
        const System system = plane("none", {0, 2 * pi, 16}, {0, 3 * pi, 40});
        std::mt19937 random(5);
        std::uniform_real_distribution<double> uniform(-1, 1);
        State start;
        for (std::size_t i = 0; i < 2 * problemOf(system).size(); ++i) start.x.push_back(uniform(random));
        const double limit = planeLeapfrogLimit(problemOf(system), start.x.data());
        const auto grown = [&](double share) {
            const State end = after(system, start, 0, 300 * share * limit, 300);
            double most = 0;
            for (const double each : end.x) most = std::max(most, std::abs(each));
            return most;
        };
        qInfo("%.4f: %.2e, %.2e", limit, grown(0.99), grown(1.01));
        QVERIFY(grown(0.99) < 1e3 && grown(1.01) > 1e6);
    }
    void energyStaysOverLongTimes() {
        const System system = plane("sine-gordon", {-8, 8, 32}, {-8, 8, 32});
        const State start = startOf(system, "2*exp(-(x^2 + y^2)/2)");
        const double before = system.energy(0, start.x.data());
        State state = start;
        const auto integrator = makeIntegrator(system, fourier(2), {0, 0.2});
        std::vector<double> most(4);
        for (double& quarter : most)
            for (int k = 0; k < 250; ++k) {
                QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
                quarter = std::max(quarter, std::abs(system.energy(0, state.x.data()) / before - 1));
            }
        qInfo("%.1e %.1e %.1e %.1e", most[0], most[1], most[2], most[3]);
        QVERIFY(most[3] < 2 * most[0] && most[0] < 1e-3);
    }
    void whatDoesNotFitIsRefused() {
        const auto refusal = [](const std::string& scheme) {
            const ReadScene read = readScene(
                R"({"extremal": 1, "model": {"type": "field-2d", "potential": "sine-gordon"}, )"
                R"J("initial": {"u": "exp(-r^2)"}, "time": {"end": 1}, "schemes": [{"step": 0.1, )J" +
                scheme + "}]}");
            return read.errors.empty() ? std::string()
                                       : read.errors.front().pointer + ": " + read.errors.front().message;
        };
        QCOMPARE(refusal(R"("scheme": "field-gauss-2")"), std::string());
        QCOMPARE(refusal(R"("baseline": "leapfrog")"), std::string());
        for (const char* scheme :
             {R"("space": {"type": "fourier-field", "degree": 2, "nodes": "exact"})",
              R"("space": {"type": "fourier-field", "degree": 2, "modes": 32})",
              R"("space": {"type": "fourier-field", "degree": 2, "nodes": 128})",
              R"("scheme": "multisymplectic-3")", R"("baseline": "pseudospectral-splitting")"}) {
            const std::string text = refusal(scheme);
            qInfo("%s", text.c_str());
            QVERIFY(!text.empty());
        }
        const ReadScene beyond = readScene(std::string(
            R"J({"extremal": 1, "model": {"type": "field-2d"}, "initial": {"u": "exp(-r^2)"}, "time": {"end": 1}, )J"
            R"J("schemes": [{"step": 0.25, "baseline": "leapfrog"}]})J"));
        QVERIFY(!beyond.errors.empty());
        qInfo("%s", beyond.errors.front().message.c_str());
    }
};

EXTREMAL_TEST(PlaneFieldTest)

}  // namespace extremal::plane_field_test

#include "plane_field_test.moc"
