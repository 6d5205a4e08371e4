// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/tools/test.hpp"
#include "ui/base/theme.hpp"

#include <QApplication>
#include <QFontInfo>
#include <QTest>
#include <set>

namespace extremal::theme_test {

class ThemeTest : public QObject {
    Q_OBJECT
private slots:
    void textIsLegibleOnEveryGround_data() {
        QTest::addColumn<bool>("dark");
        QTest::newRow("light") << false;
        QTest::newRow("dark") << true;
    }
    void textIsLegibleOnEveryGround() {
        QFETCH(bool, dark);
        const Theme t = dark ? Theme::dark() : Theme::light();
        for (const QColor& ground : {t.window, t.panel, t.field}) {
            QVERIFY2(contrast(t.text, ground) >= 4.5, qPrintable(ground.name()));
            QVERIFY2(contrast(t.muted, ground) >= 4.5, qPrintable(ground.name()));
        }
        QVERIFY(contrast(t.onAccent, t.accent) >= 4.5);
        QVERIFY(contrast(t.text, t.selection) >= 4.5);
        QVERIFY(contrast(t.warning, t.warningGround) >= 4.5);
        QVERIFY(contrast(t.error, t.errorGround) >= 4.5);
        QVERIFY(contrast(t.error, t.panel) >= 4.5);
        QVERIFY(contrast(t.good, t.panel) >= 4.5);
        for (const QColor& series : t.seriesColors)
            QVERIFY2(contrast(series, t.panel) >= 3, qPrintable(series.name()));
        for (const QColor& series : t.seriesColors) {
            const QColor ground = t.ground(series);
            QVERIFY2(contrast(t.onAccent, ground) >= 4.5, qPrintable(series.name()));
            QVERIFY2(contrast(series, ground) < 1.6,
                     qPrintable(series.name()));  // 1.49 at most: still its colour
        }
    }
    void contrastHasTheKnownExtremes() {
        QCOMPARE(contrast(Qt::black, Qt::white), 21.0);
        QCOMPARE(contrast(Qt::white, Qt::white), 1.0);
    }
    void sixteenSchemesLookDifferent() {
        std::set<std::pair<QString, QString>> seen;
        for (int i = 0; i < 16; ++i) {
            const SeriesStyle s = Theme::light().series(i);
            QString dash;
            for (qreal d : s.dash) dash += QString::number(d) + ' ';
            QVERIFY(s.dash.size() % 2 == 0);
            seen.insert({s.color.name(), dash});
        }
        QCOMPARE(seen.size(), std::size_t{16});
    }
    void bundledFontHasFourWeights() {
        const Theme t = Theme::light();
        QCOMPARE(QFontInfo(t.body()).family(), QStringLiteral("Inter"));
        QVERIFY(QFontInfo(t.strong()).weight() >= QFont::DemiBold);
        // Each weight is drawn as designed; one that was missing would be the next lighter one, smeared.
        QFont font = t.body();
        double narrower = 0;
        for (const auto weight : {QFont::Normal, QFont::Medium, QFont::DemiBold, QFont::Bold}) {
            font.setWeight(weight);
            const double width = QFontMetricsF(font).horizontalAdvance("energy");
            QVERIFY2(width > narrower, qPrintable(QString::number(weight)));
            narrower = width;
        }
    }
    void styleSheetIsCompleteAndAccepted() {
        for (Theme t : {Theme::light(), Theme::dark()}) {
            t.fontScale = 1.5;
            const QString sheet = t.styleSheet();
            QVERIFY(!sheet.contains('@'));
            QVERIFY(sheet.contains("font-size: 17px"));  // 11 px * 1.5, rounded
            applyTheme(*qApp, t);
        }
    }
};

EXTREMAL_TEST(ThemeTest)
}  // namespace extremal::theme_test

#include "theme_test.moc"
