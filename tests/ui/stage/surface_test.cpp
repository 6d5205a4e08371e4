// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/tools/test.hpp"
#include "ui/stage/gl/surface.hpp"

#include <QTest>

#include "tests/ui/stage/fake_comparison.hpp"
#include "ui/base/theme.hpp"
#include "ui/pictures/image_compare.hpp"
#include "ui/stage/stage_overlay.hpp"
#include "ui/stage/stage_player.hpp"

namespace extremal::surface_test {

class SurfaceTest : public QObject {
    Q_OBJECT

    StagePlayer player_{fake::comparisonOf({{"a"}, {"b", 0.9, 0.2}}), fake::swing()};

    StageFrame frame() const { return player_.frame(6.2, stageStyle(Theme::light())); }
    Camera camera(double width = 300, double height = 200) const {
        return fitCamera(player_.bounds(), width, height, stageMargin);
    }

private slots:
    void repeatedPicturesAreTheSameToTheByte() {
        StagePainter painter(makeOsmesaSurface());
        const QImage first = painter.draw(frame(), camera(), 300, 200, 1);
        painter.draw(player_.frame(1, stageStyle(Theme::dark())), camera(), 123, 77, 1);
        QCOMPARE(painter.draw(frame(), camera(), 300, 200, 1), first);
        StagePainter other(makeOsmesaSurface());
        QCOMPARE(other.draw(frame(), camera(), 300, 200, 1), first);
    }

    void picturesAreUprightAndInTheThemesColours() {
        StageFrame picture;
        picture.style = stageStyle(Theme::light());
        picture.layers.resize(1);
        picture.layers[0].colour = rgb(0xD1490C);
        picture.layers[0].shapes = {Disc{{0.5, 0.25, 0}, 10}};
        StagePainter painter(makeOsmesaSurface());
        const QImage image = painter.draw(picture, Camera{}, 200, 100, 1);
        QCOMPARE(image.pixelColor(150, 25).rgb(), QColor(0xD1, 0x49, 0x0C).rgb());
        QCOMPARE(image.pixelColor(50, 75).rgb(), Theme::light().panel.rgb());
    }

    void aTrailOfOneSchemeShowsNoJoints() {
        // Half-transparent pieces that overlap must be as dark as one piece: a straight trail of equal age,
        // cut in forty pieces, has one colour along its middle.
        StageFrame picture;
        picture.style = stageStyle(Theme::light());
        picture.layers.resize(1);
        picture.layers[0].colour = rgb(0x0B62D6);
        for (int i = 0; i <= 40; ++i)
            picture.layers[0].trail.push_back({{-0.8 + 0.04 * i, 0, 0}, 0.5, i > 0});
        StagePainter painter(makeOsmesaSurface());
        const QImage image = painter.draw(picture, Camera{}, 200, 101, 1);
        const QRgb middle = image.pixel(100, 50);
        QVERIFY(qRed(middle) > 20 && qRed(middle) < 235);
        for (int x = 30; x < 170; ++x) QCOMPARE(image.pixel(x, 50), middle);
    }

    void higherPixelRatiosShowTheSamePictureFiner() {
        StagePainter painter(makeOsmesaSurface());
        const QImage coarse = painter.draw(frame(), camera(), 300, 200, 1);
        QImage fine = painter.draw(frame(), camera(), 900, 600, 3);
        QCOMPARE(fine.devicePixelRatio(), 3.0);
        fine.setDevicePixelRatio(1);
        fine = fine.scaled(300, 200, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
        QImage plain = coarse;
        plain.setDevicePixelRatio(1);
        const ImageDifference difference = compareImages(fine, plain, 48);
        QVERIFY2(difference.differingPercent < 0.5, qPrintable(QString::number(difference.differingPercent)));
    }

    void eglDrawsTheSamePictureAsOsmesa() {
        std::unique_ptr<Surface> egl;
        try {
            egl = makeEglSurface();
        } catch (const OpenGlUnavailable& e) {
            QSKIP(e.what());
        }
        // One after the other: a thread has one current context.
        const QImage a = StagePainter(std::move(egl)).draw(frame(), camera(), 300, 200, 1),
                     b = StagePainter(makeOsmesaSurface()).draw(frame(), camera(), 300, 200, 1);
        QVERIFY(compareImages(a, b, 8).differingPercent < 0.1);
    }

    void unknownOpenGlVersionsAreRefusedByNumber() {
        const auto old = [](const char*) -> void (*)() {
            return reinterpret_cast<void (*)()>(
                +[](unsigned name, int* value) { *value = name == GL_MAJOR_VERSION ? 2 : 1; });
        };
        try {
            loadGlFunctions(old);
            QFAIL("version 2.1 was taken");
        } catch (const OpenGlUnavailable& e) {
            QVERIFY(QString(e.what()).contains("2.1"));
        }
    }
};

EXTREMAL_TEST(SurfaceTest)
}  // namespace extremal::surface_test

#include "surface_test.moc"
