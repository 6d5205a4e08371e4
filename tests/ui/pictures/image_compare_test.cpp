// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/tools/test.hpp"
#include "ui/pictures/image_compare.hpp"

#include <QPainter>
#include <QTest>

#include <cmath>

namespace extremal::image_compare_test {

class ImageCompareTest : public QObject {
    Q_OBJECT

    static QImage curve(double shift = 0, QColor colour = "#0B62D6") {
        QImage image(600, 400, QImage::Format_RGB32);
        image.fill(Qt::white);
        QPainter painter(&image);
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(QPen(colour, 1.5));
        QPolygonF points;
        for (int x = 20; x < 580; ++x) points << QPointF(x, 200 + shift + 120 * std::sin(x / 40.0));
        painter.drawPolyline(points);
        return image;
    }

private slots:
    void equalPicturesDoNotDiffer() {
        const ImageDifference d = compareImages(curve(), curve());
        QVERIFY(d.hasSameSize);
        QCOMPARE(d.differingPercent, 0.0);
        QCOMPARE(d.largest, 0);
        QCOMPARE(d.worstTilePercent, 0.0);
        QVERIFY(d.worstTile.isEmpty());
    }

    void aCurveShiftedByOnePixelDiffers() {
        const ImageDifference d = compareImages(curve(1), curve());
        QVERIFY2(d.differingPercent > 0.5, qPrintable(QString::number(d.differingPercent)));  // measured 1.2
    }

    void aMissingMarkDiffersInItsTile() {
        QImage marked = curve();
        const QRect mark(101, 51, 6, 6);
        QPainter(&marked).fillRect(mark, Qt::black);
        const ImageDifference d = compareImages(curve(), marked);
        QCOMPARE(d.worstTilePercent, 100 * 36 / 256.0);  // wherever it lies, a tile contains it
        QVERIFY(d.worstTile.contains(mark));
        QVERIFY(d.differingPercent < 0.1);
    }

    void aSwappedColourDiffers() {
        QVERIFY(compareImages(curve(0, "#D1490C"), curve()).differingPercent > 0.5);
    }

    void differencesUpToTheThresholdCountAsEqual() {
        QImage a(10, 10, QImage::Format_RGB32), b = a;
        a.fill(qRgb(100, 100, 100));
        b.fill(qRgb(108, 100, 92));
        QCOMPARE(compareImages(a, b, 8).differingPercent, 0.0);
        QCOMPARE(compareImages(a, b, 7).differingPercent, 100.0);
        QCOMPARE(compareImages(a, b, 7).worstTilePercent, 100.0);
        QCOMPARE(compareImages(a, b, 8).largest, 8);
    }

    void picturesOfOtherSizesDifferWhollyAndAreStillShown() {
        const ImageDifference d = compareImages(curve(), QImage(10, 10, QImage::Format_RGB32));
        QVERIFY(!d.hasSameSize);
        QCOMPARE(d.differingPercent, 100.0);
        QVERIFY(!sideBySide(curve(), QImage(10, 10, QImage::Format_RGB32), d).isNull());
        QVERIFY(!compareImages(QImage(), QImage()).hasSameSize);
    }
};

EXTREMAL_TEST(ImageCompareTest)
}  // namespace extremal::image_compare_test

#include "image_compare_test.moc"
