// SPDX-License-Identifier: GPL-3.0-or-later
/// Rows of plots that have to scroll anyway are higher than those that fit.
#include "ui/compare/card_layout.hpp"

#include <QTest>

#include <algorithm>

#include "tests/tools/test.hpp"

namespace extremal::card_layout_test {

class CardLayoutTest : public QObject {
    Q_OBJECT
private slots:
    void theRowsInSightAreWhole() {
        QWidget page;
        auto* layout = new CardLayout(&page);
        layout->setContentsMargins(0, 0, 0, 0);
        layout->setColumns(2);
        layout->addCard(new QWidget(&page), CardShape::stage);
        for (int i = 0; i < 9; ++i) layout->addCard(new QWidget(&page), CardShape::plot);
        for (const int sight : {520, 610, 765}) {
            layout->setSight(sight);
            const int all = layout->heightForWidth(900);
            QVERIFY(all > sight);
            layout->setGeometry({0, 0, 900, all});
            int stage = 0, last = 0;
            for (int i = 0; i < layout->count(); ++i) {
                const QRect card = layout->itemAt(i)->geometry();
                if (i == 0) stage = card.height();
                if (card.bottom() < sight) last = std::max(last, card.bottom() + 1);
                QVERIFY2(card.bottom() < sight || card.top() >= sight, "a row is cut");
                QVERIFY(i == 0 || card.height() >= 200);
            }
            QCOMPARE(last, sight);
            QVERIFY2(stage * 5 >= sight * 2 || sight > 700, qPrintable(QString::number(stage)));
        }
    }
    /// Squares are lower beside a scroll bar: one that is needed must be needed where it is.
    void theScrollBarDoesNotComeAndGo() {
        constexpr int bar = 14;
        QWidget page;
        auto* layout = new CardLayout(&page);
        layout->setContentsMargins(0, 0, 0, 0);
        layout->setColumns(2);
        layout->addCard(new QWidget(&page), CardShape::stage);
        for (int i = 0; i < 3; ++i) {
            layout->addCard(new QWidget(&page), CardShape::square);
            layout->addCard(new QWidget(&page), CardShape::plot);
        }
        for (int width = 700; width <= 1300; width += 13)
            for (int sight = 300; sight <= 1600; sight += 7) {
                layout->setSight(sight, width);
                QVERIFY2(
                    layout->heightForWidth(width) <= sight || layout->heightForWidth(width - bar) > sight,
                    qPrintable(QString("%1 x %2").arg(width).arg(sight)));
            }
    }
    /// Where every row has a square they take the height that is left, as long as they stay about square.
    void squaresGrowWhereNothingElseCan() {
        QWidget page;
        auto* layout = new CardLayout(&page);
        layout->setContentsMargins(0, 0, 0, 0);
        layout->setColumns(3);
        layout->addCard(new QWidget(&page), CardShape::stage);
        for (int i = 0; i < 5; ++i) layout->addCard(new QWidget(&page), CardShape::square);
        layout->setSight(920);
        layout->setGeometry({0, 0, 1500, 920});
        int last = 0;
        for (int i = 0; i < layout->count(); ++i) {
            const QRect card = layout->itemAt(i)->geometry();
            last = std::max(last, card.bottom() + 1);
            QVERIFY2(i == 0 || card.height() * 4 <= card.width() * 5,
                     qPrintable(QString("%1 x %2").arg(card.width()).arg(card.height())));
        }
        QCOMPARE(last, 920);
        // In a narrow and high window they stay square.
        layout->setGeometry({0, 0, 800, 1400});
        const QRect card = layout->itemAt(5)->geometry();
        QVERIFY(card.height() * 4 <= card.width() * 5 && card.height() > 210);
    }
    void rowsThatScrollAreHigher() {
        QWidget page;
        auto* layout = new CardLayout(&page);
        layout->setContentsMargins(0, 0, 0, 0);
        layout->setColumns(2);
        for (int i = 0; i < 8; ++i) layout->addCard(new QWidget(&page), CardShape::plot);
        const int tight = layout->heightForWidth(900);
        layout->setSight(tight);
        QCOMPARE(layout->heightForWidth(900), tight);
        layout->setSight(tight - 1);
        QVERIFY(layout->heightForWidth(900) > tight + 4 * 30);
        layout->setGeometry({0, 0, 900, layout->heightForWidth(900)});
        QVERIFY(layout->itemAt(0)->geometry().height() >= 200);
    }
};

EXTREMAL_TEST(CardLayoutTest)
}  // namespace extremal::card_layout_test

#include "card_layout_test.moc"
