// SPDX-License-Identifier: GPL-3.0-or-later
/// Edits leave alone what they do not concern: results and their costs, colours, zooms, open editors.
/// Counted, not timed.
#include <qcustomplot.h>

#include <QLineEdit>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <map>
#include <set>

#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/view/catalog.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/background.hpp"
#include "ui/base/card.hpp"
#include "ui/compare/plot_edits.hpp"
#include "ui/panels/discretizer.hpp"
#include "ui/panels/scheme_card.hpp"
#include "ui/panels/scheme_editor.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::keeping_test {
namespace {

using Results = std::map<std::string, std::shared_ptr<const SchemeResult>>;

Results resultsOf(MainWindow& window) {
    Results all;
    for (const auto& result : window.runControl().results()->schemes) all[result->spec.label] = result;
    return all;
}

std::map<std::string, int> coloursOf(MainWindow& window) {
    std::map<std::string, int> all;
    const auto& schemes = window.workspace().scene().schemes;
    for (std::size_t i = 0; i < schemes.size(); ++i) all[schemes[i].label] = styleOf(schemes[i], i);
    return all;
}

/// How often plots are drawn.
class DrawingCount : public QObject {
public:
    explicit DrawingCount(MainWindow& window) {
        for (PlotWidget* plot : window.compareView().plots())
            connect(plot->findChild<QCustomPlot*>(), &QCustomPlot::afterReplot, this, [this] { ++count; });
    }
    int count = 0;
};

void settle() {
    for (int i = 0; i < 20; ++i) QCoreApplication::processEvents();
}

}  // namespace

class KeepingTest : public QObject {
    Q_OBJECT

    struct Window : MainWindow {
        explicit Window(const QString& scene = "preset:pendulum") : MainWindow(Theme::light(), false) {
            resize(1600, 1000);
            show();
            open(scene);
            QVERIFY(waitForResults(*this));
            settle();
        }
        void edit(const std::string& pointer, const Value& value) {
            QVERIFY(workspace().edit({{pointer, value}}, "edit"));
        }
        SchemeCard* card(int index) { return findChild<SchemeCard*>(QString("scheme.%1").arg(index)); }
    };

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void switchingASchemeOffAndOnComputesNothing() {
        Window window;
        const Results before = resultsOf(window);
        const std::string label = window.workspace().scene().schemes[1].label;
        QSignalSpy states(&window.runControl(), &RunControl::stateChanged);
        window.actions().find("toggle2")->trigger();
        Results without = before;
        without.erase(label);
        QVERIFY(resultsOf(window) == without);  // at once, and the very same results
        window.actions().find("toggle2")->trigger();
        QVERIFY(resultsOf(window) == before);
        QVERIFY(states.isEmpty());  // no run
    }
    void renamingComputesNothing() {
        Window window;
        const Results before = resultsOf(window);
        const std::string label = window.workspace().scene().schemes[0].label;
        const double cost = before.at(label)->summary.cpuSeconds;
        window.edit("/schemes/0/label", "another name");
        const Results after = resultsOf(window);
        QCOMPARE(after.at("another name")->summary.cpuSeconds, cost);
        for (const auto& [name, result] : before)
            if (name != label) QCOMPARE(after.at(name), result);
        QVERIFY(!window.runControl().isStale());
    }
    void anEditOfOneSchemeComputesThatOne() {
        Window window;
        const Results before = resultsOf(window);
        const SchemeSpec edited = window.workspace().scene().schemes[1];
        window.edit("/schemes/1/step", edited.step.value / 2);
        QVERIFY(waitForResults(window));
        const Results after = resultsOf(window);
        for (const auto& [name, result] : before) {
            if (name != edited.label)
                QCOMPARE(after.at(name), result);
            else
                QVERIFY(after.at(name)->summary.steps > result->summary.steps);
        }
        window.workspace().undo();  // and back, from what is known
        QVERIFY(resultsOf(window) == before);
    }
    void aPlotMoreComputesNothingAndMakesOneFigure() {
        Window window;
        const Results before = resultsOf(window);
        const long long figures = window.compareView().figuresMade();
        const std::size_t plots = window.compareView().plots().size();
        const auto show = [&](bool isShown) {
            return window.workspace().edit(editsForView(window.workspace().scene(), "phase", isShown),
                                           "plot") &&
                   waitForResults(window);
        };
        QVERIFY(show(false));
        QCOMPARE(window.compareView().plots().size(), plots - 1);
        QVERIFY(resultsOf(window) == before);
        QCOMPARE(window.compareView().figuresMade(), figures);
        QVERIFY(show(true));
        QCOMPARE(window.compareView().plots().size(), plots);
        QVERIFY(resultsOf(window) == before);
        QCOMPARE(window.compareView().figuresMade(), figures + 1);
    }
    void computingAgainComputesEverything() {
        Window window;
        const Results before = resultsOf(window);
        window.actions().find("restart")->trigger();
        QVERIFY(waitForResults(window));
        for (const auto& [name, result] : resultsOf(window)) QVERIFY(before.at(name) != result);
    }
    void figuresAreMadeOnceAndPlotsDrawnWhereSomethingChanged() {
        Window window("preset:spring-pendulum");
        const long long plots = static_cast<long long>(window.compareView().plots().size());
        long long made = window.compareView().figuresMade();
        const auto madeSince = [&] {
            const long long before = std::exchange(made, window.compareView().figuresMade());
            return made - before;
        };
        DrawingCount drawings(window);
        const auto drawnSince = [&] { return std::exchange(drawings.count, 0); };

        window.actions().find("toggle2")->trigger();
        QVERIFY(waitForResults(window));
        settle();
        QCOMPARE(madeSince(), plots);
        QVERIFY2(drawnSince() <= 2 * plots, "a second time where margins are aligned");

        window.workspace().selectScheme(3);
        settle();
        QCOMPARE(madeSince(), 0);
        QVERIFY(drawnSince() <= plots);

        window.workspace().selectScheme(3);
        window.playback().setTime(window.playback().start() + 0.5);
        settle();
        QCOMPARE(drawnSince(), 0);  // the cursor is a layer of its own
    }
    void eachSchemeKeepsItsColour() {
        Window window;
        std::map<std::string, int> colours = coloursOf(window);
        const auto& scene = [&]() -> const Scene& { return window.workspace().scene(); };
        const auto areKept = [&] {
            const auto now = coloursOf(window);
            for (const auto& [label, colour] : colours)
                if (now.count(label) && now.at(label) != colour) return false;
            return true;
        };
        const std::string first = scene().schemes[0].label;
        window.workspace().selectScheme(0);
        window.actions().find("duplicate")->trigger();
        QVERIFY(areKept());
        const int own = styleOf(scene().schemes[1], 1);
        for (const auto& [label, colour] : colours) QVERIFY2(colour != own, label.c_str());
        colours = coloursOf(window);

        window.workspace().selectScheme(1);
        window.actions().find("down")->trigger();
        QVERIFY(areKept());
        window.workspace().selectScheme(0);
        window.actions().find("remove")->trigger();
        QVERIFY(areKept());
        QCOMPARE(coloursOf(window).size(), colours.size() - 1);
        QVERIFY(waitForResults(window));
        for (const auto& result : window.runControl().results()->schemes)
            QCOMPARE(result->style, colours.at(result->spec.label));
        for (const PlotWidget* plot : window.compareView().plots())
            for (const Series& series : plot->figure().series())
                if (series.style >= 0) QCOMPARE(series.style, colours.at(series.label));

        // The colour that is free is the next one's.
        QVERIFY(window.workspace().edit(editsForAdding(scene(), newBaseline(scene(), "rk4")), "add"));
        QVERIFY(areKept());
        QCOMPARE(styleOf(scene().schemes.back(), scene().schemes.size() - 1), colours.at(first));

        QTemporaryDir folder;
        const auto saved = coloursOf(window);
        QVERIFY(window.workspace().saveAs(folder.filePath("a.json")));
        const std::string bytes = writeScene(scene());
        QVERIFY(window.open(folder.filePath("a.json")));
        QVERIFY(coloursOf(window) == saved);
        QCOMPARE(writeScene(scene()), bytes);
    }
    void anOpenEditorStaysWithItsScheme() {
        Window window;
        window.workspace().selectScheme(1);
        const std::string label = window.workspace().scene().schemes[1].label;
        window.actions().find("editScheme")->trigger();
        SchemeCard* card = window.card(1);
        QVERIFY(card && card->isEditing());
        window.actions().find("up")->trigger();
        QCOMPARE(window.workspace().scene().schemes[0].label, label);
        QCOMPARE(window.card(0), card);
        QVERIFY(card->isEditing() && !window.card(1)->isEditing());
        // What is edited there is this scheme.
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        auto* step = card->findChild<QLineEdit*>("field.step");
        QVERIFY(step);
        step->setFocus();
        step->selectAll();
        QTest::keyClicks(step, "0.0123");
        QTest::keyClick(step, Qt::Key_Return);
        QCOMPARE(window.workspace().scene().schemes[0].step.value, 0.0123);
        window.workspace().selectScheme(1);
        window.actions().find("remove")->trigger();
        QVERIFY(window.card(0) == card && card->isEditing());
    }
    void aZoomOutlivesOtherPlots() {
        Window window;
        PlotWidget* plot = window.compareView().plots().at(1);
        QVERIFY(plot->figure().x.isTime);
        plot->setTimeRange(PlotRange{1, 2});
        emit plot->timeRangeChanged(PlotRange{1, 2});
        QVERIFY(window.workspace().edit(editsForView(window.workspace().scene(), "phase", false), "plot"));
        QVERIFY(window.workspace().edit(editsForView(window.workspace().scene(), "step", true), "plot"));
        QVERIFY(waitForResults(window));
        QCOMPARE(window.compareView().plots().at(1), plot);
        QCOMPARE(plot->visibleRange(PlotAxis::x), (PlotRange{1, 2}));
        // New plots of the time join in.
        for (const PlotWidget* other : window.compareView().plots())
            if (other->figure().x.isTime) QCOMPARE(other->visibleRange(PlotAxis::x), (PlotRange{1, 2}));
        // Another scene has no zoom.
        window.open("preset:harmonic-oscillator");
        QVERIFY(waitForResults(window));
        for (const PlotWidget* other : window.compareView().plots()) QVERIFY(!other->isUserZoomed());
    }
    /// A field that loses the focus while a slow scene is checked, say.
    void anEditDuringAnotherStays() {
        MainWindow window(Theme::light(), false);
        window.open("preset:double-slit");
        window.runControl().stop();
        Workspace& workspace = window.workspace();
        bool isInner = false, isWithin = false;  // the inner edit, while the outer one is checked
        int otherWork = 0, messages = 0;         // which could remove the field of the outer edit
        QTimer timer;
        connect(&timer, &QTimer::timeout, &window, [&] { otherWork += isInner; });
        timer.start(1);
        runInBackground([&] { sendToWindow([&] { otherWork += isInner, ++messages; }); });
        QTimer::singleShot(0, &window, [&] {
            isWithin = isInner;
            workspace.edit({{"/title", "inner"}}, "title");
        });
        isInner = true;
        QVERIFY(workspace.edit({{"/model/modes", 512}}, "modes"));  // checked for about a second
        isInner = false;
        QVERIFY(isWithin);
        QCOMPARE(otherWork, 0);
        QTRY_COMPARE(messages, 1);
        QCOMPARE(workspace.scene().model.number("modes"), 512.0);
        QCOMPARE(QString::fromStdString(workspace.scene().title), "inner");
        window.runControl().stop();
    }
    void theDiscretizerMarksWhatIsOn() {
        Window window;  // Gauss and Lobatto of degree 2 are in the scene
        using Use = DiscretizerCell::Use;
        const auto use = [&](int degree, const char* rule) {
            QCoreApplication::processEvents();  // the marks follow in the next turn
            return window.discretizer().cell(degree, rule)->use();
        };
        QCOMPARE(use(2, "gauss"), Use::on);
        QCOMPARE(use(2, "lobatto"), Use::on);
        QCOMPARE(use(3, "gauss"), Use::none);
        window.actions().find("toggle1")->trigger();
        QCOMPARE(use(2, "gauss"), Use::off);
        window.edit("/schemes/1/composition", Value(Value::Object{{"type", "yoshida"}}));
        QCOMPARE(use(2, "lobatto"), Use::none);  // a composition of it is another scheme
    }
    void onlyPlotsThatTheSystemCanHaveAreOffered() {
        std::set<std::string> models;
        for (const Preset& preset : presets()) {
            const Scene scene = readScene(preset.json).scene;
            if (!models.insert(scene.model.type).second) continue;
            for (const ViewEntry* entry : offeredPlots(scene)) {
                const ReadScene read =
                    readScene(withEdits(toValue(scene), editsForView(scene, entry->item.id, true)), {});
                const QString where =
                    QString::fromUtf8(preset.id.data()) + ": " + QString::fromStdString(entry->item.id);
                QVERIFY2(
                    read.errors.empty(),
                    qPrintable(where + ": " +
                               QString::fromStdString(read.errors.empty() ? "" : read.errors[0].message)));
            }
        }
    }
    void aMaximisedCardComesBackWithEscape() {
        Window window("preset:spring-pendulum");
        const auto plots = window.compareView().plots();
        const auto shown = [&] {
            return std::count_if(plots.begin(), plots.end(),
                                 [](const PlotWidget* p) { return p->isVisible(); });
        };
        const auto all = shown();
        const QSize before = plots[2]->size();
        auto* card = qobject_cast<Card*>(plots[2]->parentWidget());
        QVERIFY(card);
        QTest::mouseDClick(card, Qt::LeftButton, {}, {30, 18});
        settle();
        QCOMPARE(shown(), 1);
        QVERIFY(plots[2]->isVisible() && plots[2]->height() > 2 * before.height());
        window.actions().find("stop")->trigger();  // Esc
        settle();
        QCOMPARE(shown(), all);
        QCOMPARE(plots[2]->size(), before);
        QVERIFY(window.runControl().state() == RunControl::State::finished);
    }
    void plotsGrowBack() {
        Window window("preset:spring-pendulum");
        const auto heights = [&] {
            settle();
            std::vector<int> all;
            for (const PlotWidget* plot : window.compareView().plots()) all.push_back(plot->height());
            return all;
        };
        const std::vector<int> before = heights();
        window.resize(900, 1000);  // one column
        settle();
        window.resize(1600, 1000);
        QCOMPARE(heights(), before);
        Window fresh("preset:spring-pendulum");
        const auto views = parseViews(R"(["stage","energy"])");
        fresh.edit("/views", views);
        QVERIFY(waitForResults(fresh));
        settle();
        Window few("preset:spring-pendulum");
        few.resize(900, 1000);
        settle();
        few.edit("/views", views);
        few.resize(1600, 1000);
        QVERIFY(waitForResults(few));
        settle();
        QVERIFY(few.compareView().plots()[1]->height() > before[1]);
        QCOMPARE(few.compareView().plots()[1]->height(), fresh.compareView().plots()[1]->height());
    }

private:
    static Value parseViews(const char* text) {
        Value::Array views;
        for (const QString& name : QString(text).remove('[').remove(']').remove('"').split(','))
            views.emplace_back(name.toStdString());
        return Value(std::move(views));
    }
};

EXTREMAL_TEST(KeepingTest)
}  // namespace extremal::keeping_test

#include "keeping_test.moc"
