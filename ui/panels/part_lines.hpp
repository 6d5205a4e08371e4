// SPDX-License-Identifier: GPL-3.0-or-later
/// The lines under a typed Lagrangian: constraints, forces, damping and what else a model takes beside it
/// (ui/panels/part_kinds.hpp), each with a name, a formula and what is wrong with it.
///
/// A line is part of the scene as soon as its formula is sound; until then it waits here with its problem
/// below it, as the Lagrangian does. All of it works by keyboard: Tab goes from field to field, Return takes
/// a name or a formula.
#pragma once

#include <QTimer>
#include <QWidget>

#include <memory>
#include <string>
#include <vector>

#include "ui/panels/part_kinds.hpp"

class QLabel;
class QLineEdit;
class QToolButton;
class QVBoxLayout;

namespace extremal {

class FormulaEdit;
class TypedNames;
class Workspace;

class PartLines : public QWidget {
    Q_OBJECT
public:
    PartLines(Workspace& workspace, TypedNames& names, QWidget* parent = nullptr);
    ~PartLines() override;

    /// The button that adds a line.
    QWidget* addButton() const;
    /// Shows the lines of the scene, and what was typed and refused.
    void refresh();
    /// Takes what was typed a moment ago at once.
    void takeNow();
    /// Another scene: what was typed in the last one is dropped.
    void forget();

signals:
    void taken();  ///< something was typed, accepted or refused

private:
    struct Field {
        std::string member;  ///< empty: the line is one formula
        FormulaEdit* edit = nullptr;
        bool isPending = false;
    };
    struct Line {
        const PartKind* kind;
        std::string name;
        bool isFresh = false;  ///< not in the scene yet
        QWidget* row = nullptr;
        QLineEdit* nameEdit = nullptr;
        QLabel* problem = nullptr;
        std::vector<Field> fields = {};
        std::string nameProblem = {};
    };
    std::string placeOf(const Line& line) const;
    std::string placeOf(const Line& line, const Field& field) const;
    void makeMenu();
    void add(const PartKind& kind, const std::string& name);
    Line& makeLine(const PartKind& kind, const std::string& name, bool isFresh);
    void makeFields(Line& line, QVBoxLayout& column);
    void rebuild(const std::vector<std::pair<const PartKind*, std::string>>& wanted);
    void take(Line& line, Field& field);
    void rename(Line& line);
    void remove(Line& line);
    void show(Line& line);
    Line* lineOf(const QWidget* row);
    std::string freeNameFor(const PartKind& kind) const;

    Workspace& workspace_;
    TypedNames& names_;
    QVBoxLayout* column_;
    QToolButton* add_;
    std::vector<std::unique_ptr<Line>> lines_;
    QTimer debounce_;
};

}  // namespace extremal
