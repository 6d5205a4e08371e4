/// The difference from a companion as the bar of an error: against the true error, and where there is none.
#include <QTest>

#include <cmath>

#include "engine/run/run.hpp"
#include "engine/scene/codec.hpp"
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

}  // namespace

class CompanionTest : public QObject {
    Q_OBJECT private slots : void theBarIsTheErrorOfAPlanetForLong() {
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
