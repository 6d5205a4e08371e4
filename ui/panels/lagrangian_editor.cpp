// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/lagrangian_editor.hpp"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPointer>
#include <QToolButton>
#include <QUrl>
#include <QVBoxLayout>

#include "engine/model/typed/part_equations.hpp"
#include "ui/base/background.hpp"
#include "ui/base/card.hpp"
#include "ui/base/theme.hpp"
#include "ui/text/equation_lines.hpp"
#include "ui/panels/formula_edit.hpp"
#include "ui/panels/parameter_table.hpp"
#include "ui/panels/part_kinds.hpp"
#include "ui/panels/part_lines.hpp"
#include "ui/panels/problem_text.hpp"
#include "ui/workspace/lagrangian_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

namespace {

constexpr int typingPauseMs = 250;
constexpr const char* formulaPlace = "/model/lagrangian";
constexpr const char* coordinatesPlace = "/model/coordinates";

/// Characters before a byte of a UTF-8 text, as Qt counts them.
int characterAt(const std::string& text, std::size_t byte) {
    return static_cast<int>(
        QString::fromUtf8(text.data(), static_cast<qsizetype>(std::min(byte, text.size()))).size());
}

QString joined(const Value* names) {
    QStringList parts;
    if (names && names->isArray())
        for (const Value& name : names->asArray())
            if (name.isString()) parts << QString::fromStdString(name.asString());
    return parts.join(", ");
}

}  // namespace

LagrangianEditor::LagrangianEditor(Workspace& workspace, QWidget* parent)
    : QWidget(parent), workspace_(workspace) {
    setProperty("help", "lagrangian");  // of F1
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(5);
    makeFormula(*column);
    equations_ = new EquationLines(
        tr("The Euler-Lagrange equations; λ is the multiplier of a constraint, the force that keeps it"));
    column->addWidget(equations_);
    makeCoordinates(*column);
    parameters_ = new ParameterTable(
        workspace, [this](const EditsOfScene& edits, const QString& what, const FollowingText& follow) {
            return change(edits, what, follow);
        });
    column->addWidget(makeLabel(tr("Parameters"), "strong"));
    column->addWidget(parameters_);

    debounce_.setSingleShot(true);
    debounce_.setInterval(typingPauseMs);
    connect(&debounce_, &QTimer::timeout, this, &LagrangianEditor::check);
    connect(text_, &QPlainTextEdit::textChanged, this, [this] {
        isPending_ = true;
        stop_.request_stop();
        debounce_.start();
    });
    connect(&workspace_, &Workspace::sceneChanged, this, &LagrangianEditor::refresh);
    connect(&workspace_, &Workspace::draftsChanged, this, &LagrangianEditor::refresh);
    connect(&workspace_, &Workspace::opened, this, [this] {
        isPending_ = false;
        debounce_.stop();
        parts_->forget();
        names_.forget(workspace_.document());
    });
}

LagrangianEditor::~LagrangianEditor() { stop_.request_stop(); }

/// The text, what is wrong with it, and the equations of motion that come of it.
void LagrangianEditor::makeFormula(QVBoxLayout& column) {
    column.addWidget(makeLabel(tr("Lagrangian L"), "strong"));
    text_ = new FormulaEdit;
    text_->setObjectName("field.lagrangian");
    text_->setAccessibleName(tr("Lagrangian"));
    text_->setToolTip(
        tr("L as a formula: velocities are x_t or dot(x), time is t. Lines \"slow: ...\" make terms that may "
           "have rules of their own. Handbook: Typing a Lagrangian."));
    column.addWidget(text_);
    problem_ = makeLinkLabel("caption");
    problem_->setObjectName("problem.lagrangian");
    problem_->setProperty("problem", true);
    problem_->hide();
    column.addWidget(problem_);
    note_ = makeLinkLabel("caption");
    note_->setObjectName("note.names");
    note_->setAccessibleName(tr("New names"));
    note_->hide();
    column.addWidget(note_);
    for (QLabel* label : {problem_, note_})
        connect(label, &QLabel::linkActivated, this, &LagrangianEditor::follow);
    parts_ = new PartLines(workspace_, names_);
    column.addWidget(parts_);
    connect(parts_, &PartLines::taken, this, &LagrangianEditor::showProblem);
    setTabOrder(text_, parts_->addButton());  // the link of the note comes later
}

/// What the links of the notes do.
void LagrangianEditor::follow(const QString& link) {
    const QUrl url(link);
    if (url.scheme() == QLatin1String("undo")) {
        names_.clearNote();
        workspace_.undo();
    } else if (url.scheme() == QLatin1String("name")) {
        names_.mean(url.path().toStdString());
        isPending_ = true;
        check();
    }
}

void LagrangianEditor::makeCoordinates(QVBoxLayout& column) {
    auto* row = new QHBoxLayout;
    row->setSpacing(6);
    coordinates_ = new QLineEdit;
    coordinates_->setObjectName("field.coordinates");
    coordinates_->setAccessibleName(tr("Coordinates"));
    coordinates_->setToolTip(
        tr("Names separated by commas. A renamed coordinate is renamed in the formula as well."));
    auto* add = new QToolButton;
    add->setObjectName("addCoordinate");
    add->setText("+");
    add->setAccessibleName(tr("Add a coordinate"));
    add->setToolTip(tr("Adds a coordinate and its kinetic energy"));
    row->addWidget(makeLabel(tr("coordinates"), "body"));
    row->addWidget(coordinates_, 1);
    row->addWidget(add);
    column.addLayout(row);
    connect(coordinates_, &QLineEdit::editingFinished, this, &LagrangianEditor::changeCoordinates);
    connect(add, &QToolButton::clicked, this, [this] {
        if (coordinates_->isModified()) changeCoordinates();
        change(editsForNewCoordinate, tr("Add a coordinate"), [](const std::string& typed) { return typed; });
    });
}

/// The model as typed: with the names that the formula makes, and with names that were tried and refused.
Value LagrangianEditor::modelNow() const {
    std::vector<Edit> tried;
    for (const auto& [pointer, value] : workspace_.drafts())
        if (pointer.starts_with("/model/coordinates") || pointer.starts_with("/model/parameters"))
            tried.push_back({pointer, value});
    Value document = withEdits(workspace_.document(), tried);
    const Value typed = lagrangianFrom(formulaOfText(text_->toPlainText().toStdString()));
    document = isPending_ ? withEdits(document, names_.outcomeOf(document, formulaPlace, typed, false).edits)
                          : withEdits(document, {{formulaPlace, typed}});
    return *valueAt(document, "/model");
}

/// Differentiates in a background thread; the engine remembers the result, so that using it is fast.
void LagrangianEditor::check() {
    if (!isVisibleTo(parentWidget()) || workspace_.scene().model.type != "lagrangian") return;
    stop_.request_stop();
    stop_ = std::stop_source();
    Value model = modelNow();
    // As it is typed, so that places in it are those of the text.
    model.set("lagrangian", formulaOfText(text_->toPlainText().toStdString()));
    runInBackground([self = QPointer(this), formula = formulaIn(model), parts = partTextsOf(model),
                     text = text_->toPlainText().toStdString(), stop = stop_.get_token()] {
        Found found{text, typed::examine(formula, stop), {}, {}};
        if (!found.examination.isComplete) return;
        if (!found.examination.equations.empty()) {
            found.lines = typed::equationLines(formula, parts, typed::TextForm::rich);
            found.tex = typed::texOfEquations(formula, parts);
        }
        sendToWindow([self, found = std::move(found)] {
            if (self) self->take(found);
        });
    });
}

void LagrangianEditor::take(const Found& found) {
    if (found.text != text_->toPlainText().toStdString()) return;  // typed on since
    place_ = found.examination.position;
    equations_->setEquations(found.lines, found.tex);
    if (isPending_) edit(found.text);
    showProblem();
}

/// Makes what was typed part of the scene, or keeps it as refused.
void LagrangianEditor::edit(const std::string& text) {
    isPending_ = false;
    const Value* now = valueAt(workspace_.document(), formulaPlace);
    const Value typed = lagrangianFrom(formulaOfText(text));
    if (now && *now == typed)
        names_.drop(workspace_, formulaPlace);
    else
        names_.edit(workspace_, formulaPlace, typed, tr("Change the Lagrangian"));
}

void LagrangianEditor::showProblem() {
    const std::string typed = text_->toPlainText().toStdString(), text = formulaOfText(typed);
    note_->setText(names_.note().isEmpty()
                       ? QString()
                       : names_.note().toHtmlEscaped() +
                             QStringLiteral(". <a href=\"undo:\">%1</a>").arg(tr("Undo")));
    note_->setVisible(!names_.note().isEmpty());
    // Of the formula, else of the names of the coordinates: there, or what they make wrong elsewhere.
    std::vector<Problem> problems = workspace_.refusalAt(formulaPlace);
    const std::vector<Problem> ofNames = workspace_.refusalAt(coordinatesPlace);
    const bool areNamesWrong = workspace_.draftAt(coordinatesPlace) && !ofNames.empty();
    const bool isFormulaWrong = !problems.empty();
    if (problems.empty()) problems = ofNames;
    if (coordinates_->property("invalid").toBool() != areNamesWrong) {
        coordinates_->setProperty("invalid", areNamesWrong);
        repolish(*coordinates_);
    }
    for (const char* place : {formulaPlace, coordinatesPlace})
        if (!problems.empty()) workspace_.claimRefusal(place);
    const bool isWrong = !problems.empty();
    const bool isPlaced = isWrong && place_ && problems.front().pointer.starts_with(formulaPlace);
    problem_->setVisible(isWrong);
    text_->mark(isPlaced && text == typed ? std::optional(characterAt(text, *place_)) : std::nullopt);
    text_->setWrong(isFormulaWrong || isPlaced);
    if (!isWrong) return;
    const Problem& first = problems.front();
    const bool isFormula = first.pointer.starts_with(formulaPlace);
    const QString where = isFormula ? QStringLiteral("L ")
                          : first.pointer.starts_with(coordinatesPlace)
                              ? QString()
                              : workspace_.placeName(first.pointer) + ": ";
    QString shown =
        (where + QString::fromStdString(first.message.substr(0, first.message.find('\n')))).toHtmlEscaped();
    if (!first.hint.empty()) shown += " (" + QString::fromStdString(first.hint).toHtmlEscaped() + ")";
    if (isPlaced) shown = caretHtml(*text_, text, *place_, problem_->width()) + shown;
    for (const std::string& name : names_.slips())
        if (isFormula && first.message.find('"' + name) != std::string::npos)
            shown += " " + QStringLiteral("<a href=\"name:%1\">%2</a>")
                               .arg(QString::fromStdString(name),
                                    tr("%1 is meant").arg(QString::fromStdString(name)));
    problem_->setText(shown + QStringLiteral(" ") + handbookLink("lagrangian#what-is-refused"));
}

void LagrangianEditor::changeCoordinates() {
    std::vector<std::string> names;
    for (const QString& part : coordinates_->text().split(','))
        if (!part.trimmed().isEmpty()) names.push_back(part.trimmed().toStdString());
    if (joined(valueAt(workspace_.document(), coordinatesPlace)) == coordinates_->text()) {
        for (const char* place : {coordinatesPlace, "/initial"}) workspace_.dropDraft(place);
        return;
    }
    change([&](const Value& document) { return editsForCoordinates(document, names); },
           tr("Change the coordinates"),
           [&, before = workspace_.document()](const std::string& typed) {
               return formulaFor(before, names, typed);
           });
}

/// Takes what was typed a moment ago before its time: into the scene, or as refused.
void LagrangianEditor::takeNow() {
    parts_->takeNow();
    if (!isPending_) return;
    debounce_.stop();
    edit(text_->toPlainText().toStdString());
}

/// Makes edits that change the formula of the scene as well. What is typed and not valid yet is never
/// replaced: it follows a new name, and waits again, as one step of undo.
bool LagrangianEditor::change(const EditsOfScene& edits, const QString& what, const FollowingText& follow) {
    takeNow();
    if (!workspace_.draftAt(formulaPlace)) return workspace_.edit(edits(workspace_.document()), what);
    const std::string typed = text_->toPlainText().toStdString(), followed = follow(typed);
    const QString step = QStringLiteral("formula%1").arg(++changes_);
    isPending_ = true;  // keeps the text while the scene changes
    const bool isMade = workspace_.edit(edits(workspace_.document()), what, step);
    if (followed != typed) {
        const QSignalBlocker block(text_);
        const int position = text_->textCursor().position();
        text_->setPlainText(QString::fromStdString(followed));
        QTextCursor cursor = text_->textCursor();
        cursor.setPosition(std::min(position, static_cast<int>(text_->document()->characterCount()) - 1));
        text_->setTextCursor(cursor);
    }
    isPending_ = false;
    workspace_.edit({{formulaPlace, lagrangianFrom(formulaOfText(followed))}}, what, step);
    return isMade;
}

void LagrangianEditor::refresh() {
    if (!workspace_.hasScene() || workspace_.scene().model.type != "lagrangian") return;
    const Value* draft = workspace_.draftAt(formulaPlace);
    const Value* text = draft ? draft : valueAt(workspace_.document(), formulaPlace);
    if (text && !isPending_) {
        const QString shown = QString::fromStdString(lagrangianText(*text));
        const bool isSame = lagrangianFrom(formulaOfText(text_->toPlainText().toStdString())) == *text;
        if (!isSame && shown != text_->toPlainText()) {
            const QSignalBlocker block(text_);
            text_->setPlainText(shown);
            place_.reset();
        }
    }
    const Value* names = workspace_.draftAt(coordinatesPlace);
    if (!names) names = valueAt(workspace_.document(), coordinatesPlace);
    if (!coordinates_->hasFocus() || !coordinates_->isModified()) coordinates_->setText(joined(names));
    parameters_->refresh();
    parts_->refresh();
    showProblem();
    debounce_.start();
}

}  // namespace extremal
