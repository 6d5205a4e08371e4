// SPDX-License-Identifier: GPL-3.0-or-later
/// What studies change besides the step: meshes refined with it, and the tolerance of the solver; what they
/// say of that in their tables and plots, and how long they say that it takes.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/text/text.hpp"
#include "engine/figure/studies/study_figure.hpp"
#include "engine/scene/outlook/cost.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/convergence.hpp"
#include "engine/study/expected_time.hpp"
#include "engine/study/search/reductions.hpp"
#include "engine/study/sweep.hpp"
#include "engine/study/sweep_log.hpp"
#include "tests/tools/test.hpp"

namespace extremal::knobs_test {
namespace {

ResolvedScene sceneOf(const char* preset) { return *readScene(findPreset(preset)->json).resolved; }

void runAll(Sweep& sweep) { sweep.run({}, {}, {}); }

SweepOptions untimed() {
    SweepOptions options;
    options.repeat = 0;
    return options;
}

/// A chain whose steps have equations that cost something, and whose momentum is kept to round-off.
ResolvedScene planetScene() {
    return *readScene(
                std::string_view(R"({"extremal":1,"model":{"type":"kepler"},"initial":{"q":[0.4,0],"p":[0,2]},
        "time":{"end":20},"schemes":[{"label":"Galerkin 12","step":0.2,"scheme":"galerkin-gauss-6"}]})"))
                .resolved;
}

}  // namespace

class KnobsTest : public QObject {
    Q_OBJECT

private slots:
    /// Of the kink on 200 cells the error of every scheme ends at that of the mesh, whatever the step.
    void meshAndStepAreRefinedTogether() {
        Sweep sweep(sceneOf("sine-gordon-kink"), untimed());
        runAll(sweep);
        const std::vector<OrderFit> fits = fitOrders(sweep);
        const auto all = bySchemes(sweep);
        QCOMPARE(fits.size(), all.size());
        for (std::size_t i = 0; i < fits.size(); ++i) {
            const ResolvedScheme& scheme = sweep.scene().schemes[all[i].scheme];
            const int claimed = std::min(scheme.claims.order, scheme.orderInSpace());
            qInfo("%s: order %.2f, claimed %d", scheme.spec.label.c_str(), fits[i].order, claimed);
            QVERIFY(std::abs(fits[i].order - claimed) < 0.25);
            for (const SweepRow& row : all[i].rows) {
                const double cells = cellsAt(sweep, row.point) * row.point.step;
                QVERIFY(std::abs(cells / (cellsOf(scheme, sweep.scene()) * scheme.spec.step.value) - 1) <
                        0.05);
            }
        }
        QCOMPARE(convergenceFigure(sweep).subtitle, "the mesh refined with it, with the measured orders");
    }
    void aPlateauHasNoOrder() {
        SweepOptions options = untimed();
        options.knobs.isCells = false;
        Sweep sweep(sceneOf("sine-gordon-kink"), options);
        runAll(sweep);
        for (const SweepRow& row : sweep.rows()) QCOMPARE(row.point.reduction.cells, 0);
        // Of degree 2 three errors lie on a line to their last digits.
        for (const OrderFit& fit : fitOrders(sweep)) QVERIFY(!fit.isKnown());
    }
    void theSolverIsLoosenedWhereThatIsAsked() {
        SweepOptions options = untimed();
        options.wantedError = 1e-6;
        Sweep exact(planetScene(), options);
        options.knobs.isTolerance = true;
        Sweep loose(planetScene(), options);
        runAll(exact);
        runAll(loose);
        const PointResult &with = exact.rows().front().result, &without = loose.rows().front().result;
        QVERIFY(with.isDone() && without.isDone());
        QCOMPARE(with.reduction.solver, 0.0);
        qInfo("%lld evaluations, %lld with %s: error %.2e; %s", with.cost.evaluations,
              without.cost.evaluations, formatNumber(without.reduction.solver).c_str(), without.error,
              without.reason.c_str());
        QVERIFY(without.reduction.solver >= 1e-13 && without.reduction.solver <= 1e-2);
        QVERIFY(without.error <= 1e-6);
        QVERIFY(static_cast<double>(without.cost.evaluations) <
                0.95 * static_cast<double>(with.cost.evaluations));
        // What that costs is said.
        QVERIFY(without.reason.find("momentum kept to") != std::string::npos);
        // And it can be run again as it was found.
        const ResolvedScheme again = schemeAt(loose.scene(), 0, without);
        QCOMPARE(again.discretization.solver.number("tolerance"), without.reduction.solver);
    }
    void theCourantNumberIsSearched() {
        SweepOptions options = untimed();
        options.wantedError = 1e-2;
        Sweep sweep(sceneOf("bar-notch"), options);
        options.knobs.isStepFactor = false;
        Sweep fixed(sceneOf("bar-notch"), options);
        runAll(sweep);
        runAll(fixed);
        for (std::size_t i = 0; i < sweep.rows().size(); ++i) {
            const PointResult &own = fixed.rows()[i].result, &found = sweep.rows()[i].result;
            const double courant = stepFactorOf(sweep.scene().schemes[i], sweep.scene());
            qInfo("Courant number %g in place of %g: %lld evaluations in place of %lld, error %.1e",
                  found.reduction.stepFactor, courant, found.cost.evaluations, own.cost.evaluations,
                  found.error);
            QVERIFY(own.reduction.stepFactor == 0 && courant > 0);
            QVERIFY(found.isDone() && found.error <= 1e-2 && found.reduction.stepFactor > courant);
            QVERIFY(found.cost.evaluations < own.cost.evaluations);
            QVERIFY(std::abs(found.step / own.step - found.reduction.stepFactor / courant) < 1e-12);
        }
    }
    void theLogHasWhatWasTried() {
        SweepOptions options = untimed();
        options.wantedError = 1e-6;
        options.knobs.isTolerance = true;
        Sweep sweep(planetScene(), options), again(planetScene(), options);
        std::vector<std::string> lines;
        runLines(sweep, [&](const std::string& line) { lines.push_back(line); }, {});
        for (const std::string& line : lines) (void)takeLine(line, again);
        const PointResult &a = sweep.rows().front().result, &b = again.rows().front().result;
        QVERIFY(a.tried.size() > 2);
        QVERIFY(a.tried == b.tried && a.reduction == b.reduction);
    }
    void theRaceIsDrawn() {
        SweepOptions options = untimed();
        options.wantedError = 1e-6;
        options.hasAllCandidates = true;
        Sweep sweep(planetScene(), options);
        runAll(sweep);
        const Figure figure = studyFigure("cheapest", sweep);
        QCOMPARE(figure.view, "cheapest");
        QVERIFY(figure.series().size() > 1 && figure.all<Guide>().size() > 3);
        bool hasDropped = false;
        for (const Series& s : figure.series()) hasDropped = hasDropped || s.label == "dropped";
        QVERIFY(hasDropped);
        const auto labels = figure.all<Label>();
        QVERIFY(std::any_of(labels.begin(), labels.end(),
                            [](const Label& l) { return l.text == "wish 1e-06" || l.text == "wish 1e-6"; }));
        QVERIFY(figure.y.range->first < 1e-6 && figure.y.range->second > 1e-6);
    }
    void aRaceThatNobodyWinsShowsTheNearest() {
        SweepOptions options = untimed();
        options.wantedError = 1e-30;
        Sweep sweep(planetScene(), options);
        runAll(sweep);
        const Figure figure = studyFigure("cheapest", sweep);
        QVERIFY(figure.message.empty());
        QVERIFY(!figure.series().empty());
        const auto labels = figure.all<Label>();
        QVERIFY(std::any_of(labels.begin(), labels.end(),
                            [](const Label& l) { return l.text.starts_with("Galerkin 12: "); }));
    }
    void betweenTriedRunsTheLogarithmIsLinear() {
        ExpectedTime time;
        int tried = 0;
        const auto seconds = [](std::size_t i) { return 1e-3 * std::pow(2.0, static_cast<double>(i)); };
        time.addRuns(11, [&](std::size_t i) {
            ++tried;
            return seconds(i);
        });
        QVERIFY(tried <= 4);
        double all = 0;
        for (std::size_t i = 0; i < 11; ++i) all += seconds(i);
        QVERIFY(std::abs(time.onThreads(1) / all - 1) < 1e-12);
        QVERIFY(std::abs(time.onThreads(2) / seconds(10) - 1) < 1e-12);  // the longest run alone
        QVERIFY(std::abs(time.onThreads(1000) / seconds(10) - 1) < 1e-12);
    }
    /// A step of thirty-six unknowns without a second derivative takes minutes, in a trial as well.
    void aTrialStopsInTheMiddleOfAStep() {
        const ResolvedScene scene = *readScene(std::string_view(R"({"extremal":1,"model":
            {"type":"outer-solar-system"},"time":{"end":20000},
            "schemes":[{"step":2000,"baseline":"time-transformed"}]})"))
                                         .resolved;
        std::stop_source source;
        source.request_stop();
        QCOMPARE(trialSeconds(scene, scene.schemes.front(), source.get_token()), 0.0);
    }
    void studiesAnnounceTheirTime() {
        Sweep ladder(planetScene(), untimed());
        QCOMPARE(ladder.announced().seconds, 0.0);
        runAll(ladder);
        QVERIFY(ladder.announced().seconds > 0 && !ladder.announced().isLimit);
        SweepOptions options;
        options.repeat = 1;
        options.wantedError = 1e-6;
        options.searchSeconds = 0.5;
        Sweep search(planetScene(), options);
        runAll(search);
        QVERIFY(search.announced().seconds >= 0.5 && search.announced().isLimit);
        QCOMPARE(textOf(AnnouncedTime{11.2, false}), "about 12 s");
        QCOMPARE(textOf(AnnouncedTime{0.5, true}), "at most 1 s");
    }
};

EXTREMAL_TEST(KnobsTest)
}  // namespace extremal::knobs_test

#include "knobs_test.moc"
