// SPDX-License-Identifier: GPL-3.0-or-later
/// The parameters of a typed Lagrangian: one row per parameter with its name, value, a slider, and a button
/// that removes it.
#pragma once

#include <QWidget>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "ui/workspace/document.hpp"

class QGridLayout;
class QLabel;
class QLineEdit;
class QSlider;
class QToolButton;

namespace extremal {

class ValueEdit;
class Workspace;

/// The edits of a scene that a change means, and what becomes of a formula that is typed and not valid yet.
using EditsOfScene = std::function<std::vector<Edit>(const Value& document)>;
using FollowingText = std::function<std::string(const std::string& typed)>;
/// Makes edits that change the formula of the scene; false: they were refused.
using FormulaChange =
    std::function<bool(const EditsOfScene& edits, const QString& what, const FollowingText& follow)>;

class ParameterTable : public QWidget {
    Q_OBJECT
public:
    ParameterTable(Workspace& workspace, FormulaChange change, QWidget* parent = nullptr);

    /// Shows the scene's parameters, drafts and problems.
    void refresh();

private:
    /// A slider goes from 0 to twice the value it was made for, or from -1 to 1.
    struct Range {
        double low = 0, high = 2;
        static Range around(double value);
        double at(int position) const;
        int position(double value) const;
        bool contains(double value) const { return value >= low && value <= high; }
    };
    struct Row {
        std::string name;
        QLineEdit* nameEdit;
        ValueEdit* valueEdit;
        QSlider* slider;
        QToolButton* remove;
        Range range;
        bool hasRange;
    };
    void rebuild(const Value::Object& parameters);
    void addRow(const std::string& name);
    void addParameter();
    void rename(const std::string& from, QLineEdit& edit);
    void slide(const std::string& name, int position);
    Row* rowOf(const std::string& name);

    Workspace& workspace_;
    FormulaChange change_;
    QGridLayout* grid_;
    QLabel* problem_;
    std::vector<Row> rows_;
};

}  // namespace extremal
