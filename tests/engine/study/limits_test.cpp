// SPDX-License-Identifier: GPL-3.0-or-later
/// How large h may be: sets of usable steps with the reason at each end, and the seven judgements.
#include <QTest>

#include <cmath>
#include <numbers>

#include "engine/core/thread_clock.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/request.hpp"
#include "tests/tools/pointer_of.hpp"
#include "tests/tools/test.hpp"

namespace extremal::limits_test {
namespace {

ResolvedScene sceneOf(const std::string& text) {
    const ReadScene read = readScene(text);
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return *read.resolved;
}

ResolvedScene oscillator(const std::string& schemes, double end) {
    return sceneOf(R"({"extremal":1,"model":{"type":"harmonic-oscillator","m":1,"k":1},
        "initial":{"q":[1],"p":[0]},"time":{"end":)" +
                   std::to_string(end) + R"(},"schemes":[)" + schemes + "]}");
}

/// k = 1e6, a start off by 0.005, ten units of time.
ResolvedScene stiffSpring(const std::string& schemes) {
    return sceneOf(R"({"extremal":1,"model":{"type":"spring-pendulum","m":1,"l":1,"g":9.81,"k":1e6},
        "initial":{"q":[0.005,1],"p":[0,0]},"time":{"end":10},"schemes":[)" +
                   schemes + "]}");
}

LimitsStudy done(const ResolvedScene& scene, std::vector<Wish> wishes, double seconds = 20) {
    LimitsOptions options;
    options.wishes = std::move(wishes);
    options.seconds = seconds;
    LimitsStudy study(scene, options);
    study.run([](std::size_t) {}, {});
    return study;
}

std::vector<StepRange> usable(const LimitsStudy& study, std::size_t row = 0) {
    std::vector<StepRange> all;
    for (const StepRange& range : study.rows()[row].result.ranges)
        if (range.isUsable()) all.push_back(range);
    return all;
}

Judgement judged(double value, double wish, double size, double floor) {
    const JudgedValue one{value, wish, size, floor};
    return judge(RunStatus::done, Outcome::converged, {&one, 1});
}

}  // namespace

class LimitsTest : public QObject {
    Q_OBJECT
private slots:
    void aJudgementKnowsTheFloor() {
        QCOMPARE(judged(1e-4, 1e-3, 1, 0), Judgement::right);
        QCOMPARE(judged(1e-2, 1e-3, 1, 0), Judgement::coarse);
        QCOMPARE(judged(0.3, 1e-3, 1, 0), Judgement::wrong);
        QCOMPARE(judged(1e-4, 1e-3, 1, 1e-2), Judgement::notJudged);  // the wish is below the floor
        QCOMPARE(judged(1e-4, 1e-3, 1, 5e-4), Judgement::right);      // the wish is above it
        QCOMPARE(judged(0.05, 1e-3, 1, 1e-2), Judgement::coarse);     // and so is this error
        QCOMPARE(judged(std::nan(""), 1e-3, 1, 0), Judgement::notJudged);
        QCOMPARE(judge(RunStatus::failed, Outcome::lost, {}), Judgement::lost);
        QCOMPARE(judge(RunStatus::failed, Outcome::singular, {}), Judgement::diverged);
        QCOMPARE(judge(RunStatus::failed, Outcome::refused, {}), Judgement::refused);
        QCOMPARE(judge(RunStatus::partial, Outcome::stopped, {}), Judgement::unknown);
        for (const char* word : {"right", "coarse", "wrong", "lost", "diverged", "refused", "not judged"})
            QCOMPARE(name(judgementOf(word)), std::string_view(word));
    }
    /// Of the energy, which the Verlet scheme keeps within h^2/8: accuracy ends the steps. Where that is
    /// enough, it is the limit of stability.
    void anExplicitSchemeEndsByAccuracyOrByStability() {
        const ResolvedScene scene =
            oscillator(R"({"label":"SV","step":0.1,"baseline":"stormer-verlet"})", 1000);
        const LimitsStudy fine = done(scene, {{"energy", 1e-3}});
        QCOMPARE(usable(fine).size(), std::size_t{1});
        const StepRange small = usable(fine).front();
        qInfo("energy 1e-3: to %.4f, %s", small.to, std::string(name(small.above)).c_str());
        QVERIFY(std::abs(small.to / std::sqrt(8e-3) - 1) < 0.02);  // 0.0892 of 0.0894
        QCOMPARE(small.above, StepLimit::accuracy);
        QCOMPARE(small.below, StepLimit::shortest);
        const LimitsStudy rough = done(scene, {{"energy", 20}});
        const StepRange large = usable(rough).back();
        qInfo("energy 20: to %.4f, %s", large.to, std::string(name(large.above)).c_str());
        QVERIFY(large.to <= 2 && large.to > 1.95);
        QCOMPARE(large.above, StepLimit::stability);
    }
    /// The step between 3.140445 and 3.142467 grows by 1e-3: that matters in 2000 steps, and not in 100.
    void aResonanceIsNamedWhereItMattersWithinTheRun() {
        const std::string scheme = R"({"label":"L4","step":0.1,"scheme":"galerkin-lobatto-4"})";
        const auto named = [&](double steps) {
            const LimitsStudy study = done(oscillator(scheme, steps * std::numbers::pi), {{"energy", 0.2}});
            bool isNamed = false;
            for (const StepRange& range : study.rows().front().result.ranges)
                isNamed = isNamed || (range.reason == StepLimit::resonance && range.from > 3.140445 &&
                                      range.to < 3.142468);
            return isNamed;
        };
        QVERIFY(named(5000));
        QVERIFY(!named(100));
    }
    /// Newton's method fails for steps between those that resolve the spring and those that do not.
    void aSetOfStepsMayHaveAGap() {
        const LimitsStudy study = done(stiffSpring(R"({"label":"G8","step":0.1,"scheme":"galerkin-gauss-8"},
            {"label":"SV","step":0.001,"baseline":"stormer-verlet"})"),
                                       {{"error.theta", 1e-3}});
        for (const StepRange& r : study.rows().front().result.ranges)
            qInfo("G8 %.5f to %.5f: %s %s", r.from, r.to, std::string(name(r.judgement)).c_str(),
                  std::string(name(r.reason)).c_str());
        const std::vector<StepRange> sets = usable(study);
        QVERIFY(sets.size() >= 2);
        QVERIFY(sets.back().to > 1 && sets.front().to < 0.02);
        for (const StepRange& r : study.rows().front().result.ranges)
            if (r.to > 0.02 && r.from < 0.07)
                QVERIFY(!r.isUsable() && r.reason == StepLimit::solver && r.from > sets.front().to);
        QVERIFY(std::abs(study.ground().omegaHigh / 1000 - 1) < 0.02);
        const std::vector<StepRange> verlet = usable(study, 1);
        qInfo("SV to %.5f, then %s", verlet.back().to, std::string(name(verlet.back().above)).c_str());
        QVERIFY(verlet.back().to < 0.002 && verlet.back().to > 0.0014);
    }
    /// Steps that are too long cost the most: a ball on a spring that bounces without end. They must not use
    /// up the time, which was gone before a step was tried that is usable. The time is that of so many usable
    /// runs, whatever they cost on this machine.
    void longStepsLeaveTimeForShortOnes() {
        const ResolvedScene scene = sceneOf(R"json({"extremal":1,"model":{"type":"mechanism","gravity":9.81,
            "points":{"A":{"at":[0,1],"fixed":true},"B":{"body":"bar","at":[-0.7,0]},
                      "C":{"body":"bar","at":[0.7,0]},"D":{"mass":1,"at":[1.5,0]}},
            "bodies":{"bar":{"mass":1,"inertia":0.16,"at":[0.494974746830583,0.505025253169417],"angle":-0.785398163397448}},
            "pins":{"pin":{"from":"B","to":"A"}},"springs":{"s":{"from":"C","to":"D","stiffness":1000}},
            "dampers":{"d":{"from":"C","to":"D","damping":1}},
            "walls":{"w":{"through":[0,-0.5],"normal":[0,1],"restitution":1}}},
            "time":{"end":2},"schemes":[{"label":"G2","step":0.02,"scheme":"galerkin-gauss-2"}]})json");
        const double started = threadSeconds();
        State state = scene.initial;
        const auto integrator = scene.schemes.front().make(*scene.system, 0.001, state);
        for (int k = 0; k < 2000; ++k) QVERIFY(advance(*integrator, state).outcome == Outcome::converged);
        const double usableRun = threadSeconds() - started;
        qInfo("a usable run: %.1f ms", 1e3 * usableRun);
        const LimitsStudy study = done(scene, {{"error.phi_bar", 1e-3}}, 65 * usableRun);
        for (const StepRange& r : study.rows().front().result.ranges)
            qInfo("%.5f to %.5f: %s %s", r.from, r.to, std::string(name(r.judgement)).c_str(),
                  std::string(name(r.reason)).c_str());
        QVERIFY(!usable(study).empty());
        QCOMPARE(usable(study).back().above, StepLimit::accuracy);
    }
    void aLogHasAllOfIt() {
        const ResolvedScene scene = oscillator(R"({"label":"SV","step":0.1,"baseline":"stormer-verlet"},
            {"label":"RKF","tolerance":1e-6,"baseline":"fehlberg78"})",
                                               20);
        LimitsOptions options;
        options.wishes = {{"error", 1e-3}, {"energy", 1e-2}};
        LimitsStudy study(scene, options), again(scene, limitsOptionsOf(optionsValue(options)));
        QCOMPARE(headOf("limits", study), headOf("limits", again));
        runLines(study, [&](const std::string& line) { (void)takeLine(line, again); }, {});
        QVERIFY(study.isComplete() && again.isComplete());
        const StudyEntry& entry = *findStudy("limits");
        QCOMPARE(csvText(tablesOf(entry, study).front()), csvText(tablesOf(entry, again).front()));
        QCOMPARE(study.rows()[1].result.reason, std::string("its steps follow from its tolerance"));
        QCOMPARE(summaryOf(entry, study).columns.size(), summaryOf(entry, study).rows.front().size());
    }
    void wrongRequestsNameTheOption() {
        const ResolvedScene scene =
            oscillator(R"({"label":"SV","step":0.1,"baseline":"stormer-verlet"})", 20);
        const auto pointer = [&](StudyRequest request) {
            request.kind = "limits";
            return pointerOf([&] { (void)makeStudy(knownStudy(request), request, &scene, 1); });
        };
        StudyRequest request;
        request.wishes = {"nothing"};
        QCOMPARE(pointer(request), "--wish");
        request.wishes = {"energy=0"};
        QCOMPARE(pointer(request), "--wish");
        request.wishes = {};
        request.error = -1;
        QCOMPARE(pointer(request), "--error");
        // --error E is a wish for the metric of the study, beside others.
        request.error = 1e-3;
        request.metric = "energy";
        request.wishes = {"error=1e-2"};
        request.kind = "limits";
        const AnyStudy study = makeStudy(knownStudy(request), request, &scene, 1);
        const std::vector<Wish>& wishes = std::get<LimitsStudy>(study).options().wishes;
        QCOMPARE(wishes.size(), std::size_t{2});
        QCOMPARE(wishes.front().metric, "energy");
        QCOMPARE(wishes.front().value, 1e-3);
        request = {};
        request.candidates = "all";
        QCOMPARE(pointer(request), "--candidates");
        request.candidates = {};
        request.metric = "norm";
        QCOMPARE(pointer(request), "--metric");
    }
    /// Any number of a scene, with the bound of the reference of each.
    void aSceneGoesToItsExtremes() {
        const ResolvedScene scene = oscillator(R"({"label":"SV","step":0.1,"baseline":"stormer-verlet"},
            {"label":"midpoint","step":0.1,"scheme":"midpoint"})",
                                               20);
        ExtremesOptions options;
        options.x = parseAxis("/model/k=1:1e4:5:log", "--x");
        options.wishes = {{"energy", 0.1}};
        ExtremesStudy study(scene, options);
        QCOMPARE(study.size(), std::size_t{10});
        study.run([](std::size_t) {}, {});
        QVERIFY(study.isComplete());
        const auto at = [&](std::size_t i) { return study.rows()[i].result; };
        QCOMPARE(at(0).kind, std::string("right"));
        QCOMPARE(at(0).judgement, Judgement::right);
        QCOMPARE(at(4).kind, std::string("lost"));  // h omega = 10
        QCOMPARE(at(4).judgement, Judgement::lost);
        options.y = parseAxis("/schemes/*/step=0.1:0.2:2", "--y");
        const ExtremesStudy both(scene, options);
        QCOMPARE(both.size(), std::size_t{20});
        QVERIFY(both.rows()[10].at.axis->id.find("/schemes/*/step = 0.2") != std::string::npos);
        options.x.pointer = "/model/kk";
        QCOMPARE(pointerOf([&] { (void)ExtremesStudy(scene, options); }), "--x");
    }
};

EXTREMAL_TEST(LimitsTest)
}  // namespace extremal::limits_test
#include "limits_test.moc"
