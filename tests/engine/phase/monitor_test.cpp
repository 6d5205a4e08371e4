// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps that follow a monitor: the table and the orders of the design page "phase space" (law PS4), the same
/// steps from a Lagrangian that is typed in the transformed time, the form, there and back, and refusals.
#include <QTest>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/model/symplectic_form.hpp"
#include "engine/phase/monitored.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/scene_steps.hpp"
#include "tests/tools/tangent.hpp"
#include "tests/tools/test.hpp"

namespace extremal::monitor_test {
namespace {

constexpr double pi = 3.14159265358979323846, span = 3.3 * 2 * pi;

QByteArray keplerScene(double e, const QByteArray& scheme, double end, const char* model = "") {
    return QByteArray(R"json({"extremal": 1, "model": MODEL,
        "initial": {"q": ["1-ECC", 0], "p": [0, "sqrt((1+ECC)/(1-ECC))"]}, "time": {"end": END},
        "observe": ["energy", "reversibility"], "reference": "none", "schemes": [SCHEME]})json")
        .replace("MODEL", *model ? QByteArray(model) : QByteArray(R"({"type": "kepler"})"))
        .replace("ECC", QByteArray::number(e))
        .replace("END", QByteArray::number(end, 'g', 17))
        .replace("SCHEME", scheme);
}
QByteArray gaussScheme(int degree, double step, const QByteArray& monitor) {
    return "{\"scheme\": \"galerkin-gauss-" + QByteArray::number(degree) +
           "\", \"step\": " + QByteArray::number(step, 'g', 17) +
           (monitor.isEmpty() ? QByteArray() : ", \"monitor\": " + monitor) + "}";
}
const QByteArray typedRadius =
    R"json({"type": "typed", "monitor": "r^1.5", "let": {"r": "sqrt(x^2+y^2)"}})json";

struct End {
    bool hasArrived = true;
    int steps = 0;
    double error = 0, energy = 0, momentum = 0;
};
/// A run to `end`, against the exact orbit at its last node.
End runOf(double e, int degree, double step, const QByteArray& monitor, double end = span) {
    const ReadScene scene = readScene(keplerScene(e, gaussScheme(degree, step, monitor), end).toStdString());
    const auto integrator = tests::integratorOf(scene);
    const ResolvedScene& r = *scene.resolved;
    const EnergyFunction energy = energyOf(*r.system);
    const double atStart = energy(0, r.initial.x.data());
    State s = r.initial;
    integrator->begin(s);
    End found;
    const auto moment = [](const State& of) { return of.x[0] * of.x[3] - of.x[1] * of.x[2]; };
    while (s.t < end * (1 - 1e-10)) {
        if (integrator->advance(s, monitor.isEmpty() ? (found.steps + 1) * step : end).outcome !=
                Outcome::converged ||
            found.steps > 100000) {
            found.hasArrived = false;
            return found;
        }
        ++found.steps;
        found.energy = std::max(found.energy, std::abs(energy(s.t, s.x.data()) - atStart));
        found.momentum = std::max(found.momentum, std::abs(moment(s) - moment(r.initial)));
    }
    std::vector<double> exact(4);
    r.system->exact(r.initial)(s.t, exact);
    found.error = std::hypot(s.x[0] - exact[0], s.x[1] - exact[1]);
    return found;
}
/// The time that so many steps take, all of them equal in tau.
double timeOf(double e, int degree, double first, int steps, const QByteArray& monitor) {
    return tests::stateAfter(
               readScene(keplerScene(e, gaussScheme(degree, first, monitor), span).toStdString()), steps)
        .value()
        .t;
}
/// With so many steps, the last of which ends at the end of the run: with few steps an encounter the error
/// is not a smooth function of their number, and one step more or less is another figure.
End withSteps(double e, int degree, int steps, const QByteArray& monitor) {
    double first = 0.05 * std::pow(1 - e, 1.5);
    first *= runOf(e, 4, first, monitor).steps / static_cast<double>(steps);
    double before = first * 1.001, there = timeOf(e, degree, before, steps, monitor) - span;
    for (int k = 0; k < 12; ++k) {
        const double off = timeOf(e, degree, first, steps, monitor) - span;
        if (std::abs(off) < 1e-11 * span || off == there) break;
        const double next = first - off * (first - before) / (off - there);
        before = std::exchange(first, next);
        there = off;
    }
    return runOf(e, degree, first, monitor);
}

}  // namespace

class MonitorTest : public QObject {
    Q_OBJECT private slots : void tableOfThePage_data() {
        QTest::addColumn<double>("e");
        QTest::addColumn<QByteArray>("monitor");
        QTest::addColumn<int>("degree");
        QTest::addColumn<int>("steps");
        QTest::addColumn<double>("error");
        QTest::addColumn<double>("energy");
        const std::vector<int> steps{2000, 1000, 500, 400};
        const auto rows = [&](double e, const char* name, const QByteArray& monitor,
                              std::vector<double> errors, std::vector<double> energies) {
            for (int s = 1; s <= 4; ++s) {
                const auto k = static_cast<std::size_t>(s - 1);
                QTest::addRow("e=%g, %s, s=%d", e, name, s)
                    << e << monitor << s << steps[k] << errors[k] << energies[k];
            }
        };
        rows(.9, "r^1.5", typedRadius, {1.2e-3, 5.3e-9, 8.8e-11, 1e-12}, {8e-5, 1e-8, 1e-11, 1e-12});
        rows(.99, "r^1.5", typedRadius, {2.5e-3, 3.3e-7, 1.6e-10, 1e-11}, {2e-3, 5e-7, 1e-9, 1e-11});
        rows(.9, "auto", "\"auto\"", {1.2e-3, 5.3e-9, 8.8e-11, 1e-12}, {8e-5, 1e-8, 1e-11, 1e-12});
        rows(.99, "auto", "\"auto\"", {2.5e-3, 3.3e-7, 1.6e-10, 1e-11}, {2e-3, 5e-7, 1e-9, 1e-11});
        rows(.9, "action", "\"action\"", {1.4e-3, 1.1e-8, 4.7e-11, 1e-12}, {1, 1, 1, 1});
        rows(.99, "action", "\"action\"", {4.5e-3, 1.2e-7, 1.1e-8, 5.2e-11}, {1, 1, 1, 1});
        // Of degree 4 it is 7e-11 to 1.6e-9 for 396 to 404 steps, as other code in long double has it too.
        rows(.9, "arclength", "\"arclength\"", {1.2e-3, 5.3e-7, 2.3e-8, 1e-10}, {1, 1, 1, 1});
        rows(.9, "r", "\"sqrt(x^2+y^2)\"", {1.1e-3, 5.5e-8, 1.8e-10, 1e-12}, {1, 1, 1, 1});
    }
    void tableOfThePage() {
        QFETCH(double, e);
        QFETCH(QByteArray, monitor);
        QFETCH(int, degree);
        QFETCH(int, steps);
        QFETCH(double, error);
        QFETCH(double, energy);
        const End found = withSteps(e, degree, steps, monitor);
        QVERIFY(found.hasArrived);
        qInfo("%d steps: error %.1e (page %.1e), energy %.1e (%.1e), L %.1e", found.steps, found.error, error,
              found.energy, energy, found.momentum);
        QVERIFY(std::abs(found.steps - steps) <= 1);
        // The density of `action` is not that of the page.
        QVERIFY(found.error < (monitor == "\"action\"" ? 4 : 1.5) * error);
        QVERIFY(found.energy < 4 * energy);
        QVERIFY(found.momentum < 1e-12);
    }
    /// As many fixed steps.
    void fixedStepsFail() {
        for (const double e : {.9, .99}) {
            const End found = runOf(e, 4, span / 400, {});
            qInfo("e=%g: arrived %d, error %.1e", e, found.hasArrived, found.error);
            QVERIFY(!found.hasArrived || found.error > 0.05);
        }
    }
    void ordersAre2s() {
        for (int s = 1; s <= 3; ++s) {
            const double h = (s == 1 ? 0.02 : s == 2 ? 0.1 : 0.3) * std::pow(.1, 1.5);
            const End coarse = runOf(.9, s, h, typedRadius), fine = runOf(.9, s, h / 2, typedRadius);
            const double order = std::log2(coarse.error / fine.error);
            qInfo("s=%d: %.1e, %.1e, order %.2f", s, coarse.error, fine.error, order);
            QVERIFY(std::abs(order - 2 * s) < .2);
        }
    }
    /// g (L(q, q'/g) + H_0), typed: the same steps by Gauss rules, which know nothing of K.
    void theTransformedLagrangianMakesTheSameSteps() {
        const char* const transformed =
            R"json({"type": "lagrangian", "coordinates": ["x", "y"], "parameters": {},
            "lagrangian": "(x_t^2+y_t^2)/(2*(x^2+y^2)^(3/4)) + (x^2+y^2)^(3/4)*(1/sqrt(x^2+y^2)-1/2)"})json";
        for (int s = 1; s <= 4; ++s) {
            const auto inTau = tests::after(
                readScene(keplerScene(.9, gaussScheme(s, .1, {}), 100, transformed).toStdString()), 100);
            const auto inTime = tests::after(
                readScene(
                    keplerScene(.9, gaussScheme(s, .1 * std::pow(.1, 1.5), typedRadius), 100).toStdString()),
                100);
            qInfo("s=%d: apart %.1e", s, tests::apart(inTau, inTime));
            QVERIFY(tests::apart(inTau, inTime) < 1e-12);
        }
    }
    /// Three masses 3, 4, 5 from rest, which meet closely.
    void threeBodies_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<double>("error");
        QTest::newRow("s=2") << 2 << 3.0e-7;
        QTest::newRow("s=3") << 3 << 3.3e-12;
        QTest::newRow("s=4") << 4 << 1e-12;
    }
    void threeBodies() {
        QFETCH(int, degree);
        QFETCH(double, error);
        const auto scene = [](const QByteArray& scheme) {
            return QByteArray(R"json({"extremal": 1, "model": {"type": "lagrangian",
                "coordinates": ["x1", "y1", "x2", "y2", "x3", "y3"], "parameters": {},
                "lagrangian": "3*(x1_t^2+y1_t^2)/2 + 2*(x2_t^2+y2_t^2) + 5*(x3_t^2+y3_t^2)/2
                    + 12/sqrt((x1-x2)^2+(y1-y2)^2) + 15/sqrt((x1-x3)^2+(y1-y3)^2) + 20/sqrt((x2-x3)^2+(y2-y3)^2)"},
                "initial": {"q": [1, 3, -2, -1, 1, -1]}, "time": {"end": 4}, "observe": ["energy"],
                "reference": "none", "schemes": [SCHEME]})json")
                .replace("\n", " ")
                .replace("SCHEME", scheme)
                .toStdString();
        };
        const QByteArray monitor =
            R"json({"type": "typed", "monitor": "(7/a^3 + 8/b^3 + 9/c^3)^(-1/2)", "let": {
                "a": "sqrt((x1-x2)^2+(y1-y2)^2)", "b": "sqrt((x1-x3)^2+(y1-y3)^2)",
                "c": "sqrt((x2-x3)^2+(y2-y3)^2)"}})json";
        const double first = 0.04 / std::sqrt(7. / 125 + 8. / 64 + 9. / 27);
        const ReadScene read = readScene(scene(gaussScheme(degree, first, monitor)));
        const ReadScene code = readScene(scene(R"({"baseline": "fehlberg78", "tolerance": 1e-14})"));
        const auto integrator = tests::integratorOf(read), reference = tests::integratorOf(code);
        State s = read.resolved->initial;
        integrator->begin(s);
        long long calls = 0;
        while (s.t < 4) {
            const StepReport report = integrator->advance(s, 4);
            QCOMPARE(report.outcome, Outcome::converged);
            calls += report.cost.evaluations;
        }
        State there = read.resolved->initial;
        while (there.t < s.t) QCOMPARE(reference->advance(there, s.t).outcome, Outcome::converged);
        double off = 0;
        for (std::size_t k = 0; k < 6; ++k) off = std::max(off, std::abs(s.x[k] - there.x[k]));
        qInfo("%lld steps, %lld calls, error %.1e", s.node, calls, off);
        QVERIFY(off < 5 * error + 2e-10);  // of the reference
    }
    void thereAndBack() {
        for (int s = 1; s <= 4; ++s) {
            const ReadScene read = readScene(
                keplerScene(.9, gaussScheme(s, .05 * std::pow(.1, 1.5), typedRadius), span).toStdString());
            const auto result = run(read.scene).schemes.front();
            QCOMPARE(result->summary.status, RunStatus::done);
            const auto off = result->trajectory["reversibility"];
            double most = 0;
            for (const double each : off) most = std::max(most, std::isnan(each) ? 1 : each);
            qInfo("s=%d: %.1e", s, most);
            QVERIFY(most < 1e-11);
        }
    }
    /// In (t, q; -E, p), by the scheme and by differences of its steps.
    void theFormIsKept() {
        const ReadScene read =
            readScene(keplerScene(.6, gaussScheme(2, .05, "\"(1+p_x^2)*(x^2+y^2)\""), 10).toStdString());
        const auto integrator = tests::integratorOf(read);
        State s = read.resolved->initial;
        integrator->begin(s);
        for (int k = 0; k < 20; ++k) {
            QCOMPARE(integrator->advance(s, 10).outcome, Outcome::converged);
            const auto M = tangentMap(*integrator);
            QVERIFY(M);
            const double off = canonicalDefect(*M);
            QVERIFY2(off < 1e-13 * std::pow(M->cwiseAbs().maxCoeff(), 2), qPrintable(QString::number(off)));
        }
    }
    /// The tangent map of (q, p) at one energy and its memory: by differences.
    void theTangentMapIsThatOfTheSteps() {
        const ReadScene read =
            readScene(keplerScene(.6, gaussScheme(2, .1, "\"(1+p_x^2)*(x^2+y^2)\""), 10).toStdString());
        const auto integrator = tests::integratorOf(read);
        State start = read.resolved->initial;
        integrator->begin(start);
        QCOMPARE(integrator->advance(start, 10).outcome, Outcome::converged);
        const State from = start;
        State to = from;
        QCOMPARE(integrator->advance(to, 10).outcome, Outcome::converged);
        const auto M = tangentMap(*integrator);
        QVERIFY(M);
        constexpr double shift = 1e-5;
        double off = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            State up = from, down = from;
            up.x[k] += shift;
            down.x[k] -= shift;
            const auto other = integrator->clone();
            QCOMPARE(other->advance(up, 10).outcome, Outcome::converged);
            QCOMPARE(other->advance(down, 10).outcome, Outcome::converged);
            const auto column = static_cast<Eigen::Index>(k < 2 ? 1 + k : 2 + k);
            for (std::size_t i = 0; i < 4; ++i)
                off = std::max(off, std::abs((up.x[i] - down.x[i]) / (2 * shift) -
                                             (*M)(static_cast<Eigen::Index>(i < 2 ? 1 + i : 2 + i), column)));
            off = std::max(off, std::abs((up.t - down.t) / (2 * shift) - (*M)(0, column)));
        }
        qInfo("%.1e", off);
        QVERIFY(off < 1e-7);
    }
    /// Inside a step, at times of the motion.
    void theCurveIsThatOfTheMotion() {
        const ReadScene read = readScene(keplerScene(.6, gaussScheme(4, .02, typedRadius), 10).toStdString());
        const auto integrator = tests::integratorOf(read);
        const ExactSolution exact = read.resolved->system->exact(read.resolved->initial);
        State s = read.resolved->initial;
        integrator->begin(s);
        double worst = 0;
        while (s.t < 10) {
            const double before = s.t;
            QCOMPARE(integrator->advance(s, 10).outcome, Outcome::converged);
            std::vector<double> x(4), known(4);
            integrator->denseOutput(0.37, x);
            exact(before + 0.37 * (s.t - before), known);
            worst = std::max(worst, std::hypot(x[0] - known[0], x[1] - known[1]));
        }
        qInfo("%.1e", worst);
        QVERIFY(worst < 1e-6);
    }
    /// Steps are no longer than is asked for.
    void theLongestStepHolds() {
        const ReadScene read = readScene(
            keplerScene(.9, gaussScheme(3, .003, R"({"type": "auto", "max": 0.1})"), span).toStdString());
        const auto integrator = tests::integratorOf(read);
        State s = read.resolved->initial;
        integrator->begin(s);
        double longest = 0, first = 0;
        while (s.t < span) {
            const StepReport report = integrator->advance(s, span);
            QCOMPARE(report.outcome, Outcome::converged);
            if (first == 0) first = report.step;
            longest = std::max(longest, report.step);
        }
        QVERIFY(std::abs(first / .003 - 1) < .1);
        QVERIFY2(longest < .1 && longest > .05, qPrintable(QString::number(longest)));
    }
    void baselinesAndCompositionsFollowIt() {
        for (
            const char* scheme :
            {R"({"baseline": "implicit-midpoint", "step": 0.002, "monitor": "auto"})",
             R"({"baseline": {"type": "gauss-collocation", "stages": 3}, "step": 0.002, "monitor": "auto"})",
             R"json({"baseline": "rk4", "step": 0.002, "monitor": "(x^2+y^2)^(3/4)"})json",
             R"({"scheme": "midpoint", "composition": {"type": "suzuki", "order": 4}, "step": 0.002, "monitor": "auto"})"}) {
            const ReadScene read = readScene(keplerScene(.9, scheme, span).toStdString());
            QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
            const Summary s = run(read.scene).schemes.front()->summary;
            qInfo("%s: %.1e", scheme, s.maxEnergyError);
            QCOMPARE(s.status, RunStatus::done);
            QVERIFY(s.maxEnergyError < 1e-2);
        }
    }
    void refusals_data() {
        QTest::addColumn<QByteArray>("scheme");
        QTest::addColumn<QString>("place");
        QTest::addColumn<QString>("message");
        const auto row = [](const char* name, const char* scheme, const char* place, const char* message) {
            QTest::newRow(name) << QByteArray(scheme) << QString(place) << QString(message);
        };
        row("not positive", R"({"scheme": "midpoint", "step": 0.01, "monitor": "x-1"})", "/schemes/0/monitor",
            "is -0.6 at the start");
        row("not finite", R"({"scheme": "midpoint", "step": 0.01, "monitor": "1/y"})", "/schemes/0/monitor",
            "at the start");
        row("unknown name", R"({"scheme": "midpoint", "step": 0.01, "monitor": "radius"})",
            "/schemes/0/monitor", "unknown name \"radius\"");
        row("moving times", R"({"scheme": "sem-1", "step": 0.01, "monitor": "auto"})", "/schemes/0/monitor",
            "unknowns already");
        row("adaptive", R"({"baseline": "dopri5", "tolerance": 1e-9, "monitor": "auto"})",
            "/schemes/0/monitor", "unknowns already");
        row("short longest",
            R"({"scheme": "midpoint", "step": 0.01, "monitor": {"type": "auto", "max": 0.005}})",
            "/schemes/0/monitor/max", "longer than the first step");
        row("unknown key", R"({"scheme": "midpoint", "step": 0.01, "monitor": {"type": "auto", "min": 1}})",
            "/schemes/0/monitor/min", "unknown key");
    }
    void refusals() {
        QFETCH(QByteArray, scheme);
        QFETCH(QString, place);
        QFETCH(QString, message);
        const ReadScene read = readScene(keplerScene(.6, scheme, 10).toStdString());
        QVERIFY(!read.errors.empty());
        QCOMPARE(QString::fromStdString(read.errors[0].pointer), place);
        QVERIFY2(QString::fromStdString(read.errors[0].message).contains(message),
                 read.errors[0].message.c_str());
    }
    /// K at many nodes together and one by one, of a Lagrangian and of a Hamiltonian that is not separable.
    void gradientsOfManyNodesAreThoseOfEach_data() {
        QTest::addColumn<QByteArray>("model");
        QTest::addColumn<QByteArray>("monitor");
        const char* const lagrangian = R"json({"type": "lagrangian", "coordinates": ["x", "y"],
            "parameters": {"m": 1.3}, "lagrangian": "(m*x_t^2+y_t^2)/2 + 1/sqrt(x^2+y^2)"})json";
        const char* const hamiltonian = R"json({"type": "hamiltonian", "coordinates": ["x", "y"],
            "hamiltonian": "(p_x^2+p_y^2)*(1+x^2/9)/2 - 1/sqrt(x^2+y^2) + x*p_y/5"})json";
        const char* const typed = R"json({"type": "typed", "monitor": "(x^2+y^2)^(3/4)*(1+p_x^2/7)"})json";
        const char* const bounded = R"json({"type": "typed", "monitor": "(x^2+y^2)^(3/4)", "max": 0.05})json";
        QTest::newRow("a Lagrangian") << QByteArray(lagrangian) << QByteArray(typed);
        QTest::newRow("with a longest step") << QByteArray(lagrangian) << QByteArray(bounded);
        QTest::newRow("a Hamiltonian") << QByteArray(hamiltonian) << QByteArray(typed);
        const char* const defined = R"json({"type": "typed", "monitor": "r^(3/2)*exp(-p_x*y/9)", "max": 0.4,
            "let": {"r": "sqrt(x^2+y^2)"}})json";
        QTest::newRow("a Hamiltonian, with definitions") << QByteArray(hamiltonian) << QByteArray(defined);
    }
    void gradientsOfManyNodesAreThoseOfEach() {
        QFETCH(QByteArray, model);
        QFETCH(QByteArray, monitor);
        const ReadScene read =
            readScene(keplerScene(.6, gaussScheme(3, .01, monitor), 10, model.simplified()).toStdString());
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        const ResolvedScene& r = *read.resolved;
        const MonitoredProblem problem =
            monitoredProblem(*r.system, read.scene.schemes[0].monitor, r.initial, 0.01);
        const PhaseMechanics& K = problem.system.part<PhaseMechanics>();
        QVERIFY(K.gradients);
        constexpr int nodes = 16;
        const auto width = static_cast<std::size_t>(K.dimension);
        std::vector<double> t(nodes), q(width * nodes), p(q), together(2 * q.size()), alone(2 * width);
        const auto at = [](std::size_t k, std::size_t i) { return k * nodes + i; };
        for (std::size_t i = 0; i < nodes; ++i)
            for (std::size_t k = 0; k < width; ++k) {
                q[at(k, i)] = 0.3 + std::cos(static_cast<double>(3 * i + k)) / 9;
                p[at(k, i)] = 0.2 + std::sin(static_cast<double>(2 * i + 5 * k));
            }
        K.gradients(K.model.get(), t.data(), nodes, q.data(), p.data(), together.data());
        for (std::size_t i = 0; i < nodes; ++i) {
            std::vector<double> oneQ(width), oneP(width);
            for (std::size_t k = 0; k < width; ++k) oneQ[k] = q[at(k, i)], oneP[k] = p[at(k, i)];
            K.gradient(K.model.get(), 0, oneQ.data(), oneP.data(), alone.data());
            for (std::size_t k = 0; k < 2 * width; ++k)
                QVERIFY(std::abs(together[at(k, i)] - alone[k]) <= 5e-15 * (1 + std::abs(alone[k])));
        }
    }
    void explicitTimeIsRefused() {
        const ReadScene read = readScene(std::string_view(
            R"json({"extremal": 1, "model": {"type": "hamiltonian", "coordinates": ["x"],
            "hamiltonian": "p_x^2/2+x^2/2+x*cos(t)"}, "initial": {"q": [1]}, "time": {"end": 1},
            "schemes": [{"scheme": "midpoint", "step": 0.1, "monitor": "1+x^2"}]})json"));
        QVERIFY(!read.errors.empty());
        QVERIFY(read.errors[0].message.find("without explicit time") != std::string::npos);
    }
    void oddOnesAreWarnedOf() {
        const auto isWarned = [](const char* monitor) {
            const ReadScene read = readScene(keplerScene(.6, gaussScheme(1, .01, monitor), 1).toStdString());
            for (const Problem& p : read.warnings)
                if (p.message.find("not reversible") != std::string::npos) return true;
            return false;
        };
        QVERIFY(isWarned(R"("2+x*p_x/10")"));
        QVERIFY(!isWarned(R"("2+p_x^2")"));
        QVERIFY(!isWarned("\"action\""));
    }
    void theSceneIsWrittenAsItIs() {
        const ReadScene read = readScene(keplerScene(.9, gaussScheme(2, .01, typedRadius), 1).toStdString());
        const ReadScene again = readScene(writeScene(read.scene));
        QVERIFY(again.errors.empty());
        QCOMPARE(writeScene(again.scene), writeScene(read.scene));
        QVERIFY(again.scene.schemes[0].monitor == read.scene.schemes[0].monitor);
    }
};

EXTREMAL_TEST(MonitorTest)
}  // namespace extremal::monitor_test
#include "monitor_test.moc"
