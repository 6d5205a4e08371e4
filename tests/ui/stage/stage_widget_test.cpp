// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/tools/test.hpp"
#include "ui/stage/stage_widget.hpp"

#include <QSignalSpy>
#include <QWheelEvent>
#include <QTest>

#include "tests/ui/stage/model_comparison.hpp"
#include "ui/base/theme.hpp"

namespace extremal::stage_widget_test {

class StageWidgetTest : public QObject {
    Q_OBJECT

    std::shared_ptr<const Comparison> comparison_ = fake::comparison(fake::pendulum());

    static void wheel(QWidget& widget, QPointF place, int delta) {
        QWheelEvent event(place, widget.mapToGlobal(place), QPoint(), QPoint(0, delta), Qt::NoButton,
                          Qt::NoModifier, Qt::NoScrollPhase, false);
        QCoreApplication::sendEvent(&widget, &event);
    }

private slots:
    /// With ratios that are no whole numbers as well.
    void thePictureCoversItsPlace() {
        StageWidget stage;
        stage.resize(101, 61);
        QCOMPARE(stage.picture(1.25).size(), QSize(127, 77));  // 126.25 x 76.25
        QCOMPARE(stage.picture(2).size(), QSize(202, 122));
    }
    void worksOnAPlatformWithoutOpenGl() {
        StageWidget stage;
        stage.resize(400, 300);
        stage.setComparison(comparison_);
        stage.setTime(1);
        QVERIFY(!stage.usesGraphicsCard());
        const QImage early = stage.grab().toImage();
        stage.setTime(1.5);
        QVERIFY(stage.grab().toImage() != early);
        stage.setTheme(Theme::dark());
        QVERIFY(stage.grab().toImage().pixelColor(3, 150).lightness() < 60);
    }

    void wheelAndDragChangeTheViewAndDoubleClickBringsItBack() {
        StageWidget stage;
        stage.resize(400, 300);
        stage.setComparison(comparison_);
        QSignalSpy changes(&stage, &StageWidget::fittedChanged);
        const QImage whole = stage.grab().toImage();
        wheel(stage, {300, 100}, 240);
        QVERIFY(!stage.isFitted());
        QVERIFY(stage.grab().toImage() != whole);
        QTest::mousePress(&stage, Qt::LeftButton, {}, {100, 100});
        QTest::mouseMove(&stage, {150, 120});
        QTest::mouseRelease(&stage, Qt::LeftButton, {}, {150, 120});
        stage.setComparison(std::make_shared<Comparison>(*comparison_));
        QVERIFY(!stage.isFitted());  // new rows leave the user's view alone
        QTest::mouseDClick(&stage, Qt::LeftButton, {}, {150, 120});
        QVERIFY(stage.isFitted());
        QCOMPARE(stage.grab().toImage(), whole);
        QCOMPARE(changes.count(), 2);
    }

    void anotherModelBringsBackTheFullView() {
        StageWidget stage;
        stage.resize(400, 300);
        stage.setComparison(comparison_);
        stage.zoom(3);
        QVERIFY(!stage.isFitted());
        stage.setComparison(fake::comparison(fake::kepler()));
        QVERIFY(stage.isFitted());
    }

    void zoomingHasLimits() {
        StageWidget stage;
        stage.resize(400, 300);
        stage.setComparison(comparison_);
        for (int i = 0; i < 300; ++i) wheel(stage, {200, 150}, 1200);
        QVERIFY(!stage.grab().isNull());
        for (int i = 0; i < 600; ++i) wheel(stage, {200, 150}, -1200);
        QVERIFY(!stage.grab().isNull());
    }

    void picturesForSavingAreFiner() {
        StageWidget stage;
        stage.resize(400, 300);
        stage.setComparison(comparison_);
        QCOMPARE(stage.picture(2.5).size(), QSize(1000, 750));
    }

    void saysWhatItShowsToScreenReaders() {
        StageWidget stage;
        stage.setComparison(comparison_);
        QVERIFY(!stage.accessibleName().isEmpty());
        QVERIFY(stage.accessibleDescription().contains("midpoint"));
        QVERIFY(stage.accessibleDescription().contains("10.00 s"));
        stage.setComparison(nullptr);
        QVERIFY(!stage.grab().isNull());
    }
};

EXTREMAL_TEST(StageWidgetTest)
}  // namespace extremal::stage_widget_test

#include "stage_widget_test.moc"
