// SPDX-License-Identifier: GPL-3.0-or-later
/// The small picture in the corner of the stage: momenta on their sphere, the polhodes as trails, in the same
/// place at any zoom, faint behind, and off the sphere where momentum is lost.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/model/energy_curves.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/stage/model_comparison.hpp"
#include "ui/stage/stage_inset.hpp"
#include "ui/stage/stage_player.hpp"
#include "ui/stage/strokes.hpp"

namespace extremal::stage_inset_test {

namespace {

double norm(const Point& p) { return std::hypot(p[0], p[1], p[2]); }

/// The exact motion of a free body; every further scheme loses a tenth of its momentum.
fake::Film freeMotion() {
    fake::Film film = fake::freeBody();
    const System system = findModel("rigid-body")->make(film.model);
    const State start{0, 0, {1, 0, 0, 0, 0.5, 0.1, 0.8, 0.5, 0.1, 0.8}};
    const auto exact = system.exact(start);
    film.motion = [exact](int k, double t) {
        std::vector<double> x(10);
        exact(t, x);
        for (std::size_t i = 4; i < 10; ++i) x[i] *= 1 - 0.1 * k;
        return x;
    };
    return film;
}

}  // namespace

class StageInsetTest : public QObject {
    Q_OBJECT
private slots:
    void energyCurvesHaveTheirEnergyOnTheSphere() {
        const std::array<double, 3> I{1, 2, 3};
        const auto curves = energyCurves(I, 64);
        QCOMPARE(curves.size(), std::size_t(16));
        double worst = 0;
        for (const EnergyCurve& curve : curves)
            for (const auto& n : curve.points) {
                worst = std::max(worst, std::abs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1));
                worst = std::max(
                    worst, std::abs(n[0] * n[0] / I[0] + n[1] * n[1] / I[1] + n[2] * n[2] / I[2] - curve.e));
                QCOMPARE(curve.isSeparatrix, std::abs(curve.e - 0.5) < 1e-14);
            }
        qInfo("worst %.1e", worst);
        QVERIFY(worst < 1e-14);
        QCOMPARE(energyCurves({1, 1, 2}, 64).size(), std::size_t(8));
        QVERIFY(energyCurves({2, 2, 2}, 64).empty());
    }
    void polhodesLieOnTheirEnergyCurve() {
        const StagePlayer player(fake::comparison(freeMotion()));
        const StageFrame frame = player.frame(9, {});
        QVERIFY(frame.inset.has_value());
        const double L = std::hypot(0.5, 0.1, 0.8), e = (0.25 + 0.01 / 2 + 0.64 / 3) / (L * L);
        QVERIFY(std::abs(frame.inset->reach - L) < 1e-14);
        for (std::size_t k = 0; k < 2; ++k) {
            const StageLayer& layer = frame.layers[k];
            QVERIFY(layer.insetTrail.size() > 100);
            const double size = k == 0 ? L : 0.9 * L;
            double worst = 0;
            for (const TrailPoint& p : layer.insetTrail) {
                // On the stage axis 3 is up and axis 2 goes away.
                const double now = p.r[0] * p.r[0] + p.r[2] * p.r[2] / 2 + p.r[1] * p.r[1] / 3;
                worst = std::max({worst, std::abs(norm(p.r) - size), std::abs(now / (size * size) - e)});
            }
            qInfo("scheme %zu: worst %.1e", k, worst);
            QVERIFY(worst < 1e-6);  // the cubic between rows
            QVERIFY(std::abs(norm(layer.insetTracer) - size) < 1e-12);
        }
    }
    void itStaysInItsCornerAndTurnsWithTheCamera() {
        const StagePlayer player(fake::comparison(freeMotion()));
        const StageFrame frame = player.frame(4, {});
        Camera camera = player.fittedCamera(500, 300, 20);
        const Point fitted = camera.project(InsetPlace(frame, camera, 500, 300).centre());
        const double r = InsetPlace::pixels(500, 300);
        QVERIFY(fitted[0] + 1.3 * r < 250 && fitted[1] - 1.3 * r > -150);
        camera.azimuth += 0.7;
        camera.elevation = -0.4;
        camera.pixelsPerUnit *= 3;
        const InsetPlace place(frame, camera, 500, 300);
        const Point turned = camera.project(place.centre());
        QVERIFY(std::abs(turned[0] - fitted[0]) < 1e-9 && std::abs(turned[1] - fitted[1]) < 1e-9);
        // A point of the ball is seen at the ball's radius, where the camera turns it to.
        const Point pole = camera.project(place.map(Point{0, frame.inset->reach, 0}));
        QVERIFY(std::abs(pole[0] - turned[0]) < 1e-9);
        QVERIFY(std::abs(pole[1] - turned[1] - r * std::cos(-0.4)) < 1e-9);
    }
    void whatIsBehindIsFaint() {
        const StagePlayer player(fake::comparison(freeMotion()));
        StageStyle style;
        style.series = {rgb(0x0000ff), rgb(0xff0000)};
        StageFrame frame = player.frame(4, style);
        const Camera camera = player.fittedCamera(500, 300, 20);
        const Point front = camera.axes()[2];
        const auto alphaOfDisc = [&](double side) {
            for (StageLayer& layer : frame.layers)
                layer.insetTracer = {side * front[0], side * front[1], side * front[2]};
            const StrokeList list = makeStrokes(frame, camera, 500, 300, 1);
            return list.strokes.back().alphaA;
        };
        QCOMPARE(alphaOfDisc(0.5), 1.f);
        QVERIFY(alphaOfDisc(-0.5) < 0.5f);
    }
    void onlyFreeBodiesHaveIt() {
        QVERIFY(!StagePlayer(fake::comparison(fake::heavyTop())).frame(1, {}).inset);
        QVERIFY(!StagePlayer(fake::comparison(fake::pendulum())).frame(1, {}).inset);
        fake::Film resting = freeMotion();
        resting.motion = [](int, double) { return std::vector<double>{1, 0, 0, 0, 0, 0, 0, 0, 0, 0}; };
        QVERIFY(!StagePlayer(fake::comparison(resting)).frame(1, {}).inset);
    }
};

EXTREMAL_TEST(StageInsetTest)
}  // namespace extremal::stage_inset_test

#include "stage_inset_test.moc"
