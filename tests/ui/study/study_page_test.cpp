// SPDX-License-Identifier: GPL-3.0-or-later
/// The page of studies: points arrive while it runs, it stops at once and keeps them, and a row, a point of
/// the plot or a cell of a map goes into the scene as an edit.
#include <qcustomplot.h>

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QTabBar>
#include <QTest>
#include <QPushButton>
#include <QTableWidget>

#include <cmath>

#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/search/proposal.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/notices.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/study/study_edits.hpp"
#include "ui/study/study_form.hpp"
#include "ui/study/study_page.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::study_page_test {
namespace {

bool waitForStudy(StudyPage& page) {
    return QTest::qWaitFor([&] { return !page.job().isRunning(); }, 60000);
}

template <class Box>
Box* named(QWidget& inside, const QString& name) {
    for (Box* box : inside.findChildren<Box*>())
        if (box->accessibleName() == name) return box;
    return nullptr;
}

void choose(StudyPage& page, const char* study) { page.form().choose(study); }

/// Where a value of the plot stands on its canvas.
QPoint placeOf(PlotWidget& plot, double x, double y) {
    auto* canvas = plot.findChild<QCustomPlot*>();
    canvas->replot();
    return {static_cast<int>(std::lround(canvas->xAxis->coordToPixel(x))),
            static_cast<int>(std::lround(canvas->yAxis->coordToPixel(y)))};
}

void click(PlotWidget& plot, double x, double y) {
    QTest::mouseClick(plot.findChild<QCustomPlot*>(), Qt::LeftButton, {}, placeOf(plot, x, y));
}

/// A short scene, so that studies are soon done.
bool openKepler(MainWindow& window) {
    window.show();
    return window.open("preset:kepler") && window.workspace().edit({{"/time/end", 5.0}}, "Shorter");
}

/// Work and precision of it.
bool runWork(MainWindow& window) {
    choose(window.studies(), "work-precision");
    window.actions().find("runStudy")->trigger();
    return waitForStudy(window.studies()) && window.studies().job().as<Sweep>()->isComplete();
}

bool isAtCompare(MainWindow& window) {
    for (const QTabBar* tabs : window.findChildren<QTabBar*>())
        if (tabs->count() == 3) return tabs->currentIndex() == 0;
    return false;
}

void type(StudyPage& page, const char* field, const char* text) {
    auto* edit = named<QLineEdit>(page, QString::fromLatin1(field));
    edit->setText(QString::fromLatin1(text));
    emit edit->editingFinished();
}

QString stateOf(StudyPage& page) { return page.findChild<QLabel*>(QStringLiteral("studyState"))->text(); }

}  // namespace

class StudyPageTest : public QObject {
    Q_OBJECT
private slots:
    void theCheapestSchemeGoesIntoTheScene() {
        MainWindow window(Theme::light(), false);
        QVERIFY(openKepler(window));
        StudyPage& page = window.studies();
        choose(page, "cheapest");
        window.actions().find("runStudy")->trigger();
        QVERIFY(page.isVisible() && page.job().isRunning());
        QVERIFY(waitForStudy(page));
        const Sweep& sweep = *page.job().as<Sweep>();
        QVERIFY(sweep.isComplete());
        auto* table = named<QTableWidget>(page, QStringLiteral("Results of the study"));
        QVERIFY(table->rowCount() >= 2);
        QVERIFY(!page.findChild<PlotWidget*>()->figure().series().empty());

        table->selectRow(0);
        const QString label = table->item(0, 1)->text();
        const double step = table->item(0, 2)->data(Qt::UserRole).toDouble();
        QVERIFY(step > 0);
        const Scene before = window.workspace().scene();
        page.findChild<QPushButton*>(QStringLiteral("useStudy"))->click();
        const Scene& after = window.workspace().scene();
        const auto used = std::find_if(after.schemes.begin(), after.schemes.end(),
                                       [&](const SchemeSpec& s) { return s.label == label.toStdString(); });
        QVERIFY(used != after.schemes.end());
        QCOMPARE(used->step.value, step);
        QVERIFY(stateOf(page).contains("earlier version"));
        window.workspace().undo();
        QVERIFY(window.workspace().scene() == before);
        QVERIFY(!stateOf(page).contains("earlier version"));
    }
    void aStoppedStudyKeepsItsPoints() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:kepler"));
        StudyPage& page = window.studies();
        choose(page, "work-precision");
        window.actions().find("runStudy")->trigger();
        const auto known = [&] {
            const auto& rows = page.job().as<Sweep>()->rows();
            return std::count_if(rows.begin(), rows.end(),
                                 [](const SweepRow& row) { return row.result.status != RunStatus::waiting; });
        };
        QVERIFY(QTest::qWaitFor([&] { return known() > 0; }, 60000));
        window.actions().find("stop")->trigger();
        QVERIFY(!page.job().isRunning() && page.job().wasStopped());
        QVERIFY(stateOf(page).contains("stopped"));
        const auto kept = known();
        QVERIFY(kept > 0 && kept < static_cast<long>(page.job().as<Sweep>()->rows().size()));
        QTest::qWait(0);
        QCOMPARE(known(), kept);
    }
    void whatIsWrongIsSaid() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:kepler"));
        StudyPage& page = window.studies();
        window.actions().find("studies")->trigger();
        choose(page, "cheapest");
        type(page, "Wanted error", "-1");
        QVERIFY(!window.notices().all().empty());
        QVERIFY(window.notices().all().back().text.contains("must be a number above 0"));
        QCOMPARE(named<QLineEdit>(page, QStringLiteral("Wanted error"))->text(), QStringLiteral("1e-6"));

        choose(page, "stability");
        type(page, "x from", "much");
        window.actions().find("runStudy")->trigger();
        QVERIFY(!page.job().isRunning());
        QVERIFY2(window.notices().all().back().text.contains("POINTER=FROM:TO:N"),
                 qPrintable(window.notices().all().back().text));
    }
    void aPointThatIsClickedIsLoadedIntoCompare() {
        MainWindow window(Theme::light(), false);
        QVERIFY(openKepler(window));
        QVERIFY(runWork(window));
        StudyPage& page = window.studies();
        const Series& series = page.plot().figure().series().front();
        QVERIFY(series.rows.size() == series.x.size() && series.rows.size() > 3);
        // The window's copy knows the size of the motion, where its front ends.
        QVERIFY(std::isfinite(page.job().as<Sweep>()->metricSize()));
        const SweepRow row = page.job().as<Sweep>()->rows()[series.rows[2]];
        const Scene before = window.workspace().scene();
        click(page.plot(), series.x[2], series.y[2]);
        const Scene after = window.workspace().scene();
        QCOMPARE(after.schemes[row.point.scheme].step.value, row.point.step);
        QVERIFY(row.point.step != before.schemes[row.point.scheme].step.value);
        QVERIFY(isAtCompare(window));
        QCOMPARE(window.workspace().selectedScheme(), static_cast<int>(row.point.scheme));
        window.workspace().undo();
        QVERIFY(window.workspace().scene() == before);
    }
    void theWantedErrorIsANumberASliderAndALine() {
        MainWindow window(Theme::light(), false);
        QVERIFY(openKepler(window));
        QVERIFY(runWork(window));
        StudyPage& page = window.studies();
        auto* slider = named<QSlider>(page, QStringLiteral("Wanted error, slider"));
        auto* number = named<QLineEdit>(page, QStringLiteral("Wanted error"));
        auto* table = named<QTableWidget>(page, QStringLiteral("Results of the study"));
        const int figures = page.figuresMade();
        QCOMPARE(*page.plot().level(), 1e-6);

        slider->setValue(-40);
        QCOMPARE(*page.plot().level(), 1e-4);
        QCOMPARE(number->text(), QStringLiteral("1e-4"));
        const Sweep& sweep = *page.job().as<Sweep>();
        const std::vector<Proposal> proposals = proposalsFor(sweep, 1e-4);
        QVERIFY(proposals.size() >= 2);
        QCOMPARE(table->rowCount(), static_cast<int>(proposals.size()));
        QCOMPARE(table->item(0, 0)->text().toStdString(),
                 sweep.scene().scene.schemes[proposals.front().scheme].label);
        QVERIFY(page.findChild<QLabel*>("studyAnswer")->text().contains("predicted"));

        // Dragged by two decades.
        QCustomPlot& canvas = *page.plot().findChild<QCustomPlot*>();
        const PlotRange x = page.plot().visibleRange(PlotAxis::x);
        const double left = x.low * 1.02;
        const QPoint from = placeOf(page.plot(), left, 1e-4), to = placeOf(page.plot(), left, 1e-2);
        QTest::mousePress(&canvas, Qt::LeftButton, {}, from);
        QTest::mouseMove(&canvas, (from + to) / 2);
        QTest::mouseMove(&canvas, to);
        QTest::mouseRelease(&canvas, Qt::LeftButton, {}, to);
        QVERIFY2(std::abs(std::log10(*page.plot().level()) + 2) < 0.1, qPrintable(number->text()));
        QCOMPARE(slider->value(), static_cast<int>(std::lround(10 * std::log10(*page.plot().level()))));
        QVERIFY(!page.plot().isUserZoomed());
        QTest::keyClick(&page.plot(), Qt::Key_Up);
        QVERIFY(*page.plot().level() > 1.2e-2 * 0.9);

        type(page, "Wanted error", "2e-5");
        QCOMPARE(*page.plot().level(), 2e-5);
        // None of this is a new figure.
        QCOMPARE(page.figuresMade(), figures);

        window.actions().find("measureCheapest")->trigger();
        QVERIFY(waitForStudy(page));
        QCOMPARE(page.job().as<Sweep>()->options().wantedError, 2e-5);
        const QString answer = page.findChild<QLabel*>("studyAnswer")->text();
        QVERIFY2(answer.contains("measured") && answer.contains("predicted"), qPrintable(answer));
        window.actions().find("useResult")->trigger();
        QVERIFY(!isAtCompare(window));
        QVERIFY(window.workspace().isDirty());
        window.actions().find("loadResult")->trigger();
        QVERIFY(isAtCompare(window));
    }
    void aMapOfStabilityLoadsItsCells() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:harmonic-oscillator"));
        StudyPage& page = window.studies();
        window.actions().find("studies")->trigger();
        choose(page, "stability");
        auto* y = named<QComboBox>(page, QStringLiteral("Number along y"));
        y->setCurrentIndex(y->findText("k"));
        for (const auto& [field, text] : {std::pair{"x from", "0.2"},
                                          {"x to", "6"},
                                          {"x values", "8"},
                                          {"y from", "0.5"},
                                          {"y to", "2"},
                                          {"y values", "3"}})
            type(page, field, text);
        window.actions().find("runStudy")->trigger();
        QVERIFY(waitForStudy(page));
        const auto& study = *page.job().as<StabilityStudy>();
        QVERIFY(study.isComplete());
        const auto count = [&](StabilityClass kind) {
            return std::count_if(study.rows().begin(), study.rows().end(),
                                 [&](const auto& row) { return row.result.kind == kind; });
        };
        QVERIFY(count(StabilityClass::stable) > 0 && count(StabilityClass::blowUp) > 0);
        const HeatMap& heat = *page.plot().figure().heat();
        QCOMPARE(heat.columns * heat.rows, 24);
        // Each scheme has a map, with its limits as a line.
        auto* table = named<QTableWidget>(page, QStringLiteral("Results of the study"));
        const QString first = QString::fromStdString(page.plot().figure().subtitle);
        for (int row = 0; row < table->rowCount(); ++row)
            if (table->item(row, 0)->text() != first) {
                table->selectRow(row);
                break;
            }
        const std::string label = page.plot().figure().subtitle;
        QVERIFY(QString::fromStdString(label) != first);
        QVERIFY(page.plot().figure().find<Guide>());

        const double step = page.plot().figure().heat()->xs[1], k = page.plot().figure().heat()->ys[2];
        click(page.plot(), step, k);
        QVERIFY(isAtCompare(window));
        const Scene& scene = window.workspace().scene();
        const int index = indexOfScheme(scene, label);
        QCOMPARE(scene.schemes[static_cast<std::size_t>(index)].step.value, step);
        QCOMPARE(scene.model.number("k"), k);
    }
    void theTestEquationAndTheExtremesNeedNoOptions() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:harmonic-oscillator"));
        StudyPage& page = window.studies();
        choose(page, "linear-stability");
        window.actions().find("runStudy")->trigger();
        QVERIFY(waitForStudy(page));
        QVERIFY(page.job().as<LinearStudy>()->isComplete());
        QVERIFY(!page.plot().figure().series().empty());
        choose(page, "extremes");
        window.actions().find("runStudy")->trigger();
        QVERIFY(page.job().isRunning() && page.job().as<ExtremesStudy>());
        QVERIFY(QTest::qWaitFor([&] { return countOf(*page.job().study()).known > 0; }, 60000));
        window.actions().find("stop")->trigger();
        QVERIFY(!page.job().isRunning());
    }
    void figuresAreMadeForNewPointsAlone() {
        MainWindow window(Theme::light(), false);
        QVERIFY(openKepler(window));
        QVERIFY(runWork(window));
        StudyPage& page = window.studies();
        const int made = page.figuresMade();
        // At most one for each time that points arrive, and one for the start.
        QVERIFY(made <= static_cast<int>(page.job().as<Sweep>()->size()) + 1);
        emit const_cast<StudyJob&>(page.job()).changed();  // progress without points
        QCOMPARE(page.figuresMade(), made);
    }
    void aPointBecomesEdits() {
        const Scene scene = readScene(findPreset("kepler")->json).scene;
        const std::string label = scene.schemes.front().label;
        const std::vector<Edit> edits = editsForPoint(scene, label, 0.25, 0);
        QCOMPARE(edits.size(), std::size_t(1));
        QCOMPARE(edits.front().pointer, std::string("/schemes/0/step"));
        QVERIFY(editsForPoint(scene, "no such scheme", 0.25, 0).empty());
        Scene off = scene;
        off.schemes.front().isEnabled = false;
        QCOMPARE(editsForPoint(off, label, 0.25, 0).size(), std::size_t(2));
    }
};

EXTREMAL_TEST(StudyPageTest)
}  // namespace extremal::study_page_test

#include "study_page_test.moc"
