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
        void move(QPoint to, Qt::KeyboardModifiers keys = {}, quint64 ms = 0) {
            QMouseEvent event(QEvent::MouseMove, to, stage().mapToGlobal(to), Qt::NoButton, Qt::LeftButton,
                              keys);
            event.setTimestamp(ms);
            QCoreApplication::sendEvent(&stage(), &event);
        }
        /// The time is that of the events: a hand at rest throws nothing.
        void let(QPoint at, quint64 ms = 1000) {
            QMouseEvent event(QEvent::MouseButtonRelease, at, stage().mapToGlobal(at), Qt::LeftButton,
                              Qt::NoButton, {});
            event.setTimestamp(ms);
            QCoreApplication::sendEvent(&stage(), &event);
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
    /// A short run may be about square where the whole one is not.
    void cardsStayWhereTheyAreMeanwhile() {
        Window window("double-pendulum");
        const auto plots = [&] { return window.compareView().plots(); };
        const auto places = [&] {
            QList<QRect> all;
            for (PlotWidget* plot : plots())
                all << QRect(plot->mapTo(&window.compareView(), QPoint()), plot->size());
            return all;
        };
        const auto aspects = [&] {
            QList<Aspect> all;
            for (const PlotWidget* plot : plots()) all << plot->figure().aspect;
            return all;
        };
        // The cards are placed by events, and once more where a scroll bar comes or goes.
        const auto isPlaced = [&] {
            const QList<QRect> now = places();
            QCoreApplication::processEvents();
            return places() == now;
        };
        QTRY_VERIFY(isPlaced());
        const QList<QRect> before = places();
        const QList<Aspect> whole = aspects();
        const QPoint from = window.onStage(window.body(1));
        QTest::mousePress(&window.stage(), Qt::LeftButton, {}, from);
        int others = 0;
        for (int i = 1; i <= 12; ++i) {  // around where it is
            const long long made = window.compareView().figuresMade();
            window.move(from + (60 * QPointF(std::cos(i) - 1, std::sin(i))).toPoint());
            QTRY_VERIFY_WITH_TIMEOUT(window.isPreviewing() && window.compareView().figuresMade() > made,
                                     60000 * tests::slowdown);
            QCoreApplication::processEvents();  // the cards are placed
            others += aspects() != whole;
            QCOMPARE(places(), before);
        }
        window.let(from);
        QVERIFY(others > 0);
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
    /// 12 pixels in each 10 ms, upwards; however long it takes to deal with the events.
    void aThrowGivesTheVelocityOfThePointer() {
        Window window("kepler");
        const QPoint from = window.onStage(window.body(0));
        const double pixels = window.camera().pixelsPerUnit;
        QTest::mousePress(&window.stage(), Qt::LeftButton, {}, from);
        for (int i = 1; i <= 8; ++i)
            window.move(from - QPoint(0, 12 * i), {}, static_cast<quint64>(5000 + 10 * i));
        window.let(from - QPoint(0, 96), 5080);
        const double second = (window.playback().end() - window.playback().start()) / 12;
        QVERIFY(valueAt(window.workspace().document(), "/initial/v"));
        const double thrown = window.number("/initial/v/1"), expected = 1200 / pixels / second;
        QVERIFY2(std::abs(thrown / expected - 1) < 0.02,
                 qPrintable(QString("%1 of %2").arg(thrown).arg(expected)));
        QVERIFY(std::abs(window.number("/initial/v/0")) < 1e-9);
    }
    void besideTheOthersABodyIsTakenInItsPlace() {
        Window window("kepler");
        window.compareView().toggleSideBySide();
        QVERIFY(window.stage().isSideBySide());
        const StagePlayer player(window.runControl().results());
        const StageTiling tiling =
            player.tilingFor(window.stage().width(), window.stage().height() - 20, Camera{});
        QVERIFY(tiling.columns * tiling.rows >=
                static_cast<int>(window.runControl().results()->schemes.size()));
        const Point place = window.body(0), by = tiling.offset(1);
        const QPoint from = window.onStage({place[0] + by[0], place[1] + by[1], 0});
        const QPoint to = window.onStage({place[0] + by[0] + 0.1, place[1] + by[1], 0});
        window.drag(from, to);
        window.let(to);
        QVERIFY2(std::abs(window.number("/initial/q/0") - place[0] - 0.1) < 0.03,
                 qPrintable(QString::number(window.number("/initial/q/0"))));
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
