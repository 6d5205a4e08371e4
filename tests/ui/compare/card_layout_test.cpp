// SPDX-License-Identifier: GPL-3.0-or-later
/// Rows of plots that have to scroll anyway are higher than those that fit.
#include "ui/compare/card_layout.hpp"

#include <QTest>

#include "tests/tools/test.hpp"

namespace extremal::card_layout_test {

class CardLayoutTest : public QObject {
    Q_OBJECT
private slots:
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
