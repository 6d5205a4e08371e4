// SPDX-License-Identifier: GPL-3.0-or-later
/// The stage of bodies in space: it is seen from a corner, fills its picture and can be turned.
#include <QMouseEvent>
#include <QTest>

#include <algorithm>
#include <cmath>

#include "tests/tools/test.hpp"
#include "tests/ui/stage/model_comparison.hpp"
#include "ui/stage/stage_player.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/stage/strokes.hpp"

namespace extremal::spatial_stage_test {

class SpatialStageTest : public QObject {
    Q_OBJECT
private slots:
    void whatIsInSpaceFillsThePictureFromItsCorner() {
        const StagePlayer player(fake::comparison(fake::freeBody()));
        QVERIFY(player.isSpatial());
        const Camera camera = player.fittedCamera(400, 300, 20);
        QVERIFY(camera.azimuth != 0);
        double widest = 0, highest = 0;
        for (double t = 0; t < 10; t += 0.25) {
            const StageFrame frame = player.frame(t, {});
            std::vector<Shape> shapes = frame.scenery;
            shapes.insert(shapes.end(), frame.layers[0].shapes.begin(), frame.layers[0].shapes.end());
            for (const Shape& shape : shapes) {
                std::vector<Point> points;
                if (const auto* solid = std::get_if<Solid>(&shape)) points = solid->corners;
                if (const auto* segment = std::get_if<Segment>(&shape)) points = {segment->a, segment->b};
                for (const Point& p : points) {
                    const Point seen = camera.project(p);
                    widest = std::max(widest, std::abs(seen[0]));
                    highest = std::max(highest, std::abs(seen[1]));
                }
            }
        }
        QVERIFY(widest <= 180.5 && highest <= 130.5);
        QVERIFY(widest > 170 || highest > 120);  // one of the two is filled
        QVERIFY(!StagePlayer(fake::comparison(fake::pendulum())).isSpatial());
    }
    void facesTurnedAwayAreNotFilled() {
        // A box shows three faces of six: two triangles each, for the first scheme alone.
        const StagePlayer player(fake::comparison(fake::freeBody()));
        StageStyle style;
        style.series = {rgb(0x0000ff), rgb(0xff0000)};
        StageFrame frame = player.frame(2, style);
        frame.inset.reset();
        const StrokeList list = makeStrokes(frame, player.fittedCamera(400, 300, 20), 400, 300, 1);
        QCOMPARE(list.fills.size(), std::size_t(3 * 2 * 3));
        for (const FillCorner& corner : list.fills) QCOMPARE(corner.colour[2], 1.f);
    }
    void smoothBodiesShowTheirOutlineAlone() {
        Solid cube;
        for (int c = 0; c < 8; ++c)
            cube.corners.push_back({c & 1 ? 1.0 : -1.0, c & 2 ? 1.0 : -1.0, c & 4 ? 1.0 : -1.0});
        cube.faces = {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3}, {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};
        Camera corner;
        corner.azimuth = 0.5;
        corner.elevation = 0.4;
        corner.pixelsPerUnit = 50;
        const auto strokes = [&](bool isSmooth) {
            cube.isSmooth = isSmooth;
            StageFrame frame;
            frame.layers.resize(1);
            frame.layers[0].shapes = {cube};
            return makeStrokes(frame, corner, 300, 300, 1).strokes.size();
        };
        QCOMPARE(strokes(false), std::size_t(12));
        QCOMPARE(strokes(true), std::size_t(6));
    }
    void draggingTurnsItAndShiftMovesIt() {
        StageWidget stage;
        stage.resize(400, 300);
        stage.setComparison(fake::comparison(fake::freeBody()));
        stage.setTime(2);
        const QImage whole = stage.grab().toImage();
        const auto drag = [&](Qt::KeyboardModifiers keys) {
            QTest::mousePress(&stage, Qt::LeftButton, keys, {150, 150});
            // QTest::mouseMove knows no modifiers.
            QMouseEvent move(QEvent::MouseMove, {190, 150}, stage.mapToGlobal(QPointF(190, 150)),
                             Qt::NoButton, Qt::LeftButton, keys);
            QCoreApplication::sendEvent(&stage, &move);
            QTest::mouseRelease(&stage, Qt::LeftButton, keys, {190, 150});
            const QImage after = stage.grab().toImage();
            stage.fit();
            return after;
        };
        const QImage turned = drag({}), moved = drag(Qt::ShiftModifier);
        QVERIFY(turned != whole);
        // Moved by 40 pixels it is the same picture; turned it is not.
        const QRect part(20, 40, 170, 200);  // the inset, right of it, stays where it is
        const auto changed = [&](const QImage& image) {
            int count = 0;
            for (int y = part.top(); y <= part.bottom(); ++y)
                for (int x = part.left(); x <= part.right(); ++x)
                    count += std::abs(image.pixelColor(x + 40, y).lightness() -
                                      whole.pixelColor(x, y).lightness()) > 24;
            return 100.0 * count / (part.width() * part.height());
        };
        qInfo("percent of the pixels that differ: moved %.2f, turned %.2f", changed(moved), changed(turned));
        QVERIFY(changed(moved) < 0.3);
        QVERIFY(changed(turned) > 1.5);
        QCOMPARE(stage.grab().toImage(), whole);
    }
};

EXTREMAL_TEST(SpatialStageTest)
}  // namespace extremal::spatial_stage_test

#include "spatial_stage_test.moc"
