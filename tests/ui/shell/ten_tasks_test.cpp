// SPDX-License-Identifier: GPL-3.0-or-later
/// The ten tasks that the window is judged by, each done with a mouse and keys as a user does it, and
/// counted: three clicks or keys at most, words and numbers that are typed aside.
#include <QDir>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTest>
#include <QWheelEvent>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/panels/values_table.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/gallery.hpp"
#include "ui/shell/start_page.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/windows/figure_sheet.hpp"
#include "ui/windows/folder_dialog.hpp"
#include "ui/windows/help_window.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::ten_tasks_test {

class TenTasksTest : public QObject {
    Q_OBJECT

    static constexpr int most = 3;
    KeyGuard guard_;  // as in the program
    std::unique_ptr<MainWindow> window_;
    int acts_ = 0;

    void click(QWidget* widget, QPoint at = {}) {
        QVERIFY(widget && widget->isVisible() && widget->isEnabled());
        ++acts_;
        QTest::mouseClick(widget, Qt::LeftButton, {}, at.isNull() ? widget->rect().center() : at);
    }
    /// The key of an action.
    void press(const char* action) {
        QAction* const a = window_->actions().find(action);
        QVERIFY2(a && a->isEnabled() && !a->shortcut().isEmpty(), action);
        ++acts_;
        a->trigger();
    }
    void key(QWidget* widget, Qt::Key key) {
        ++acts_;
        QTest::keyClick(widget, key);
    }
    const Scene& scene() { return window_->workspace().scene(); }

private slots:
    void initTestCase() {
        loadFonts();
        qApp->installEventFilter(&guard_);
        applyTheme(*qApp, Theme::light());
    }
    void init() {
        acts_ = 0;
        window_ = std::make_unique<MainWindow>(Theme::light(), false);
        window_->resize(1600, 1000);
        window_->show();
        if (QString(QTest::currentTestFunction()) == "openAPreset") return;
        QVERIFY(window_->open("preset:pendulum"));
        QVERIFY(waitForResults(*window_));
    }
    void cleanup() {
        qInfo("%d clicks or keys", acts_);
        QVERIFY(acts_ >= 1 && acts_ <= most);
        window_.reset();
    }

    void openAPreset() {
        auto* const page = window_->findChild<StartPage*>();
        QTRY_VERIFY(page->findChild<GalleryCard*>("preset.pendulum"));
        auto* const card = page->findChild<GalleryCard*>("preset.pendulum");
        QTRY_VERIFY(card->visibleRegion().contains(QPoint(20, 80)));  // it has its place
        click(card, {20, 80});
        QTRY_VERIFY(window_->workspace().hasScene());
    }
    void changeAParameter() {
        auto* const length = window_->findChild<QLineEdit*>("field.l");
        click(length);        // which selects what is in it
        length->selectAll();  // a click does that in an active window; without a display there is not one
        QTest::keyClicks(length, "2");
        key(length, Qt::Key_Return);
        QTRY_COMPARE(scene().model.number("l"), 2.0);
    }
    void addAScheme() {
        const std::size_t schemes = scene().schemes.size();
        const QList<DiscretizerCell*> cells = window_->findChildren<DiscretizerCell*>();
        const auto cell = std::find_if(cells.begin(), cells.end(), [](const DiscretizerCell* c) {
            return c->isEnabled() && c->isVisible();
        });
        QVERIFY(cell != cells.end());
        click(*cell);  // after which the grid may have made its cells anew
        QCOMPARE(scene().schemes.size(), schemes + 1);
    }
    void changeAStep() {
        QWidget* const card = window_->findChild<QWidget*>("scheme.0");
        click(card->findChild<QWidget*>("stepLabel"));
        auto* const step = card->findChild<QLineEdit*>("step");
        QVERIFY(step->isVisible());
        step->selectAll();
        QTest::keyClicks(step, "0.125");
        key(step, Qt::Key_Return);
        QCOMPARE(scene().schemes[0].step.value, 0.125);
    }
    void compareTwoEnergiesZoomed() {
        press("nextPlot");
        press("nextPlot");  // behind speed against accuracy
        QWidget* const plot = window_->focusWidget();
        auto* const energy = qobject_cast<PlotWidget*>(plot);
        QVERIFY(energy);
        QCOMPARE(energy->figure().view, std::string("energy"));
        key(plot, Qt::Key_Plus);
        QVERIFY(energy->isUserZoomed());
    }
    void valuesAtATime() {
        press("values");
        QVERIFY(window_->findChild<ValuesTable*>()->isVisible());
    }
    void exportAFigure() {
        QTemporaryDir folder;
        press("figureSheet");
        auto* const sheet = window_->findChild<FigureSheet*>();
        QVERIFY(sheet->isVisible());
        ++acts_;  // Save...
        ++acts_;  // Return in the dialog, which has a name
        sheet->save(folder.filePath("figure.pdf"));
        QVERIFY(QFile::exists(folder.filePath("figure.pdf")) && QFile::exists(folder.filePath("figure.tex")));
    }
    void exportAllWithTheCommand() {
        QTemporaryDir folder;
        press("exportAll");
        auto* const dialog = window_->findChild<FolderDialog*>();
        QVERIFY(dialog && dialog->isVisible());
        auto* const path = dialog->findChild<QLineEdit*>("folder");
        path->setText(folder.filePath("new/all"));  // as if typed; a folder that is not there yet
        key(path, Qt::Key_Return);
        QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(folder.filePath("new/all/command.txt")), 60000);
        QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(folder.filePath("new/all/stage.png")), 60000);
    }
    void typeALagrangian() {
        press("newLagrangian");
        auto* const formula = window_->findChild<QPlainTextEdit*>("field.lagrangian");
        QVERIFY(formula->hasFocus());
        QTest::keyClicks(formula, "m/2*x_t^2 - k/2*x^2");
        window_->compareView().stage()->setFocus();
        QVERIFY(waitForResults(*window_));
        QCOMPARE(scene().schemes.empty(), false);
        QVERIFY(!window_->compareView().plots().empty());
        QCOMPARE(acts_, 1);
    }
    void findHelpOnAWord() {
        press("searchHelp");
        auto* const help = window_->findChild<HelpWindow*>();
        QVERIFY(help && help->isVisible());
        auto* const field = help->findChild<QLineEdit*>("search");
        QTest::keyClicks(field, "symplectic");
        key(field, Qt::Key_Return);
    }
};

EXTREMAL_TEST(TenTasksTest)

}  // namespace extremal::ten_tasks_test

#include "ten_tasks_test.moc"
