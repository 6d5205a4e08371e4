// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study/varied_number_edit.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>

#include <algorithm>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/map_grid.hpp"
#include "engine/scene/write/codec.hpp"
#include "ui/base/card.hpp"
#include "ui/base/combo_box.hpp"

namespace extremal {
namespace {

const char* const everyStep = "/schemes/*/step";

/// What can be varied, the most usual first: the step, numbers of the model, initial data, the end.
std::vector<std::pair<std::string, double>> numbersOf(const Scene& scene) {
    std::vector<std::pair<std::string, double>> all;
    for (const SchemeSpec& scheme : scene.schemes)
        if (scheme.isEnabled && scheme.step.value > 0 && all.empty())
            all.emplace_back(everyStep, scheme.step.value);
    for (const ModelParameter& p : parametersOf(scene)) all.emplace_back(p.pointer, p.value);
    const Value document = toValue(scene);
    if (const Value* initial = document.find("initial"); initial && initial->isObject())
        for (const auto& [key, values] : initial->asObject()) {
            if (!values.isArray()) continue;
            for (std::size_t i = 0; i < values.asArray().size(); ++i)
                if (const Value& v = values.asArray()[i]; v.isNumber())
                    all.emplace_back("/initial/" + key + "/" + std::to_string(i), v.asNumber());
        }
    all.emplace_back("/time/end", scene.end.value);
    return all;
}

QString titleOf(const std::string& pointer) {
    if (pointer == everyStep) return VariedNumberEdit::tr("step");
    const std::size_t last = pointer.rfind('/');
    if (pointer.starts_with("/model/")) return QString::fromStdString(pointer.substr(last + 1));
    return QString::fromStdString(pointer.substr(1)).replace('/', ' ');
}

}  // namespace

VariedNumberEdit::VariedNumberEdit(const QString& axis, QGridLayout& grid, int row, QObject* parent)
    : QObject(parent), axis_(axis), isOptional_(axis == "y") {
    const auto field = [&](const QString& name, const QString& tip) {
        auto* edit = new QLineEdit;
        edit->setAccessibleName(name);
        edit->setToolTip(tip);
        edit->setMinimumWidth(58);
        edit->setMaximumWidth(90);
        return edit;
    };
    number_ = new ComboBox;
    number_->setEditable(true);
    number_->setInsertPolicy(QComboBox::NoInsert);
    number_->setMinimumContentsLength(7);
    number_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    number_->setAccessibleName(tr("Number along %1").arg(axis));
    number_->setToolTip(
        tr("What varies along %1: a number of the scene, from the list or by its place, such as /model/k")
            .arg(axis));
    from_ = field(tr("%1 from").arg(axis), tr("The first value"));
    to_ = field(tr("%1 to").arg(axis), tr("The last value"));
    count_ = field(tr("%1 values").arg(axis), tr("How many values"));
    count_->setMinimumWidth(40);
    count_->setMaximumWidth(54);
    isLog_ = new QCheckBox(tr("ratios"));
    isLog_->setAccessibleName(tr("%1 in equal ratios").arg(axis));
    isLog_->setToolTip(tr("Values in equal ratios in place of equal distances"));
    fields_ = {makeLabel(axis, "caption"),
               number_,
               makeLabel(tr("from"), "caption"),
               from_,
               makeLabel(tr("to"), "caption"),
               to_,
               makeLabel(tr("values"), "caption"),
               count_,
               isLog_};
    for (std::size_t i = 0; i < fields_.size(); ++i) grid.addWidget(fields_[i], row, static_cast<int>(i));
    connect(number_, &QComboBox::currentIndexChanged, this, &VariedNumberEdit::showRange);
    connect(number_, &QComboBox::editTextChanged, this, &VariedNumberEdit::enable);
}

void VariedNumberEdit::offer(const Scene& scene) {
    const auto numbers = numbersOf(scene);
    if (numbers == numbers_) return;
    const bool isFirst = numbers_.empty();
    const QString before = number_->currentText();
    numbers_ = numbers;
    const QSignalBlocker blocker(number_);
    number_->clear();
    if (isOptional_) number_->addItem(tr("none"), QString());
    for (const auto& [pointer, value] : numbers_)
        number_->addItem(titleOf(pointer), QString::fromStdString(pointer));
    const int kept = isFirst ? -1 : number_->findText(before);
    number_->setCurrentIndex(std::max(0, kept));
    if (kept < 0) showRange();
    enable();
}

/// Around the present value: a decade to either side of a step, a decade and a half of what is positive, else
/// as much to either side.
void VariedNumberEdit::showRange() {
    const std::string pointer = number_->currentData().toString().toStdString();
    const auto found = std::find_if(numbers_.begin(), numbers_.end(),
                                    [&](const auto& number) { return number.first == pointer; });
    enable();
    if (found == numbers_.end()) return;
    const double value = found->second, reach = pointer == everyStep ? 10 : 30;
    const bool isPositive = value > 0 && !pointer.starts_with("/initial");
    const double half = value == 0 ? 1 : std::abs(value);
    const auto text = [](double number) { return QString::fromStdString(formatNumber(number, 3)); };
    from_->setText(text(isPositive ? value / reach : value - half));
    to_->setText(text(isPositive ? value * reach : value + half));
    isLog_->setChecked(isPositive);
    if (count_->text().isEmpty()) count_->setText(isOptional_ ? "12" : "24");
}

void VariedNumberEdit::enable() {
    const bool isNone =
        isOptional_ && (number_->currentText().isEmpty() || number_->currentText() == tr("none"));
    for (QWidget* field : fields_)
        if (field != number_) field->setEnabled(!isNone);
}

std::optional<VariedNumber> VariedNumberEdit::value() const {
    if (!from_->isEnabled()) return {};
    const int index = number_->findText(number_->currentText());
    const QString pointer = index >= 0 ? number_->itemData(index).toString() : number_->currentText();
    const QString text = QStringLiteral("%1=%2:%3:%4%5")
                             .arg(pointer.trimmed(), from_->text().trimmed(), to_->text().trimmed(),
                                  count_->text().trimmed(), isLog_->isChecked() ? ":log" : "");
    return parseAxis(text.toStdString(), axis_.toStdString());
}

void VariedNumberEdit::setVisible(bool isVisible) {
    for (QWidget* field : fields_) field->setVisible(isVisible);
}

}  // namespace extremal
