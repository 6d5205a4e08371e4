// SPDX-License-Identifier: GPL-3.0-or-later
/// A form: one row per parameter, each bound to a place of the scene. A refused value stays in its field,
/// marked, with the message below it.
#pragma once

#include <QWidget>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/field.hpp"
#include "ui/workspace/document.hpp"

class QGridLayout;
class QLabel;

namespace extremal {

class ValueEdit;
class Workspace;

struct FormField {
    FieldInfo info;
    std::string pointer;  ///< where the value stands
    QString label;        ///< rich text; empty: title and symbol of the descriptor
    /// The edits that a new value means; empty: the value goes to `pointer`.
    std::function<std::vector<Edit>(const Value&)> edits;
    std::string place = {};  ///< where its problems are reported; empty: at `pointer`
};

class Form : public QWidget {
    Q_OBJECT
public:
    explicit Form(Workspace& workspace, QWidget* parent = nullptr);

    void setFields(std::vector<FormField> fields);
    /// Shows the scene's values, drafts and problems.
    void refresh();

private:
    struct Row {
        FormField field;
        ValueEdit* edit;
        QLabel* problem;
    };
    void addRow(FormField field);

    Workspace& workspace_;
    QGridLayout* grid_;
    std::vector<Row> rows_;
};

}  // namespace extremal
