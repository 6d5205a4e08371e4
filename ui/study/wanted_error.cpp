// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study/wanted_error.hpp"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>

#include <cmath>
#include <optional>

#include "engine/core/text/text.hpp"
#include "ui/base/card.hpp"
#include "ui/base/format.hpp"
#include "ui/base/seek_slider.hpp"
#include "ui/workspace/wanted.hpp"

namespace extremal {
namespace {

constexpr int tenths = 10;  ///< of a power of ten

}  // namespace

WantedError::WantedError(Wanted& wanted, QWidget* parent) : QWidget(parent), wanted_(wanted) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(8);
    text_ = new QLineEdit;
    text_->setObjectName("wantedError");
    text_->setAccessibleName(tr("Wanted error"));
    text_->setMaximumWidth(80);
    text_->setToolTip(
        tr("The largest acceptable value of the metric (W); also a line in the plot, to be dragged"));
    auto* label = makeLabel(tr("wanted error"), "caption");
    label->setBuddy(text_);
    slider_ = new SeekSlider(Qt::Horizontal);
    slider_->setRange(tenths * Wanted::lowestPower, tenths * Wanted::highestPower);
    slider_->setPageStep(tenths);
    slider_->setMinimumWidth(80);
    slider_->setAccessibleName(tr("Wanted error, slider"));
    row->addWidget(label);
    row->addWidget(text_);
    row->addWidget(slider_, 1);
    connect(text_, &QLineEdit::editingFinished, this, &WantedError::readText);
    connect(slider_, &QSlider::valueChanged, this,
            [this](int place) { wanted_.setError(std::pow(10.0, static_cast<double>(place) / tenths)); });
    connect(&wanted_, &Wanted::changed, this, &WantedError::show);
    show();
}

void WantedError::takeFocus() {
    text_->setFocus(Qt::ShortcutFocusReason);
    text_->selectAll();
}

void WantedError::readText() {
    const std::optional<double> number = parseNumber(text_->text().trimmed().toStdString());
    if (number && *number > 0 && std::isfinite(*number))
        wanted_.setError(*number);
    else
        emit refused(text_->text());
    show();
}

void WantedError::show() {
    text_->setText(shortNumber(wanted_.error(), 2));
    const QSignalBlocker blocker(slider_);
    slider_->setValue(static_cast<int>(std::lround(tenths * std::log10(wanted_.error()))));
}

}  // namespace extremal
