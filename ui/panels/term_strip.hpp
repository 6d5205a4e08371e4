// SPDX-License-Identifier: GPL-3.0-or-later
/// A rule for each term of the Lagrangian: one line per term with its rule and its number of nodes. Shown for
/// a space and a rule on a system that says its terms; the first change makes the rule of the scheme that of
/// the other terms.
#pragma once

#include <QWidget>

#include <string>
#include <vector>

#include "engine/core/value.hpp"

class QComboBox;
class QGridLayout;
class QLabel;
class QSpinBox;

namespace extremal {

class Workspace;

class TermStrip : public QWidget {
    Q_OBJECT
public:
    explicit TermStrip(Workspace& workspace, QWidget* parent = nullptr);
    /// Shows the rules of this scheme, or nothing where it can have none for terms.
    void setScheme(int index);

private:
    struct Row {
        std::string term;
        QComboBox* rule;
        QSpinBox* nodes;
    };
    void fill(const std::vector<std::string>& terms);
    void change(const Row& row);

    Workspace& workspace_;
    int index_ = -1;
    QGridLayout* grid_;
    QLabel* caption_;
    std::vector<Row> rows_;
    bool isFilling_ = false;
};

}  // namespace extremal
