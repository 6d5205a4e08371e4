// SPDX-License-Identifier: GPL-3.0-or-later
/// What is done to plots from the plots: hidden, moved, scaled, followed through the time, reached by keys.
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QTest>

#include <algorithm>
#include <set>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/card.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/windows/palette_dialog.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::plots_by_hand_test {

class PlotsByHandTest : public QObject {
    Q_OBJECT

    std::unique_ptr<MainWindow> window_;
    std::vector<std::string> views() {
        std::vector<std::string> all;
        for (const PlotWidget* plot : window_->compareView().plots()) all.push_back(plot->figure().view);
        return all;
    }
    PlotWidget* plotOf(const char* view) { return extremal::plotOf(*window_, view); }
    QAction* actionOf(const char* view, const char* text) {
        QMenu* const menu = qobject_cast<Card*>(plotOf(view)->parentWidget())->menu();
        emit menu->aboutToShow();
        const auto all = menu->actions();
        const auto at =
            std::find_if(all.begin(), all.end(), [&](const QAction* a) { return a->text().contains(text); });
        return at == all.end() ? nullptr : *at;
    }

private slots:
    void initTestCase() { loadFonts(); }
    void init() {
        window_ = std::make_unique<MainWindow>(Theme::light(), false);
        window_->resize(1600, 1000);
        window_->show();
        QVERIFY(window_->open("preset:kepler"));
        QVERIFY(waitForResults(*window_));
    }
    void cleanup() { window_.reset(); }

    void plotsAreHiddenAndMoved() {
        const std::vector<std::string> before = views();
        QVERIFY(before.size() > 3 && before[0] == "work-precision");
        QVERIFY(!actionOf("work-precision", "Hide")->isEnabled());
        QVERIFY(!actionOf(before[1].c_str(), "before the last")->isEnabled());
        actionOf(before[1].c_str(), "behind the next")->trigger();
        QVERIFY(waitForResults(*window_));
        QCOMPARE(views()[2], before[1]);
        QCOMPARE(views()[1], before[2]);
        actionOf(before[2].c_str(), "Hide")->trigger();
        QVERIFY(waitForResults(*window_));
        QCOMPARE(views().size(), before.size() - 1);
        QVERIFY(!plotOf(before[2].c_str()));
        window_->workspace().undo();
        window_->workspace().undo();
        QVERIFY(waitForResults(*window_));
        QCOMPARE(views(), before);
    }

    void theScaleIsThatOfTheUser() {
        QVERIFY(plotOf("energy")->figure().y.isLog);
        actionOf("energy", "Logarithmic")->trigger();
        QVERIFY(waitForResults(*window_));
        QVERIFY(!plotOf("energy")->figure().y.isLog);
        const auto range = *plotOf("energy")->figure().y.range;
        QVERIFY(range.first <= 0 && range.second > 0);
        // New results keep it.
        QVERIFY(window_->workspace().edit({{"/time/end", 40.0}}, "end"));
        QVERIFY(waitForResults(*window_));
        QVERIFY(!plotOf("energy")->figure().y.isLog);
        actionOf("energy", "Logarithmic")->trigger();
        QVERIFY(waitForResults(*window_));
        QVERIFY(plotOf("energy")->figure().y.isLog);
    }

    void portraitsFollowTheWindowOfTime() {
        const auto span = [&] {
            const Series& s = plotOf("phase")->figure().series().front();
            return std::pair(s.t.front(), s.t.back());
        };
        const auto whole = span();
        const auto axes = plotOf("phase")->figure().x.range;
        PlotWidget* const energy = plotOf("energy");
        emit energy->timeRangeChanged(PlotRange{5, 10});
        QCOMPARE(span(), std::pair(5.0, 10.0));
        QCOMPARE(plotOf("phase")->figure().x.range, axes);
        QVERIFY(window_->workspace().edit({{"/schemes/0/step", 0.11}}, "step"));
        QVERIFY(waitForResults(*window_));
        QCOMPARE(span(), std::pair(5.0, 10.0));
        energy->fit();
        QVERIFY(span().second > 0.99 * whole.second);  // steps of another length end elsewhere
    }

    void keysReachStageAndPlots() {
        std::set<QWidget*> reached;
        window_->compareView().stage()->setFocus();
        for (int i = 0; i < 300; ++i) {
            QTest::keyClick(window_->focusWidget(), Qt::Key_Tab);
            if (window_->focusWidget()) reached.insert(window_->focusWidget());
        }
        QVERIFY(reached.contains(window_->compareView().stage()));
        for (PlotWidget* plot : window_->compareView().plots()) {
            QVERIFY2(reached.contains(plot), plot->figure().view.c_str());
            QVERIFY(!plot->accessibleName().isEmpty() && !plot->accessibleDescription().isEmpty());
        }
        PlotWidget* const energy = plotOf("energy");
        energy->setFocus();
        const PlotRange before = energy->visibleRange(PlotAxis::x);
        QTest::keyClick(energy, Qt::Key_Plus);
        const PlotRange after = energy->visibleRange(PlotAxis::x);
        QVERIFY(after.high - after.low < 0.9 * (before.high - before.low));
        QTest::keyClick(energy, Qt::Key_Backspace);
        QCOMPARE(energy->visibleRange(PlotAxis::x).high, before.high);
    }

    void theStageSaysWhatItShows() {
        window_->playback().setPlaying(false);
        window_->playback().setTime(2.5);
        const QString said = window_->compareView().stage()->accessibleDescription();
        QVERIFY2(said.contains("t = 2.5") && said.contains("RK4: x "), qPrintable(said));
    }

    void thePaletteGroupsAndExplains() {
        window_->actions().find("plots")->trigger();
        auto* const dialog = window_->findChild<PaletteDialog*>();
        QVERIFY(dialog);
        auto* const list = dialog->findChild<QListWidget*>();
        QStringList headings, entries;
        for (int i = 0; i < list->count(); ++i)
            (list->item(i)->data(Qt::UserRole).isValid() ? entries : headings) << list->item(i)->text();
        QVERIFY2(headings.size() >= 3 && entries.size() >= 12, qPrintable(headings.join("; ")));
        QVERIFY(list->currentItem()->data(Qt::UserRole).isValid());
        // A word of an explanation finds what it explains.
        auto* const field = dialog->findChild<QLineEdit*>();
        QTest::keyClicks(field, "Lyapunov");
        QVERIFY(list->count() >= 1);
        QTest::keyClick(dialog, Qt::Key_Escape);
        QTRY_VERIFY(!window_->findChild<PaletteDialog*>());
        window_->actions().find("palette")->trigger();
        auto* const all = window_->findChild<PaletteDialog*>();
        QTest::keyClicks(all->findChild<QLineEdit*>(), "add stormer");
        const std::size_t schemes = window_->workspace().scene().schemes.size();
        QTest::keyClick(all->findChild<QLineEdit*>(), Qt::Key_Return);
        QCOMPARE(window_->workspace().scene().schemes.size(), schemes + 1);
    }
};

EXTREMAL_TEST(PlotsByHandTest)

}  // namespace extremal::plots_by_hand_test

#include "plots_by_hand_test.moc"
