// SPDX-License-Identifier: GPL-3.0-or-later
/// What is seen becomes part of the scene, and another window shows the same: times, parts, scales, layout
/// and sizes.
#include <QMenu>
#include <QTemporaryDir>
#include <QTest>

#include <map>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/plots/plot_group.hpp"
#include "ui/shell/actions.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::seen_test {
namespace {

struct Window : MainWindow {
    explicit Window(const QString& scene, bool plays = false) : MainWindow(Theme::light(), false) {
        setPlaysWhenOpened(plays);
        resize(1600, 1000);
        show();
        QVERIFY(open(scene));
        QVERIFY(waitForResults(*this));
        settle();
    }
    /// The page is laid out when its events are done.
    void settle() {
        QCoreApplication::sendPostedEvents();
        QCoreApplication::processEvents();
    }
    void act(const char* id) { actions().find(id)->trigger(); }
    std::map<std::string, QRect> places() {
        std::map<std::string, QRect> all;
        const auto add = [&](const std::string& name, const QWidget* widget) {
            if (widget->isVisible()) all[name] = {widget->mapTo(this, QPoint()), widget->size()};
        };
        for (const PlotWidget* plot : compareView().plots()) add(plot->figure().title, plot);
        add("stage", compareView().stage());
        return all;
    }
    std::vector<Axis> axes() {
        std::vector<Axis> all;
        for (const PlotWidget* plot : compareView().plots()) {
            const Figure figure = plot->visibleFigure();
            if (figure.view == "work-precision") continue;  // it depends on the clock
            all.insert(all.end(), {figure.x, figure.y});
        }
        return all;
    }
};

}  // namespace

class SeenTest : public QObject {
    Q_OBJECT
    QTemporaryDir dir_;

private slots:
    void initTestCase() { loadFonts(); }

    void anotherWindowShowsTheSame() {
        Window window("preset:kepler");
        const Value before = window.workspace().document();
        const auto usual = window.places();
        PlotWidget* const energy = plotOf(window, "energy");
        emit energy->timeRangeChanged(PlotRange{5, 10});
        energy->setTimeRange(PlotRange{5, 10});
        emit energy->pinRequested(6.5);
        window.playback().setTime(8.25);
        window.act("layout2");
        window.compareView().growRow(130);
        window.settle();
        window.act("storeSeen");
        QVERIFY(waitForResults(window));
        window.settle();
        const QString file = dir_.filePath("seen.json");
        QVERIFY(window.workspace().saveAs(file));
        QVERIFY(window.places() != usual);

        Window other(file, true);
        QVERIFY(!other.playback().isPlaying());
        QCOMPARE(other.playback().time(), 8.25);
        QCOMPARE(other.compareView().pinned(), std::optional(6.5));
        QCOMPARE(other.compareView().pageLayout(), PageLayout::twoColumns);
        QVERIFY(other.actions().find("layout2")->isChecked());
        QVERIFY(other.places() == window.places());
        const auto there = window.axes(), here = other.axes();
        QCOMPARE(here.size(), there.size());
        for (std::size_t i = 0; i < here.size(); ++i) {
            QVERIFY2(std::abs(here[i].range->first - there[i].range->first) <=
                         1e-3 * (there[i].range->second - there[i].range->first),
                     here[i].title.c_str());
            QCOMPARE(here[i].isLog, there[i].isLog);
        }
        // Storing what another window shows changes nothing: the artefact is complete.
        const Value stored = other.workspace().document();
        other.act("storeSeen");
        QVERIFY(other.workspace().document() == stored);

        other.act("forgetSeen");
        QVERIFY(waitForResults(other));
        QVERIFY(!other.workspace().document().find("show"));
        for (const View& view : other.workspace().scene().views)
            QVERIFY(view.size == CardSize() && !view.xRange && !view.yRange);
        other.settle();
        QVERIFY(other.places() == usual);
        window.workspace().undo();  // one step
        QVERIFY(window.workspace().document() == before);
    }

    void aSceneWithoutOneHasTheLayoutOfTheUser() {
        Window window("preset:kepler");
        window.act("layout3");
        QVERIFY(
            window.workspace().edit({{"/show", Value(Value::Object{{"layout", "one-column"}})}}, "layout"));
        QCOMPARE(window.compareView().pageLayout(), PageLayout::oneColumn);
        QVERIFY(window.open("preset:pendulum"));
        QCOMPARE(window.compareView().pageLayout(), PageLayout::threeColumns);
        QVERIFY(window.actions().find("layout3")->isChecked());
    }
};

EXTREMAL_TEST(SeenTest)

}  // namespace extremal::seen_test

#include "seen_test.moc"
