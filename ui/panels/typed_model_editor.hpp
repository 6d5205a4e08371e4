// SPDX-License-Identifier: GPL-3.0-or-later
/// The editor of a typed model, a Lagrangian, a Hamiltonian, a one-form or a bracket
/// (ui/workspace/typed_kind.hpp): the formula, checked while it is typed, the lines of what stands beside it,
/// the equations of motion, the names and the parameters.
///
/// Names that are typed and unknown become coordinates and parameters (ui/workspace/typed_names.hpp).
/// A valid formula becomes part of the scene automatically; one that is not stays in the editor, with the
/// place underlined and a caret below it, while the scene keeps the last sound one. Differentiation runs
/// beside the window.
#pragma once

#include <QTimer>
#include <QWidget>
#include <optional>
#include <stop_token>
#include <string>

#include "engine/core/settings.hpp"
#include "engine/model/typed/typed_model.hpp"
#include "ui/panels/parameter_table.hpp"
#include "ui/workspace/typed_names.hpp"

class QLabel;
class QLineEdit;
class QToolButton;
class QVBoxLayout;

namespace extremal {

class EquationLines;
class FormulaEdit;
class PartLines;
struct TypedKind;
class Workspace;

class TypedModelEditor : public QWidget {
    Q_OBJECT
public:
    explicit TypedModelEditor(Workspace& workspace, QWidget* parent = nullptr);
    ~TypedModelEditor() override;

    /// Shows the scene's formula, or what was typed and refused.
    void refresh();

private:
    void makeFormula(QVBoxLayout& column);
    void follow(const QString& link);
    void makeNames(QVBoxLayout& column);
    void check();
    /// What was found for a text: where it is wrong, else its equations.
    struct Found {
        std::string text;
        typed::Examination examination;
        std::vector<std::string> lines;
        std::string tex;
    };
    void take(const Found& found);
    void edit(const std::string& text);
    void showProblem();
    void changeNames();
    void takeNow();
    void become(const TypedKind& kind);
    bool change(const EditsOfScene& edits, const QString& what, const FollowingText& follow);
    Settings modelNow() const;

    Workspace& workspace_;
    const TypedKind* kind_;  ///< of the scene, or of the last one that was typed
    TypedNames names_;
    QLabel* title_;
    FormulaEdit* text_;
    QLabel *problem_, *note_;
    EquationLines* equations_;
    PartLines* parts_;
    QLabel* namesTitle_;
    QLineEdit* namesEdit_;
    QToolButton* addNames_;
    ParameterTable* parameters_;
    QTimer debounce_;
    std::stop_source stop_;
    int changes_ = 0;
    bool isPending_ = false;  ///< typed, and not yet in the scene or refused
    std::optional<std::size_t> place_;
};

}  // namespace extremal
