// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/lagrangian_editor.hpp"

#include <QApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPointer>
#include <QToolButton>
#include <QVBoxLayout>

#include "engine/core/text/expression.hpp"
#include "ui/base/background.hpp"
#include "ui/base/card.hpp"
#include "ui/base/theme.hpp"
#include "ui/panels/formula_edit.hpp"
#include "ui/panels/parameter_table.hpp"
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
    equations_ = makeLabel({}, "body");
    equations_->setObjectName("equations");
    equations_->setAccessibleName(tr("Equations of motion"));
    equations_->setToolTip(tr("The Euler-Lagrange equations"));
    equations_->setWordWrap(true);
    equations_->setTextFormat(Qt::RichText);
    equations_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    column.addWidget(equations_);
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

/// The formula as typed, with the names of the scene or of what was last tried.
typed::Formula LagrangianEditor::formulaNow() const {
    Value model = *valueAt(workspace_.document(), "/model");
    for (const char* key : {"coordinates", "parameters"})
        if (const Value* draft = workspace_.draftAt(std::string("/model/") + key)) model.set(key, *draft);
    model.set("lagrangian", text_->toPlainText().toStdString());
    return formulaIn(model);
}

/// Whether the model has constraints or forces beside its Lagrangian.
bool LagrangianEditor::hasDrive(const Value& document) {
    for (const char* key : {"constraints", "forces", "dissipation"})
        if (valueAt(document, std::string("/model/") + key)) return true;
    return false;
}

/// Differentiates in a background thread; the engine remembers the result, so that using it is fast.
void LagrangianEditor::check() {
    if (!isVisibleTo(parentWidget()) || workspace_.scene().model.type != "lagrangian") return;
    stop_.request_stop();
    stop_ = std::stop_source();
    runInBackground([self = QPointer(this), formula = formulaNow(), text = text_->toPlainText().toStdString(),
                     stop = stop_.get_token()] {
        const typed::Examination found = typed::examine(formula, stop);
        if (!found.isComplete) return;
        sendToWindow([self, text, found] {
            if (self) self->take(text, found);
        });
    });
}

void LagrangianEditor::take(const std::string& text, const typed::Examination& found) {
    if (text != text_->toPlainText().toStdString()) return;  // typed on since
    place_ = found.position;
    if (!found.equations.empty()) {
        QString lines;
        for (const std::string& line : found.equations)
            lines += "<p style='margin:2px 0'>" + QString::fromStdString(line) + "</p>";
        // With constraints and forces the left-hand sides are these.
        if (hasDrive(workspace_.document())) {
            lines.replace(" = 0</p>", " = <i>Q</i></p>");
            lines += "<p style='margin:2px 0'>" + tr("Q: forces, and reactions of constraints") + "</p>";
        }
        equations_->setText(lines);
    }
    equations_->setVisible(!found.equations.empty());
    if (isPending_) {
        isPending_ = false;
        const Value* now = valueAt(workspace_.document(), formulaPlace);
        const Value typed = lagrangianFrom(text);
        if (now && *now == typed)
            workspace_.dropDraft(formulaPlace);
        else
            workspace_.edit({{formulaPlace, typed}}, tr("Change the Lagrangian"), formulaPlace);
    }
    showProblem();
}

void LagrangianEditor::showProblem() {
    const std::string text = text_->toPlainText().toStdString();
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
    text_->mark(isPlaced ? std::optional(characterAt(text, *place_)) : std::nullopt);
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
    if (isPlaced) {
        const QFontMetrics metrics(text_->font());
        const int columns = std::max(16, problem_->width() / metrics.horizontalAdvance('x'));
        const auto lines =
            caretLines(text, std::min(*place_, text.size()), static_cast<std::size_t>(columns / 2 - 4), "");
        shown = "<pre style='font-family:\"" + text_->font().family() +
                "\";font-size:" + QString::number(QFontInfo(text_->font()).pixelSize()) + "px;margin:0'>" +
                QString::fromStdString(lines).toHtmlEscaped() + "</pre>" + shown;
    }
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
    if (!isPending_) return;
    isPending_ = false;
    debounce_.stop();
    const Value* const now = valueAt(workspace_.document(), formulaPlace);
    const Value typed = lagrangianFrom(text_->toPlainText().toStdString());
    if (now && *now == typed)
        workspace_.dropDraft(formulaPlace);
    else
        workspace_.edit({{formulaPlace, typed}}, tr("Change the Lagrangian"), formulaPlace);
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
    workspace_.edit({{formulaPlace, lagrangianFrom(followed)}}, what, step);
    return isMade;
}

void LagrangianEditor::refresh() {
    if (!workspace_.hasScene() || workspace_.scene().model.type != "lagrangian") return;
    const Value* draft = workspace_.draftAt(formulaPlace);
    const Value* text = draft ? draft : valueAt(workspace_.document(), formulaPlace);
    if (text && !isPending_) {
        const QString shown = QString::fromStdString(lagrangianText(*text));
        const bool isSame = lagrangianFrom(text_->toPlainText().toStdString()) == *text;
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
    showProblem();
    debounce_.start();
}

}  // namespace extremal
