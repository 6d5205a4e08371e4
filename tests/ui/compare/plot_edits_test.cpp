// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a plot and its curve, kept in the scene by the menu of its card.
#include <QDialog>
#include <QDialogButtonBox>
#include <QLabel>
#include <QLineEdit>
#include <QInputDialog>
#include <QMenu>
#include <QPushButton>
#include <QTest>
#include <QTimer>
#include <QWheelEvent>

#include <algorithm>

#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/card.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/compare/plot_edits.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::plot_edits_test {

class PlotEditsTest : public QObject {
    Q_OBJECT

    static PlotWidget* plot(MainWindow& window, std::size_t i) { return window.compareView().plots().at(i); }
    /// Whether the plot has been drawn with all its data along x.
    static bool showsAll(MainWindow& window, std::size_t i) {
        const auto range = plot(window, i)->figure().x.range;
        return range && !plot(window, i)->figure().series().empty() &&
               plot(window, i)->visibleRange(PlotAxis::x) == PlotRange{range->first, range->second};
    }
    /// Chooses an entry of the menu of a plot's card as a click does.
    static bool choose(MainWindow& window, std::size_t i, const QString& text) {
        QWidget* parent = plot(window, i)->parentWidget();
        while (parent && !qobject_cast<Card*>(parent)) parent = parent->parentWidget();
        QMenu* menu = qobject_cast<Card*>(parent)->menu();
        emit menu->aboutToShow();
        for (QAction* action : menu->actions())
            if (action->text() == text && action->isVisible() && action->isEnabled())
                return action->trigger(), true;
        return false;
    }

    static QAction* entryOf(MainWindow& window, std::size_t i, const QString& submenu, const QString& text) {
        QWidget* parent = plot(window, i)->parentWidget();
        while (parent && !qobject_cast<Card*>(parent)) parent = parent->parentWidget();
        for (QAction* action : qobject_cast<Card*>(parent)->menu()->actions())
            if (action->menu() && action->text() == submenu) {
                emit action->menu()->aboutToShow();
                for (QAction* entry : action->menu()->actions())
                    if (entry->text() == text) return entry;
            }
        return nullptr;
    }
    static bool chooseIn(MainWindow& window, std::size_t i, const QString& submenu, const QString& text) {
        QAction* entry = entryOf(window, i, submenu, text);
        if (entry) entry->trigger();
        return entry;
    }
    static bool isChosen(MainWindow& window, std::size_t i, const QString& submenu, const QString& text) {
        const QAction* entry = entryOf(window, i, submenu, text);
        return entry && entry->isChecked();
    }

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void rangesAreSavedWithTheDigitsThatShow() {
        const auto text = [](PlotRange r, bool isLog) {
            const ViewRange v = roundedRange(r, isLog);
            return std::pair{v.low.value, v.high.value};
        };
        QCOMPARE(text({1.00000001234, 1.25132741228718}, false), (std::pair{1.0, 1.25133}));
        QCOMPARE(text({-123456.7, 654321.9}, false), (std::pair{-123460.0, 654320.0}));
        QCOMPARE(text({1.23456e-9, 0.0314159}, true), (std::pair{1.235e-9, 0.03142}));
    }
    void aViewOfSeveralPlotsIsSplit() {
        const Scene scene =
            readScene(findPreset("spring-pendulum")->json).scene;  // "trajectory": a and theta
        const View before{"trajectory", "t", "q.theta"};
        View after = before;
        after.xRange = ViewRange{{1, {}}, {2, {}}};
        const auto edits = editsForPlot(scene, before, after);
        const Value& views = *edits.at(0).value;
        QCOMPARE(views.asArray().size(), scene.views.size() + 1);
        QCOMPARE(views.asArray()[3].find("y")->asString(), std::string("q.a"));
        QVERIFY(!views.asArray()[3].find("range") && views.asArray()[4].find("range"));
    }
    void whatIsShownIsKeptAndForgotten() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:pendulum");
        QVERIFY(waitForResults(window));
        QTRY_VERIFY(showsAll(window, 1));
        const PlotRange all = plot(window, 1)->visibleRange(PlotAxis::x);
        QVERIFY(!choose(window, 1, "Store this range in the scene"));  // nothing to keep
        plot(window, 1)->setTimeRange(PlotRange{1, 2});
        QVERIFY(choose(window, 1, "Store this range in the scene"));
        const auto part = [&] {
            for (const View& v : window.workspace().scene().views)
                if (v.xRange) return std::optional(*v.xRange);
            return std::optional<ViewRange>();
        };
        QVERIFY(part());
        QCOMPARE((std::pair{part()->low.value, part()->high.value}), (std::pair{1.0, 2.0}));
        QVERIFY(waitForResults(window));
        QVERIFY(std::none_of(window.workspace().scene().views.begin(), window.workspace().scene().views.end(),
                             [](const View& v) { return v.yRange.has_value(); }));
        QWidget* canvas = plot(window, 1)->childAt(plot(window, 1)->rect().center());
        const QPointF middle = canvas->rect().center();
        QWheelEvent wheel(middle, canvas->mapToGlobal(middle), {}, {0, 120}, Qt::NoButton, Qt::NoModifier,
                          Qt::NoScrollPhase, false);
        QApplication::sendEvent(canvas, &wheel);
        QVERIFY(choose(window, 1, "Store this range in the scene"));
        QVERIFY(part()->low.value > 1 && part()->high.value < 2);
        window.workspace().undo();
        QVERIFY(waitForResults(window));
        plot(window, 1)->fit();  // to the part, not to all
        QTRY_COMPARE(plot(window, 1)->visibleRange(PlotAxis::x).high, 2.0);
        QVERIFY(choose(window, 1, "Show all data"));
        QCOMPARE(plot(window, 1)->visibleRange(PlotAxis::x).high, all.high);
        QVERIFY(part());
        QVERIFY(choose(window, 1, "Remove the range from the scene"));
        QVERIFY(!part());
        QVERIFY(waitForResults(window));
        QTRY_VERIFY(!plot(window, 1)->isUserZoomed() && plot(window, 1)->visibleRange(PlotAxis::x) == all);
    }
    void whatAPlotShowsIsChosenInItsMenu() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:pendulum");
        QVERIFY(waitForResults(window));
        QCOMPARE(plot(window, 1)->figure().view, std::string("energy"));
        QVERIFY(plot(window, 1)->figure().x.isTime);
        QTRY_VERIFY(showsAll(window, 1));
        plot(window, 1)->setTimeRange(PlotRange{1, 2});
        QVERIFY(choose(window, 1, "Store this range in the scene"));
        const auto energyView = [&] {
            const auto& views = window.workspace().scene().views;
            return *std::find_if(views.begin(), views.end(), [](const View& v) { return v.id == "energy"; });
        };
        QVERIFY(energyView().xRange);
        QVERIFY(waitForResults(window));
        QVERIFY(chooseIn(window, 1, "Against", "steps"));
        QTRY_COMPARE(energyView().keys.text("against"), std::string("steps"));
        QVERIFY(!energyView().xRange);  // a part of time is not a part of the steps
        QVERIFY(!window.workspace().hasDrafts());
        QVERIFY(waitForResults(window));
        QTRY_VERIFY(plot(window, 1)->figure().x.isLog && !plot(window, 1)->figure().x.isTime);
        QVERIFY(plot(window, 1)->visibleRange(PlotAxis::x).low > 0);
        QVERIFY(isChosen(window, 1, "Against", "steps") && !isChosen(window, 1, "Against", "time"));
        QVERIFY(chooseIn(window, 1, "Against", "time"));
        QTRY_VERIFY(energyView().keys.keys.empty());
        QTRY_VERIFY(plot(window, 1)->figure().x.isTime);
        window.workspace().undo();
        QCOMPARE(energyView().keys.text("against"), std::string("steps"));
    }
    void columnsAreChosenInTheMenu() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:henon-heiles");
        QVERIFY(window.workspace().edit(
            {{"/views", Value::Array{"phase", "energy", Value::Object{{"view", "section"}}}}}, "views"));
        QVERIFY(waitForResults(window));
        const auto phase = [&] { return window.workspace().scene().views.at(0); };
        // The cost has no columns, and the energy none either.
        for (const std::size_t i : {0, 2}) QVERIFY(!entryOf(window, i, "Along x", "default"));
        QVERIFY(isChosen(window, 1, "Along y", "default"));
        QVERIFY(entryOf(window, 1, "Along y", "energy_error"));  // of what is observed
        QVERIFY(chooseIn(window, 1, "Along y", "p.y"));
        QTRY_COMPARE(phase().y, std::string("p.y"));
        QVERIFY(phase().x.empty());
        QVERIFY(waitForResults(window));
        QTRY_VERIFY(plot(window, 1)->figure().y.title.find("y") != std::string::npos);
        QVERIFY(isChosen(window, 1, "Along y", "p.y") && !isChosen(window, 1, "Along y", "default"));
        QVERIFY(chooseIn(window, 1, "Along x", "t"));
        QTRY_COMPARE(phase().x, std::string("t"));
        QVERIFY(chooseIn(window, 1, "Along x", "default"));
        QTRY_VERIFY(phase().x.empty());
        QCOMPARE(phase().y, std::string("p.y"));
        // A section is of state columns, and where one of them is zero.
        QVERIFY(!entryOf(window, 3, "Along x", "energy_error") && !entryOf(window, 3, "Section at", "t"));
        QVERIFY(chooseIn(window, 3, "Section at", "p.x"));
        QTRY_COMPARE(window.workspace().scene().views.at(2).at, std::string("p.x"));
        QVERIFY(!window.workspace().hasDrafts());
        window.workspace().undo();
        QVERIFY(window.workspace().scene().views.at(2).at.empty());
    }
    void theSchemeOfAPictureIsChosenInTheMenu() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:double-slit");
        QVERIFY(window.workspace().edit({{"/model/modes", 16.0},
                                         {"/model/modes_y", 16.0},
                                         {"/time/end", 0.1},
                                         {"/reference", Value::Object{{"type", "none"}}}},
                                        "small"));
        QVERIFY(waitForResults(window));
        QCOMPARE(plot(window, 1)->figure().title, std::string("Profile of SRKN 14a"));
        QVERIFY(isChosen(window, 1, "Scheme", "the first"));
        QVERIFY(chooseIn(window, 1, "Scheme", "Strang"));
        QVERIFY(waitForResults(window));
        QTRY_COMPARE(plot(window, 1)->figure().title, std::string("Profile of Strang"));
        QVERIFY(chooseIn(window, 2, "Scheme", "Gauss 4"));
        QVERIFY(waitForResults(window));
        QTRY_COMPARE(plot(window, 2)->figure().title, std::string("Carpet of Gauss 4"));
        QVERIFY(!window.workspace().hasDrafts());
    }
    void theNodeOfAShapeFunctionIsAskedFor() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:seed-elliptic");
        QVERIFY(waitForResults(window));
        const auto& views = window.workspace().scene().views;
        const auto at = [&] {
            return std::find_if(views.begin(), views.end(),
                                [](const View& v) { return v.id == "shape-function"; });
        };
        QVERIFY(at() != views.end());
        std::size_t slot = 0;
        while (plot(window, slot)->figure().view != "shape-function") ++slot;
        QTimer::singleShot(0, [&] {
            auto* dialog = qobject_cast<QInputDialog*>(QApplication::activeModalWidget());
            QCOMPARE(dialog->intMinimum(), 1);
            dialog->setIntValue(2);
            dialog->accept();
        });
        QVERIFY(choose(window, slot, "Node..."));
        QVERIFY(at()->node && at()->node->value == 2);
        QVERIFY(!window.workspace().hasDrafts());
    }
    void aCurveIsAskedForAndItsMistakesAreShown() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:pendulum");
        QVERIFY(waitForResults(window));
        QString shown;
        QTimer::singleShot(0, [&] {
            auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget());
            auto* input = dialog->findChild<QLineEdit*>();
            QPushButton* ok = dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok);
            input->setText("cos(t");
            ok->click();
            for (const QLabel* label : dialog->findChildren<QLabel*>()) shown += label->text();
            input->setText("1e-3*sqrt(g/l)*t");
            ok->click();
        });
        QVERIFY(choose(window, 1, "Compare with a curve..."));
        QVERIFY2(shown.contains("a bracket that is not closed"), qPrintable(shown));
        QVERIFY(!window.workspace().hasDrafts());
        QVERIFY(waitForResults(window));
        const auto curve = [&] { return plot(window, 1)->figure().series().back(); };
        QTRY_COMPARE(curve().style, formulaStyle);
        QCOMPARE(curve().label, std::string("1e-3*sqrt(g/l)*t"));
    }
};

EXTREMAL_TEST(PlotEditsTest)
}  // namespace extremal::plot_edits_test

#include "plot_edits_test.moc"
