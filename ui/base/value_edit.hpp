// SPDX-License-Identifier: GPL-3.0-or-later
/// An input for one parameter, made from its descriptor: a text field for numbers and expressions, a spin box
/// for integers, a box for yes or no, a list for choices.
#pragma once

#include <QWidget>

#include "engine/core/field.hpp"

class QCheckBox;
class QComboBox;
class QLineEdit;
class QSpinBox;

namespace extremal {

class ValueEdit : public QWidget {
    Q_OBJECT
public:
    explicit ValueEdit(const FieldInfo& info, QWidget* parent = nullptr);
    ~ValueEdit() override;

    /// Shows a value; does not disturb what is being typed.
    void show(const Value& value);
    void setInvalid(bool isInvalid);
    /// Changes a number: by units of the tenth of its leading digit.
    void scaleBy(int notches);

signals:
    void edited(const Value& value);

private:
    void makeText();
    void submitText();
    bool eventFilter(QObject* watched, QEvent* event) override;

    FieldInfo info_;
    QLineEdit* text_ = nullptr;
    QSpinBox* spin_ = nullptr;
    QCheckBox* check_ = nullptr;
    QComboBox* choice_ = nullptr;
    QString shown_;
};

}  // namespace extremal
