// SPDX-License-Identifier: GPL-3.0-or-later
/// A number of the scene that a study varies: which, from where to where, how many values, in equal ratios or
/// not.
#pragma once

#include <QObject>

#include <optional>

#include "engine/scene/scene.hpp"
#include "engine/study/stability/stability.hpp"

class QCheckBox;
class QComboBox;
class QGridLayout;
class QLineEdit;
class QWidget;

namespace extremal {

/// One line of a grid of fields; it owns none of them.
class VariedNumberEdit : public QObject {
    Q_OBJECT
public:
    /// `axis`: "x" or "y"; a y may be left out.
    VariedNumberEdit(const QString& axis, QGridLayout& grid, int row, QObject* parent);

    /// Offers the numbers of the scene; keeps what is chosen where the scene has it.
    void offer(const Scene& scene);
    /// None where no number is chosen. Throws InvalidScene where what is typed is not an axis.
    std::optional<VariedNumber> value() const;
    void setVisible(bool isVisible);

private:
    void showRange();
    void enable();

    QString axis_;
    bool isOptional_;
    std::vector<std::pair<std::string, double>> numbers_;  ///< pointers with their present values
    QComboBox* number_;
    QLineEdit *from_, *to_, *count_;
    QCheckBox* isLog_;
    std::vector<QWidget*> fields_;
};

}  // namespace extremal
