// SPDX-License-Identifier: GPL-3.0-or-later
/// Habits of the window: rows by keyboard, Esc in the windows beside it, numbers that explain themselves,
/// folders that need not exist, runs that wait, one text at a time in the status line.
#include <QDir>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QStatusBar>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <QToolTip>

#include <algorithm>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/notices.hpp"
#include "ui/own/own_window.hpp"
#include "ui/panels/formula_edit.hpp"
#include "ui/panels/scheme_card.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/theme_switch.hpp"
#include "ui/windows/folder_dialog.hpp"
#include "ui/workspace/cost_trial.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::window_habits_test {

const Notice* noticeOf(MainWindow& window, const QString& key) {
    for (const Notice& notice : window.notices().all())
        if (notice.key == key) return &notice;
    return nullptr;
}

class WindowHabitsTest : public QObject {
    Q_OBJECT

    static SchemeCard& row(MainWindow& window, int index) {
        return *window.findChild<SchemeCard*>(QString("scheme.%1").arg(index));
    }

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }

    void rowsAreChosenByKeyboard() {
        MainWindow window(Theme::light(), false);
        window.resize(1400, 900);
        window.show();
        QVERIFY(window.open("preset:kepler"));
        QVERIFY(waitForResults(window));
        QVERIFY(row(window, 0).focusPolicy() & Qt::TabFocus);
        row(window, 0).setFocus(Qt::TabFocusReason);
        QCOMPARE(window.workspace().selectedScheme(), 0);
        const auto press = [&](Qt::Key key) {
            QTest::keyClick(QApplication::focusWidget() ? QApplication::focusWidget() : &window, key);
        };
        press(Qt::Key_Up);  // no row is above
        QCOMPARE(window.workspace().selectedScheme(), 0);
        press(Qt::Key_Down);
        press(Qt::Key_Down);
        QCOMPARE(window.workspace().selectedScheme(), 2);
        QVERIFY(row(window, 2).hasFocus());
        press(Qt::Key_Up);
        QCOMPARE(window.workspace().selectedScheme(), 1);
        press(Qt::Key_Return);
        QVERIFY(row(window, 1).isEditing());
        press(Qt::Key_Return);
        QVERIFY(!row(window, 1).isEditing());
        // What a window gives back when it becomes active is not a choice.
        window.workspace().selectScheme(3);
        row(window, 1).clearFocus();
        row(window, 1).setFocus(Qt::ActiveWindowFocusReason);
        QCOMPARE(window.workspace().selectedScheme(), 3);
    }

    void escapeClosesTheWindowsBeside_data() {
        QTest::addColumn<QString>("action");
        QTest::addColumn<QString>("name");
        for (const auto& [action, name] : {std::pair{"race", "race"},
                                           {"perturb", "copies"},
                                           {"inspect", "inspector"},
                                           {"passport", "passport"},
                                           {"log", "log"},
                                           {"ownSchemes", "ownSchemes"},
                                           {"own", "ownScheme"}})
            QTest::newRow(action) << QString(action) << QString(name);
    }
    void escapeClosesTheWindowsBeside() {
        QFETCH(QString, action);
        QFETCH(QString, name);
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        window.actions().find(action.toUtf8())->trigger();
        auto* const beside = window.findChild<QWidget*>(name);
        QVERIFY(beside && beside->isVisible());
        // From each part that can have the focus.
        QWidgetList parts = beside->findChildren<QWidget*>();
        parts.prepend(beside);
        for (QWidget* part : parts) {
            if (part->window() != beside || part->focusPolicy() == Qt::NoFocus || !part->isVisible())
                continue;
            beside->activateWindow();
            QTRY_COMPARE(QApplication::activeWindow(), beside);
            part->setFocus();
            QTest::keyClick(part, Qt::Key_Escape);
            QVERIFY2(!beside->isVisible(), part->metaObject()->className());
            beside->show();
        }
        beside->activateWindow();
        QTRY_COMPARE(QApplication::activeWindow(), beside);
        QTest::keyClick(beside, Qt::Key_Escape, Qt::ShiftModifier);
        QVERIFY(beside->isVisible());
        QTest::keyClick(beside, Qt::Key_Escape);
        QVERIFY(!beside->isVisible());
    }
    void escapeKeepsWhatWasTypedAndNotApplied() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        QTest::mouseClick(window.discretizer().findChild<DiscretizerCell*>("cell.own0.nodes"),
                          Qt::LeftButton);
        QTRY_VERIFY(window.findChild<OwnWindow*>() && window.findChild<OwnWindow*>()->isVisible());
        auto* const own = window.findChild<OwnWindow*>();
        own->activateWindow();
        QTRY_COMPARE(QApplication::activeWindow(), static_cast<QWidget*>(own));
        auto* const nodes = own->findChild<FormulaEdit*>("ownNodes");
        const QString before = nodes->toPlainText();
        nodes->setPlainText("0\n1/3\n1");
        QTest::keyClick(nodes, Qt::Key_Escape);
        QVERIFY(own->isVisible());
        nodes->setPlainText(before);
        QTest::keyClick(nodes, Qt::Key_Escape);
        QVERIFY(!own->isVisible());
    }

    void aClickOnANumberExplainsIt() {
        MainWindow window(Theme::light(), false);
        window.resize(1400, 900);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        for (const auto& [name, part] : {std::pair{"cost", "CPU time"},
                                         {"error", "in rad"},
                                         {"order", "order"},
                                         {"steps", "Number of steps"}}) {
            QToolTip::hideText();
            QTRY_VERIFY(!QToolTip::isVisible());
            auto* const number = row(window, 0).findChild<QLabel*>(name);
            QVERIFY2(number, name);
            // Up through the row, as Qt hands on what a label does not take.
            QTest::mouseClick(number, Qt::LeftButton);
            QVERIFY2(QToolTip::isVisible(), name);
            QVERIFY2(QToolTip::text().contains(part), qPrintable(QToolTip::text()));
        }
        QCOMPARE(window.workspace().selectedScheme(), 0);  // the row is chosen all the same
    }
    void aClickOnAValueAtTheCursorExplainsIt() {
        MainWindow window(Theme::light(), false);
        window.resize(1400, 900);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        window.actions().find("values")->trigger();
        auto* const table = window.findChild<QTableWidget*>();
        QVERIFY(table && table->isVisible() && table->rowCount() > 0);
        QToolTip::hideText();
        const QRect cell = table->visualItemRect(table->item(0, 0));
        QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, cell.center());
        QVERIFY(QToolTip::isVisible());
        const QString scheme = QString::fromStdString(window.workspace().scene().schemes[0].label);
        QVERIFY2(QToolTip::text().contains(scheme) && QToolTip::text().contains("Plot:"),
                 qPrintable(QToolTip::text()));
        for (int column = 0; column < table->columnCount(); ++column) {
            const QString unit =
                table->horizontalHeaderItem(column)->text().section('[', 1).section(']', 0, 0);
            const QString tip = table->item(0, column)->toolTip();
            QVERIFY2(tip.contains(unit.isEmpty() ? QString("without a unit") : "in " + unit),
                     qPrintable(tip));
        }
    }

    void anExportFolderNeedNotExist() {
        QTemporaryDir place;
        QFile file(place.filePath("file"));
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.close();
        QVERIFY(problemOfFolder({}).size() > 0);
        QVERIFY(problemOfFolder(place.filePath("file")).contains("is a file"));
        QVERIFY(problemOfFolder(place.filePath("file/below")).contains("is a file"));
        QCOMPARE(problemOfFolder(place.path()), QString());
        QCOMPARE(problemOfFolder(place.filePath("a/b/c")), QString());
        QVERIFY(!QFile::exists(place.filePath("a")));  // asking makes nothing

        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        window.actions().find("exportAll")->trigger();
        auto* const dialog = window.findChild<FolderDialog*>();
        QVERIFY(dialog && dialog->isVisible());
        auto* const path = dialog->findChild<QLineEdit*>("folder");
        auto* const note = dialog->findChild<QLabel*>("folderNote");
        QVERIFY(path->text().endsWith("pendulum-export"));
        path->setText(place.filePath("file"));
        QVERIFY(note->text().contains("is a file"));
        QTest::keyClick(path, Qt::Key_Return);
        QVERIFY(dialog->isVisible());
        path->setText(place.filePath("new/folder"));
        QVERIFY(note->text().contains("will be made"));
        QTest::keyClick(path, Qt::Key_Return);
        QTRY_VERIFY_WITH_TIMEOUT(
            noticeOf(window, "export") && noticeOf(window, "export")->text.startsWith("Exported to"), 60000);
        QVERIFY(QFile::exists(place.filePath("new/folder/summary.csv")));
        QVERIFY(QFile::exists(place.filePath("new/folder/report.html")));
    }

    void aRunThatTakesLongWaits() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:double-slit"));
        QTRY_COMPARE_WITH_TIMEOUT(window.runControl().state(), RunControl::State::offered, 60000);
        const Notice* const offer = noticeOf(window, "offer");
        QVERIFY(offer);
        QVERIFY2(offer->text.contains("waits") && offer->text.contains(" s of processor time"),
                 qPrintable(offer->text));
        const auto& schemes = window.workspace().scene().schemes;
        QVERIFY2(offer->text.contains("the reference") ||
                     std::any_of(schemes.begin(), schemes.end(),
                                 [&](const SchemeSpec& s) {
                                     return offer->text.contains(QString::fromStdString(s.label));
                                 }),
                 qPrintable(offer->text));
        QCOMPARE(offer->choices.size(), std::size_t{1});
        offer->choices.front().act();
        QCOMPARE(window.runControl().state(), RunControl::State::running);
        window.runControl().stop();
    }
    void aSmallPlaneStartsByItself() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:double-slit"));
        QTRY_COMPARE_WITH_TIMEOUT(window.runControl().state(), RunControl::State::offered, 60000);
        QVERIFY(window.workspace().edit({{"/model/modes", 16.0}, {"/model/modes_y", 16.0}}, "smaller"));
        QTRY_VERIFY_WITH_TIMEOUT(window.runControl().state() == RunControl::State::finished, 60000);
        QVERIFY(!noticeOf(window, "offer"));
    }
    void aSceneThatIsLeftDoesNotStart() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:double-slit"));
        QVERIFY(window.open("preset:pendulum"));  // while the first is tried
        QVERIFY(waitForResults(window));
        QVERIFY(!noticeOf(window, "offer"));
        QCOMPARE(window.runControl().results()->scene.model.type, std::string("pendulum"));
    }

    void oneTextAtATimeInTheStatusLine() {
        MainWindow window(Theme::light(), false);
        window.resize(1400, 900);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        auto* const status = window.findChild<QLabel*>("status");
        QVERIFY(status && status->isVisible());
        window.statusBar()->showMessage("a message");
        QVERIFY(!status->isVisible());
        for (const double scale : {1.0, 1.3, 1.0}) {  // another height lays the bar out again
            Theme theme = scale == 1.0 ? Theme::dark() : Theme::light();
            theme.fontScale = scale;
            window.setTheme(theme);
            QTRY_VERIFY_WITH_TIMEOUT(!window.themeSwitch().isRunning(), 60000);
            QCoreApplication::sendPostedEvents();
            QCoreApplication::processEvents();
            QCOMPARE(window.statusBar()->currentMessage(), QString("a message"));
            QVERIFY(!status->isVisible());
        }
        window.statusBar()->clearMessage();
        QVERIFY(status->isVisible());
        applyTheme(*qApp, Theme::light());
    }
};

EXTREMAL_TEST(WindowHabitsTest)

}  // namespace extremal::window_habits_test

#include "window_habits_test.moc"
