// SPDX-License-Identifier: GPL-3.0-or-later
/// Lines of "speed against accuracy": measured in the background, kept while nothing changes that they depend
/// on, and a step that they propose goes into the scene by one click.
#include "ui/study/background_sweep.hpp"

#include <QPushButton>
#include <QSignalSpy>
#include <QSlider>
#include <QTest>

#include <algorithm>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/header_bar.hpp"
#include "ui/workspace/wanted.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::background_sweep_test {

class BackgroundSweepTest : public QObject {
    Q_OBJECT

    struct Window : MainWindow {
        explicit Window(const char* preset) : MainWindow(Theme::light(), false) {
            resize(1600, 1000);
            show();
            open(preset);
            QVERIFY(waitForResults(*this));
        }
        BackgroundSweep& sweep() { return *findChild<BackgroundSweep*>(); }
        PlotWidget& costs() { return *compareView().plots().front(); }
        std::size_t lines() {
            const auto all = costs().figure().series();
            return static_cast<std::size_t>(std::count_if(
                all.begin(), all.end(), [](const Series& s) { return s.kind == SeriesKind::curve; }));
        }
    };

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void everySchemeGetsALine() {
        Window window("preset:pendulum");
        QCOMPARE(window.lines(), std::size_t{0});
        const std::size_t schemes = window.runControl().results()->schemes.size();
        QTRY_COMPARE_WITH_TIMEOUT(window.lines(), schemes, 60000);
        for (const SweptScheme& swept : window.sweep().known()) {
            QVERIFY2(swept.points.size() >= 3, swept.spec.label.c_str());
            // Errors fall with the step as the order says, until they are those of rounding.
            QVERIFY(swept.points.front().error > swept.points.back().error);
            QVERIFY(swept.points.front().step > 3 * swept.points.back().step);
        }
        const Figure& figure = window.costs().figure();
        // The front falls from the cheapest point to the most accurate one, and nothing is below it.
        const Guide* front = nullptr;
        for (const Guide& guide : figure.all<Guide>())
            if (guide.isBroad) front = &guide;
        QVERIFY(front && front->x.size() >= 2);
        for (std::size_t i = 1; i < front->x.size(); ++i)
            QVERIFY(front->x[i] > front->x[i - 1] && front->y[i] < front->y[i - 1]);
        const Sweep::ErrorRange judged = window.sweep().known().front().judged;
        QVERIFY(judged.most > 0.1 && judged.most < 1);  // a fifth of the motion
        for (const Series& s : figure.series())
            for (std::size_t i = 0; i < s.x.size(); ++i) {
                const bool isCheaper = s.x[i] < front->x.front(), isBetter = s.y[i] < front->y.back();
                QVERIFY2(!judged.has(s.y[i]) || (!isCheaper && !isBetter), s.label.c_str());
            }
        for (const double error : front->y) QVERIFY(judged.has(error));
        // The axes show all of them.
        for (const Series& s : figure.series())
            for (std::size_t i = 0; i < s.x.size(); ++i)
                QVERIFY(s.y[i] >= figure.y.range->first && s.y[i] <= figure.y.range->second &&
                        s.x[i] >= figure.x.range->first && s.x[i] <= figure.x.range->second);
    }
    void whatIsKnownIsNotMeasuredAgain() {
        Window window("preset:pendulum");
        const std::size_t schemes = window.runControl().results()->schemes.size();
        QTRY_COMPARE_WITH_TIMEOUT(window.lines(), schemes, 60000);
        const std::vector<SweptScheme> before = window.sweep().known();
        QVERIFY(window.workspace().edit({{"/schemes/0/label", "renamed"}}, "name"));
        QVERIFY(waitForResults(window));
        QCOMPARE(window.sweep().known().size(), before.size());
        QCOMPARE(window.sweep().known()[0].spec.label, std::string("renamed"));
        QCOMPARE(window.sweep().known()[0].points[0].seconds, before[0].points[0].seconds);
        // Another problem has other errors.
        QVERIFY(window.workspace().edit({{"/model/l", 1.5}}, "length"));
        QVERIFY(waitForResults(window));
        QVERIFY(window.sweep().known().empty());
    }
    void theProposedStepIsOneClickAway() {
        Window window("preset:pendulum");
        auto* header = window.findChild<HeaderBar*>();
        auto* use = header->findChild<QPushButton*>("useChoice");
        const std::size_t schemes = window.runControl().results()->schemes.size();
        QTRY_COMPARE_WITH_TIMEOUT(window.lines(), schemes, 60000);
        // The smallest error that a finer step reaches, and no scheme of the scene.
        double best = 1e9, own = 1e9;
        for (const auto& s : window.runControl().results()->schemes) own = std::min(own, s->summary.maxError);
        for (const SweptScheme& swept : window.sweep().known())
            for (const SweptPoint& p : swept.points) best = std::min(best, p.error);
        const double wanted = std::pow(10, std::ceil(std::log10(best)));
        QVERIFY(wanted < own);
        window.wanted().setError(wanted);
        QCOMPARE(window.costs().level().value_or(0), window.wanted().error());
        QVERIFY(use->isVisible());
        const Scene scene = window.workspace().scene();
        use->click();
        QVERIFY(!(window.workspace().scene() == scene));
        QVERIFY(waitForResults(window));
        double now = 1e9;
        for (const auto& s : window.runControl().results()->schemes) now = std::min(now, s->summary.maxError);
        QVERIFY2(now <= wanted, qPrintable(QString::number(now)));
    }
    void theLineOfTheWantedErrorMovesTheSlider() {
        Window window("preset:pendulum");
        emit window.costs().levelMoved(1e-3);
        QCOMPARE(window.wanted().error(), 1e-3);
        QCOMPARE(window.costs().level().value_or(0), 1e-3);
    }
};

EXTREMAL_TEST(BackgroundSweepTest)
}  // namespace extremal::background_sweep_test

#include "background_sweep_test.moc"
