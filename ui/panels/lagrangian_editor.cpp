#include "ui/panels/lagrangian_editor.hpp"

#include <QApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPointer>
#include <QToolButton>
#include <QVBoxLayout>

#include "engine/core/expression.hpp"
#include "ui/panels/card.hpp"
#include "ui/panels/problem_text.hpp"
#include "ui/panels/formula_edit.hpp"
#include "ui/panels/lagrangian_edits.hpp"
#include "ui/panels/parameter_table.hpp"
#include "ui/shell/background.hpp"
#include "ui/shell/workspace.hpp"

namespace extremal {

namespace {

constexpr int debounceMs = 250;
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
    column->addWidget(makeLabel(tr("Lagrangian L"), "strong"));
    text_ = new FormulaEdit;
    text_->setObjectName("field.lagrangian");
    text_->setAccessibleName(tr("Lagrangian"));
    text_->setToolTip(
        tr("L as a formula: velocities are x_t or dot(x), time is t. Lines \"slow: ...\" make terms that may "
           "have "
           "rules of their own. Handbook: Typing a Lagrangian."));
    column->addWidget(text_);
    problem_ = makeLinkLabel("caption");
    problem_->setObjectName("problem.lagrangian");
    problem_->setProperty("problem", true);
    problem_->hide();
    column->addWidget(problem_);
    equations_ = makeLabel({}, "body");
    equations_->setObjectName("equations");
    equations_->setAccessibleName(tr("Equations of motion"));
    equations_->setToolTip(tr("The Euler-Lagrange equations"));
    equations_->setWordWrap(true);
    equations_->setTextFormat(Qt::RichText);
    equations_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    column->addWidget(equations_);

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
    column->addLayout(row);
    parameters_ = new ParameterTable(workspace);
    column->addWidget(makeLabel(tr("Parameters"), "strong"));
    column->addWidget(parameters_);

    debounce_.setSingleShot(true);
    debounce_.setInterval(debounceMs);
    connect(&debounce_, &QTimer::timeout, this, &LagrangianEditor::check);
    connect(text_, &QPlainTextEdit::textChanged, this, [this] {
        isPending_ = true;
        stop_.request_stop();
        debounce_.start();
    });
    connect(coordinates_, &QLineEdit::editingFinished, this, &LagrangianEditor::changeCoordinates);
    connect(add, &QToolButton::clicked, this, [this] {
        workspace_.edit(editsForNewCoordinate(workspace_.document()), tr("Add a coordinate"));
    });
    connect(&workspace_, &Workspace::sceneChanged, this, &LagrangianEditor::refresh);
    connect(&workspace_, &Workspace::draftsChanged, this, &LagrangianEditor::refresh);
    connect(&workspace_, &Workspace::opened, this, [this] {
        isPending_ = false;
        debounce_.stop();
    });
}

LagrangianEditor::~LagrangianEditor() { stop_.request_stop(); }

/// The formula as typed, with the names of the scene or of what was last tried.
typed::Formula LagrangianEditor::formulaNow() const {
    Value model = *valueAt(workspace_.document(), "/model");
    for (const char* key : {"coordinates", "parameters"})
        if (const Value* draft = workspace_.draftAt(std::string("/model/") + key)) model.set(key, *draft);
    model.set("lagrangian", text_->toPlainText().toStdString());
    return formulaIn(model);
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
    const auto problems = workspace_.problemsAt("/model");
    const std::string text = text_->toPlainText().toStdString();
    std::string message, hint;
    for (const Problem& p : problems) {
        const bool isFormula = p.pointer.starts_with(formulaPlace);
        if (!(isFormula || p.pointer.starts_with(coordinatesPlace)) || !message.empty()) continue;
        message = (isFormula ? "L " : "") + p.message.substr(0, p.message.find('\n'));
        hint = p.hint;
    }
    const bool isWrong = !message.empty();
    problem_->setVisible(isWrong);
    text_->mark(isWrong && place_ ? std::optional(characterAt(text, *place_)) : std::nullopt);
    if (!isWrong) return;
    QString shown = QString::fromStdString(message).toHtmlEscaped();
    if (!hint.empty()) shown += " (" + QString::fromStdString(hint).toHtmlEscaped() + ")";
    if (place_) {
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
    // A formula that is not valid yet follows the new names as well, and waits again.
    const std::string typed = text_->toPlainText().toStdString();
    const Value* formula = valueAt(workspace_.document(), formulaPlace);
    const bool isUnfinished = !(formula && *formula == lagrangianFrom(typed));
    const std::string renamed = isUnfinished ? formulaFor(workspace_.document(), names, typed) : typed;
    isPending_ = false;
    debounce_.stop();
    workspace_.edit(editsForCoordinates(workspace_.document(), names), tr("Change the coordinates"));
    if (isUnfinished)
        workspace_.edit({{formulaPlace, lagrangianFrom(renamed)}}, tr("Change the coordinates"));
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
