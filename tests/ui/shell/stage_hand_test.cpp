// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies taken on the stage of the whole window: the start follows the hand, and so do the plots.
#include <QTest>

#include <cmath>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/stage/stage_player.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::stage_hand_test {

class StageHandTest : public QObject {
    Q_OBJECT

    struct Window : MainWindow {
        explicit Window(const QString& preset) : MainWindow(Theme::light(), false) {
            resize(1400, 900);
            show();
            open("preset:" + preset);
            QVERIFY(waitForResults(*this));
            playback().setTime(playback().start());
        }
        StageWidget& stage() { return *compareView().stage(); }
        Camera camera() { return stage().camera(); }
        QPoint onStage(const Point& p) {
            const Point at = camera().project(p);
            return QPointF(stage().width() / 2.0 + at[0], stage().height() / 2.0 - at[1]).toPoint();
        }
        /// Body number i at the start.
        Point body(std::size_t number) {
            const ResolvedScene& scene = *workspace().resolved();
            Drawing drawing;
            scene.system->draw(scene.initial.x.data(), drawing);
            for (const Shape& shape : drawing.shapes)
                if (const auto* disc = std::get_if<Disc>(&shape); disc && disc->role == ShapeRole::body)
                    if (number-- == 0) return disc->centre;
            return {};
        }
        /// In steps, as a mouse moves, and then at rest.
        void drag(QPoint from, QPoint to, Qt::KeyboardModifiers keys = {}) {
            QTest::mousePress(&stage(), Qt::LeftButton, keys, from);
            for (int i = 1; i <= 5; ++i) move(from + (to - from) * i / 5, keys);
        }
        void move(QPoint to, Qt::KeyboardModifiers keys = {}) {
            QMouseEvent event(QEvent::MouseMove, to, stage().mapToGlobal(to), Qt::NoButton, Qt::LeftButton,
                              keys);
            QCoreApplication::sendEvent(&stage(), &event);
        }
        void let(QPoint at) {
            QTest::qWait(150);  // a hand at rest throws nothing
            QTest::mouseRelease(&stage(), Qt::LeftButton, {}, at);
        }
        double number(const char* pointer) { return valueAt(workspace().document(), pointer)->asNumber(); }
        bool isPreviewing() { return compareView().isPreviewing(); }
    };

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void aPlanetIsDraggedAndAllPlotsFollow() {
        Window window("kepler");
        const Value before = window.workspace().document();
        const long long made = window.compareView().figuresMade();
        const auto results = window.runControl().results();
        const QPoint from = window.onStage(window.body(0)), to = window.onStage({0.7, 0.3, 0});
        window.drag(from, to);
        QTRY_VERIFY(window.isPreviewing());
        QTRY_VERIFY(window.compareView().figuresMade() > made);  // while the button is down
        QVERIFY(window.workspace().document() == before);
        QCOMPARE(window.runControl().results(), results);
        window.let(to);
        QVERIFY(std::abs(window.number("/initial/q/0") - 0.7) < 0.02);
        QVERIFY(std::abs(window.number("/initial/q/1") - 0.3) < 0.02);
        QVERIFY(waitForResults(window));
        QTRY_VERIFY(!window.isPreviewing());
        window.workspace().undo();  // one step
        QVERIFY(window.workspace().document() == before);
    }
    void aClickChangesNothing() {
        Window window("kepler");
        const Value before = window.workspace().document();
        const QPoint at = window.onStage(window.body(0));
        QTest::mouseClick(&window.stage(), Qt::LeftButton, {}, at);
        QVERIFY(window.workspace().document() == before);
        // Beside the bodies dragging moves the view.
        window.drag({20, 60}, {60, 60});
        window.let({60, 60});
        QVERIFY(window.workspace().document() == before);
        QVERIFY(!window.stage().isFitted());
    }
    void shiftGivesAVelocity() {
        Window window("kepler");
        const Point place = window.body(0);
        const QPoint from = window.onStage(place);
        window.drag(from, from + QPoint(0, -60), Qt::ShiftModifier);
        window.let(from + QPoint(0, -60));
        QVERIFY(!valueAt(window.workspace().document(), "/initial/p"));
        QVERIFY(std::abs(window.number("/initial/v/0")) < 1e-3);
        const double second = (window.playback().end() - window.playback().start()) / 12;
        const double wanted = 60 / window.camera().pixelsPerUnit / second;
        QVERIFY(window.number("/initial/v/1") > 0);
        QVERIFY(wanted > 0);
        QVERIFY(std::abs(window.number("/initial/q/0") - place[0]) < 1e-9);
    }
    void aMechanismIsDraggedAlongItsRods() {
        Window window("double-pendulum-rods");
        const QPoint from = window.onStage(window.body(1)), to = from + QPoint(25, -25);
        window.drag(from, to);
        window.let(to);
        QVERIFY(valueAt(window.workspace().document(), "/initial/project")->asBool());
        QVERIFY(waitForResults(window));
        const State& start = window.workspace().resolved()->initial;
        const double rod = std::hypot(start.x[2] - start.x[0], start.x[3] - start.x[1]);
        const double upper = std::hypot(start.x[0], start.x[1]);
        const Value* lengths = valueAt(window.workspace().document(), "/model/parameters");
        const auto length = [&](const char* name) {
            const Value* v = lengths->find(name);
            return v && v->isNumber() ? v->asNumber() : 1.0;
        };
        QVERIFY(std::abs(upper - length("l1")) < 1e-9);
        QVERIFY(std::abs(rod - length("l2")) < 1e-9);
    }
    void takenAtALaterTimeItStartsFromThere() {
        Window window("kepler");
        const double p0 = window.number("/initial/p/1");
        window.playback().setTime(window.playback().start() + 1.3);
        const StagePlayer player(window.runControl().results());
        const auto grip = player.gripAt(window.playback().time(), window.camera(), 0, 0, 1e9);
        QVERIFY(grip);
        const QPoint from = window.onStage(grip->place);
        window.drag(from, from + QPoint(10, 0));
        window.let(from + QPoint(10, 0));
        QVERIFY(std::abs(window.number("/initial/p/1") - p0) > 0.05);
        QCOMPARE(window.playback().time(), window.playback().start());
    }
    void aScenePlaysWhenItOpens() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:pendulum");
        QVERIFY(waitForResults(window));
        QVERIFY(!window.playback().isPlaying());  // not without being told so
        window.setPlaysWhenOpened(true);
        window.open("preset:kepler");
        QTRY_VERIFY(window.playback().isPlaying());
        QVERIFY(window.playback().time() < window.playback().end() / 2);
        window.playback().setPlaying(false);
        QVERIFY(window.workspace().edit({{"/time/end", 11.0}}, "end"));
        QVERIFY(waitForResults(window));
        QVERIFY(!window.playback().isPlaying());  // an edit is no opening
    }
};

EXTREMAL_TEST(StageHandTest)
}  // namespace extremal::stage_hand_test

#include "stage_hand_test.moc"
