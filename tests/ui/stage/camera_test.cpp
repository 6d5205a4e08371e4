// SPDX-License-Identifier: GPL-3.0-or-later
/// A fitted camera shows the whole box from every side, no smaller than it must, and pixels lead back to
/// points.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "tests/tools/test.hpp"
#include "ui/stage/camera.hpp"

namespace extremal::camera_test {
namespace {

Bounds box() {
    Bounds bounds;
    bounds.add(Point{-1, 0.5, 2});
    bounds.add(Point{3, 1.5, 5});
    return bounds;
}

}  // namespace

class CameraTest : public QObject {
    Q_OBJECT
private slots:
    void aFittedBoxTouchesTheMargin_data() {
        QTest::addColumn<double>("azimuth");
        QTest::addColumn<double>("elevation");
        for (const double azimuth : {-2.5, -0.7, 0.0, 0.6, 2.0})
            for (const double elevation : {-1.0, 0.0, 0.8})
                QTest::addRow("%g, %g", azimuth, elevation) << azimuth << elevation;
    }
    void aFittedBoxTouchesTheMargin() {
        QFETCH(double, azimuth);
        QFETCH(double, elevation);
        const Bounds bounds = box();
        const Camera camera = fitCamera(bounds, 400, 300, 20, azimuth, elevation);
        double right = 0, up = 0;
        for (int corner = 0; corner < 8; ++corner) {
            Point p = bounds.low;
            for (std::size_t i = 0; i < 3; ++i)
                if ((corner >> i) & 1) p[i] = bounds.high[i];
            const Point seen = camera.project(p);
            right = std::max(right, std::abs(seen[0]));
            up = std::max(up, std::abs(seen[1]));
        }
        QVERIFY(right < 180 + 1e-9 && up < 130 + 1e-9);
        QVERIFY(right > 180 - 1e-9 || up > 130 - 1e-9);
    }
    void pixelsLeadBack() {
        const Camera camera = fitCamera(box(), 400, 300, 20, 0.6, 0.8);
        for (const auto& [x, y] : {std::pair{30.0, 0.0}, {0.0, 40.0}, {-25.0, 70.0}}) {
            const Point seen = camera.project(camera.unproject(x, y));
            QVERIFY(std::abs(seen[0] - x) < 1e-9 && std::abs(seen[1] - y) < 1e-9);
        }
    }
};

EXTREMAL_TEST(CameraTest)

}  // namespace extremal::camera_test

#include "camera_test.moc"
