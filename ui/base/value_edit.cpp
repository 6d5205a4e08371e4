// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/value_edit.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLineEdit>
#include <QSpinBox>
#include <QTimer>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/read/json.hpp"
#include "ui/base/combo_box.hpp"
#include "ui/base/format.hpp"
#include "ui/base/theme.hpp"

namespace extremal {

namespace {

int asInt(double limit, int otherwise) {
    return std::isfinite(limit) && std::abs(limit) < 1e9 ? static_cast<int>(limit) : otherwise;
}

}  // namespace

ValueEdit::ValueEdit(const FieldInfo& info, QWidget* parent) : QWidget(parent), info_(info) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    QWidget* input = nullptr;
    if (info.type == FieldType::boolean) {
        input = check_ = new QCheckBox;
        connect(check_, &QCheckBox::toggled, this, [this](bool on) { emit edited(Value(on)); });
    } else if (info.type == FieldType::choice || (info.type == FieldType::integer && !info.choices.empty())) {
        input = choice_ = new ComboBox;
        if (info.isOptional) choice_->addItem(tr("default"));
        for (const std::string& choice : info.choices) choice_->addItem(QString::fromStdString(choice));
        choice_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        choice_->setMinimumContentsLength(6);
        connect(choice_, &QComboBox::activated, this, [this](int i) {
            const bool isInteger = info_.type == FieldType::integer;
            if (info_.isOptional && i == 0) return emit edited(Value());
            emit edited(isInteger ? Value(choice_->itemText(i).toInt())
                                  : Value(choice_->itemText(i).toStdString()));
        });
    } else if (info.type == FieldType::integer) {
        input = spin_ = new QSpinBox;
        const int least = asInt(info.min, -1000000000);
        // A key that is left out: a word below the least number.
        spin_->setRange(info.isOptional ? least - 1 : least, asInt(info.max, 1000000000));
        if (info.isOptional) spin_->setSpecialValueText(tr("default"));
        spin_->setKeyboardTracking(false);
        spin_->setAlignment(Qt::AlignRight);
        connect(spin_, &QSpinBox::valueChanged, this, [this](int i) {
            emit edited(info_.isOptional && i == spin_->minimum() ? Value() : Value(i));
        });
    } else {
        makeText();
        input = text_;
    }
    QString tip = QString::fromStdString(info.description);
    if (info.type == FieldType::number)
        tip += tr("\nA number, or an expression in the model's parameters. Up and Down change it.");
    if (info.type == FieldType::numbers) {
        QStringList names;
        for (const std::string& component : info.components) names << QString::fromStdString(component);
        tip += tr("\nNumbers or expressions, separated by commas: %1.").arg(names.join(", "));
    }
    if (info.type == FieldType::names) tip += tr("\nNames, separated by commas.");
    if (info.type == FieldType::terms)
        tip += tr("\nA formula, or formulas by name: {\"kinetic\": \"p_x^2/2\", \"potential\": \"x^2/2\"}.");
    if (info.type == FieldType::constants)
        tip += tr("\nNames and numbers, separated by commas: a = 1, b = 2.");
    input->setToolTip(tip.trimmed());
    input->setAccessibleName(QString::fromStdString(info.title));
    input->setObjectName("field." + QString::fromStdString(info.key));
    setFocusProxy(input);
    row->addWidget(input);
}

/// The destructor of the base class takes the focus from the text field, which then says that its text is
/// finished.
ValueEdit::~ValueEdit() {
    if (text_) text_->disconnect(this);
}

void ValueEdit::makeText() {
    text_ = new QLineEdit;
    if (info_.type == FieldType::number) text_->setAlignment(Qt::AlignRight);
    if (info_.type == FieldType::number && info_.isOptional) text_->setPlaceholderText(tr("default"));
    text_->setMinimumWidth(info_.type == FieldType::numbers ? 72 : 40);
    text_->installEventFilter(this);
    connect(text_, &QLineEdit::editingFinished, this, &ValueEdit::submitText);
}

void ValueEdit::submitText() {
    if (text_->text() == shown_) return;
    shown_ = text_->text();
    text_->setText(shown_);  // nothing is left to be undone in the field itself: undo is that of the scene
    if (info_.type == FieldType::text) {
        emit edited(Value(shown_.toStdString()));
    } else if (info_.type == FieldType::numbers) {
        emit edited(numbersOrExpressions(shown_));
    } else if (info_.type == FieldType::constants) {
        emit edited(constantsFrom(shown_));
    } else if (info_.type == FieldType::terms && !shown_.trimmed().startsWith('{')) {
        emit edited(Value(shown_.toStdString()));
    } else if (info_.type == FieldType::names) {
        emit edited(formulasFrom(shown_));  // by commas
    } else if (info_.type == FieldType::formulas) {
        const Value formulas = formulasFrom(shown_);
        emit edited(formulas.asArray().empty() ? info_.fallback : formulas);
    } else if (info_.type == FieldType::definitions) {
        emit edited(definitionsFrom(shown_));
    } else if (info_.type == FieldType::json || info_.type == FieldType::terms) {
        try {
            emit edited(parseJson(shown_.toStdString()));
        } catch (const InvalidScene&) {
            emit edited(Value(shown_.toStdString()));  // the scene's own check says what is wrong with it
        }
    } else {
        Value value = numberOrExpression(shown_);
        emit edited(value.isNull() ? info_.fallback : value);
    }
}

/// One notch is one unit of the leading digit's tenth: 9.81 -> 9.91, 1e4 -> 11000.
void ValueEdit::scaleBy(int notches) {
    const auto number = parseNumber(text_->text().trimmed().toStdString());
    if (!number || !std::isfinite(*number)) return;
    const double size = std::abs(*number);
    const double unit = size > 0 ? std::pow(10, std::floor(std::log10(size)) - 1) : 0.1;
    const double next = std::round(*number / unit + notches) * unit;
    text_->setText(QString::fromStdString(formatNumber(next, 12)));
    submitText();
}

bool ValueEdit::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::KeyPress && info_.type == FieldType::number) {
        const int key = static_cast<QKeyEvent*>(event)->key();
        if (key == Qt::Key_Up || key == Qt::Key_Down) {
            scaleBy(key == Qt::Key_Up ? 1 : -1);
            return true;
        }
    }
    return QWidget::eventFilter(watched, event);
}

namespace {

constexpr int mostShown = 100;  // values that can be edited as a text

int valuesIn(const Value& value) {
    int count = 0;
    if (value.isArray())
        for (const Value& each : value.asArray()) count += valuesIn(each);
    else if (value.isObject())
        for (const auto& [key, member] : value.asObject()) count += valuesIn(member);
    else
        count = 1;
    return count;
}

}  // namespace

void ValueEdit::show(const Value& value) {
    const QSignalBlocker b1(check_), b2(spin_), b3(choice_);
    if (check_) check_->setChecked(value.isBool() && value.asBool());
    if (spin_ && value.isNumber())
        spin_->setValue(static_cast<int>(value.asNumber()));
    else if (spin_ && info_.isOptional)
        spin_->setValue(spin_->minimum());
    if (choice_ && info_.isOptional && value.isNull())
        choice_->setCurrentIndex(0);
    else if (choice_)
        choice_->setCurrentText(fieldText(value));
    if (!text_) return;
    // The state of a field has more values than a line holds, and it would cut them.
    const int count = valuesIn(value);
    text_->setReadOnly(count > mostShown);
    const QString text = count > mostShown                      ? tr("%n values", nullptr, count)
                         : info_.type == FieldType::constants   ? constantsText(value)
                         : info_.type == FieldType::formulas    ? formulasText(value)
                         : info_.type == FieldType::names       ? formulasText(value)
                         : info_.type == FieldType::definitions ? definitionsText(value)
                                                                : fieldText(value);
    const bool isTyping = text_->hasFocus() && text_->text() != shown_;
    if (isTyping || text == text_->text()) {
        if (!isTyping) shown_ = text;
        return;
    }
    shown_ = text;
    text_->setText(text);
    text_->setCursorPosition(0);
}

void ValueEdit::setInvalid(bool isInvalid) {
    QWidget* const input = focusProxy();
    if (input->property("invalid").toBool() == isInvalid) return;
    input->setProperty("invalid", isInvalid);
    repolish(*input);
}

}  // namespace extremal
