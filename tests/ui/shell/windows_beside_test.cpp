// SPDX-License-Identifier: GPL-3.0-or-later
/// Windows beside the main one: a race of the schemes, and two copies of a motion; and what leaves by files.
#include <QDir>
#include <QImage>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/pictures/export_folder.hpp"
#include "ui/plots/plot_renderer.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/windows/copies_window.hpp"
#include "ui/windows/race_window.hpp"
#include "ui/workspace/wanted.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::windows_beside_test {

class WindowsBesideTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() { loadFonts(); }

    void aRaceEndsAtTheWantedError() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        window.actions().find("race")->trigger();
        auto* const race = window.findChild<RaceWindow*>();
        QVERIFY(race && race->isVisible());
        QCOMPARE(race->verdicts().size(), qsizetype{4});
        window.wanted().setError(1);
        race->setSpent(1);
        const auto with = [&](const char* text) {
            const QStringList all = race->verdicts();
            return std::count_if(all.begin(), all.end(), [&](const QString& v) { return v.contains(text); });
        };
        QVERIFY(with("1. in") == 1);
        window.wanted().setError(1e-14);
        QCOMPARE(with("1. in"), 0);
        QCOMPARE(with("out"), 4);
        race->setSpent(0);
        QCOMPARE(with("out"), 0);
    }
    void twoCopiesFollowTheSelection() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:double-pendulum"));
        QVERIFY(waitForResults(window));
        window.workspace().selectScheme(0);
        window.actions().find("perturb")->trigger();
        auto* const copies = window.findChild<CopiesWindow*>();
        QVERIFY(copies);
        QTRY_VERIFY_WITH_TIMEOUT(copies->isCurrent() && !copies->plot().figure().series().empty(), 20000);
        const Series& distance = copies->plot().figure().series().front();
        QCOMPARE(distance.label, window.workspace().scene().schemes[0].label);
        QVERIFY(distance.y.back() > distance.y.front());
    }
    void aPictureHasItsSizeOnPaper() {
        constexpr double dotsPerInch = 300;
        const QSize size(378, 189);  // of 100 x 50 mm, in pixels of 1/96 inch
        QTemporaryDir folder;
        const QString file = folder.filePath("a.png");
        QCOMPARE(saveFigure(file, Figure{}, size, Theme::light(), dotsPerInch / 96, {}), QString());
        const QImage image(file);
        QVERIFY(std::abs(image.width() - 100 / 25.4 * 300) < 3);
        QVERIFY(std::abs(image.dotsPerMeterX() - 300 / 0.0254) < 2);
    }
    void framesGoFromTheStartToTheEnd() {
        QTemporaryDir folder;
        std::vector<double> times;
        const auto steps = frameSteps(folder.path(), 2, 4, 3, [&](double t) {
            times.push_back(t);
            return QImage(4, 4, QImage::Format_RGB32);
        });
        for (const auto& step : steps) QCOMPARE(step(), QString());
        QCOMPARE(times, (std::vector<double>{2, 3, 4}));
        QCOMPARE(QDir(folder.path()).entryList({"*.png"}),
                 (QStringList{"frame-0001.png", "frame-0002.png", "frame-0003.png"}));
        QVERIFY(
            !frameSteps("/proc/nowhere", 0, 1, 2, [](double) { return QImage(4, 4, QImage::Format_RGB32); })
                 .front()()
                 .isEmpty());
    }
};

EXTREMAL_TEST(WindowsBesideTest)

}  // namespace extremal::windows_beside_test

#include "windows_beside_test.moc"
