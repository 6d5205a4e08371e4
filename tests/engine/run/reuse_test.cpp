// SPDX-License-Identifier: GPL-3.0-or-later
/// Results that hold after an edit are told from those that do not, and are not computed again.
#include <QTest>

#include "engine/run/reuse.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::reuse_test {
namespace {

Scene preset(const std::vector<Override>& overrides = {}) {
    const ReadScene read = readScene(findPreset("pendulum")->json, overrides);
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return read.scene;
}

bool covers(const Scene& before, const Scene& after) {
    return coversRun(before, before.schemes[0], after, after.schemes[0]);
}

}  // namespace

class ReuseTest : public QObject {
    Q_OBJECT
private slots:
    void namesPlacesAndOtherSchemesDoNotMatter() {
        const Scene before = preset();
        Scene after = before;
        after.title = "another";
        after.schemes[0].label = "renamed";
        after.schemes[0].style = 5;
        after.schemes[1].isEnabled = false;
        after.schemes.pop_back();
        QVERIFY(covers(before, after));
    }
    void theProblemAndTheSchemeMatter() {
        const Scene before = preset();
        QVERIFY(!covers(before, preset({{"/model/g", 9.0}})));
        QVERIFY(!covers(before, preset({{"/time/end", before.end.value / 2}})));
        QVERIFY(!covers(before, preset({{"/schemes/0/step", before.schemes[0].step.value / 2}})));
        QVERIFY(!covers(before, preset({{"/initial/q/0", 0.5}})));
        Scene unobserved = before;
        unobserved.observe.pop_back();
        QVERIFY(!covers(before, unobserved));
    }
    void plotsMatterWhereTheyNeedTheInsideOfSteps() {
        const auto withViews = [](const char* views) {
            const ReadScene read = readScene(findPreset("pendulum")->json, {{"/views", parseJson(views)}});
            return read.scene;
        };
        const Scene plain = withViews(R"(["energy"])"), phase = withViews(R"(["energy","phase"])"),
                    matrix = withViews(R"(["energy","sparsity"])");
        QVERIFY(!plain.views.empty() && !matrix.views.empty());
        QVERIFY(covers(plain, phase) && covers(phase, plain));
        QVERIFY(!covers(plain, matrix));  // the pattern of the equations is not there
        QVERIFY(covers(matrix, plain));   // nor in the way
    }
    void aRunTakesOverWhatIsKnown() {
        const Scene before = preset();
        const Comparison first = run(before);
        Scene after = before;
        after.schemes[1].step.value /= 2;
        after.schemes[2].label = "renamed";
        RunOptions options;
        options.known = {first.schemes[0], nullptr, first.schemes[2]};
        const Comparison second = run(after, options);
        QVERIFY(second.isFinished);
        QCOMPARE(second.schemes[0], first.schemes[0]);  // the very same
        QCOMPARE(second.schemes[1]->summary.steps, 2 * first.schemes[1]->summary.steps);
        QCOMPARE(second.schemes[2]->summary.cpuSeconds, first.schemes[2]->summary.cpuSeconds);
        QCOMPARE(second.schemes[2]->summary.label, std::string("renamed"));
        QCOMPARE(second.schemes[2]->spec.label, std::string("renamed"));
        // What is new is measured against the same reference.
        const Comparison anew = run(after);
        QCOMPARE(second.schemes[1]->summary.maxError, anew.schemes[1]->summary.maxError);
        QCOMPARE(second.reference.description, anew.reference.description);
    }
    /// What is known is not a work of the run, and a scheme that has failed has none left.
    void progressIsThatOfTheWorkOfTheRun() {
        Scene scene = preset();
        const Comparison first = run(scene);
        QVERIFY(scene.schemes.size() >= 2);
        RunOptions options;
        options.known.assign(scene.schemes.size(), nullptr);
        for (std::size_t i = 1; i < first.schemes.size(); ++i) options.known[i] = first.schemes[i];
        Run other(scene, options);
        QCOMPARE(other.fraction(), 0.0);
        other.start();
        other.wait();
        QCOMPARE(other.fraction(), 1.0);
        options.known[0] = first.schemes[0];
        QCOMPARE(Run(scene, options).fraction(), 1.0);

        // Far beyond what the iteration can solve.
        Scene lost =
            readScene(findPreset("kepler")->json, {{"/schemes/0/step", 5.0}, {"/time/end", 100.0}}).scene;
        lost.schemes.resize(1);
        Run failing(lost);
        failing.start();
        failing.wait();
        QVERIFY(failing.latest().schemes[0]->summary.status == RunStatus::failed);
        QCOMPARE(failing.fraction(), 1.0);
    }
};

EXTREMAL_TEST(ReuseTest)
}  // namespace extremal::reuse_test

#include "reuse_test.moc"
