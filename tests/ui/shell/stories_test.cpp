// SPDX-License-Identifier: GPL-3.0-or-later
/// Four people use the window from its start to what they came for, each with pictures in order
/// (tests/output/stories): what they click and press is counted.
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QDir>
#include <QFile>
#include <QLineEdit>
#include <QListWidget>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QTest>

#include <cmath>
#include <functional>

#include "engine/model/parts/constraint.hpp"
#include "engine/model/parts/force.hpp"
#include "engine/model/parts/wall.hpp"
#include "engine/scene/resolve.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/enter.hpp"
#include "tests/ui/window.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/lesson_bar.hpp"
#include "ui/shell/record_bar.hpp"
#include "ui/shell/start_page.hpp"
#include "ui/sketch/mechanism_sketch.hpp"
#include "ui/sketch/sketch_canvas.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/windows/figure_sheet.hpp"
#include "ui/windows/palette_dialog.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::stories_test {

class StoriesTest : public QObject {
    Q_OBJECT

    std::unique_ptr<MainWindow> window_;
    QString story_;
    int pictures_ = 0, acts_ = 0;  ///< clicks and keys

    void begin(const QString& story) {
        story_ = story;
        pictures_ = acts_ = 0;
        window_ = std::make_unique<MainWindow>(Theme::light(), false);
        window_->resize(1600, 1000);
        window_->show();
        QTRY_VERIFY(!window_->findChild<StartPage*>()->shownPresets().isEmpty());
        picture("start");
    }
    void picture(const char* what, QWidget* of = nullptr) {
        const QString folder = QStringLiteral(EXTREMAL_TEST_OUTPUT "/stories");
        QDir().mkpath(folder);
        for (int i = 0; i < 20; ++i) QCoreApplication::processEvents();
        (of ? of : window_.get())
            ->grab()
            .save(QString("%1/%2-%3-%4.png").arg(folder, story_).arg(++pictures_).arg(what));
    }
    /// A key of the window, by the action that it belongs to.
    void press(const char* action) {
        ++acts_;
        QVERIFY2(window_->actions().find(action)->isEnabled(), action);
        window_->actions().find(action)->trigger();
    }
    void click(QWidget* widget) {
        QVERIFY(widget && widget->isVisible() && widget->isEnabled());
        ++acts_;
        QTest::mouseClick(widget, Qt::LeftButton);
    }
    template <class Control>
    Control* named(const QString& name) {
        for (Control* each : window_->findChildren<Control*>())
            if (each->accessibleName() == name && each->isVisible()) return each;
        return nullptr;
    }
    /// What a box of choices offers under this name.
    void choose(const QString& box, const QString& text) {
        auto* const found = named<QComboBox>(box);
        QVERIFY2(found && found->findText(text) >= 0, qPrintable(box + ": " + text));
        ++acts_;
        found->setCurrentIndex(found->findText(text));
        emit found->activated(found->currentIndex());
    }
    LessonBar& lesson() { return *window_->findChild<LessonBar*>("lesson"); }
    /// Types into the palette and takes what is found first.
    void find(const QString& words) {
        press("palette");
        auto* const input = window_->findChild<PaletteDialog*>()->findChild<QLineEdit*>();
        QTest::keyClicks(input, words);
        ++acts_;
        QTest::keyClick(input, Qt::Key_Return);
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void cleanup() { window_.reset(); }

    /// Why does RK4 lose energy? Found in two clicks, understood in the steps of the lesson.
    void student() {
        begin("student");
        click(window_->findChild<QPushButton*>("firstLesson"));
        QVERIFY(acts_ <= 2);
        QVERIFY(waitForResults(*window_));
        QVERIFY(lesson().isRunning());
        QVERIFY(lesson().steps().size() <= 6);
        while (lesson().isRunning()) {
            if (!lesson().steps()[static_cast<std::size_t>(lesson().at())].set.empty()) press("lessonDo");
            QVERIFY(waitForResults(*window_));
            picture("step");
            press("lessonNext");
        }
    }

    /// An own Lagrangian, three steps of a lesson, presented, and shared as text.
    void teacher() {
        begin("teacher");
        press("newLagrangian");
        auto* const formula = window_->findChild<QPlainTextEdit*>("field.lagrangian");
        QVERIFY(formula && formula->hasFocus());
        QTest::keyClicks(formula, "m/2*x_t^2 - k/2*x^2 - b/4*x^4");
        window_->compareView().stage()->setFocus();
        QVERIFY(waitForResults(*window_));
        picture("typed");
        press("recordLesson");
        auto* const told = window_->findChild<QLineEdit*>("stepText");
        for (const char* text :
             {"A spring that stiffens.", "Look at the energy.", "Every scheme has its error."}) {
            QTest::keyClicks(told, text);
            press("recordStep");
        }
        picture("recorded");
        window_->record().finish();
        press("present");
        QVERIFY(waitForResults(*window_));
        QCOMPARE(lesson().steps().size(), std::size_t{3});
        for (int i = 0; i < 3; ++i) {
            picture("presented");
            press("stepForward");
        }
        press("stop");
        press("copyScene");
        QVERIFY(QApplication::clipboard()->text().contains("A spring that stiffens."));
        picture("shared");
    }

    /// The cheapest for 1e-8 over fifty starts, and a figure with panels for a paper of two columns.
    void researcher() {
        begin("researcher");
        find("open preset: kepler");
        QVERIFY(waitForResults(*window_));
        picture("kepler");
        press("studies");
        choose("Study", "The cheapest scheme");
        enter(window_->findChild<QLineEdit*>("overCases"), "/initial/q/0=0.35:0.45:50");
        enter(window_->findChild<QLineEdit*>("wantedError"), "1e-8");
        press("runStudy");
        auto* const table = named<QTableWidget>("Results of the study");
        QVERIFY(table);
        auto* const run = window_->findChild<QPushButton*>("runStudy");
        QTRY_VERIFY_WITH_TIMEOUT(table->rowCount() > 0 && run->text() == "Run the study", 120000);
        picture("cheapest-over-50-starts");
        press("compare");
        press("figureSheet");
        auto* const sheet = window_->findChild<FigureSheet*>();
        PaperStyle style = sheet->style();
        style.width = 178;
        sheet->setStyle(style);
        QTRY_COMPARE(sheet->style().width, 178.0);
        QTRY_VERIFY(!sheet->preview().isNull());
        picture("sheet", sheet);
        const QImage seenByAll = sheet->preview();
        sheet->setSight(Sight::withoutGreen);
        QTRY_VERIFY(sheet->preview() != seenByAll);
        picture("sheet-seen-without-green", sheet);
        sheet->save(QStringLiteral(EXTREMAL_TEST_OUTPUT "/stories/paper.pdf"));
        QVERIFY(QFile::exists(QStringLiteral(EXTREMAL_TEST_OUTPUT "/stories/paper.csv")));
        sheet->close();
    }

    /// Two bodies, a stiff spring, a damper and a wall, drawn: how large may h be for the angle to 1e-3?
    void engineer() {
        begin("engineer");
        press("drawMechanism");
        SketchCanvas& sheet = window_->findChild<MechanismSketch*>()->canvas();
        const auto tool = [&](Qt::Key key) {
            ++acts_;
            QTest::keyClick(&sheet, key);
        };
        const auto drag = [&](double x, double y, double toX, double toY) {
            const auto at = [&](double along, double up) {
                const Point p = sheet.camera().project({along, up, 0});
                return QPoint(qRound(sheet.width() / 2.0 + p[0]), qRound(sheet.height() / 2.0 - p[1]));
            };
            ++acts_;
            QTest::mousePress(&sheet, Qt::LeftButton, {}, at(x, y));
            QTest::mouseMove(&sheet, at((x + toX) / 2, (y + toY) / 2));
            QTest::mouseMove(&sheet, at(toX, toY));
            QTest::mouseRelease(&sheet, Qt::LeftButton, {}, at(toX, toY));
        };
        tool(Qt::Key_F);
        drag(0, 1, 0, 1);
        tool(Qt::Key_B);
        drag(0, 1, 0.8, 0.2);
        tool(Qt::Key_P);
        drag(1.6, -0.2, 1.6, -0.2);
        tool(Qt::Key_S);
        drag(0.8, 0.2, 1.6, -0.2);
        picture("a-spring");
        auto* const stiffness = window_->findChild<QWidget*>("value.stiffness");
        QVERIFY(stiffness);
        enter(stiffness->findChild<QLineEdit*>(), "300");
        tool(Qt::Key_D);
        drag(0.8, 0.2, 1.6, -0.2);
        tool(Qt::Key_W);
        drag(-1, -0.5, 2, -0.5);
        QVERIFY(waitForResults(*window_));
        const System& drawn = *window_->workspace().resolved()->system;
        QVERIFY(drawn.parts.find<Constraint>() && drawn.parts.find<Force>() && drawn.parts.find<Wall>());
        picture("drawn");
        enter(window_->findChild<QLineEdit*>("field.end"), "2");
        tool(Qt::Key_Escape);
        tool(Qt::Key_Escape);
        auto* const errors = window_->findChild<QPushButton*>("useChoice");
        QTRY_VERIFY(errors->isVisible());
        picture("no-errors");
        click(errors);
        QTRY_VERIFY(window_->workspace().scene().reference.kind == ReferenceSpec::Kind::automatic);
        QVERIFY(waitForResults(*window_));
        picture("errors");
        QVERIFY(std::isfinite(window_->runControl().results()->schemes.front()->summary.maxError));
        press("studies");
        choose("Study", "How large may h be?");
        choose("Metric", "error.phi_body1");
        enter(window_->findChild<QLineEdit*>("wantedError"), "1e-3");
        press("runStudy");
        auto* const table = named<QTableWidget>("Results of the study");
        QVERIFY(table);
        QTRY_VERIFY_WITH_TIMEOUT(table->rowCount() > 0, 60000);
        picture("steps-for-the-angle");
        qInfo("%d clicks, drags and keys", acts_);
    }
};

EXTREMAL_TEST(StoriesTest)

}  // namespace extremal::stories_test

#include "stories_test.moc"
