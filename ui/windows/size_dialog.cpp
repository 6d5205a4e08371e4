// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/windows/size_dialog.hpp"

#include <QAbstractButton>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QSpinBox>
#include <QVBoxLayout>

#include <cmath>

namespace extremal {
namespace {

PrintSize& lastSize() {
    static PrintSize size;
    return size;
}

}  // namespace

QSize PrintSize::pixels() const {
    const auto of = [](int millimetres) { return static_cast<int>(std::lround(millimetres / 25.4 * 96)); };
    return {of(width), of(height)};
}

SizeDialog::SizeDialog(QWidget* parent) : QDialog(parent) {
    setWindowTitle(tr("Export plot with a size"));
    auto* column = new QVBoxLayout(this);
    auto* form = new QFormLayout;
    const auto field = [&](const QString& text, int low, int high, const QString& unit) {
        auto* box = new QSpinBox(this);
        box->setRange(low, high);
        box->setSuffix(" " + unit);
        form->addRow(text, box);
        return box;
    };
    width_ = field(tr("&Width"), 40, 1000, tr("mm"));
    height_ = field(tr("&Height"), 30, 1000, tr("mm"));
    dots_ = field(tr("&Resolution of PNG"), 72, 1200, tr("dpi"));
    column->addLayout(form);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
    for (QAbstractButton* button : buttons->buttons()) button->setIcon({});
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(this, &QDialog::accepted, this, [this] { lastSize() = chosen(); });
    column->addWidget(buttons);
    choose(lastSize());
}

PrintSize SizeDialog::chosen() const { return {width_->value(), height_->value(), dots_->value()}; }

void SizeDialog::choose(const PrintSize& size) {
    width_->setValue(size.width);
    height_->setValue(size.height);
    dots_->setValue(size.dotsPerInch);
}

}  // namespace extremal
