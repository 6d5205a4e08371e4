// SPDX-License-Identifier: GPL-3.0-or-later
/// A lesson drives the window, and its steps stay with the scene.
#include <QFile>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/card.hpp"
#include "ui/base/notices.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/gallery.hpp"
#include "ui/shell/lesson_bar.hpp"
#include "ui/shell/start_page.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::lesson_test {

class LessonTest : public QObject {
    Q_OBJECT

    static LessonBar& barOf(MainWindow& window) { return *window.findChild<LessonBar*>("lesson"); }
    static void press(MainWindow& window, const char* action) { window.actions().find(action)->trigger(); }

private slots:
    void initTestCase() { loadFonts(); }

    void theStartPageLeadsToLessons() {
        MainWindow window(Theme::light(), false);
        window.resize(1400, 900);
        window.show();
        auto* const page = window.findChild<StartPage*>();
        QTRY_VERIFY(!page->shownPresets().isEmpty());
        const qsizetype all = page->shownPresets().size();
        QTest::mouseClick(page->findChild<QPushButton*>("lessons"), Qt::LeftButton);
        QVERIFY(page->shownPresets().size() >= 3 && page->shownPresets().size() < all / 4);
        QVERIFY(page->shownPresets().contains("stability-limit"));
        auto* const card = page->findChild<GalleryCard*>("preset.stability-limit");
        QTest::mouseClick(card->findChild<QPushButton*>("lesson"), Qt::LeftButton);
        QVERIFY(window.workspace().hasScene());
        QCOMPARE(window.workspace().origin(), QString("preset:stability-limit"));
        QCOMPARE(barOf(window).at(), 0);
        QVERIFY(barOf(window).isVisible());
    }
    void stepsSelectPointAndSet() {
        MainWindow window(Theme::light(), false);
        window.resize(1600, 1000);
        window.show();
        QVERIFY(window.open("preset:stability-limit"));
        LessonBar& bar = barOf(window);
        QVERIFY(!bar.isVisible());
        press(window, "lesson");
        QVERIFY(bar.isVisible());
        QCOMPARE(window.workspace().selectedScheme(), 0);
        press(window, "lessonBack");  // there is none before
        QCOMPARE(bar.at(), 0);
        press(window, "lessonNext");
        QCOMPARE(bar.at(), 1);
        QCOMPARE(window.workspace().selectedScheme(), 1);
        const auto isMarked = [&](const std::string& view) {
            const auto plots = window.compareView().plots();
            return std::any_of(plots.begin(), plots.end(), [&](PlotWidget* plot) {
                return plot->parentWidget()->property("selected").toBool() && plot->figure().view == view;
            });
        };
        QVERIFY(waitForResults(window));
        QVERIFY(isMarked("energy"));
        QVERIFY(!isMarked("phase"));

        const LessonStep step = bar.steps()[1];  // a copy: an edit makes the bar read its steps again
        QVERIFY(!isReached(step, window.workspace().document()));
        press(window, "lessonDo");
        QVERIFY(isReached(step, window.workspace().document()));
        QCOMPARE(window.workspace().scene().schemes[1].step.value, 2.02);
        press(window, "undo");
        QCOMPARE(window.workspace().scene().schemes[1].step.value, 1.9);

        for (std::size_t i = 1; i < bar.steps().size(); ++i) press(window, "lessonNext");
        QVERIFY(!bar.isRunning());
        QVERIFY(!bar.isVisible());
        QVERIFY(!isMarked("error"));
    }
    void withoutALessonThatIsSaid() {
        MainWindow window(Theme::light(), false);
        QVERIFY(window.open("preset:duffing"));
        press(window, "lesson");
        QVERIFY(!barOf(window).isRunning());
        QVERIFY(std::any_of(window.notices().all().begin(), window.notices().all().end(),
                            [](const Notice& n) { return n.text.contains("no lesson"); }));
    }
    void stepsAreSavedWithTheScene() {
        QTemporaryDir folder;
        Notices notices;
        Workspace workspace(notices);
        QVERIFY(workspace.open("preset:kepler"));
        const Value steps = *workspace.document().find("steps");
        QVERIFY(workspace.edit({{"/time/end", 20.0}}, "end"));
        workspace.undo();
        const QString path = folder.filePath("kepler.json");
        QVERIFY(workspace.saveAs(path));
        Workspace again(notices);
        QVERIFY(again.open(path));
        QVERIFY(*again.document().find("steps") == steps);
    }
};

EXTREMAL_TEST(LessonTest)

}  // namespace extremal::lesson_test

#include "lesson_test.moc"
