// SPDX-License-Identifier: GPL-3.0-or-later
/// A rule for each term and a space for each coordinate: the schemes they are by other names, orders as
/// predicted, symplecticity, momenta, bands of instability, and errors at their places.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/text/text.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/scene_steps.hpp"
#include "tests/tools/test.hpp"

namespace extremal::split_test {
namespace {

using tests::after, tests::apart;

/// L = x_t^2/2 + y_t^2/2 - w^2 y^2/2 - (x - y)^4/4 - x^2/2, the spring on y fast.
std::string twoSprings(const std::string& slow = "-(x-y)^4/4 - x^2/2", double w = 10) {
    return "\"model\": {\"type\": \"lagrangian\", \"coordinates\": [\"x\", \"y\"], \"parameters\": {\"w\": " +
           formatNumber(w) +
           "}, \"lagrangian\": {\"kinetic\": \"(x_t^2+y_t^2)/2\", \"fast\": \"-w^2*y^2/2\", \"slow\": \"" +
           slow + "\"}}, \"initial\": {\"q\": [1, 0.1], \"v\": [0.2, 0.5]}";
}
const std::string pendulum =
    "\"model\": {\"type\": \"pendulum\", \"g\": 1}, \"initial\": {\"q\": [1.5], \"p\": [0]}";

std::string poly(int degree) {
    return "{\"type\": \"polynomial\", \"degree\": " + std::to_string(degree) + "}";
}
std::string gauss(int nodes) { return "{\"type\": \"gauss\", \"nodes\": " + std::to_string(nodes) + "}"; }

ReadScene read(const std::string& problem, const std::string& space, const std::string& rule, double h,
               double end = 4) {
    return readScene("{\"extremal\": 1, " + problem + ", \"time\": {\"end\": " + formatNumber(end) +
                     "}, \"schemes\": [{\"step\": " + formatNumber(h) + ", \"space\": " + space +
                     ", \"quadrature\": " + rule + "}]}");
}

/// A potential that is the same along all axes, in a part along an axis and one across it, each the mean over
/// n axes at equal angles; with u and v in them for the coordinates along and across.
std::string averaged(int n, const std::string& along, const std::string& across, double speed = 0.7) {
    const std::string angle = "(2*pi*j/" + std::to_string(n) + ")";
    const auto mean = [&](std::string term) {
        for (const auto& [name, turned] :
             {std::pair<std::string, std::string>{"u", "(x*cos" + angle + " + y*sin" + angle + ")"},
              {"v", "(y*cos" + angle + " - x*sin" + angle + ")"}})
            for (std::size_t k = 0; (k = term.find(name, k)) != std::string::npos; k += turned.size())
                term.replace(k, 1, turned);
        return "\"-sum(j, 1.." + std::to_string(n) + ", " + term + ")/" + std::to_string(n) + "\"";
    };
    return "\"model\": {\"type\": \"lagrangian\", \"coordinates\": [\"x\", \"y\"], \"parameters\": {}, "
           "\"lagrangian\": {\"kinetic\": \"(x_t^2+y_t^2)/2\", \"along\": " +
           mean(along) + ", \"across\": " + mean(across) +
           "}}, \"initial\": {\"q\": [0.9, 0], \"v\": [0.1, " + formatNumber(speed) + "]}";
}

/// The largest change of the angular momentum in 400 steps, the parts under the midpoint rule and the
/// trapezoidal one.
double changeOfMomentum(const std::string& problem) {
    const ReadScene scene =
        read(problem, poly(1), "{\"otherwise\": \"midpoint\", \"across\": \"trapezoid\"}", 0.05, 20);
    const auto integrator = tests::integratorOf(scene);
    State state = scene.resolved->initial;
    const auto momentum = [&] { return state.x[0] * state.x[3] - state.x[1] * state.x[2]; };
    const double start = momentum();
    double largest = 0;
    for (int k = 1; k <= 400; ++k) {
        if (integrator->advance(state, 0.05 * k).outcome != Outcome::converged) return 1e300;
        largest = std::max(largest, std::abs(momentum() - start));
    }
    return largest;
}

}  // namespace

class SplitTest : public QObject {
    Q_OBJECT
private slots:
    /// Rules by axes break the symmetry under rotations; the mean of the action over n of them finds the
    /// harmonics of a polynomial of degree 4 where n divides neither 2 nor 4, and others exponentially well.
    void theMeanOverRotationsKeepsTheMomentum() {
        for (const int n : {1, 2, 3, 4, 5, 6, 7}) {
            const double change = changeOfMomentum(averaged(n, "u^4", "(v^4 + 2*u^2*v^2)"));
            qInfo("U = r^4, %d axes: momentum moves by %.1e", n, change);
            QVERIFY(n == 1 || n == 2 || n == 4 ? change > 3e-4 : change < 5e-15);
        }
        double before = 1;
        for (const int n : {1, 3, 5, 7, 9}) {
            const double change = changeOfMomentum(averaged(n, "(-u^2/(u^2 + v^2/2)/sqrt(x^2 + y^2))",
                                                            "(-v^2/2/(u^2 + v^2/2)/sqrt(x^2 + y^2))", 1));
            qInfo("U = -1/r, %d axes: momentum moves by %.1e", n, change);
            QVERIFY(change < before / 3);
            before = change;
        }
    }
    void oneRuleForAllTermsIsThatRule() {
        const auto split = after(
            read(twoSprings(), poly(3), "{\"fast\": " + gauss(3) + ", \"otherwise\": " + gauss(3) + "}", 0.1),
            10);
        const auto whole = after(read(twoSprings(), poly(3), gauss(3), 0.1), 10);
        QVERIFY2(apart(split, whole) < 1e-13, qPrintable(QString::number(apart(split, whole))));
    }
    /// Stern and Grinspun's scheme: half a kick of the slow force, the implicit midpoint of the rest, half a
    /// kick.
    void midpointAndTrapezoidAreImpulsesAroundAMidpoint() {
        const double h = 0.1, w = 10;
        auto x = after(
            read(twoSprings(), poly(1), "{\"otherwise\": \"midpoint\", \"slow\": \"trapezoid\"}", h), 1);
        double q[] = {1, 0.1}, p[] = {0.2, 0.5};
        const auto kick = [&] {
            const double r = q[0] - q[1];
            p[0] += h / 2 * (-r * r * r - q[0]);
            p[1] += h / 2 * r * r * r;
        };
        kick();
        q[0] += h * p[0];
        const double a = h * w / 2, turned = (1 - a * a) * q[1] / (1 + a * a) + h * p[1] / (1 + a * a);
        p[1] = ((1 - a * a) * p[1] - h * w * w * q[1]) / (1 + a * a);
        q[1] = turned;
        kick();
        const double defect = apart(x, {q[0], q[1], p[0], p[1]});
        QVERIFY2(defect < 1e-13, qPrintable(QString::number(defect)));
    }
    /// r-RESPA: a kick of the slow force, n steps of leapfrog with the fast one, a kick.
    void linearSplinesAndEndsAreRespa() {
        const double h = 0.1, w = 10;
        const int n = 5;
        const auto x = after(read(twoSprings(), "{\"type\": \"spline\", \"degree\": 1, \"cells\": 5}",
                                  "{\"otherwise\": {\"type\": \"trapezoid\", \"panels\": 5}, \"slow\": "
                                  "{\"type\": \"trapezoid\", \"panels\": 1}}",
                                  h),
                             1);
        double q[] = {1, 0.1}, p[] = {0.2, 0.5};
        const auto kick = [&](double time, bool isSlow) {
            const double r = q[0] - q[1];
            p[0] += isSlow ? time * (-r * r * r - q[0]) : 0;
            p[1] += time * (isSlow ? r * r * r : -w * w * q[1]);
        };
        kick(h / 2, true);
        for (int k = 0; k < n; ++k) {
            kick(h / n / 2, false);
            for (int i = 0; i < 2; ++i) q[i] += h / n * p[i];
            kick(h / n / 2, false);
        }
        kick(h / 2, true);
        const double defect = apart(x, {q[0], q[1], p[0], p[1]});
        QVERIFY2(defect < 1e-13, qPrintable(QString::number(defect)));
    }
    void predictedOrdersAreMeasured_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<int>("nodes");
        QTest::addColumn<int>("order");
        for (const auto& [degree, nodes, order] :
             {std::array{2, 2, 4}, {2, 1, 2}, {3, 2, 4}, {4, 2, 2}, {4, 3, 6}, {5, 3, 4}, {6, 4, 6}})
            QTest::addRow("degree %d, %d nodes", degree, nodes) << degree << nodes << order;
    }
    void predictedOrdersAreMeasured() {
        QFETCH(int, degree);
        QFETCH(int, nodes);
        QFETCH(int, order);
        const std::string rule = "{\"kinetic\": " + gauss(degree) + ", \"potential\": " + gauss(nodes) + "}";
        QCOMPARE(read(pendulum, poly(degree), rule, 0.25).resolved->schemes[0].claims.order, order);
        QCOMPARE(std::min({2 * degree, 2 * nodes, 2 * std::max(1, 2 * nodes - degree + 1)}), order);
        const auto exact = after(read(pendulum, poly(8), gauss(8), 0.0625), 32);
        const auto error = [&](double h) {
            return apart(after(read(pendulum, poly(degree), rule, h), static_cast<int>(std::lround(2 / h))),
                         exact);
        };
        const double h = order < 6    ? 0.125
                         : degree < 6 ? 0.25
                                      : 0.5,
                     coarse = error(h), fine = error(h / 2), slope = std::log2(coarse / fine);
        qInfo("error %.1e, slope %.2f", fine, slope);
        QVERIFY(std::abs(slope - order) < 0.3);
    }
    void theStepIsSymplectic() {
        for (const auto& [space, rule] :
             {std::pair{poly(1), std::string("{\"otherwise\": \"midpoint\", \"slow\": \"trapezoid\"}")},
              {poly(4), "{\"otherwise\": " + gauss(4) + ", \"slow\": " + gauss(2) + "}"}}) {
            const ReadScene scene = read(twoSprings(), space, rule, 0.1);
            const auto integrator = tests::integratorOf(scene);
            State state = scene.resolved->initial;
            integrator->begin(state);
            QVERIFY(integrator->advance(state, 0.1).outcome == Outcome::converged);
            std::vector<double> M(16, 0);
            for (std::size_t i = 0; i < 4; ++i) M[5 * i] = 1;
            QVERIFY(integrator->applyTangent(M));
            double defect = 0;  // of M^T J M - J, columns of M being (dq, dp)
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t j = 0; j < 4; ++j) {
                    double sum = 0;
                    for (std::size_t k = 0; k < 2; ++k)
                        sum += M[4 * i + k] * M[4 * j + k + 2] - M[4 * i + k + 2] * M[4 * j + k];
                    defect = std::max(defect, std::abs(sum - (j == i + 2 ? 1 : i == j + 2 ? -1 : 0)));
                }
            QVERIFY2(defect < 1e-12, qPrintable(QString::number(defect)));
        }
    }
    void momentaAreKeptWhereEveryTermHasTheSymmetry() {
        const auto drift = [](const std::string& terms, const std::string& rule) {
            const std::string problem = std::string(
                                            "\"model\": {\"type\": \"lagrangian\", \"coordinates\": [\"x\", "
                                            "\"y\"], \"parameters\": {}, \"lagrangian\": ") +
                                        terms + "}, \"initial\": {\"q\": [1, 0], \"v\": [0, 1.2]}";
            const auto x = after(read(problem, poly(2), rule, 0.2), 10);
            return std::abs(x[0] * x[3] - x[1] * x[2] - 1.2);
        };
        const std::string gravity = "{\"kinetic\": \"(x_t^2+y_t^2)/2\", \"gravity\": \"1/sqrt(x^2+y^2)\", ",
                          other = ": {\"type\": \"lobatto\", \"nodes\": 3}}",
                          rest = "{\"otherwise\": " + gauss(2) + ", ";
        const double kept = drift(gravity + "\"spring\": \"-(x^2+y^2)/2\"}", rest + "\"spring\"" + other),
                     lost = drift(gravity + "\"a\": \"-x^2/2\", \"b\": \"-y^2/2\"}", rest + "\"b\"" + other);
        qInfo("kept to %.1e, lost by %.1e", kept, lost);
        QVERIFY(kept < 1e-13);
        QVERIFY(lost > 1e-8);
    }
    /// Half the trace of P_1 with the fast term at the midpoint and the slow one at the ends.
    void impulsesAroundAMidpointAreStableUpToTwo() {
        const auto trace = [](double zFast, double zSlow) {
            const std::string problem =
                "\"model\": {\"type\": \"lagrangian\", \"coordinates\": [\"x\"], \"parameters\": {\"f\": " +
                formatNumber(zFast) + ", \"s\": " + formatNumber(zSlow) +
                "}, \"lagrangian\": {\"kinetic\": \"x_t^2/2\", \"fast\": \"-f^2*x^2/2\", \"slow\": "
                "\"-s^2*x^2/2\"}}, \"initial\": {\"q\": [1], \"p\": [0]}";
            // As long as it takes a band to matter, as narrow as it is.
            const ReadScene scene =
                read(problem, poly(1), "{\"otherwise\": \"midpoint\", \"slow\": \"trapezoid\"}", 1, 1e5);
            const auto integrator = tests::integratorOf(scene);
            State state = scene.resolved->initial;
            integrator->begin(state);
            if (integrator->advance(state, 1).outcome != Outcome::converged) return 1e300;
            std::vector<double> M{1, 0, 0, 1};
            if (!integrator->applyTangent(M)) return 1e300;
            const bool warns = std::any_of(
                scene.warnings.begin(), scene.warnings.end(),
                [](const Problem& p) { return p.message.find("band of instability") != std::string::npos; });
            const double half = (M[0] + M[3]) / 2;
            return warns == (std::abs(half) > 1) ? half : 1e300;
        };
        for (const double z : {0.1, 1.0, 10.0, 100.0})
            for (const double slow : {1.0, 1.99, 2.01}) {
                const double exact = (1 - z * z / 4 - slow * slow / 2) / (1 + z * z / 4),
                             found = trace(z, slow);
                QVERIFY2(std::abs(found - exact) < 1e-11 * (1 + z),
                         qPrintable(QString::number(found - exact)));
                QCOMPARE(std::abs(found) <= 1, slow < 2);
            }
    }
    void oneSpaceForAllCoordinatesIsThatSpace() {
        const auto own = after(read(twoSprings(),
                                    "{\"type\": \"by-coordinate\", \"otherwise\": " + poly(3) +
                                        ", \"variables\": {\"y\": " + poly(3) + "}}",
                                    gauss(3), 0.1),
                               10);
        const auto known = after(read(twoSprings(), poly(3), gauss(3), 0.1), 10);
        QVERIFY2(apart(own, known) < 1e-13, qPrintable(QString::number(apart(own, known))));
    }
    void multirateHasItsPredictedOrder_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<QString>("slow");
        QTest::addColumn<int>("order");
        QTest::newRow("1, apart") << 1 << "-x^4/4" << 2;
        QTest::newRow("2, apart") << 2 << "-x^4/4" << 4;
        QTest::newRow("2, the slow term sees y") << 2 << "-(x-y)^4/4 - x^2/2" << 2;
        QTest::newRow("3, the slow term sees y") << 3 << "-(x-y)^4/4 - x^2/2" << 2;
    }
    void multirateHasItsPredictedOrder() {
        QFETCH(int, degree);
        QFETCH(QString, slow);
        QFETCH(int, order);
        const std::string problem = twoSprings(slow.toStdString(), 3);
        const std::string space =
            "{\"type\": \"by-coordinate\", \"otherwise\": " + poly(degree) +
            ", \"variables\": {\"y\": {\"type\": \"spline\", \"degree\": " + std::to_string(degree) +
            ", \"cells\": 3}}}";
        const std::string rule = "{\"otherwise\": " + gauss(degree) +
                                 ", \"slow\": {\"type\": \"gauss\", \"nodes\": " + std::to_string(degree) +
                                 ", \"panels\": 1}}";
        QCOMPARE(read(problem, space, rule, 0.25).resolved->schemes[0].claims.order, order);
        const auto exact = after(read(problem, poly(8), gauss(8), 0.0625), 32);
        const auto error = [&](double h) {
            return apart(after(read(problem, space, rule, h), static_cast<int>(std::lround(2 / h))), exact);
        };
        const double coarse = error(0.0625), fine = error(0.03125), slope = std::log2(coarse / fine);
        qInfo("error %.1e, slope %.2f", fine, slope);
        QVERIFY(std::abs(slope - order) < 0.3);
    }
    void misuseIsNamedWithTheRemedy_data() {
        QTest::addColumn<QString>("space");
        QTest::addColumn<QString>("rule");
        QTest::addColumn<QString>("place");
        QTest::addColumn<QString>("message");
        QTest::addColumn<QString>("hint");
        const auto row = [](const char* name, const std::string& space, const std::string& rule,
                            const char* place, const char* message, const char* hint) {
            QTest::newRow(name) << QString::fromStdString(space) << QString::fromStdString(rule) << place
                                << message << hint;
        };
        row("unknown term", poly(2), "{\"otherwise\": \"gauss\", \"slwo\": \"gauss\"}",
            "/schemes/0/quadrature/slwo", "has no term \"slwo\"", "kinetic, fast and slow");
        row("velocities", poly(4), "{\"otherwise\": \"gauss\", \"kinetic\": " + gauss(2) + "}",
            "/schemes/0/quadrature/kinetic", "has velocities", "gauss with 4 nodes");
        row("key of a rule", poly(2),
            "{\"otherwise\": \"gauss\", \"slow\": {\"type\": \"gauss\", \"nods\": 2}}",
            "/schemes/0/quadrature/slow/nods", "unknown key", "nodes");
        row("unknown rule", poly(2), "{\"otherwise\": \"gauss\", \"slow\": \"gaus\"}",
            "/schemes/0/quadrature/slow", "unknown quadrature", "gauss");
        row("unknown coordinate",
            "{\"type\": \"by-coordinate\", \"otherwise\": " + poly(1) +
                ", \"variables\": {\"z\": " + poly(2) + "}}",
            gauss(2), "/schemes/0/space/variables/z", "has no coordinate \"z\"", "x and y");
        row("wrong part", "{\"type\": \"by-coordinate\", \"otherwise\": {\"type\": \"polynomial\"}}",
            gauss(2), "/schemes/0/space/otherwise/degree", "is required", "");
        row("part of another family",
            "{\"type\": \"by-coordinate\", \"otherwise\": {\"type\": \"oscillatory\"}}", gauss(2),
            "/schemes/0/space/otherwise/type", "unknown space", "");
    }
    void misuseIsNamedWithTheRemedy() {
        QFETCH(QString, space);
        QFETCH(QString, rule);
        QFETCH(QString, place);
        QFETCH(QString, message);
        QFETCH(QString, hint);
        const ReadScene scene = read(twoSprings(), space.toStdString(), rule.toStdString(), 0.1);
        QVERIFY(!scene.errors.empty());
        const Problem& found = scene.errors.front();
        const QString what = tests::unlike(found, place, message, hint);
        QVERIFY2(what.isEmpty(), qPrintable(what));
    }
    void lostOrderIsAWarning() {
        const ReadScene scene = read(twoSprings(), poly(4),
                                     "{\"otherwise\": " + gauss(4) + ", \"slow\": " + gauss(2) + "}", 0.05);
        QVERIFY(scene.errors.empty());
        QVERIFY(std::any_of(scene.warnings.begin(), scene.warnings.end(), [](const Problem& p) {
            return p.message.find("order 2, not 8: the rule of \"slow\" has degree 3") != std::string::npos;
        }));
    }
    void builtInModelsHaveTerms() {
        const std::string spring =
            "\"model\": {\"type\": \"spring-pendulum\", \"k\": 100}, \"initial\": {\"q\": [0.1, 0.5], \"p\": "
            "[0, 0]}";
        const std::string chain =
            "\"model\": {\"type\": \"fput-chain\", \"k_stiff\": 100}, \"initial\": {\"q\": [0.6, 0.8, 0, 0, "
            "0, 0], \"p\": [0, 1, 0, 0, 0, 0]}";
        for (const std::string& problem : {spring, chain}) {
            const auto split =
                after(read(problem, poly(2),
                           "{\"otherwise\": " + gauss(2) +
                               ", \"slow\": {\"type\": \"gauss\", \"nodes\": 2, \"panels\": 1}}",
                           0.05),
                      5);
            const auto whole = after(read(problem, poly(2), gauss(2), 0.05), 5);
            QVERIFY2(apart(split, whole) < 1e-13, qPrintable(QString::number(apart(split, whole))));
            // The terms are not the same thing under another name: with other nodes the step is another one.
            const auto other = after(
                read(problem, poly(2),
                     "{\"otherwise\": " + gauss(2) + ", \"slow\": {\"type\": \"lobatto\", \"nodes\": 3}}",
                     0.05),
                5);
            QVERIFY(apart(other, whole) > 1e-12);
        }
    }
    void writingKeepsTheTerms() {
        const std::string once = writeScene(
            read(twoSprings(),
                 "{\"type\": \"by-coordinate\", \"otherwise\": " + poly(2) +
                     ", \"variables\": {\"y\": {\"type\": \"spline\", \"degree\": 2, \"cells\": 4}}}",
                 "{\"otherwise\": \"gauss\", \"slow\": {\"type\": \"gauss\", \"nodes\": \"1+1\"}}", 0.1)
                .scene);
        const ReadScene again = readScene(once);
        QVERIFY2(again.errors.empty(), again.errors.empty() ? "" : again.errors[0].message.c_str());
        QCOMPARE(writeScene(again.scene), once);
        QVERIFY(once.find("\"1+1\"") != std::string::npos);
    }
};

EXTREMAL_TEST(SplitTest)

}  // namespace extremal::split_test

#include "split_test.moc"
