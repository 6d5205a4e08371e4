// SPDX-License-Identifier: GPL-3.0-or-later
/// A box of choices whose text, where it has no room, ends in an ellipsis; the whole of it is in the tooltip.
#pragma once

#include <QComboBox>

namespace extremal {

class ComboBox : public QComboBox {
public:
    using QComboBox::QComboBox;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    QString ownTip_;
};

}  // namespace extremal
