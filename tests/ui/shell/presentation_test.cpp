// SPDX-License-Identifier: GPL-3.0-or-later
/// Presentation, and lessons that are changed in place.
#include <QMenuBar>
#include <QMenu>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTest>

#include <algorithm>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/card.hpp"
#include "ui/panels/scheme_list.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/lesson_bar.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::presentation_test {

class PresentationTest : public QObject {
    Q_OBJECT

    std::unique_ptr<MainWindow> window_;
    LessonBar& bar() { return *window_->findChild<LessonBar*>("lesson"); }
    void press(const char* action) { window_->actions().find(action)->trigger(); }
    std::vector<std::string> shownPlots() {
        std::vector<std::string> shown;
        for (const PlotWidget* plot : window_->compareView().plots())
            if (!plot->parentWidget()->isHidden()) shown.push_back(plot->figure().view);
        return shown;
    }
    const std::string& textOfStep(int i) {
        return window_->workspace()
            .document()
            .find("steps")
            ->asArray()[static_cast<std::size_t>(i)]
            .find("text")
            ->asString();
    }

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void init() {
        window_ = std::make_unique<MainWindow>(Theme::light(), false);
        window_->resize(1600, 1000);
        window_->show();
        QVERIFY(window_->open("preset:stability-limit"));
        QVERIFY(waitForResults(*window_));
    }
    void cleanup() { window_.reset(); }

    void theStageAndOnePlotAreLeftInLargeType() {
        const std::size_t all = shownPlots().size();
        QVERIFY(all > 1);
        const int letters = QApplication::font().pixelSize();
        QVERIFY(letters > 0);
        press("present");
        QCOMPARE(shownPlots().size(), std::size_t{1});
        QVERIFY(window_->compareView().stage()->isVisible());
        QVERIFY(window_->findChild<SchemeList*>()->isHidden());
        QVERIFY(window_->menuBar()->isHidden());
        QVERIFY(QApplication::font().pixelSize() >= 1.7 * letters);
        QVERIFY(window_->isFullScreen());

        // One key for the next step, whose plot comes into sight.
        QVERIFY(bar().isRunning());
        const double t = window_->playback().time();
        press("stepForward");
        QCOMPARE(bar().at(), 1);
        QCOMPARE(shownPlots(), std::vector<std::string>{bar().steps()[1].view});
        press("stepBack");
        QCOMPARE(bar().at(), 0);
        QVERIFY(bar().steps()[0].time || window_->playback().time() == t);

        // Esc brings everything back.
        press("stop");
        QCOMPARE(shownPlots().size(), all);
        QVERIFY(!window_->findChild<SchemeList*>()->isHidden());
        QVERIFY(!window_->menuBar()->isHidden());
        QVERIFY(!window_->isFullScreen());
        QVERIFY(!bar().isRunning());
        press("stepForward");
        QVERIFY(!bar().isRunning());
    }

    void keysGoFromPlotToPlot() {
        const std::vector<PlotWidget*> plots = window_->compareView().plots();
        for (std::size_t i = 0; i <= plots.size(); ++i) {
            press("nextPlot");
            QVERIFY(plots[i % plots.size()]->hasFocus());
        }
        press("previousPlot");
        QVERIFY(plots.back()->hasFocus());
        press("present");
        const std::string first = shownPlots().front();
        press("nextPlot");
        QCOMPARE(shownPlots().size(), std::size_t{1});
        QVERIFY(shownPlots().front() != first);
    }

    void stepsAreWrittenInPlace() {
        press("lesson");
        press("lessonNext");
        const std::string before = textOfStep(1);
        const std::size_t count = bar().steps().size();
        press("writeStep");
        auto* const field = bar().findChild<QPlainTextEdit*>("lessonWritten");
        QVERIFY(field->isVisible() && bar().isWriting());
        QCOMPARE(field->toPlainText().toStdString(), before);
        field->setPlainText("Now **look**.");
        QTest::keyClick(field, Qt::Key_Return, Qt::ControlModifier);
        QVERIFY(!bar().isWriting());
        QCOMPARE(textOfStep(1), std::string("Now **look**."));
        QCOMPARE(bar().at(), 1);
        QCOMPARE(bar().steps()[1].text, std::string("Now **look**."));
        press("undo");
        QCOMPARE(textOfStep(1), before);
        QCOMPARE(bar().steps()[1].text, before);
        // An empty text is no step.
        press("writeStep");
        field->setPlainText("  ");
        press("lessonNext");
        QCOMPARE(textOfStep(1), before);
        QCOMPARE(bar().steps().size(), count);
    }

    void stepsAreMovedAndRemoved() {
        press("lesson");
        const std::string first = textOfStep(0), second = textOfStep(1);
        const std::size_t count = bar().steps().size();
        const auto choose = [&](const char* text) {
            const auto actions = bar().findChild<QPushButton*>("lessonEdit")->menu()->actions();
            const auto at = std::find_if(actions.begin(), actions.end(),
                                         [&](const QAction* a) { return a->text().contains(text); });
            QVERIFY2(at != actions.end(), text);
            (*at)->trigger();
        };
        choose("later");
        QCOMPARE(bar().at(), 1);
        QCOMPARE(textOfStep(0), second);
        QCOMPARE(textOfStep(1), first);
        choose("Remove");
        QCOMPARE(bar().steps().size(), count - 1);
        QCOMPARE(textOfStep(0), second);
        window_->playback().setTime(1.25);
        choose("time of the cursor");
        QCOMPARE(*bar().steps()[static_cast<std::size_t>(bar().at())].time, window_->playback().time());
        for (std::size_t i = 1; i < count; ++i) choose("Remove");
        QVERIFY(!bar().isRunning());
        QVERIFY(!window_->workspace().document().find("steps"));
        for (std::size_t i = 0; i <= count + 1; ++i) press("undo");
        QCOMPARE(textOfStep(0), first);
    }
};

EXTREMAL_TEST(PresentationTest)

}  // namespace extremal::presentation_test

#include "presentation_test.moc"
