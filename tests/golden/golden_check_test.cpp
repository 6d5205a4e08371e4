// SPDX-License-Identifier: GPL-3.0-or-later
/// The comparison with golden images must itself be able to fail.
#include "tests/golden/golden_check.hpp"
#include "tests/tools/test.hpp"

#include <QDir>
#include <QFile>
#include <QPainter>
#include <QTemporaryDir>
#include <QTest>

#include <cmath>

namespace extremal::golden_check_test {

class GoldenCheckTest : public QObject {
    Q_OBJECT

    static QImage plot(double shift, const QColor& second) {
        QImage image(600, 400, QImage::Format_RGB32);
        image.fill(Qt::white);
        QPainter painter(&image);
        painter.setRenderHint(QPainter::Antialiasing);
        const auto curve = [&](const QColor& colour, double phase, double down) {
            QPolygonF points;
            for (int x = 40; x < 580; ++x)
                points << QPointF(x, 200 + down + 120 * std::sin(x / 50.0 + phase));
            painter.setPen(QPen(colour, 1.5));
            painter.drawPolyline(points);
        };
        curve("#0B62D6", 0, 0);
        curve(second, 1.5, shift);
        return image;
    }

private slots:
    void init() { qunsetenv("EXTREMAL_UPDATE_GOLDEN"); }

    void theSamePicturePasses() {
        QTemporaryDir kept, out;
        plot(0, "#D1490C").save(kept.filePath("plot.png"));
        for (const GoldenLimits& limits : {GoldenLimits::plot(), GoldenLimits::stage()})
            QVERIFY(checkGolden(plot(0, "#D1490C"), "plot", limits, kept.path(), out.path()).isEqual);
        QVERIFY(QDir(out.path()).isEmpty());
    }

    void aCurveShiftedByOnePixelFailsAndIsShown() {
        QTemporaryDir kept, out;
        plot(0, "#D1490C").save(kept.filePath("plot.png"));
        const GoldenResult result =
            checkGolden(plot(1, "#D1490C"), "plot", GoldenLimits::plot(), kept.path(), out.path());
        QVERIFY(!result.isEqual);
        for (const char* file : {"plot.actual.png", "plot.expected.png", "plot.difference.png", "plot.html"})
            QVERIFY2(QFile::exists(out.filePath(file)), file);
    }

    void aSwappedColourFails() {
        QTemporaryDir kept, out;
        plot(0, "#D1490C").save(kept.filePath("plot.png"));
        QVERIFY(
            !checkGolden(plot(0, "#0A8F6A"), "plot", GoldenLimits::plot(), kept.path(), out.path()).isEqual);
    }

    void aMissingPictureFails() {
        QTemporaryDir kept, out;
        QVERIFY(
            !checkGolden(plot(0, "#D1490C"), "plot", GoldenLimits::plot(), kept.path(), out.path()).isEqual);
    }

    void updatingIsRefusedWhereCiIsSet() {
        QTemporaryDir kept, out;
        const QByteArray before = qgetenv("CI");
        qputenv("EXTREMAL_UPDATE_GOLDEN", "1");
        qputenv("CI", "true");
        QVERIFY(
            !checkGolden(plot(0, "#D1490C"), "plot", GoldenLimits::plot(), kept.path(), out.path()).isEqual);
        QVERIFY(QDir(kept.path()).isEmpty());
        qunsetenv("CI");
        QVERIFY(
            checkGolden(plot(0, "#D1490C"), "plot", GoldenLimits::plot(), kept.path(), out.path()).isEqual);
        QVERIFY(QFile::exists(kept.filePath("plot.png")));
        qunsetenv("EXTREMAL_UPDATE_GOLDEN");
        if (!before.isEmpty()) qputenv("CI", before);
    }
};

EXTREMAL_TEST(GoldenCheckTest)
}  // namespace extremal::golden_check_test

#include "golden_check_test.moc"
