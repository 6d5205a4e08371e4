// SPDX-License-Identifier: GPL-3.0-or-later
/// Golden images of the stage, through OSMesa.
#include <QPainter>
#include <QTest>

#include "tests/golden/golden_check.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/stage/model_comparison.hpp"
#include "ui/base/theme.hpp"
#include "ui/stage/stage_overlay.hpp"
#include "ui/stage/stage_picture.hpp"
#include "ui/stage/stage_player.hpp"

namespace extremal::stage_test {

class StageGoldenTest : public QObject {
    Q_OBJECT

    static QImage stage(const fake::Film& film, double t, const Theme& theme) {
        const StagePlayer player(fake::comparison(film));
        const QSizeF size(520, 300);
        const StageFrame frame = player.frame(t, stageStyle(theme));
        const Camera camera = player.fittedCamera(size.width(), size.height(), stageMargin);
        QImage image = drawStage(frame, camera, size, 1);
        QPainter painter(&image);
        paintOverlay(painter, QRectF(QPointF(0, 0), size), frame, player, theme, {true, camera});
        return image;
    }
    static void check(const QImage& image, const QString& name) {
        const GoldenResult result = checkGolden(image, name, GoldenLimits::stage());
        QVERIFY2(result.isEqual, qPrintable(result.message));
    }

private slots:
    void springPendulumMatchesItsImage() {
        check(stage(fake::springPendulum(), 3.2, Theme::light()), "stage-spring-pendulum");
    }
    void springPendulumMatchesItsImageInTheDark() {
        check(stage(fake::springPendulum(), 6.2, Theme::dark()), "stage-spring-pendulum-dark");
    }
    void pendulumMatchesItsImage() { check(stage(fake::pendulum(), 2.6, Theme::light()), "stage-pendulum"); }
    void keplerMatchesItsImage() { check(stage(fake::kepler(), 11.3, Theme::light()), "stage-kepler"); }
    void oscillatorMatchesItsImage() {
        check(stage(fake::oscillator(), 2, Theme::light()), "stage-oscillator");
    }

    void aBodyMatchesItsImage() { check(stage(fake::freeBody(), 6.2, Theme::light()), "stage-body"); }
    void aBodyMatchesItsImageInTheDark() {
        check(stage(fake::freeBody(), 3.1, Theme::dark()), "stage-body-dark");
    }
    void anEllipsoidOfInertiaMatchesItsImage() {
        fake::Film film = fake::freeBody();
        film.model =
            fake::settings("rigid-body", {{"inertia", Value::Array{1.0, 2.0, 3.0}}, {"shape", "ellipsoid"}});
        check(stage(film, 6.2, Theme::light()), "stage-ellipsoid");
    }
    void aTopMatchesItsImage() { check(stage(fake::heavyTop(), 4.4, Theme::light()), "stage-top"); }

    void theLimitsSeeASwappedColourAndAMovedBody() {
        const QImage right = stage(fake::pendulum(), 2.6, Theme::light());
        Theme swapped = Theme::light();
        std::swap(swapped.seriesColors[0], swapped.seriesColors[2]);
        const GoldenLimits limits = GoldenLimits::stage();
        QVERIFY(
            !isWithin(compareImages(stage(fake::pendulum(), 2.6, swapped), right, limits.threshold), limits));
        QVERIFY(!isWithin(
            compareImages(stage(fake::pendulum(), 2.62, Theme::light()), right, limits.threshold), limits));
    }
};

EXTREMAL_TEST(StageGoldenTest)
}  // namespace extremal::stage_test

#include "stage_test.moc"
