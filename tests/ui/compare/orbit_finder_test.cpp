// SPDX-License-Identifier: GPL-3.0-or-later
/// A periodic orbit near a place of a section: found, taken as the start, and its manifolds drawn.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/notices.hpp"
#include "ui/compare/orbit_finder.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::orbit_finder_test {
namespace {

const char* const scene =
    R"json({"extremal": 1, "model": {"type": "henon-heiles"}, "initial": {"q": [0, -0.2],
        "p": ["sqrt(2*(1/8 - 0.2^2/2 - 0.2^3/3))", 0.01]}, "time": {"end": 60}, "schemes": [
        {"label": "a", "step": 0.1, "scheme": "galerkin-gauss-4"}, {"label": "b", "step": 0.25, "baseline": "rk4"}],
        "reference": "none", "observe": ["energy"],
        "views": [{"view": "section", "range": {"x": [-0.5, 0.7], "y": [-0.5, 0.5]}}]})json";

struct Window : MainWindow {
    Window() : MainWindow(Theme::light(), false) {
        resize(1600, 1000);
        show();
        workspace().adopt(toValue(readScene(std::string(scene)).scene));
        if (!waitForResults(*this)) qFatal("no results");
    }
    PlotWidget* section() { return plotOf(*this, "section"); }
    /// The notice about orbits; none: null.
    const Notice* notice() {
        const auto& all = notices().all();
        const auto found =
            std::find_if(all.begin(), all.end(), [](const Notice& each) { return each.key == "orbit"; });
        return found == all.end() ? nullptr : &*found;
    }
    bool waitForOrbit() {
        return QTest::qWaitFor([this] { return !orbits().isRunning(); }, 60000);
    }
    void choose(const QString& text) {
        const std::vector<Notice::Choice> choices = notice()->choices;  // acting replaces the notice
        for (const Notice::Choice& choice : choices)
            if (choice.text == text) return choice.act();
        qFatal("no such choice");
    }
};

}  // namespace

class OrbitFinderTest : public QObject {
    Q_OBJECT
private slots:
    void anOrbitNearAPlaceBecomesTheStart() {
        Window window;
        QTRY_VERIFY(window.section());
        emit window.section()->orbitAsked(-0.25, 0);
        QVERIFY(window.orbits().isRunning());
        QVERIFY(window.notice() && window.notice()->text.startsWith("Looking for"));
        QVERIFY(window.waitForOrbit());
        QVERIFY2(window.notice()->text.startsWith("Periodic orbit of a: period"),
                 qPrintable(window.notice()->text));
        const double before = window.workspace().scene().end.value;
        window.choose("Start there");
        QVERIFY(waitForResults(window));
        const Scene& now = window.workspace().scene();
        QVERIFY(now.end.value != before);
        // What is the start now comes back at the end.
        const auto results = window.runControl().results();
        const Trajectory& rows = results->schemes.front()->trajectory;
        for (const char* column : {"q.x", "q.y", "p.x", "p.y"})
            QVERIFY(std::abs(rows[column].back() - rows[column].front()) < 1e-11);
        window.workspace().undo();
        QCOMPARE(window.workspace().scene().end.value, before);
    }
    void itsManifoldsAreStartsOfTheSection() {
        Window window;
        QTRY_VERIFY(window.section());
        emit window.section()->orbitAsked(-0.25, 0);
        QVERIFY(window.waitForOrbit());
        for (const auto& [choice, sign] :
             {std::pair{"Unstable manifold", 1}, std::pair{"Stable manifold", -1}}) {
            window.choose(choice);
            QVERIFY(window.waitForOrbit());
            const Scene& now = window.workspace().scene();
            QCOMPARE(now.views.at(0).starts.points.size(), std::size_t(200));
            QVERIFY(sign * now.end.value > 0);
            window.choose("Undo");
            QVERIFY(window.workspace().scene().views.at(0).starts.isEmpty());
            emit window.section()->orbitAsked(-0.25, 0);
            QVERIFY(window.waitForOrbit());
        }
    }
    void aKeyStartsItAndEscStopsIt() {
        Window window;
        window.actions().find("periodicOrbit")->trigger();
        QVERIFY(window.orbits().isRunning());
        window.actions().find("stop")->trigger();
        QVERIFY(!window.orbits().isRunning());
        QVERIFY(!window.notice());
        QTest::qWait(300);  // the thread ends, and says nothing
        QVERIFY(!window.notice());
    }
    void whatHasNoneIsSaid() {
        Window window;
        QVERIFY(window.workspace().edit({{"/time/end", 1.0}}, "end"));
        window.actions().find("periodicOrbit")->trigger();
        QVERIFY(window.waitForOrbit());
        QVERIFY2(
            window.notice()->text.startsWith("No periodic orbit: the motion of the scene does not come back"),
            qPrintable(window.notice()->text));
        QVERIFY(!window.notice()->hint.isEmpty());
    }
};

EXTREMAL_TEST(OrbitFinderTest)
}  // namespace extremal::orbit_finder_test

#include "orbit_finder_test.moc"
