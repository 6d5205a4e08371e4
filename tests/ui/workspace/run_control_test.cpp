// SPDX-License-Identifier: GPL-3.0-or-later
/// What a run is expected to take: steps, maps, and how many nodes a wave function has.
#include <QTest>

#include "engine/run/run.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/compare/figure_job.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::run_control_test {
namespace {

Scene scene(const std::string& name, const std::vector<Override>& overrides = {}) {
    const ReadScene read = readScene(findPreset(name)->json, overrides);
    for (const Problem& p : read.errors) qWarning("%s %s", p.pointer.c_str(), p.message.c_str());
    return read.scene;
}

}  // namespace

class RunControlTest : public QObject {
    Q_OBJECT
private slots:
    void mapsCount() {
        const CostModel model;
        const Scene with = scene("stiffness-map");
        Scene without = with;
        std::erase_if(without.views, [](const View& v) { return v.id == "parameter-map"; });
        QVERIFY(without.views.size() < with.views.size());
        QVERIFY(model.predict(with) > 10 * model.predict(without));
    }
    void nodesCount() {
        CostModel model;
        const Scene small = scene("double-slit", {{"/model/modes", 16.0}, {"/model/modes_y", 16.0}}),
                    large = scene("double-slit");
        QVERIFY(std::abs(model.predict(large) / model.predict(small) - 256) < 1e-9);
        // What was measured on few nodes is carried over to many, and the other way round.
        Comparison measured;
        measured.scene = small;
        for (const SchemeSpec& spec : small.schemes) {
            auto result = std::make_shared<SchemeResult>();
            result->spec = spec;
            result->summary.steps = 100;
            result->summary.cpuSeconds = 0.01;
            measured.schemes.push_back(result);
        }
        model.learn(measured);
        double steps = 0;
        for (const SchemeSpec& spec : small.schemes) steps += 1.25 / spec.step.value;
        QVERIFY(std::abs(model.predict(small) - 1e-4 * steps) < 1e-9);
        QVERIFY(std::abs(model.predict(large) - 256 * 1e-4 * steps) < 1e-7);
    }
    /// A plot without data says what it waits for.
    void whatIsNotComputedIsNotCalledComputing() {
        const View energy{"energy", "", ""};
        QCOMPARE(figureToCome(energy, RunControl::State::running).message, std::string("Computing ..."));
        QCOMPARE(figureToCome(energy, RunControl::State::scheduled).message, std::string("Computing ..."));
        QCOMPARE(figureToCome(energy, RunControl::State::offered).message, std::string("Waiting for Run"));
        QVERIFY(figureToCome(energy, RunControl::State::stopped).message.starts_with("Stopped"));
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        QVERIFY(window.workspace().edit({{"/time/end", Value(1e7)}}, "end"));
        QTRY_VERIFY(window.runControl().state() == RunControl::State::offered);
        QVERIFY(window.workspace().edit({{"/views/-", Value("step")}}, "plot"));
        QTRY_VERIFY(window.runControl().state() == RunControl::State::offered);
        const auto plots = window.compareView().plots();
        const auto isWaiting = [](const PlotWidget* p) { return p->figure().message == "Waiting for Run"; };
        QVERIFY(std::none_of(plots.begin(), plots.end(),
                             [](const PlotWidget* p) { return p->figure().message == "Computing ..."; }));
        QVERIFY(std::any_of(plots.begin(), plots.end(), isWaiting) || window.compareView().isCurrent());
    }
    /// A scene that waits for the key from the beginning.
    void aSceneThatTakesLongSaysThatItWaits() {
        MainWindow window(Theme::light(), false);
        window.show();
        Value document = window.workspace().document();
        QVERIFY(window.open("preset:pendulum"));
        document = window.workspace().document();
        document.find("time")->set("end", 1e7);
        QVERIFY(window.workspace().adopt(document));
        QTRY_VERIFY(window.runControl().state() == RunControl::State::offered);
        for (const PlotWidget* plot : window.compareView().plots())
            QCOMPARE(plot->figure().message, std::string("Waiting for Run"));
    }
};

EXTREMAL_TEST(RunControlTest)
}  // namespace extremal::run_control_test

#include "run_control_test.moc"
