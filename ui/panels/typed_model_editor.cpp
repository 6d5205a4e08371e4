// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/typed_model_editor.hpp"

#include <QCoreApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPointer>
#include <QToolButton>
#include <QUrl>
#include <QVBoxLayout>

#include <algorithm>

#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/model/typed/phase/motion_lines.hpp"
#include "engine/model/typed/written_out.hpp"
#include "ui/base/background.hpp"
#include "ui/base/card.hpp"
#include "ui/base/theme.hpp"
#include "ui/text/equation_lines.hpp"
#include "ui/panels/formula_edit.hpp"
#include "ui/panels/parameter_table.hpp"
#include "ui/panels/part_lines.hpp"
#include "ui/panels/problem_text.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/typed_edits.hpp"
#include "ui/workspace/typed_kind.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

namespace {

constexpr int typingPauseMs = 250;

QString translated(const char* text) { return QCoreApplication::translate("extremal", text); }

/// Characters before a byte of a UTF-8 text, as Qt counts them.
int characterAt(const std::string& text, std::size_t byte) {
    return static_cast<int>(
        QString::fromUtf8(text.data(), static_cast<qsizetype>(std::min(byte, text.size()))).size());
}

/// Whether names by index stand for few enough that their equations can be read.
bool isShortByIndex(const Settings& model, const char* names) {
    constexpr std::size_t most = 24;
    if (!typed::hasIndices(model)) return false;
    const Settings written = typed::writtenOut(model);
    const Value* const all = written.find(names);
    return all && all->isArray() && all->asArray().size() <= most;
}

QString joined(const Value* names) {
    QStringList parts;
    if (names && names->isArray())
        for (const Value& name : names->asArray())
            if (name.isString()) parts << QString::fromStdString(name.asString());
    return parts.join(", ");
}

}  // namespace

TypedModelEditor::TypedModelEditor(Workspace& workspace, QWidget* parent)
    : QWidget(parent), workspace_(workspace), kind_(typedKind("lagrangian")) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(5);
    makeFormula(*column);
    equations_ = new EquationLines;
    column->addWidget(equations_);
    makeNames(*column);
    parameters_ = new ParameterTable(
        workspace, [this](const EditsOfScene& edits, const QString& what, const FollowingText& follow) {
            return change(edits, what, follow);
        });
    column->addWidget(makeLabel(tr("Parameters"), "strong"));
    column->addWidget(parameters_);
    become(*kind_);

    debounce_.setSingleShot(true);
    debounce_.setInterval(typingPauseMs);
    connect(&debounce_, &QTimer::timeout, this, &TypedModelEditor::check);
    connect(text_, &QPlainTextEdit::textChanged, this, [this] {
        isPending_ = true;
        stop_.request_stop();
        debounce_.start();
    });
    connect(&workspace_, &Workspace::sceneChanged, this, &TypedModelEditor::refresh);
    connect(&workspace_, &Workspace::draftsChanged, this, &TypedModelEditor::refresh);
    connect(&workspace_, &Workspace::opened, this, [this] {
        isPending_ = false;
        debounce_.stop();
        parts_->forget();
        names_.forget(workspace_.document());
    });
}

TypedModelEditor::~TypedModelEditor() { stop_.request_stop(); }

/// The text, what is wrong with it, and the equations of motion that come of it.
void TypedModelEditor::makeFormula(QVBoxLayout& column) {
    title_ = makeLabel({}, "strong");
    column.addWidget(title_);
    text_ = new FormulaEdit;
    column.addWidget(text_);
    problem_ = makeLinkLabel("caption");
    problem_->setProperty("problem", true);
    problem_->hide();
    column.addWidget(problem_);
    note_ = makeLinkLabel("caption");
    note_->setObjectName("note.names");
    note_->setAccessibleName(tr("New names"));
    note_->hide();
    column.addWidget(note_);
    for (QLabel* label : {problem_, note_})
        connect(label, &QLabel::linkActivated, this, &TypedModelEditor::follow);
    parts_ = new PartLines(workspace_, names_);
    column.addWidget(parts_);
    connect(parts_, &PartLines::taken, this, &TypedModelEditor::showProblem);
    setTabOrder(text_, parts_->addButton());  // the link of the note comes later
}

/// What the links of the notes do.
void TypedModelEditor::follow(const QString& link) {
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

void TypedModelEditor::makeNames(QVBoxLayout& column) {
    auto* row = new QHBoxLayout;
    row->setSpacing(6);
    namesTitle_ = makeLabel({}, "body");
    namesEdit_ = new QLineEdit;
    namesEdit_->setToolTip(
        tr("Names separated by commas. A renamed coordinate is renamed in the formulas as well."));
    addNames_ = new QToolButton;
    addNames_->setObjectName("addCoordinate");
    addNames_->setText("+");
    row->addWidget(namesTitle_);
    row->addWidget(namesEdit_, 1);
    row->addWidget(addNames_);
    column.addLayout(row);
    connect(namesEdit_, &QLineEdit::editingFinished, this, &TypedModelEditor::changeNames);
    connect(addNames_, &QToolButton::clicked, this, [this] {
        if (namesEdit_->isModified()) changeNames();
        change(editsForNewCoordinates, addNames_->accessibleName(),
               [](const std::string& typed) { return typed; });
    });
}

/// Titles and names of fields by the kind of the formula.
void TypedModelEditor::become(const TypedKind& kind) {
    kind_ = &kind;
    setProperty("help", kind.help);  // of F1
    title_->setText(translated(kind.title));
    text_->setObjectName(QStringLiteral("field.") + kind.formula);
    text_->setAccessibleName(translated(kind.title));
    text_->setToolTip(translated(kind.tip));
    problem_->setObjectName(QStringLiteral("problem.") + kind.formula);
    equations_->setTip(translated(kind.equations));
    const bool areVariables = !kind.hasRates();
    namesTitle_->setText(areVariables ? tr("variables") : tr("coordinates"));
    namesEdit_->setObjectName(QStringLiteral("field.") + kind.names);
    namesEdit_->setAccessibleName(areVariables ? tr("Variables") : tr("Coordinates"));
    addNames_->setAccessibleName(areVariables ? tr("Add two variables") : tr("Add a coordinate"));
    addNames_->setToolTip(areVariables ? tr("Adds two variables that are conjugate, and their energy")
                                       : tr("Adds a coordinate and its kinetic energy"));
}

/// The model as typed: with the names that the formula makes, and with names that were tried and refused.
/// Parameters that are expressions, or new, have the value that the scene has for them, or 1.
Settings TypedModelEditor::modelNow() const {
    std::vector<Edit> tried;
    for (const auto& [pointer, value] : workspace_.drafts())
        if (pointer.starts_with(kind_->namesPlace()) || pointer.starts_with("/model/parameters"))
            tried.push_back({pointer, value});
    Value document = withEdits(workspace_.document(), tried);
    const std::string place = kind_->formulaPlace();
    const Value typed = formulaFrom(formulaOfText(text_->toPlainText().toStdString()));
    document = isPending_ ? withEdits(document, names_.outcomeOf(document, place, typed, false).edits)
                          : withEdits(document, {{place, typed}});
    Settings model = workspace_.scene().model;
    const Value known = model.find("parameters") ? *model.find("parameters") : Value(Value::Object{});
    for (const auto& [key, value] : valueAt(document, "/model")->asObject()) {
        if (key == "type") continue;
        Value now = value;
        if (key == "parameters" && now.isObject())
            for (auto& [name, number] : now.asObject())
                if (!number.isNumber()) number = known.find(name) ? *known.find(name) : Value(1.0);
        const auto old = std::find_if(model.keys.begin(), model.keys.end(),
                                      [&key = key](const Value::Member& m) { return m.first == key; });
        if (old != model.keys.end())
            old->second = std::move(now);
        else
            model.keys.emplace_back(key, std::move(now));
    }
    return model;
}

/// Differentiates in a background thread; the engine remembers the result, so that using it is fast.
void TypedModelEditor::check() {
    if (!isVisibleTo(parentWidget()) || typedKind(workspace_.scene().model.type) != kind_) return;
    stop_.request_stop();
    stop_ = std::stop_source();
    const Settings model = modelNow();
    // As it is typed, so that places in it are those of the text.
    Value whole = settingsTree(model);
    whole.set(kind_->formula, formulaOfText(text_->toPlainText().toStdString()));
    runInBackground([self = QPointer(this), formula = formulaIn(whole), model, names = kind_->names,
                     text = text_->toPlainText().toStdString(), stop = stop_.get_token()] {
        Found found{text, typed::examine(formula, stop), {}, {}};
        if (!found.examination.isComplete) return;
        try {
            // A name by index, x[1..n], is one of those that it is written out to.
            if (!found.examination.position || isShortByIndex(model, names)) {
                found.lines = typed::motionLines(model, typed::TextForm::rich);
                found.tex = typed::texOfMotion(model);
            }
        } catch (const InvalidScene&) {  // the scene says what is wrong
        } catch (const ExpressionError&) {
        }
        sendToWindow([self, found = std::move(found)] {
            if (self) self->take(found);
        });
    });
}

void TypedModelEditor::take(const Found& found) {
    if (found.text != text_->toPlainText().toStdString()) return;  // typed on since
    place_ = found.examination.position;
    equations_->setEquations(found.lines, found.tex);
    if (isPending_) edit(found.text);
    showProblem();
}

/// Makes what was typed part of the scene, or keeps it as refused.
void TypedModelEditor::edit(const std::string& text) {
    isPending_ = false;
    const std::string place = kind_->formulaPlace();
    const Value* now = valueAt(workspace_.document(), place);
    const Value typed = formulaFrom(formulaOfText(text));
    if (now && *now == typed)
        names_.drop(workspace_, place);
    else
        names_.edit(workspace_, place, typed, tr("Change the formula"));
}

void TypedModelEditor::showProblem() {
    const std::string formulaPlace = kind_->formulaPlace(), namesPlace = kind_->namesPlace();
    const std::string typed = text_->toPlainText().toStdString(), text = formulaOfText(typed);
    note_->setText(names_.note().isEmpty()
                       ? QString()
                       : names_.note().toHtmlEscaped() +
                             QStringLiteral(". <a href=\"undo:\">%1</a>").arg(tr("Undo")));
    note_->setVisible(!names_.note().isEmpty());
    // Of the formula, else of the names of the coordinates: there, or what they make wrong elsewhere.
    std::vector<Problem> problems = workspace_.refusalAt(formulaPlace);
    const std::vector<Problem> ofNames = workspace_.refusalAt(namesPlace);
    const bool areNamesWrong = workspace_.draftAt(namesPlace) && !ofNames.empty();
    const bool isFormulaWrong = !problems.empty();
    if (problems.empty()) problems = ofNames;
    if (namesEdit_->property("invalid").toBool() != areNamesWrong) {
        namesEdit_->setProperty("invalid", areNamesWrong);
        repolish(*namesEdit_);
    }
    for (const std::string* place : {&formulaPlace, &namesPlace})
        if (!problems.empty()) workspace_.claimRefusal(*place);
    const bool isWrong = !problems.empty();
    const bool isPlaced = isWrong && place_ && problems.front().pointer.starts_with(formulaPlace);
    problem_->setVisible(isWrong);
    text_->mark(isPlaced && text == typed ? std::optional(characterAt(text, *place_)) : std::nullopt);
    text_->setWrong(isFormulaWrong || isPlaced);
    if (!isWrong) return;
    const Problem& first = problems.front();
    const bool isFormula = first.pointer.starts_with(formulaPlace);
    const QString where = isFormula ? kind_->letter + QStringLiteral(" ")
                          : first.pointer.starts_with(namesPlace)
                              ? QString()
                              : workspace_.placeName(first.pointer) + ": ";
    QString message = QString::fromStdString(first.message.substr(0, first.message.find('\n')));
    if (isFormula && message.startsWith("the expression ")) message.remove(0, 15);  // its letter says so
    QString shown = (where + message).toHtmlEscaped();
    if (!first.hint.empty()) shown += " (" + QString::fromStdString(first.hint).toHtmlEscaped() + ")";
    if (isPlaced) shown = caretHtml(*text_, text, *place_, problem_->width()) + shown;
    for (const std::string& name : names_.slips())
        if (isFormula && first.message.find('"' + name) != std::string::npos)
            shown += " " + QStringLiteral("<a href=\"name:%1\">%2</a>")
                               .arg(QString::fromStdString(name),
                                    tr("%1 is meant").arg(QString::fromStdString(name)));
    problem_->setText(shown + QStringLiteral(" ") + handbookLink(kind_->refused));
}

void TypedModelEditor::changeNames() {
    const std::string namesPlace = kind_->namesPlace();
    std::vector<std::string> names;
    for (const QString& part : namesEdit_->text().split(','))
        if (!part.trimmed().isEmpty()) names.push_back(part.trimmed().toStdString());
    if (joined(valueAt(workspace_.document(), namesPlace)) == namesEdit_->text()) {
        for (const char* place : {namesPlace.c_str(), "/initial"}) workspace_.dropDraft(place);
        return;
    }
    change([&](const Value& document) { return editsForCoordinates(document, names); },
           tr("Change the names"),
           [&, before = workspace_.document()](const std::string& typed) {
               return formulaFor(before, names, typed);
           });
}

/// Takes what was typed a moment ago before its time: into the scene, or as refused.
void TypedModelEditor::takeNow() {
    parts_->takeNow();
    if (!isPending_) return;
    debounce_.stop();
    edit(text_->toPlainText().toStdString());
}

/// Makes edits that change the formula of the scene as well. What is typed and not valid yet is never
/// replaced: it follows a new name, and waits again, as one step of undo.
bool TypedModelEditor::change(const EditsOfScene& edits, const QString& what, const FollowingText& follow) {
    takeNow();
    const std::string formulaPlace = kind_->formulaPlace();
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
    workspace_.edit({{formulaPlace, formulaFrom(formulaOfText(followed))}}, what, step);
    return isMade;
}

void TypedModelEditor::refresh() {
    const TypedKind* const kind = workspace_.hasScene() ? typedKind(workspace_.scene().model.type) : nullptr;
    if (!kind) return;
    if (kind != kind_) become(*kind);
    const std::string formulaPlace = kind->formulaPlace(), namesPlace = kind->namesPlace();
    const Value* draft = workspace_.draftAt(formulaPlace);
    const Value* text = draft ? draft : valueAt(workspace_.document(), formulaPlace);
    if (text && !isPending_) {
        const QString shown = QString::fromStdString(formulaText(*text));
        const bool isSame = formulaFrom(formulaOfText(text_->toPlainText().toStdString())) == *text;
        if (!isSame && shown != text_->toPlainText()) {
            const QSignalBlocker block(text_);
            text_->setPlainText(shown);
            place_.reset();
        }
    }
    const Value* names = workspace_.draftAt(namesPlace);
    if (!names) names = valueAt(workspace_.document(), namesPlace);
    if (!namesEdit_->hasFocus() || !namesEdit_->isModified()) namesEdit_->setText(joined(names));
    parameters_->refresh();
    parts_->refresh();
    showProblem();
    debounce_.start();
}

}  // namespace extremal
