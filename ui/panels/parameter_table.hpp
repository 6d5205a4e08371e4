/// The parameters of a typed Lagrangian: one row per parameter with its name, value, a slider, and a button
/// that removes it.
#pragma once

#include <QWidget>
#include <string>
#include <vector>

#include "engine/core/value.hpp"

class QGridLayout;
class QLabel;
class QLineEdit;
class QSlider;
class QToolButton;

namespace extremal {

class ValueEdit;
class Workspace;

class ParameterTable : public QWidget {
    Q_OBJECT
public:
    explicit ParameterTable(Workspace& workspace, QWidget* parent = nullptr);

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
    QGridLayout* grid_;
    QLabel* problem_;
    std::vector<Row> rows_;
};

}  // namespace extremal
