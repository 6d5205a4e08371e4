// SPDX-License-Identifier: GPL-3.0-or-later
/// Typed spaces: the same step as the built-in space they retype, exactness where they are fitted, predicted
/// orders as they are measured, and an error with its place and remedy for each misuse.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/text/text.hpp"
#include "engine/family/table_of.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/space/catalog.hpp"
#include "engine/space/typed.hpp"
#include "tests/tools/scene_steps.hpp"
#include "tests/tools/test.hpp"

namespace extremal::typed_space_test {
namespace {

using tests::after, tests::apart;

const char* const kepler = "\"model\": {\"type\": \"kepler\"}, \"initial\": {\"q\": [0.4, 0], \"p\": [0, 2]}";
const char* const pendulum =
    "\"model\": {\"type\": \"pendulum\", \"g\": 1}, \"initial\": {\"q\": [1.5], \"p\": [0]}";
std::string oscillator(double omega) {
    return "\"model\": {\"type\": \"harmonic-oscillator\", \"m\": 1, \"k\": " + formatNumber(omega * omega) +
           "}, \"initial\": {\"q\": [1], \"p\": [0.5]}";
}

ReadScene read(const std::string& problem, const std::string& space, double h, double end,
               const std::string& rule = "") {
    return readScene("{\"extremal\": 1, " + problem + ", \"time\": {\"end\": " + formatNumber(end) +
                     "}, \"schemes\": [{\"step\": " + formatNumber(h) + ", \"space\": " + space +
                     (rule.empty() ? "" : ", \"quadrature\": " + rule) + "}]}");
}

/// "1; tau; cos(z*tau)" as an array of texts.
std::string textsOf(const std::string& list) {
    std::string texts = "[";
    for (std::size_t start = 0; start < list.size();) {
        const std::size_t end = std::min(list.find(';', start), list.size());
        const std::size_t from = list.find_first_not_of(' ', start);
        texts += (texts.size() > 1 ? ", \"" : "\"") + list.substr(from, end - from) + "\"";
        start = end + 1;
    }
    return texts + "]";
}
std::string typed(const std::string& functions, const std::string& z = "", const std::string& knots = "") {
    return "{\"type\": \"typed\", \"functions\": " + textsOf(functions) +
           (z.empty() ? "" : ", \"let\": {\"z\": \"" + z + "\"}") +
           (knots.empty() ? "" : ", \"knots\": [" + knots + "]") + "}";
}
std::string named(const std::string& name) {
    return "{\"type\": \"typed\", \"functions\": [\"1\", \"tau\"], \"let\": {\"" + name + "\": \"1\"}}";
}
std::string gauss(int nodes, int panels = 1) {
    return "{\"type\": \"gauss\", \"nodes\": " + std::to_string(nodes) +
           ", \"panels\": " + std::to_string(panels) + "}";
}
std::string polynomials(int degree) {
    return "{\"type\": \"polynomial\", \"degree\": " + std::to_string(degree) + "}";
}
std::string splines(int degree, const std::string& rest) {
    return "{\"type\": \"spline\", \"degree\": " + std::to_string(degree) + ", " + rest + "}";
}
const char* const waves = "1; tau; cos(z*tau); sin(z*tau)";
const char* const stumpffs = "1; tau; tau^2*stumpff(2, (z*tau)^2); tau^3*stumpff(3, (z*tau)^2)";

Settings keysOf(const std::string& space) {
    const ReadScene scene = read(pendulum, space, 0.1, 1);
    return scene.scene.schemes.empty() ? Settings{} : scene.scene.schemes[0].space;
}

Problem errorOf(const std::string& space, const std::string& rule = "") {
    const ReadScene scene = read(pendulum, space, 0.1, 1, rule);
    return scene.errors.empty() ? Problem{} : scene.errors.front();
}

}  // namespace

class TypedSpaceTest : public QObject {
    Q_OBJECT
private slots:
    void everyBasisOfTheQuarticPolynomialsGivesTheirStep_data() {
        QTest::addColumn<QString>("functions");
        QTest::newRow("monomials") << "1; tau; tau^2; tau^3; tau^4";
        QTest::newRow("Bernstein") << "(1-tau)^4; tau*(1-tau)^3; tau^2*(1-tau)^2; tau^3*(1-tau); tau^4";
        QTest::newRow("shifted by 100") << "1; tau+100; (tau+100)^2; (tau+100)^3; (tau+100)^4";
        QTest::newRow("nearly equal") << "1; tau; tau+1e-12*tau^2; tau+1e-12*tau^3; tau+1e-12*tau^4";
    }
    void everyBasisOfTheQuarticPolynomialsGivesTheirStep() {
        QFETCH(QString, functions);
        const auto own = after(read(kepler, typed(functions.toStdString()), 0.1, 1), 1);
        const auto known = after(read(kepler, polynomials(4), 0.1, 1), 1);
        QVERIFY2(apart(own, known) < 1e-15, qPrintable(QString::number(apart(own, known))));
    }
    void aTruncatedCubeIsASpline() {
        const std::string cube = typed("1; tau; tau^2; tau^3; (abs(tau-0.5)+tau-0.5)^3", "", "0.5");
        for (const int steps : {1, 20}) {
            const auto own = after(read(kepler, cube, 0.1, 2, gauss(3, 2)), steps);
            const auto known = after(read(kepler, splines(3, "\"cells\": 2"), 0.1, 2), steps);
            QVERIFY2(apart(own, known) < 1e-14, qPrintable(QString::number(apart(own, known))));
        }
    }
    void equalKnotsAreEqualCells() {
        const auto own = after(read(kepler, splines(3, "\"knots\": [0.25, 0.5, 0.75]"), 0.1, 1), 5);
        const auto known = after(read(kepler, splines(3, "\"cells\": 4"), 0.1, 1), 5);
        QVERIFY2(apart(own, known) < 1e-14, qPrintable(QString::number(apart(own, known))));
    }
    void stumpffsFunctionsBecomeTheCubics() {
        const auto own = after(read(kepler, typed(stumpffs, "0"), 0.1, 1), 1);
        const auto known = after(read(kepler, polynomials(3), 0.1, 1), 1);
        QVERIFY2(apart(own, known) < 1e-15, qPrintable(QString::number(apart(own, known))));
        // The conditioning of both bases of one space: 0.037 z^2 for small z, and 0.13 whatever z is.
        for (const double z : {1e-2, 1e-4, 1e-8}) {
            const double plain = typedSpace(keysOf(typed(waves, formatNumber(z)))).sigma,
                         stumpff = typedSpace(keysOf(typed(stumpffs, formatNumber(z)))).sigma;
            qInfo("z = %g: sigma %.3g z^2 and %.3g", z, plain / (z * z), stumpff);
            QVERIFY(std::abs(plain / (z * z) - 0.037) < 0.003);
            QVERIFY(std::abs(stumpff - 0.13) < 0.02);
        }
    }
    void aHundredDigitsAreTakenWhereTheyAreNeeded() {
        QVERIFY(!typedSpace(keysOf(typed(waves, "1e-4"))).usesHundredDigits);
        QVERIFY(typedSpace(keysOf(typed(waves, "1e-9"))).usesHundredDigits);
        // Still the same space as in Stumpff's functions, in the step.
        const auto plain = after(read(kepler, typed(waves, "1e-9"), 0.1, 1), 1),
                   stumpff = after(read(kepler, typed(stumpffs, "1e-9"), 0.1, 1), 1);
        QVERIFY2(apart(plain, stumpff) < 1e-15, qPrintable(QString::number(apart(plain, stumpff))));
    }
    void fittedFunctionsAreExactForEveryStep() {
        double worst = 0;
        for (const double z : {0.1, 1.0, 3.0, 6.0, 10.0, 20.0, 30.0}) {
            const auto x = after(read(oscillator(z), typed(waves, "sqrt(k/m)*h"), 1, 10), 1);
            const double error =
                apart(x, {std::cos(z) + 0.5 / z * std::sin(z), 0.5 * std::cos(z) - z * std::sin(z)});
            worst = std::max(worst, error / std::max(1.0, z));
        }
        qInfo("largest error, relative to z where that is above 1: %.1e", worst);
        QVERIFY(worst < 2e-12);
        // Under three Gauss nodes the same functions are no better than the cubics.
        const auto poor = after(read(oscillator(1), typed(waves, "h"), 1, 10, gauss(3)), 1);
        QVERIFY(apart(poor, {std::cos(1) + 0.5 * std::sin(1), 0.5 * std::cos(1) - std::sin(1)}) > 1e-6);
    }
    void automaticRulesHaveTheNodesThatTheProductsNeed() {
        for (const auto& [z, nodes] :
             {std::pair{0.1, 6}, {1.0, 8}, {3.0, 10}, {6.0, 13}, {10.0, 17}, {20.0, 24}, {30.0, 31}}) {
            const Settings space = withStep(keysOf(typed(waves, "h")), z);
            const Table<double> table = tableOf(space, {"auto", {}, {}});
            qInfo("z = %g: %d nodes", z, table.nodes());
            QVERIFY(std::abs(table.nodes() - nodes) <= 1);
        }
    }
    void predictedOrdersAreMeasured_data() {
        QTest::addColumn<QString>("space");
        QTest::addColumn<QString>("rule");
        QTest::addColumn<int>("order");
        const auto row = [](const char* name, const std::string& space, const std::string& rule, int order) {
            QTest::newRow(name) << QString::fromStdString(space) << QString::fromStdString(rule) << order;
        };
        row("cos h", typed(waves, "h"), gauss(3), 6);
        row("exponentials", typed("1; tau; exp(h*tau); exp(-h*tau)"), gauss(3), 6);
        row("cos 2", typed(waves, "2"), gauss(10), 2);
        row("rational", typed("1; tau; 1/(1+tau); 1/(2-tau)"), gauss(8), 2);
        row("bubble on degree 1", typed("1; tau; tau^2*(1-tau)^2"), gauss(4), 2);
        row("bubble on degree 2", typed("1; tau; tau^2; tau^2*(1-tau)^2"), gauss(4), 4);
        row("sine on degree 2", typed("1; tau; tau^2; sin(pi*tau)"), gauss(8), 4);
        row("unequal splines", splines(2, "\"knots\": [0.1, 0.3, 0.6]"), gauss(2, 4), 4);
        row("Hermite",
            typed("1; tau; tau^2; tau^3; (abs(tau-0.5)+tau-0.5)^2; (abs(tau-0.5)+tau-0.5)^3", "", "0.5"),
            gauss(3, 2), 6);
    }
    void predictedOrdersAreMeasured() {
        QFETCH(QString, space);
        QFETCH(QString, rule);
        QFETCH(int, order);
        const auto exact = after(read(pendulum, polynomials(8), 1.0 / 32, 1), 32);
        const auto error = [&](double h) {
            const int steps = static_cast<int>(std::lround(1 / h));
            return apart(after(read(pendulum, space.toStdString(), h, 1, rule.toStdString()), steps), exact);
        };
        const ReadScene scene = read(pendulum, space.toStdString(), 0.125, 1, rule.toStdString());
        QVERIFY2(scene.errors.empty(), scene.errors.empty() ? "" : scene.errors[0].message.c_str());
        QCOMPARE(scene.resolved->schemes[0].claims.order, order);
        const double coarse = error(0.25), fine = error(0.125), slope = std::log2(coarse / fine);
        qInfo("error %.1e at h = 1/8, slope %.2f", fine, slope);
        QVERIFY(std::abs(slope - order) < 0.3);
    }
    /// What a fitted space loses of smooth curves, which the bounds on the order at the nodes do not show.
    void curvesBetweenTheNodesHaveTheirOrder() {
        const auto error = [&](int steps) {
            const double h = 1.0 / steps;
            const ReadScene scene = read(pendulum, typed(waves, "h"), h, 1, gauss(8));
            const auto integrator = tests::integratorOf(scene);
            State state = scene.resolved->initial;
            integrator->begin(state);
            for (int k = 1; k <= steps; ++k)
                if (integrator->advance(state, k * h).outcome != Outcome::converged) return 1e300;
            std::vector<double> middle(2);
            integrator->denseOutput(0.5, middle);
            const auto exact = after(read(pendulum, polynomials(8), h / 2, 1), 2 * steps - 1);
            return std::abs(middle[0] - exact[0]);
        };
        const ReadScene scene = read(pendulum, typed(waves, "h"), 0.125, 1, gauss(8));
        QCOMPARE(scene.resolved->schemes[0].properties.curveOrder, 4);
        const double coarse = error(32), fine = error(64), slope = std::log2(coarse / fine);
        qInfo("error %.1e at h = 1/64, slope %.2f", fine, slope);
        QVERIFY(std::abs(slope - 4) < 0.2);
    }
    void symmetryIsThatOfTheSpace() {
        const auto isSymmetric = [](const std::string& space) {
            return read(pendulum, space, 0.1, 1).resolved->schemes[0].claims.isSymmetric;
        };
        QVERIFY(!isSymmetric(typed("1; tau; exp(-tau)")));
        QVERIFY(isSymmetric(typed("1; tau; exp(-tau); exp(tau)")));
        QVERIFY(isSymmetric(typed(waves, "h")));
        QVERIFY(!isSymmetric(splines(2, "\"knots\": [0.3]")));
        QVERIFY(isSymmetric(splines(2, "\"knots\": [0.3, 0.7]")));
    }
    void denseOutputHasTheDigitsOfTheFunctions() {
        const TypedSpace space = typedSpace(withStep(keysOf(typed(waves, "h")), 1e-3));
        std::vector<double> value(4), slope(4);
        std::vector<__float128> exact(4), exactSlope(4);
        double worst = 0;
        for (double tau = 0; tau <= 1; tau += 0.0371) {
            space.space.evaluate(tau, value, slope);
            space.space.evaluateQuadruple(tau, exact, exactSlope);
            for (std::size_t a = 0; a < 4; ++a) {
                worst = std::max(worst, std::abs(value[a] - static_cast<double>(exact[a])));
                worst = std::max(worst, std::abs(slope[a] - static_cast<double>(exactSlope[a])));
            }
        }
        qInfo("largest error %.1e", worst);
        QVERIFY(worst < 2e-14);
    }
    void misuseIsNamedWithTheRemedy_data() {
        QTest::addColumn<QString>("space");
        QTest::addColumn<QString>("rule");
        QTest::addColumn<QString>("place");
        QTest::addColumn<QString>("message");
        QTest::addColumn<QString>("hint");
        const auto row = [](const char* name, const std::string& space, const char* place,
                            const char* message, const char* hint, const std::string& rule = "") {
            QTest::newRow(name) << QString::fromStdString(space) << QString::fromStdString(rule)
                                << "/schemes/0" + QString(place) << message << hint;
        };
        const char *third = "/space/functions/2", *all = "/space/functions";
        row("dependent", typed("1; tau; cos(2*tau); sin(tau)^2"), "/space/functions/3",
            "follows from the others: sin(tau)^2 = 0.5 - 0.5*cos(2*tau)", "leave it out");
        row("twice", typed("1; tau; tau"), third, "follows from the others: tau = tau", "leave it out");
        row("zero", typed("1; tau; 0*tau"), third, "is 0 on the whole step", "leave it out");
        row("no constants", typed("tau; tau^2"), all, "do not contain the constants", "add \"1\"");
        row("equal traces", typed("1; cos(2*pi*tau); sin(2*pi*tau)"), all, "are all equal at 0 and 1",
            "add \"tau\"");
        row("jump", typed("1; tau; sign(tau-0.3)"), third, "jumps at tau = 0.3", "another function");
        row("corner", typed("1; tau; abs(tau-0.3)"), third, "the slope of abs(tau-0.3) jumps at tau = 0.3",
            "add \"knots\": [0.3]");
        row("corner in the middle", typed("1; tau; abs(tau-0.5)"), third, "jumps at tau = 0.5",
            "add \"knots\": [0.5]");
        row("third derivative", typed("1; tau; abs(tau-0.5)^3"), third, "is not smooth at tau = 0.5",
            "add \"knots\": [0.5]");
        row("infinite slope", typed("1; tau; sqrt(tau)"), third, "infinite slope at tau = 0",
            "another function");
        row("pole", typed("1; tau; 1/(tau-0.25)"), third, "is not finite at tau = 0.25", "whole step");
        row("unknown name", typed("1; tau; cos(w*tau)"), third, "unknown name \"w\"", "");
        row("time", typed("1; tau; cos(t)"), third, "unknown name \"t\"", "");
        row("unknown function", typed("1; tau; cosine(tau)"), third, "no function \"cosine\"", "");
        row("too fast", typed("1; tau; cos(1e6*tau)"), third, "varies too fast", "smaller");
        row("one function", typed("1"), all, "all equal", "add \"tau\"");
        row("none", typed(""), all, "at least two", "");
        row("name of a parameter", named("g"), "/space/let/g", "is a parameter", "another name");
        row("name of the variable", named("tau"), "/space/let/tau", "has a meaning", "another name");
        row("knots", typed("1; tau", "", "0.6, 0.3"), "/space/knots/1", "must be greater", "ascending");
        row("knot outside", splines(3, "\"knots\": [1]"), "/space/knots/0", "inside the step", "");
        row("singular", typed("1; tau; tau^2; sin(pi*tau)"), "",
            "3 nodes see one odd slope, the space has two", "at least 4 nodes", gauss(3));
        row("order 0", typed("1; tau^2; tau^3"), "", "order 0", "add \"tau\"");
    }
    void misuseIsNamedWithTheRemedy() {
        QFETCH(QString, space);
        QFETCH(QString, rule);
        QFETCH(QString, place);
        QFETCH(QString, message);
        QFETCH(QString, hint);
        const Problem found = errorOf(space.toStdString(), rule.toStdString());
        const QString what = tests::unlike(found, place, message, hint);
        QVERIFY2(what.isEmpty(), qPrintable(what));
    }
    void whatIsSmoothEnoughIsTaken() {
        // A power at the end of the step, a pole near it, a corner at its knot.
        for (const char* function : {"tau^1.5", "1/(1.001-tau)", "exp(20*tau)"})
            QCOMPARE(errorOf(typed(std::string("1; tau; ") + function), gauss(12)).message.find("smooth"),
                     std::string::npos);
        QCOMPARE(errorOf(typed("1; tau; abs(tau-0.3)", "", "0.3")).message, std::string());
    }
    void writingKeepsWhatWasTyped() {
        const std::string once = writeScene(read(oscillator(3), typed(waves, "sqrt(k)*h"), 0.1, 1).scene);
        QVERIFY(once.find("sqrt(k)*h") != std::string::npos);
        const ReadScene again = readScene(once);
        QVERIFY(again.errors.empty());
        QCOMPARE(writeScene(again.scene), once);
    }
    void stepsOfAnotherLengthHaveOtherFunctions() {
        // A study changes the step of an integrator: fitted to its own step, it stays exact.
        const ReadScene scene = read(oscillator(2), typed(waves, "2*h"), 0.5, 10);
        const ResolvedScene& r = *scene.resolved;
        State state = r.initial;
        const auto integrator = r.schemes[0].make(*r.system, 0.5, state);
        integrator->setStep(1.25);
        integrator->begin(state);
        QVERIFY(integrator->advance(state, 1.25).outcome == Outcome::converged);
        QVERIFY(std::abs(state.x[0] - (std::cos(2.5) + 0.25 * std::sin(2.5))) < 1e-13);
    }
};

EXTREMAL_TEST(TypedSpaceTest)

}  // namespace extremal::typed_space_test

#include "typed_test.moc"
