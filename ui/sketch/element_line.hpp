// SPDX-License-Identifier: GPL-3.0-or-later
/// The values of one element of a mechanism in a line: its name, and a field for each number of its kind.
#pragma once

#include <QWidget>

#include <optional>
#include <string>

#include "engine/core/value.hpp"
#include "ui/sketch/mechanism_drawing.hpp"

class QHBoxLayout;

namespace extremal {

class ElementLine : public QWidget {
    Q_OBJECT
public:
    explicit ElementLine(QWidget* parent = nullptr);

    /// Nothing selected: the line says so.
    void show(const MechanismDrawing& drawing, const std::optional<MechanismDrawing::Element>& element);

signals:
    void renamed(const QString& name);
    void edited(const std::string& key, const Value& value);  ///< null: left out

private:
    void rebuild(const MechanismDrawing& drawing);
    QHBoxLayout* row_;
    std::optional<MechanismDrawing::Element> element_;
    std::string shape_;  ///< of the fields that are there
};

}  // namespace extremal
