// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/combo_box.hpp"

#include <QStyleOptionComboBox>
#include <QStylePainter>

namespace extremal {

void ComboBox::paintEvent(QPaintEvent*) {
    QStylePainter painter(this);
    QStyleOptionComboBox option;
    initStyleOption(&option);
    const QRect room =
        style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, this);
    const QString whole = currentIndex() < 0 ? placeholderText() : currentText();
    option.currentText =
        fontMetrics().elidedText(whole, Qt::ElideRight, room.width() - 2);  // what Fusion leaves free
    const QString tip = option.currentText == whole ? QString() : whole;
    if (toolTip() == ownTip_ && tip != ownTip_) setToolTip(ownTip_ = tip);
    painter.drawComplexControl(QStyle::CC_ComboBox, option);
    painter.drawControl(QStyle::CE_ComboBoxLabel, option);
}

}  // namespace extremal
