// SPDX-License-Identifier: GPL-3.0-or-later
/// One setting for several cases of a scene: what the search finds is run on each case by itself.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/scene/write/codec.hpp"
#include "engine/study/request.hpp"
#include "engine/study/sweep.hpp"
#include "tests/tools/pointer_of.hpp"
#include "tests/tools/test.hpp"

namespace extremal::cases_test {
namespace {

/// Kepler's problem from its nearest point, at two eccentricities and a half.
const char* const kepler = R"J({"extremal": 1, "model": {"type": "lagrangian", "coordinates": ["x", "y"],
    "parameters": {"e": 0.3}, "lagrangian": "(x_t^2+y_t^2)/2+1/sqrt(x^2+y^2)"},
    "initial": {"q": ["1-e", 0], "v": [0, "sqrt((1+e)/(1-e))"]}, "time": {"end": 7}, "observe": ["error"],
    "schemes": [{"label": "Gauss", "step": 0.1, "scheme": "galerkin-gauss-3"},
                {"label": "RK4", "step": 0.01, "baseline": "rk4"},
                {"label": "Dormand", "tolerance": 1e-6, "baseline": "dopri5"}]})J";
constexpr double eccentricities[] = {0.1, 0.4, 0.8};
constexpr double wish = 1e-5;

ResolvedScene sceneAt(double e) {
    return *readScene(std::string(kepler), {{"/model/parameters/e", e}}).resolved;
}

Sweep found(bool isMedian) {
    SweepOptions options;
    options.metric = "error";
    options.wantedError = wish;
    options.repeat = 0;
    options.over = {"/model/parameters/e", {std::begin(eccentricities), std::end(eccentricities)}, isMedian};
    Sweep sweep(sceneAt(0.3), options);
    sweep.run({}, {}, {});
    return sweep;
}

/// The error of the setting on one case, by a sweep of its own.
double errorAt(double e, const SweepRow& row) {
    SweepOptions options;
    options.repeat = 0;
    options.only = {sceneAt(e).scene.schemes[row.point.scheme].label};
    ResolvedScene scene = sceneAt(e);
    ResolvedScheme& scheme = scene.schemes[row.point.scheme];
    if (scheme.isAdaptive()) {
        scheme.spec.tolerance = row.result.tolerance;
        options.ladder.steps = {};
    }
    const StudyPoint point{row.point.scheme, row.result.step, row.result.tolerance, 0, row.result.reduction};
    const Metric metric = metricOf("error", false, *scene.system, scene.initial);
    const SearchReference reference(scene, {metric}, {});
    return runPoint(scene, point, metric, reference.of(scene.schemes[row.point.scheme]), 0, {}).error;
}

}  // namespace

class CasesTest : public QObject {
    Q_OBJECT
private slots:
    void theWorstIsServed() {
        const Sweep sweep = found(false);
        QCOMPARE(sweep.rows().size(), std::size_t(3));
        for (const SweepRow& row : sweep.rows()) {
            QVERIFY(row.result.isDone());
            double worst = 0;
            for (const double e : eccentricities) worst = std::max(worst, errorAt(e, row));
            qInfo("worst %.2e, said %.2e", worst, row.result.error);
            QVERIFY(worst <= wish);
            QVERIFY(std::abs(row.result.error / worst - 1) < 1e-6);
            QVERIFY(errorAt(0.1, row) < 0.1 * worst);  // one is much harder than the others
        }
    }
    void ofTheMedianOneMayFail() {
        const Sweep sweep = found(true);
        for (const SweepRow& row : sweep.rows()) {
            QVERIFY(row.result.isDone());
            std::vector<double> errors;
            for (const double e : eccentricities) {
                const double error = errorAt(e, row);
                errors.push_back(std::isfinite(error) ? error : std::numeric_limits<double>::infinity());
            }
            std::sort(errors.begin(), errors.end());
            QVERIFY(errors[1] <= wish && errors[2] > wish);
            QVERIFY(std::abs(row.result.error / errors[1] - 1) < 1e-6);
        }
    }
    void whatIsWrongIsSaid_data() {
        QTest::addColumn<QString>("over");
        QTest::addColumn<QString>("of");
        QTest::addColumn<QString>("message");
        QTest::newRow("no list") << "/model/parameters/e"
                                 << ""
                                 << "must be POINTER=VALUE";
        QTest::newRow("one value") << "/model/parameters/e=0.1"
                                   << ""
                                   << "takes 2 to 64 values, got 1";
        QTest::newRow("unknown key") << "/model/parameters/f=0.1,0.2"
                                     << ""
                                     << "unknown key \"f\"";
        QTest::newRow("no start") << "/model/parameters/e=0.1,2"
                                  << ""
                                  << "";
        QTest::newRow("changes nothing") << "/schemes/0/step=0.1,0.2"
                                         << ""
                                         << "changes neither";
        QTest::newRow("of what") << "/model/parameters/e=0.1,0.2"
                                 << "mean"
                                 << "must be worst or median";
        QTest::newRow("of nothing") << ""
                                    << "worst"
                                    << "needs --over";
    }
    void whatIsWrongIsSaid() {
        QFETCH(QString, over);
        QFETCH(QString, of);
        QFETCH(QString, message);
        StudyRequest request;
        request.kind = "cheapest";
        request.error = wish;
        request.over = over.toStdString();
        request.of = of.toStdString();
        const ResolvedScene scene = sceneAt(0.3);
        try {
            (void)makeStudy(knownStudy(request), request, &scene, 1);
            QFAIL("nothing was said");
        } catch (const InvalidScene& e) {
            const std::string said = e.problems().front().message;
            QVERIFY2(said.find(message.toStdString()) != std::string::npos, said.c_str());
        }
    }
};

EXTREMAL_TEST(CasesTest)

}  // namespace extremal::cases_test

#include "cases_test.moc"
