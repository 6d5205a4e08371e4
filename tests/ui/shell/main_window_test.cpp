// SPDX-License-Identifier: GPL-3.0-or-later
/// The window as a user drives it, on the offscreen platform.
#include <qcustomplot.h>

#include <QComboBox>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QSet>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QClipboard>
#include <QFileInfo>
#include <QProcess>
#include <QTest>
#include <QTextBrowser>

#include <algorithm>
#include <cmath>

#include "engine/core/libraries.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/resolve.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/card.hpp"
#include "ui/base/notices.hpp"
#include "ui/base/value_edit.hpp"
#include "ui/compare/case_preview.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/panels/discretizer.hpp"
#include "ui/panels/scheme_editor.hpp"
#include "ui/pictures/export_folder.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/windows/about.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::main_window_test {

namespace {

/// The map of steps and stiffness of the first scheme of a scene whose runs end at 4; null: it did not come.
PlotWidget* mapOf(MainWindow& window) {
    window.resize(1600, 1000);
    window.show();
    const std::string view =
        R"([{"view":"parameter-map","parameter":"k","from":1,"to":1e4,"steps":[0.01,1],"cells":[5,5],"duration":4}])";
    if (!window.open("preset:stability-limit") || !waitForResults(window) ||
        !window.workspace().edit({{"/views", parseJson(view)}}, "a map") || !waitForResults(window))
        return nullptr;
    return plotOf(window, "parameter-map");
}

}  // namespace

class MainWindowTest : public QObject {
    Q_OBJECT

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void theNotesOfTheSceneAreShown() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:kepler"));
        QTextBrowser* notes = nullptr;
        for (auto* browser : window.findChildren<QTextBrowser*>())
            if (browser->accessibleName() == "Notes") notes = browser;
        QVERIFY(notes);
        const auto isShown = [&] {
            const QString lesson = QString::fromStdString(window.workspace().scene().lesson);
            return !lesson.isEmpty() && notes->toPlainText().simplified().contains(lesson.simplified());
        };
        QTRY_VERIFY(isShown());
        QVERIFY(window.open("preset:pendulum"));
        QTRY_VERIFY(isShown());
    }
    void aPresetOpensAndRunsByItself() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:kepler"));
        QVERIFY(waitForResults(window));
        const auto results = window.runControl().results();
        QVERIFY(results && results->isFinished);
        for (const auto& s : results->schemes) QVERIFY(s->summary.status == RunStatus::done);
        QVERIFY(window.compareView().plots().size() >= 5);
        for (const PlotWidget* plot : window.compareView().plots()) QVERIFY(!plot->figure().series().empty());
    }
    void aClickInTheDiscretizerAddsAScheme() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:pendulum");
        QVERIFY(waitForResults(window));
        const std::size_t before = window.workspace().scene().schemes.size();
        DiscretizerCell* cell = window.discretizer().cell(3, "lobatto");
        QVERIFY(cell);
        QTest::mouseClick(cell, Qt::LeftButton);
        QCOMPARE(window.workspace().scene().schemes.size(), before + 1);
        QVERIFY(waitForResults(window));
        QCOMPARE(window.runControl().results()->schemes.size(), before + 1);
        window.actions().find("undo")->trigger();
        QCOMPARE(window.workspace().scene().schemes.size(), before);
        window.actions().find("redo")->trigger();
        QCOMPARE(window.workspace().scene().schemes.size(), before + 1);
    }
    void aStepNearAResonanceIsChangedByOneClick() {
        QTemporaryDir folder;
        QFile file(folder.filePath("near.json"));
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write(
            R"({"extremal":1,"model":{"type":"spring-pendulum","k":1e6},"initial":{"q":[0.005,1],"p":[0,0]},"time":{"end":1},)"
            R"("schemes":[{"label":"R1","step":0.2008,"scheme":"multiscale-r1"}],"observe":["energy"]})");
        file.close();
        MainWindow window(Theme::light(), false);
        window.resize(1600, 1000);
        window.show();
        QVERIFY(window.open(file.fileName()));
        QVERIFY(waitForResults(window));
        const auto step = [&] { return window.workspace().scene().schemes[0].step.value; };
        auto* button = window.findChild<QPushButton*>("remedy");
        QVERIFY(button && button->isVisible());
        QCOMPARE(step(), 0.2008);  // offered, not taken
        QTest::mouseClick(button, Qt::LeftButton);
        QVERIFY(step() != 0.2008 && std::abs(step() / 0.2008 - 1) < 0.02);
        QTRY_VERIFY(!window.findChild<QPushButton*>("remedy")->isVisible());
        window.actions().find("undo")->trigger();
        QCOMPARE(step(), 0.2008);
    }
    void everythingIsExportedAsRunDoes() {
        QTemporaryDir folder;
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:harmonic-oscillator");
        QVERIFY(waitForResults(window));
        QVERIFY(window.exportEverything(folder.path()));
        for (const char* name : {"scene.json", "summary.csv", "summary.json", "command.txt", "stage.png",
                                 "report.html", "2-energy.pdf"})
            QVERIFY2(QFile::exists(folder.filePath(name)), name);
        const QStringList pictures = QDir(folder.path()).entryList({"*.svg"});
        QCOMPARE(static_cast<std::size_t>(pictures.size()), window.compareView().plots().size());
        // A banner that leads to the folder.
        QCOMPARE(window.notices().all().back().choices.front().text, QString("Open folder"));
        QFile report(folder.filePath("report.html"));
        QVERIFY(report.open(QIODevice::ReadOnly));
        const QString page = QString::fromUtf8(report.readAll());
        for (const SchemeSpec& s : window.workspace().scene().schemes)
            QVERIFY(page.contains(QString::fromStdString(s.label).toHtmlEscaped()));
        QCOMPARE(page.count("<img "), pictures.size() + ExportParts{}.frames);  // of the stage
        QVERIFY(!page.contains("http:") && !page.contains("https:") && !page.contains("file:"));
        // The commands make the figures as well.
        QProcess shell;
        shell.setWorkingDirectory(folder.path());
        QVERIFY(QFile::remove(folder.filePath("2-energy.svg")) &&
                QFile::remove(folder.filePath("stage.png")));
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert("PATH",
                           QFileInfo(EXTREMAL_BINARY).absolutePath() + ":" + environment.value("PATH"));
        shell.setProcessEnvironment(environment);
        shell.start("sh", {"-e", "command.txt"});
        QVERIFY(shell.waitForFinished(60000));
        QCOMPARE(shell.exitCode(), 0);
        QVERIFY(QFile::exists(folder.filePath("2-energy.svg")) &&
                QFile::exists(folder.filePath("stage.png")));
        QVERIFY(!window.exportEverything("/proc/nowhere"));
        QVERIFY(window.notices().all().back().kind == Notice::Kind::error);  // a banner, not a box
    }
    void aSceneIsCopiedAndPasted() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        const Value document = window.workspace().document();
        window.actions().find("copyScene")->trigger();
        QVERIFY(window.open("preset:kepler"));
        window.actions().find("pasteScene")->trigger();
        QVERIFY(window.workspace().document() == document);
        QGuiApplication::clipboard()->setText("no scene");
        window.actions().find("pasteScene")->trigger();
        QVERIFY(window.workspace().document() == document);
        QVERIFY(window.notices().all().back().kind == Notice::Kind::error);
    }
    void plotsAreChosenFromTheMenu() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:pendulum");
        QVERIFY(waitForResults(window));
        const auto shown = [&](const std::string& view) {
            const auto& plots = window.compareView().plots();
            return std::count_if(plots.begin(), plots.end(),
                                 [&](const PlotWidget* p) { return p->figure().view == view; });
        };
        const auto entry = [&](const QString& title) -> QAction* {
            for (QMenu* menu : window.findChildren<QMenu*>()) {
                if (menu->title().remove('&') != QStringLiteral("Plots")) continue;
                emit menu->aboutToShow();
                for (QAction* action : menu->actions())
                    if (action->text() == title) return action;
            }
            return nullptr;
        };
        QCOMPARE(shown("sparsity"), 0);
        QAction* matrix = entry("Matrix of the equations");
        QVERIFY(matrix && matrix->isCheckable() && !matrix->isChecked());
        matrix->trigger();
        QVERIFY(waitForResults(window));
        QVERIFY(shown("sparsity") > 0);
        for (const PlotWidget* plot : window.compareView().plots()) QVERIFY(plot->figure().message.empty());
        QVERIFY(entry("Matrix of the equations")->isChecked());
        entry("Matrix of the equations")->trigger();
        QVERIFY(waitForResults(window));
        QCOMPARE(shown("sparsity"), 0);
    }
    void aCaseUnderThePointerPlaysOnTheStage() {
        MainWindow window(Theme::light(), false);
        PlotWidget* const map = mapOf(window);
        QVERIFY(map);
        auto& canvas = *map->findChild<QCustomPlot*>();
        canvas.replot();
        const QRect rect = canvas.axisRect()->rect();
        const QPoint at(rect.left() + rect.width() * 3 / 10, rect.bottom() - rect.height() * 3 / 10);
        const Scene before = window.workspace().scene();
        const auto* preview = window.findChild<CasePreview*>();
        StageWidget* stage = window.compareView().stage();
        const double time = stage->time();
        QTest::mouseMove(&canvas, at);
        QTRY_VERIFY_WITH_TIMEOUT(preview->isShown(), 20000);
        QVERIFY(stage->time() <= 4.0);  // the runs of the map end there, that of the scene at 100
        QCOMPARE(window.workspace().scene(), before);
        QTest::mouseMove(&canvas, at + QPoint(rect.width() / 5, 0));  // the next cell: another case
        QTRY_VERIFY(preview->isShown());
        QTest::mouseMove(&canvas, {2, 2});
        QVERIFY(!preview->isShown());
        QTRY_VERIFY_WITH_TIMEOUT(window.compareView().isCurrent() && stage->time() == time, 20000);
    }
    void aClickOnAMapLoadsItsCase() {
        MainWindow window(Theme::light(), false);
        PlotWidget* const map = mapOf(window);
        QVERIFY(map);
        PlotWidget& plot = *map;
        QCOMPARE(plot.figure().heat()->faults.size(), std::size_t(25));
        auto& canvas = *plot.findChild<QCustomPlot*>();
        canvas.replot();
        const QRect rect = canvas.axisRect()->rect();
        // The cell in the second column from the left and the second row from the bottom: k = 10, h = 0.0316.
        const QPoint at(rect.left() + rect.width() * 3 / 10, rect.bottom() - rect.height() * 3 / 10);
        const Scene before = window.workspace().scene();
        QTest::mouseClick(&canvas, Qt::LeftButton, {}, at);
        const Scene& after = window.workspace().scene();
        QCOMPARE(after.model.number("k"), 10.0);
        const std::string label = plot.figure().series()[0].label;
        for (std::size_t i = 0; i < after.schemes.size(); ++i)
            QCOMPARE(after.schemes[i].step.value,
                     after.schemes[i].label == label ? 0.0316 : before.schemes[i].step.value);
        const auto& notices = window.notices().all();
        QVERIFY(std::any_of(notices.begin(), notices.end(), [](const Notice& n) { return n.key == "case"; }));
        QVERIFY(waitForResults(window));
        QCOMPARE(map->figure().series()[0].x.front(), 10.0);  // the dot moves along
        window.actions().find("undo")->trigger();             // one edit
        QVERIFY(window.workspace().scene() == before);
        QVERIFY(waitForResults(window));
        // The same with the pointer over the cell and Return.
        canvas.replot();
        QTest::mouseMove(&canvas, at);
        plot.setFocus();
        QTest::keyClick(&plot, Qt::Key_Return);
        QCOMPARE(window.workspace().scene().model.number("k"), 10.0);
    }
    void mapsAreNotOfferedWhereNothingVaries() {
        MainWindow window(Theme::light(), false);
        window.show();
        const auto isOffered = [&](const char* preset) {
            window.open(preset);
            for (QMenu* menu : window.findChildren<QMenu*>()) {
                if (menu->title().remove('&') != QStringLiteral("Plots")) continue;
                emit menu->aboutToShow();
                for (const QAction* action : menu->actions())
                    if (action->text() == QStringLiteral("Parameter map")) return true;
            }
            return false;
        };
        QVERIFY(isOffered("preset:pendulum"));
        QVERIFY(!isOffered("preset:free-body"));
    }
    void schemesAreComposedInTheEditor() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:pendulum");
        QVERIFY(waitForResults(window));
        const auto& schemes = window.workspace().scene().schemes;
        const auto indexOf = [&](bool isSymmetric) {
            const auto found = std::find_if(schemes.begin(), schemes.end(), [&](const SchemeSpec& s) {
                return !s.tolerance && resolve(s).claims.isSymmetric == isSymmetric;
            });
            return static_cast<int>(found - schemes.begin());
        };
        const int symmetric = indexOf(true), other = indexOf(false);
        QVERIFY(symmetric < static_cast<int>(schemes.size()) && other < static_cast<int>(schemes.size()));
        QVERIFY(!SchemeEditor(window.workspace(), other).findChild<QComboBox*>("field.composition"));

        SchemeEditor editor(window.workspace(), symmetric);
        const auto choose = [&](const QString& what) {
            auto* box = editor.findChild<QComboBox*>("field.composition");
            const int at = box ? box->findText(what) : -1;
            if (at < 0) return false;
            box->setCurrentIndex(at);
            emit box->activated(at);
            return true;
        };
        const auto spec = [&]() -> const SchemeSpec& {
            return window.workspace().scene().schemes[static_cast<std::size_t>(symmetric)];
        };
        const int order = resolve(spec()).claims.order;
        QVERIFY(choose("suzuki"));
        QCOMPARE(spec().composition.type, std::string("suzuki"));
        QCOMPARE(resolve(spec()).claims.order, order + 2);
        QVERIFY(editor.findChild<QSpinBox*>("field.order") || editor.findChild<QLineEdit*>("field.order"));
        QVERIFY(waitForResults(window));
        QVERIFY(window.runControl().results()->schemes[static_cast<std::size_t>(symmetric)]->summary.status ==
                RunStatus::done);
        QVERIFY(choose("none"));
        QVERIFY(spec().composition.type.empty());
    }
    void aRefusedEditKeepsTheScene() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:spring-pendulum");
        const Scene before = window.workspace().scene();
        QVERIFY(!window.workspace().edit({{"/model/k", Value(-1.0)}}, "stiffness"));
        QVERIFY(window.workspace().scene() == before);
        QVERIFY(!window.workspace().refusalAt("/model/k").empty());
        QVERIFY(window.workspace().edit({{"/model/k", Value(2e4)}}, "stiffness"));
        QVERIFY(window.workspace().refusalAt("/model/k").empty());
    }
    void rapidEditsLeaveOneRun() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:spring-pendulum");
        for (int i = 0; i < 20; ++i) {
            QVERIFY(window.workspace().edit({{"/model/k", Value(1e4 + 100.0 * i)}}, "stiffness", "k"));
            QCoreApplication::processEvents();
        }
        QVERIFY(waitForResults(window));
        QVERIFY(window.runControl().results()->scene == window.workspace().scene());
    }
    void closingWhileRunningIsClean() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:kepler");
        // Days of work: the test ends only if closing the window stops the run.
        QVERIFY(window.workspace().edit({{"/time/end", Value(1e9)}}, "end"));
        window.runControl().start();
        QTRY_VERIFY(window.runControl().isRunning() && window.runControl().fraction() > 0);
        window.close();
    }
    /// Before there are results a card says what will be in it.
    void cardsHaveTitlesBeforeTheirFigures() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:kepler"));
        QVERIFY(!window.runControl().results());
        for (const PlotWidget* plot : window.compareView().plots()) {
            QVERIFY(!plot->figure().title.empty() && !plot->figure().message.empty());
            QVERIFY(plot->figure().axes == AxisStyle::none);
            const auto* card = qobject_cast<const Card*>(plot->parentWidget());
            QVERIFY(card && card->accessibleName() == QString::fromStdString(plot->figure().title));
        }
        QVERIFY(waitForResults(window));
        for (const PlotWidget* plot : window.compareView().plots()) QVERIFY(plot->figure().message.empty());
    }
    void menusHaveLettersToPress() {
        MainWindow window(Theme::light(), false);
        QSet<QChar> ofBar;
        for (const QAction* menu : window.menuBar()->actions()) {
            const qsizetype at = menu->text().indexOf('&');
            QVERIFY2(at >= 0 && !ofBar.contains(menu->text()[at + 1].toUpper()), qPrintable(menu->text()));
            ofBar.insert(menu->text()[at + 1].toUpper());
            QSet<QChar> ofMenu;
            for (const QAction* action : menu->menu()->actions()) {
                const qsizetype mark = action->text().indexOf('&');
                if (mark < 0) continue;  // more actions than letters
                const QChar letter = action->text()[mark + 1].toUpper();
                QVERIFY2(!ofMenu.contains(letter), qPrintable(action->text()));
                ofMenu.insert(letter);
            }
            QVERIFY(ofMenu.size() >= std::min<qsizetype>(12, menu->menu()->actions().size() - 4));
        }
        QVERIFY(ofBar.contains('F') && ofBar.contains('H'));
    }
    void aboutNamesVersionsAndWhatDraws() {
        MainWindow window(Theme::light(), false);
        const QString backend = window.compareView().stage()->drawingBackend(), text = aboutText(backend);
        QVERIFY(!backend.isEmpty() && text.contains(backend.toHtmlEscaped()));
        for (const auto& [library, version] : libraries())
            QVERIFY2(text.contains(QString::fromStdString(library)), library.c_str());
        QVERIFY(text.contains(qVersion()));
    }
    void everyActionHasItsOwnKey() {
        MainWindow window(Theme::light(), false);
        QSet<QString> keys;
        for (const QAction* action : window.actions().all()) {
            QVERIFY2(!action->shortcuts().isEmpty(), qPrintable(action->text()));
            if (action->objectName() == "back")
                continue;  // Esc of the start page, where no other action has it
            for (const QKeySequence& key : action->shortcuts()) {
                QVERIFY2(!keys.contains(key.toString()), qPrintable(action->text() + ' ' + key.toString()));
                keys.insert(key.toString());
            }
        }
        const QAction *const back = window.actions().find("back"), *const stop =
                                                                       window.actions().find("stop");
        QVERIFY(!back->isEnabled() && !stop->isEnabled());  // no scene is open
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(!back->isEnabled() && stop->isEnabled());
        window.actions().find("gallery")->trigger();
        QVERIFY(back->isEnabled() && !stop->isEnabled());
    }
    void keysMoveTheTimeButNotInATextField() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:harmonic-oscillator");
        QVERIFY(waitForResults(window));
        window.actions().find("home")->trigger();
        QCOMPARE(window.playback().time(), 0.0);
        window.actions().find("stepForward")->trigger();
        QVERIFY(window.playback().time() > 0);
    }
    void aZoomStaysWhenNewDataArrive() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:pendulum");
        QVERIFY(waitForResults(window));
        const auto plots = window.compareView().plots();
        PlotWidget* plot = plots[1];
        QVERIFY(plot->figure().x.isTime);
        plot->setTimeRange(PlotRange{1, 2});
        const PlotRange before = plot->visibleRange(PlotAxis::x);
        window.runControl().start();
        QVERIFY(waitForResults(window));
        QVERIFY(plot->visibleRange(PlotAxis::x) == before);
        plot->fit();
        QVERIFY(!plot->isUserZoomed());
    }
};

EXTREMAL_TEST(MainWindowTest)
}  // namespace extremal::main_window_test

#include "main_window_test.moc"
