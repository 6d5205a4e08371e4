// SPDX-License-Identifier: GPL-3.0-or-later
/// The difference from a companion as the bar of an error: against the true error, and where there is none.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/estimate_ratio.hpp"
#include "tests/tools/test.hpp"

namespace extremal::companion_test {
namespace {

std::string sceneText(const std::string& schemes, const std::string& reference,
                      const std::string& end = "200") {
    return "{\"extremal\": 1, \"model\": {\"type\": \"kepler\"}, \"initial\": {\"q\": [0.4, 0], \"p\": [0, "
           "2]}, "
           "\"time\": {\"end\": " +
           end + "}, \"schemes\": [" + schemes + "], \"observe\": [\"error\"], \"reference\": {\"type\": \"" +
           reference + "\"}}";
}

ReadScene splittingScene(const QString& problem, const QString& scheme, const QString& reference) {
    const std::string kepler = R"~("model": {"type": "kepler"}, "initial": {"q": [0.4, 0], "p": [0, 2]},
        "time": {"end": 50})~";
    const std::string bodies =
        R"~("model": {"type": "lagrangian", "coordinates": ["x", "y", "z", "u", "v", "w"],
        "lagrangian": "(x_t^2+y_t^2+z_t^2+u_t^2+v_t^2+w_t^2)/2 + 1/sqrt((z-x)^2+(u-y)^2+0.05)
            + 1/sqrt((v-x)^2+(w-y)^2+0.05) + 1/sqrt((v-z)^2+(w-u)^2+0.05)"},
        "initial": {"q": [1, 0, -0.5, 0.8, -0.5, -0.8], "p": [0, 0.6, -0.5, -0.3, 0.5, -0.3]},
        "time": {"end": 20})~";
    std::string text = "{\"extremal\": 1, " + (problem == "kepler" ? kepler : bodies) +
                       ", \"observe\": [\"error\"], \"reference\": " + reference.toStdString() +
                       ", \"schemes\": [{" + scheme.toStdString() + "}]}";
    std::replace(text.begin(), text.end(), '\n', ' ');
    return readScene(std::string_view(text));
}

/// x'' = -sign(x) from rest at 1.
double bouncing(double t) {
    const double quarter = std::sqrt(2.0), u = std::fmod(t, 4 * quarter);
    if (u < quarter) return 1 - u * u / 2;
    if (u < 3 * quarter) return (u - 2 * quarter) * (u - 2 * quarter) / 2 - 1;
    return 1 - (u - 4 * quarter) * (u - 4 * quarter) / 2;
}

}  // namespace

class CompanionTest : public QObject {
    Q_OBJECT
private slots:
    void theBarIsTheErrorOfAPlanetForLong() {
        const std::string schemes = R"({"label": "2", "step": 0.05, "scheme": "galerkin-gauss-2"},
            {"label": "3", "step": 0.1, "scheme": "galerkin-gauss-3"},
            {"label": "4", "step": 0.05, "scheme": "galerkin-gauss-4"},
            {"label": "verlet", "step": 0.005, "baseline": "stormer-verlet"},
            {"label": "rk4", "step": 0.02, "baseline": "rk4"})";
        const Comparison bars = run(readScene(sceneText(schemes, "companion")).scene),
                         truth = run(readScene(sceneText(schemes, "exact")).scene);
        QCOMPARE(bars.reference.type, std::string("companion"));
        for (std::size_t k = 0; k < 5; ++k) {
            const EstimateRatio ratio(bars.schemes[k]->trajectory["error"],
                                      truth.schemes[k]->trajectory["error"], 1e-10);
            QVERIFY(ratio.rows > 500);
            QVERIFY(ratio.low >= 0.8 && ratio.high <= 1.3);  // measured: 0.991 to 1.001
        }
    }
    void theBarOfASchemeWithItselfWouldBeNothing() {
        // The same run as its own reference has no error: what is measured above is not that.
        const Comparison result =
            run(readScene(sceneText(R"({"label": "2", "step": 0.05, "scheme": "galerkin-gauss-2"})",
                                    "companion", "2"))
                    .scene);
        QVERIFY(result.schemes[0]->summary.maxError > 1e-7);
        QVERIFY(std::isnan(result.schemes[0]->summary.opensAt));
    }
    void barsThatAreTooLargeOpen() {
        const Comparison result = run(
            readScene(sceneText(R"({"label": "a", "step": 0.2, "scheme": "galerkin-gauss-2"})", "companion"))
                .scene);
        const SchemeResult& scheme = *result.schemes[0];
        QCOMPARE(summaryValue(result).find("schemes")->asArray()[0].find("error_bar_opens_at")->asNumber(),
                 scheme.summary.opensAt);
        QVERIFY(scheme.summary.opensAt > 1);
        QVERIFY(scheme.summary.opensAt < 100);
        QVERIFY(scheme.summary.caution.starts_with("the error bar is open from t ="));
    }
    void whatHasNoCompanionSaysWhy_data() {
        QTest::addColumn<QString>("schemes");
        QTest::addColumn<QString>("why");
        QTest::newRow("highest degree") << R"({"step": 0.1, "scheme": "galerkin-gauss-24"})"
                                        << "the degree of polynomial is at most 24";
        QTest::newRow("tolerance") << R"({"tolerance": 1e-14, "baseline": "fehlberg78"})"
                                   << "its tolerance is at round-off";
    }
    void whatHasNoCompanionSaysWhy() {
        QFETCH(QString, schemes);
        QFETCH(QString, why);
        const ReadScene read = readScene(sceneText(schemes.toStdString(), "companion", "2"));
        QCOMPARE(read.errors.size(), std::size_t(1));
        QCOMPARE(read.errors[0].pointer, std::string("/schemes/0"));
        QVERIFY2(read.errors[0].message.find(why.toStdString()) != std::string::npos,
                 read.errors[0].message.c_str());
    }
    void oneSchemeWithoutACompanionLeavesTheOthersTheirs() {
        const ReadScene read =
            readScene(sceneText(R"({"label": "24", "step": 0.5, "scheme": "galerkin-gauss-24"},
                                                      {"label": "2", "step": 0.05, "scheme": "galerkin-gauss-2"})",
                                "companion", "2"));
        QVERIFY(read.errors.empty());
        QVERIFY(read.warnings.size() >= 1);
        QCOMPARE(read.warnings[0].pointer, std::string("/schemes/0"));
        QVERIFY(read.warnings[0].message.ends_with("there is no error bar for it"));
        const Comparison result = run(read.scene);
        QVERIFY(result.schemes[0]->summary.status == RunStatus::done);
        QVERIFY(!(result.schemes[0]->summary.maxError > 0));
        QVERIFY(result.schemes[0]->summary.caution.starts_with("there is no error bar: "));
        QVERIFY(result.schemes[1]->summary.maxError > 1e-7);
    }
    void companionsWhoseStepsFailAreNamed() {
        const std::string scene = R"~({"extremal": 1, "model": {"type": "lagrangian", "coordinates": ["x"],
            "lagrangian": "x_t^2/2 - x^2/2 - x^4/4"}, "initial": {"q": [1.5], "p": [0]}, "time": {"end": 40},
            "reference": "companion", "observe": ["error"], "schemes": [)~";
        const auto cautionOf = [&](const std::string& scheme) {
            return run(readScene(scene + scheme + "]}").scene).schemes.at(0)->summary.caution;
        };
        const std::string three = cautionOf(R"({"step": 0.2, "scheme": "sem-3"})");
        QVERIFY2(three.starts_with("the error bar is open from the start"), three.c_str());
        QCOMPARE(cautionOf(R"({"step": 0.1, "scheme": "galerkin-gauss-2"})"), std::string());
    }
    /// Both may step over a fast motion in the same way: of 2.5 rad the bar is wrong, and said to be before.
    void stepsOverAFastMotionHaveAnOpenBar() {
        const std::string scene = R"~({"extremal": 1, "model": {"type": "spring-pendulum", "k": 1e6},
            "initial": {"q": [0.005, 1]}, "time": {"end": 2}, "observe": ["error"], "schemes": [
            {"label": "over", "step": 0.0025, "scheme": "galerkin-gauss-2"},
            {"label": "resolved", "step": 0.0003, "scheme": "galerkin-gauss-2"}], "reference": )~";
        const ReadScene bars = readScene(scene + "\"companion\"}");
        QCOMPARE(bars.warnings.size(), std::size_t(1));
        QCOMPARE(bars.warnings[0].pointer, std::string("/schemes/0"));
        QVERIFY(bars.warnings[0].message.starts_with("has an error bar that is open from the start"));
        const Comparison bar = run(bars.scene), truth = run(readScene(scene + "\"auto\"}").scene);
        const auto ratio = [&](std::size_t k) {
            return EstimateRatio(bar.schemes[k]->trajectory["error"], truth.schemes[k]->trajectory["error"],
                                 1e-8);
        };
        qInfo("over: %.2f to %.2f, resolved: %.3f to %.3f", ratio(0).low, ratio(0).high, ratio(1).low,
              ratio(1).high);
        QCOMPARE(bar.schemes[0]->summary.opensAt, 0.0);
        QVERIFY(ratio(0).low < 0.3 || ratio(0).high > 3);
        QVERIFY(std::isnan(bar.schemes[1]->summary.opensAt));
        QVERIFY(ratio(1).rows > 100 && ratio(1).low > 0.3 && ratio(1).high < 3);
    }
    void barsOfOptimisedSplittingsAreTheError_data() {
        QTest::addColumn<QString>("problem");
        QTest::addColumn<QString>("scheme");
        for (const char* problem : {"kepler", "three bodies"})
            for (
                const char* scheme :
                {R"("step": 0.1, "baseline": "blanes-moan-s10")", R"("step": 0.1, "baseline": "srkn-14a")",
                 R"("step": 0.05, "baseline": "srkn-6b")", R"("step": 0.02, "baseline": "srkn-6b")",
                 R"("step": 0.05, "baseline": "srkn-11b")", R"("step": 0.1, "baseline": "blanes-moan-s6")",
                 R"("step": 0.05, "baseline": "stormer-verlet", "composition": {"type": "yoshida", "order": 8})",
                 R"("step": 0.02, "scheme": "galerkin-lobatto-2", "composition": {"type": "suzuki", "order": 6})",
                 R"("step": 0.05, "scheme": "midpoint", "composition": {"type": "yoshida", "order": 6})"})
                QTest::addRow("%s, %s", problem, scheme) << problem << scheme;
    }
    void barsOfOptimisedSplittingsAreTheError() {
        QFETCH(QString, problem);
        QFETCH(QString, scheme);
        const Comparison bar = run(splittingScene(problem, scheme, R"("companion")").scene),
                         truth = run(splittingScene(problem, scheme, R"("auto")").scene);
        const auto& rows = truth.schemes[0]->trajectory["error"];
        const double floor = std::max(0.01 * truth.schemes[0]->summary.maxError, 1e-12);
        const EstimateRatio ratio(bar.schemes[0]->trajectory["error"], rows, floor);
        qInfo("%d rows, %.3f to %.3f", ratio.rows, ratio.low, ratio.high);
        QVERIFY(std::isnan(bar.schemes[0]->summary.opensAt));
        QVERIFY(ratio.rows > 60);
        QVERIFY(ratio.low > 0.6 && ratio.high < 1.5);
    }
    /// Seen failing: a composition of them, whose parts are longer than the step, has larger errors than they
    /// have themselves. It was their companion.
    void aCompositionIsNoCompanionOfAnOptimisedSplitting() {
        const auto worst = [](const char* scheme, const char* composed) {
            const Comparison bar = run(splittingScene(
                                           "three bodies", scheme,
                                           QString(R"({"type": "scheme", "scheme": {%1}})").arg(composed))
                                           .scene),
                             truth = run(splittingScene("three bodies", scheme, R"("auto")").scene);
            const EstimateRatio ratio(bar.schemes[0]->trajectory["error"],
                                      truth.schemes[0]->trajectory["error"],
                                      0.01 * truth.schemes[0]->summary.maxError);
            return std::max(ratio.high, 1 / ratio.low);
        };
        QVERIFY(worst(R"("step": 0.1, "baseline": "blanes-moan-s10")",
                      R"("step": 0.1, "baseline": "blanes-moan-s10", "composition": "yoshida")") > 4);
        QVERIFY(worst(R"("step": 0.1, "baseline": "srkn-14a")",
                      R"("step": 0.1, "baseline": "srkn-14a", "composition": "yoshida")") > 3);
    }
    void barsOpenWhereTwoCompanionsDisagree_data() {
        QTest::addColumn<QString>("scheme");
        for (const char* scheme :
             {R"("scheme": "galerkin-gauss-2")", R"("scheme": "galerkin-gauss-3")",
              R"("scheme": "galerkin-lobatto-2")", R"("scheme": "midpoint")",
              R"("baseline": "stormer-verlet")", R"("baseline": "srkn-14a")", R"("baseline": "rk4")"})
            QTest::newRow(scheme) << scheme;
    }
    /// A well with a kink, x'' = -sign(x) from rest at 1: every step over the kink errs in its own way. Up to
    /// where the bar opens its largest value is right to a factor of 3.
    void barsOpenWhereTwoCompanionsDisagree() {
        QFETCH(QString, scheme);
        for (const double step : {0.1, 0.037, 0.01}) {
            const std::string scene =
                R"~({"extremal": 1, "model": {"type": "lagrangian", "coordinates": ["x"],
                "lagrangian": "x_t^2/2 - abs(x)"}, "initial": {"q": [1]}, "time": {"end": 40},
                "observe": ["error"], "reference": "companion", "schemes": [{"step": )~" +
                std::to_string(step) + ", " + scheme.toStdString() + "}]}";
            const Comparison bar = run(readScene(scene).scene);
            const SchemeResult& result = *bar.schemes[0];
            QVERIFY2(result.summary.opensAt < 20, qPrintable(QString::number(step)));
            const auto& t = result.trajectory.columns.front().values;
            const auto& x = result.trajectory["q.x"];
            const auto& said = result.trajectory["error"];
            double largest = 0, largestSaid = 0;
            for (std::size_t r = 0; r < t.size() && t[r] < result.summary.opensAt; ++r) {
                largest = std::max(largest, std::abs(x[r] - bouncing(t[r])));
                largestSaid = std::max(largestSaid, said[r]);
            }
            qInfo("h = %g: opens at %.3g, the bar said %.3g of %.3g", step, result.summary.opensAt,
                  largestSaid, largest);
            QVERIFY(largest < 1e-10 || (largestSaid > largest / 3 && largestSaid < 3 * largest));
        }
    }
    /// Seen failing: codes with error control had one companion alone. `fehlberg78` steps over the kink of
    /// |x| in one step, whatever its tolerance, and was 19 away from the solution with a bar of 0.
    void barsOfErrorControlOpenWhereTheForcesJump() {
        for (const char* code : {"dopri5", "fehlberg78", "bulirsch-stoer", "stiff", "rk8pd"})
            for (const double tolerance : {1e-4, 1e-6, 1e-9}) {
                const std::string scene =
                    R"~({"extremal": 1, "model": {"type": "lagrangian", "coordinates": ["x"],
                    "lagrangian": "x_t^2/2 - abs(x)"}, "initial": {"q": [1]}, "time": {"end": 40},
                    "observe": ["error"], "reference": "companion", "schemes": [{"tolerance": )~" +
                    formatNumber(tolerance) + ", \"baseline\": \"" + code + "\"}]}";
                const ReadScene read = readScene(scene);
                QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
                const Comparison bar = run(read.scene);
                const SchemeResult& result = *bar.schemes[0];
                QVERIFY2(std::isfinite(result.summary.opensAt), code);
                const auto& t = result.trajectory.columns.front().values;
                const auto& x = result.trajectory["q.x"];
                const auto& said = result.trajectory["error"];
                double largest = 0, largestSaid = 0;
                for (std::size_t r = 0; r < t.size() && t[r] < result.summary.opensAt; ++r) {
                    largest = std::max(largest, std::abs(x[r] - bouncing(t[r])));
                    largestSaid = std::max(largestSaid, said[r]);
                }
                qInfo("%s, %g: opens at %.3g, the bar said %.3g of %.3g", code, tolerance,
                      result.summary.opensAt, largestSaid, largest);
                QVERIFY(largest < tolerance || (largestSaid > largest / 3 && largestSaid < 3 * largest));
            }
    }
    /// A pulse of the force, 0.05 long: the companion errs more at it than the code itself.
    void barsOfErrorControlOpenWhereTwoCompanionsDisagree() {
        const std::string scene =
            R"~({"extremal": 1, "model": {"type": "lagrangian", "coordinates": ["x"],
            "lagrangian": "x_t^2/2 - x^2/2 + x*exp(-((t-5)/0.05)^2)"}, "initial": {"q": [1]},
            "time": {"end": 12}, "observe": ["error"], "schemes": [
            {"tolerance": 1e-9, "baseline": "bulirsch-stoer"}, {"tolerance": 1e-9, "baseline": "dopri5"}],
            "reference": )~";
        const std::string trusted =
            R"~({"type": "scheme", "scheme": {"baseline": "rk8pd", "tolerance": 1e-13}}})~";
        const Comparison bar = run(readScene(scene + "\"companion\"}").scene),
                         truth = run(readScene(scene + trusted).scene);
        const auto ratio = [&](std::size_t k) {
            return bar.schemes[k]->summary.maxError / truth.schemes[k]->summary.maxError;
        };
        qInfo("bar / truth: %.2f and %.2f", ratio(0), ratio(1));
        QVERIFY(ratio(0) > 3);  // measured: 4.9
        QVERIFY(bar.schemes[0]->summary.opensAt > 4.5 && bar.schemes[0]->summary.opensAt < 5.2);
        QVERIFY(ratio(1) > 0.9 && ratio(1) < 1.1);
        QVERIFY2(std::isnan(bar.schemes[1]->summary.opensAt), bar.schemes[1]->summary.caution.c_str());
    }
    /// The first errors of an error-controlled code are far below its tolerance, where it promises nothing.
    void smoothMotionsKeepTheBarsOfErrorControl() {
        for (const char* problem : {"kepler", "three bodies"})
            for (const char* code : {"dopri5", "fehlberg78", "bulirsch-stoer", "stiff", "rk8pd"})
                for (const char* tolerance : {"1e-5", "1e-8", "1e-10"}) {
                    const QString scheme =
                        QString(R"("tolerance": %1, "baseline": "%2")").arg(tolerance, code);
                    const Comparison bar = run(splittingScene(problem, scheme, R"("companion")").scene);
                    const Summary& s = bar.schemes[0]->summary;
                    QVERIFY2(s.caution.find("disagree") == std::string::npos,
                             (std::string(code) + ": " + s.caution).c_str());
                }
    }
    void smoothMotionsKeepTheirBars() {
        for (const char* scheme :
             {R"("step": 0.05, "scheme": "galerkin-gauss-3")",
              R"("step": 0.02, "scheme": "galerkin-lobatto-2")",
              R"("step": 0.005, "baseline": "stormer-verlet")", R"("step": 0.02, "baseline": "rk4")"}) {
            const Comparison bar = run(splittingScene("kepler", scheme, R"("companion")").scene);
            QVERIFY2(std::isnan(bar.schemes[0]->summary.opensAt), bar.schemes[0]->summary.caution.c_str());
        }
        // The lines between rows half a period apart pass through the sun, where nothing jumps.
        const ReadScene sparse = readScene(std::string_view(R"~({"extremal": 1, "model": {"type": "kepler"},
            "initial": {"q": [0.4, 0], "p": [0, 2]}, "time": {"end": 63}, "observe": ["error"],
            "output": {"every": "pi", "dense": true}, "reference": "companion",
            "schemes": [{"step": "pi/50", "scheme": "galerkin-gauss-3"}]})~"));
        QVERIFY2(sparse.errors.empty(), sparse.errors.empty() ? "" : sparse.errors[0].message.c_str());
        const Comparison bar = run(sparse.scene);
        QVERIFY2(std::isnan(bar.schemes[0]->summary.opensAt), bar.schemes[0]->summary.caution.c_str());
    }
    /// Of V = x^2 on the left and x^2/8 on the right, which is left for the first time at pi:
    /// galerkin-gauss-4 had bars from 0 to 2 times its error up to t = 15.
    void aKinkOpensTheBarOfHighOrders() {
        const auto opensAt = [](const std::string& scheme) {
            const ReadScene read = readScene(
                "{\"extremal\": 1, \"model\": {\"type\": \"lagrangian\", \"coordinates\": [\"x\"], "
                "\"lagrangian\": \"x_t^2/2 - if(x<0, x^2, x^2/8)\"}, \"initial\": {\"q\": [0.7]}, "
                "\"time\": {\"end\": 30}, \"observe\": [\"error\"], \"reference\": \"companion\", "
                "\"schemes\": [" +
                scheme + "]}");
            return run(read.scene).schemes[0]->summary.opensAt;
        };
        QVERIFY(std::abs(opensAt("{\"step\": 0.1, \"scheme\": \"galerkin-gauss-4\"}") - 3.2) < 1e-9);
        QVERIFY(std::isnan(opensAt("{\"step\": 0.1, \"scheme\": \"midpoint\"}")));
        QVERIFY(std::isnan(opensAt("{\"tolerance\": 1e-8, \"baseline\": \"dopri5\"}")));
    }
    /// A force that jumps in time, and one that is seen on one coordinate alone.
    void everyJumpOfTheForcesOpensTheBar() {
        for (
            const char* model :
            {R"("coordinates": ["x"], "lagrangian": "x_t^2/2 - x^2/2 + x*sign(sin(3*t))/5")",
             R"("coordinates": ["x", "y"], "lagrangian": "x_t^2/2 + y_t^2/2 - x^2/2 - abs(y - 0.1)/50 - y^2")"}) {
            const bool isPlane = std::string(model).find("\"y\"") != std::string::npos;
            const ReadScene read = readScene(
                "{\"extremal\": 1, \"model\": {\"type\": \"lagrangian\", " + std::string(model) +
                "}, \"initial\": {\"q\": " + (isPlane ? "[1, 0.5]" : "[1]") +
                "}, \"time\": {\"end\": 10}, \"observe\": [\"error\"], \"reference\": \"companion\", "
                "\"schemes\": [{\"step\": 0.05, \"baseline\": \"stormer-verlet\"}]}");
            QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
            const Comparison bar = run(read.scene);
            QVERIFY2(bar.schemes[0]->summary.opensAt < 1.2, bar.schemes[0]->summary.caution.c_str());
        }
    }
    void meshesHaveNone() {
        const ReadScene read =
            readScene(std::string(R"~({"extremal": 1, "model": {"type": "field", "cells": 20},
            "initial": {"u": "cos(x)", "u_t": "0"}, "time": {"end": 1},
            "schemes": [{"step": 0.1, "baseline": "leapfrog"}], "reference": "companion"})~"));
        QCOMPARE(read.errors.size(), std::size_t(1));
        QVERIFY2(read.errors[0].message.find("error in space") != std::string::npos,
                 read.errors[0].message.c_str());
    }
    void bodiesAndWavesHaveBars() {
        const auto errorOf = [](const std::string& model, const std::string& reference) {
            const std::string text = "{\"extremal\": 1, " + model +
                                     ", \"observe\": [\"error\"], \"reference\": {\"type\": \"" + reference +
                                     "\"}}";
            return run(readScene(text).scene).schemes.at(0)->summary.maxError;
        };
        for (const char* model :
             {R"("model": {"type": "heavy-top"}, "initial": {"omega": [0.1, 0, 8]}, "time": {"end": 2},
                 "schemes": [{"step": 0.02, "scheme": "lie-2"}])",
              R"("model": {"type": "schrodinger", "potential": "x^2/2", "domain": [-8, 8], "modes": 64},
                 "initial": {"psi": {"packet": "gaussian", "centre": 1, "width": 0.7, "wave_number": 0}},
                 "time": {"end": 2}, "schemes": [{"step": 0.05, "scheme": "schrodinger-gauss-2"}])"}) {
            const double ratio = errorOf(model, "companion") / errorOf(model, "auto");
            QVERIFY(ratio > 0.8 && ratio < 1.3);  // measured: 0.99998 and 0.9997
        }
    }
};

EXTREMAL_TEST(CompanionTest)

}  // namespace extremal::companion_test

#include "companion_test.moc"
