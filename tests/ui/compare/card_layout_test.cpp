// SPDX-License-Identifier: GPL-3.0-or-later
/// Rows that scroll and rows that fit, squares, and sizes that a hand gave.
#include "ui/compare/card_layout.hpp"

#include <QMouseEvent>
#include <QTest>

#include <algorithm>

#include "tests/tools/test.hpp"
#include "ui/compare/card_handle.hpp"

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
    void rowsAndCardsHaveTheSizesOfAHand() {
        QWidget page;
        auto* layout = new CardLayout(&page);
        layout->setContentsMargins(0, 0, 0, 0);
        layout->setColumns(2);
        for (const CardShape shape : {CardShape::stage, CardShape::plot, CardShape::plot, CardShape::square})
            layout->addCard(new QWidget(&page), shape);
        const auto places = [&] {
            layout->setGeometry({0, 0, 900, std::max(700, layout->heightForWidth(900))});
            QList<QRect> all;
            for (int i = 0; i < layout->count(); ++i) all << layout->itemAt(i)->geometry();
            return all;
        };
        const QList<QRect> before = places();
        const auto handle = [&](Qt::CursorShape shape) {  // the uppermost
            CardHandle* found = nullptr;
            for (CardHandle* each : page.findChildren<CardHandle*>())
                if (each->cursor().shape() == shape && (!found || each->y() < found->y())) found = each;
            return found;
        };
        const auto drag = [](CardHandle* at, QPoint by) {
            const QPoint middle = at->rect().center();
            QTest::mousePress(at, Qt::LeftButton, {}, middle);
            QMouseEvent move(QEvent::MouseMove, middle + by, at->mapToGlobal(middle + by), Qt::NoButton,
                             Qt::LeftButton, {});
            QCoreApplication::sendEvent(at, &move);
            QTest::mouseRelease(at, Qt::LeftButton, {}, middle);
        };
        drag(handle(Qt::SizeVerCursor), {0, 60});
        const QList<QRect> higher = places();
        QVERIFY(std::abs(higher[0].height() - before[0].height() - 60) <= 1);
        QCOMPARE(higher[1].height(), higher[0].height());
        QVERIFY(higher[2].top() > higher[0].bottom());
        drag(handle(Qt::SizeHorCursor), {-100, 0});
        const QList<QRect> narrower = places();
        QVERIFY(std::abs(narrower[0].width() - before[0].width() + 100) <= 1);
        QCOMPARE(narrower[1].right(), before[1].right());
        QVERIFY(narrower[1].left() > narrower[0].right());
        drag(handle(Qt::SizeHorCursor), {-5000, 0});
        QVERIFY(places()[0].width() >= 100);
        layout->grow(layout->itemAt(2)->widget(), 40);
        QCOMPARE(places()[2].height(), narrower[2].height() + 40);
        QTest::mouseDClick(handle(Qt::SizeVerCursor), Qt::LeftButton);
        QCOMPARE(places()[0].width(), before[0].width());
        layout->forgetSizes();
        QCOMPARE(places(), before);
        // Cards go away while a handle is in hand.
        CardHandle* const held = handle(Qt::SizeHorCursor);
        delete layout->itemAt(1)->widget();
        drag(held, {-100, 0});
        QCOMPARE(places().size(), 3);
        layout->clear();
        drag(held, {-100, 0});
        QVERIFY(places().isEmpty());
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
