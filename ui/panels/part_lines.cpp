// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/part_lines.hpp"

#include <QCoreApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>

#include "engine/core/text/expression.hpp"
#include "ui/base/card.hpp"
#include "ui/base/theme.hpp"
#include "ui/panels/formula_edit.hpp"
#include "ui/panels/problem_text.hpp"
#include "ui/workspace/typed_edits.hpp"
#include "ui/workspace/typed_kind.hpp"
#include "ui/workspace/typed_names.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

constexpr int lineTypingPauseMs = 250;

QString titleOf(const PartKind& kind) { return QCoreApplication::translate("extremal", kind.title); }

/// By names of the model's: there is a line for each at most.
bool isNamedByModel(const PartKind& kind) {
    return kind.naming == PartNaming::byCoordinate || kind.naming == PartNaming::byPair;
}

std::string keyPlace(const PartKind& kind) { return std::string("/model/") + kind.key; }

/// The names that a kind has in the scene, or in what was typed and refused.
std::vector<std::string> namesOf(const Workspace& workspace, const PartKind& kind) {
    std::vector<std::string> names;
    const std::string place = keyPlace(kind);
    const auto draft = workspace.drafts().find(place);
    const Value* const all =
        draft != workspace.drafts().end() ? &draft->second : valueAt(workspace.document(), place);
    if (kind.naming == PartNaming::single) {
        const bool isThere =
            (all && all->isString() && !all->asString().empty()) || draft != workspace.drafts().end();
        if (isThere) names.emplace_back();
        return names;
    }
    if (all && all->isObject())
        for (const auto& [name, value] : all->asObject()) names.push_back(name);
    for (const auto& [pointer, value] : workspace.drafts()) {
        if (!pointer.starts_with(place + "/")) continue;
        const std::string name =
            pointer.substr(place.size() + 1, pointer.find('/', place.size() + 1) - place.size() - 1);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
}

/// Where in the formula the caret of a message stands; none where it has no caret or shows a part.
std::optional<std::size_t> caretOf(const std::string& message, const std::string& text) {
    const auto first = message.find('\n'), second = message.find('\n', first + 1);
    if (first == std::string::npos || second == std::string::npos) return {};
    const std::string shown = message.substr(first + 1, second - first - 1);
    const auto indent = shown.size() >= text.size() ? shown.size() - text.size() : std::string::npos;
    const auto caret = message.find('^', second);
    if (indent == std::string::npos || shown.substr(indent) != text || caret == std::string::npos) return {};
    const std::size_t column = caret - second - 1;
    return column < indent ? std::nullopt : std::optional(column - indent);
}

/// A formula, or the number that one is.
std::string textOf(const Value* value) {
    if (!value) return {};
    if (value->isString()) return value->asString();
    return value->isNumber() ? QString::number(value->asNumber(), 'g', 15).toStdString() : std::string();
}

Value memberFrom(const std::string& text) {
    bool isNumber = false;
    const double number = QString::fromStdString(text).toDouble(&isNumber);
    return isNumber ? Value(number) : Value(text);
}

}  // namespace

PartLines::PartLines(Workspace& workspace, TypedNames& names, QWidget* parent)
    : QWidget(parent), workspace_(workspace), names_(names) {
    setObjectName("parts");
    column_ = new QVBoxLayout(this);
    column_->setContentsMargins(0, 0, 0, 0);
    column_->setSpacing(4);
    makeMenu();
    column_->addWidget(add_, 0, Qt::AlignLeft);
    debounce_.setSingleShot(true);
    debounce_.setInterval(lineTypingPauseMs);
    connect(&debounce_, &QTimer::timeout, this, &PartLines::takeNow);
}

PartLines::~PartLines() = default;

QWidget* PartLines::addButton() const { return add_; }

void PartLines::makeMenu() {
    add_ = new QToolButton;
    add_->setObjectName("addPart");
    add_->setAccessibleName(tr("Add a constraint, a force, a bracket or what else the model takes"));
    add_->setToolTip(tr("Adds a line for what stands beside the formula"));
    add_->setPopupMode(QToolButton::InstantPopup);
    auto* menu = new QMenu(add_);
    menu->setToolTipsVisible(true);
    add_->setMenu(menu);
    connect(menu, &QMenu::aboutToShow, this, [this, menu] {
        menu->clear();
        for (const PartKind& kind : partKinds()) {
            if (!isOffered(kind, workspace_.scene().model.type)) continue;
            const std::string name = freeNameFor(kind);
            QAction* const action =
                menu->addAction(isNamedByModel(kind) && !name.empty()
                                    ? tr("%1 on %2").arg(titleOf(kind), QString::fromStdString(name))
                                    : titleOf(kind),
                                this, [this, &kind, name] { add(kind, name); });
            action->setObjectName(QStringLiteral("add.") + kind.key);
            action->setToolTip(QCoreApplication::translate("extremal", kind.tip));
            const bool isFull =
                kind.naming != PartNaming::free &&
                (isNamedByModel(kind) ? name.empty()
                                      : std::any_of(lines_.begin(), lines_.end(),
                                                    [&](const auto& l) { return l->kind == &kind; }));
            action->setEnabled(!isFull);
        }
    });
}

/// A name that no line of the kind has; for forces a coordinate without one, empty: each has.
std::string PartLines::freeNameFor(const PartKind& kind) const {
    const auto isTaken = [&](const std::string& name) {
        return std::any_of(lines_.begin(), lines_.end(),
                           [&](const auto& l) { return l->kind == &kind && l->name == name; });
    };
    if (kind.naming == PartNaming::single) return {};
    const std::vector<std::string> names = typedNamesOf(workspace_.document());
    if (kind.naming == PartNaming::byCoordinate) {
        const auto free = std::find_if_not(names.begin(), names.end(), isTaken);
        return free != names.end() ? *free : std::string();
    }
    if (kind.naming == PartNaming::byPair) {
        for (std::size_t i = 0; i < names.size(); ++i)
            for (std::size_t j = i + 1; j < names.size(); ++j)
                if (!isTaken(names[i] + "," + names[j]) && !isTaken(names[j] + "," + names[i]))
                    return names[i] + "," + names[j];
        return {};
    }
    if (!isTaken(kind.firstName)) return kind.firstName;
    for (int i = 2;; ++i)
        if (const std::string name = kind.firstName + std::to_string(i); !isTaken(name)) return name;
}

std::string PartLines::placeOf(const Line& line) const {
    return keyPlace(*line.kind) + (line.name.empty() ? "" : "/" + line.name);
}

std::string PartLines::placeOf(const Line& line, const Field& field) const {
    return placeOf(line) + (field.member.empty() ? "" : "/" + field.member);
}

void PartLines::add(const PartKind& kind, const std::string& name) {
    Line& line = makeLine(kind, name, true);
    refresh();
    line.fields.front().edit->setFocus();
}

PartLines::Line* PartLines::lineOf(const QWidget* row) {
    const auto found =
        std::find_if(lines_.begin(), lines_.end(), [&](const auto& line) { return line->row == row; });
    return found == lines_.end() ? nullptr : found->get();
}

/// A name, the formula, a cross; below them what is wrong.
PartLines::Line& PartLines::makeLine(const PartKind& kind, const std::string& name, bool isFresh) {
    Line& line = *lines_.emplace_back(std::make_unique<Line>(Line{&kind, name, isFresh}));
    const QString id =
        QString::fromLatin1(kind.key) + (name.empty() ? "" : "." + QString::fromStdString(name));
    const QString spoken = titleOf(kind) + " " + QString::fromStdString(name);
    QWidget* const row = line.row = new QWidget;
    row->setObjectName("part." + id);
    auto* whole = new QVBoxLayout(row);
    whole->setContentsMargins(0, 0, 0, 0);
    whole->setSpacing(2);
    auto* head = new QHBoxLayout;
    head->setSpacing(6);
    auto* title = makeLabel(titleOf(kind), "caption");
    title->setToolTip(QCoreApplication::translate("extremal", kind.tip));
    head->addWidget(title);
    if (kind.naming != PartNaming::single) {
        line.nameEdit = new QLineEdit(QString::fromStdString(name));
        line.nameEdit->setObjectName("partName." + id);
        line.nameEdit->setAccessibleName(tr("Name of %1").arg(spoken));
        line.nameEdit->setToolTip(kind.naming == PartNaming::byCoordinate ? tr("The coordinate of this line")
                                  : kind.naming == PartNaming::byPair
                                      ? tr("The two variables, with a comma between")
                                      : tr("A name of your own: columns and plots have it"));
        line.nameEdit->setProperty("room", "value");
        head->addWidget(line.nameEdit);
        connect(line.nameEdit, &QLineEdit::editingFinished, this, [this, row] {
            if (Line* const edited = lineOf(row)) rename(*edited);
        });
    }
    head->addStretch();
    auto* remove = new QToolButton;
    remove->setObjectName("removePart." + id);
    remove->setText("×");
    remove->setAccessibleName(tr("Remove %1").arg(spoken));
    remove->setToolTip(tr("Removes this line"));
    remove->setProperty("room", "mark");
    connect(remove, &QToolButton::clicked, this, [this, row] {
        if (Line* const gone = lineOf(row)) this->remove(*gone);
    });
    head->addWidget(remove);
    whole->addLayout(head);
    makeFields(line, *whole);
    line.problem = makeLinkLabel("caption");
    line.problem->setObjectName("partProblem." + id);
    line.problem->setProperty("problem", true);
    line.problem->hide();
    whole->addWidget(line.problem);
    return line;
}

void PartLines::makeFields(Line& line, QVBoxLayout& column) {
    const PartKind& kind = *line.kind;
    std::vector<PartKind::Member> members = kind.members;
    if (members.empty()) members.push_back({"", ""});
    for (const PartKind::Member& member : members) {
        Field field{member.key};
        const std::size_t index = line.fields.size();
        const std::string place = placeOf(line, field).substr(std::string("/model/").size());
        field.edit = new FormulaEdit;
        field.edit->setLeastLines(1);
        field.edit->setObjectName("partFormula." + QString::fromStdString(place).replace('/', '.'));
        field.edit->setAccessibleName(
            titleOf(kind) + " " + QString::fromStdString(line.name) +
            (field.member.empty() ? "" : ", " + QString::fromStdString(field.member)));
        field.edit->setToolTip(QCoreApplication::translate("extremal", kind.tip));
        field.edit->setPlaceholderText(index == 0 ? QString::fromLatin1(kind.example) : QString());
        field.edit->setPlainText(QString::fromLatin1(line.isFresh ? member.initial : ""));
        auto* row = new QHBoxLayout;
        row->setSpacing(6);
        if (!field.member.empty()) row->addWidget(makeLabel(QString::fromStdString(field.member), "caption"));
        row->addWidget(field.edit, 1);
        if (index == 0 && *kind.tail) row->addWidget(makeLabel(QString::fromUtf8(kind.tail), "body"));
        column.addLayout(row);
        connect(field.edit, &QPlainTextEdit::textChanged, this, [this, widget = line.row, index] {
            Line* const edited = lineOf(widget);
            if (!edited) return;
            edited->fields[index].isPending = true;
            debounce_.start();
        });
        connect(field.edit, &FormulaEdit::returnPressed, this, &PartLines::takeNow);
        line.fields.push_back(field);
    }
}

void PartLines::takeNow() {
    debounce_.stop();
    std::vector<QWidget*> rows;  // lines come and go with the edits
    for (const auto& line : lines_) rows.push_back(line->row);
    bool isAny = false;
    for (QWidget* const row : rows)
        for (std::size_t i = 0; lineOf(row) && i < lineOf(row)->fields.size(); ++i)
            if (Line* const line = lineOf(row); line->fields[i].isPending) {
                isAny = true;
                take(*line, line->fields[i]);
            }
    if (isAny) emit taken();
}

void PartLines::forget() {
    debounce_.stop();
    for (const auto& line : lines_) {
        line->isFresh = false;
        for (Field& field : line->fields) field.isPending = false;
    }
}

void PartLines::take(Line& line, Field& field) {
    field.isPending = false;
    const std::string place = placeOf(line, field);
    const std::string text = formulaOfText(field.edit->toPlainText().trimmed().toStdString());
    if (line.isFresh && text.empty()) return;
    const Value* const now = valueAt(workspace_.document(), place);
    if (now && *now == Value(text)) return names_.drop(workspace_, place);
    const QString what =
        line.isFresh ? tr("Add a %1").arg(titleOf(*line.kind)) : tr("Change the %1").arg(titleOf(*line.kind));
    line.isFresh = false;
    if (line.kind->members.empty()) {
        names_.edit(workspace_, place, text, what);
        return;
    }
    Value whole{Value::Object{}};
    const Value* const there = valueAt(workspace_.document(), placeOf(line));
    if (there && there->isObject()) whole = *there;
    for (const Field& other : line.fields) {
        const std::string member = formulaOfText(other.edit->toPlainText().trimmed().toStdString());
        if (!member.empty() || &other == &line.fields.front()) whole.set(other.member, memberFrom(member));
    }
    names_.edit(workspace_, placeOf(line), whole, what);
}

void PartLines::rename(Line& line) {
    const std::string to = line.nameEdit->text().trimmed().toStdString();
    if (to == line.name) {
        line.nameProblem.clear();
        return show(line);
    }
    const std::string from = line.name, place = keyPlace(*line.kind);
    const auto isSame = [&](const auto& other) {
        return other.get() != &line && other->kind == line.kind && other->name == to;
    };
    if (to.empty() || std::any_of(lines_.begin(), lines_.end(), isSame)) {
        line.nameProblem = to.empty() ? "needs a name" : "there is another \"" + to + "\"";
        return show(line);
    }
    const Value* const all = valueAt(workspace_.document(), place);
    if (line.isFresh || !all || !all->isObject() || !all->find(from)) {  // it is here alone
        line.isFresh = true;                                             // stays while its draft goes
        const std::string old = placeOf(line);
        for (Field& field : line.fields) field.isPending = !field.edit->toPlainText().trimmed().isEmpty();
        names_.drop(workspace_, old);
        line.name = to;
        line.nameProblem.clear();
        takeNow();
        return;
    }
    Value::Object renamed;
    for (const auto& [name, value] : all->asObject()) renamed.emplace_back(name == from ? to : name, value);
    QWidget* const row = line.row;
    line.name = to;
    std::vector<Edit> edits{{place, Value(std::move(renamed))}};
    const Value* const views = valueAt(workspace_.document(), "/views");
    if (views && line.kind->naming == PartNaming::free) renameColumns(*views, "/views", from, to, edits);
    const std::vector<Problem> problems =
        workspace_.tryEdit(edits, tr("Rename %1").arg(QString::fromStdString(from)));
    Line* const left = lineOf(row);
    if (!left) return;
    left->nameProblem = problems.empty() ? std::string() : problems.front().message;
    if (!problems.empty()) {
        left->name = from;
        if (!problems.front().hint.empty()) left->nameProblem += " (" + problems.front().hint + ")";
    }
    show(*left);
}

void PartLines::remove(Line& line) {
    const std::string place = placeOf(line);
    const Value* const all = valueAt(workspace_.document(), keyPlace(*line.kind));
    QWidget* const row = line.row;
    const bool isInScene = valueAt(workspace_.document(), place) && !line.isFresh;
    line.isFresh = false;
    for (Field& field : line.fields) field.isPending = false;
    if (!isInScene) {
        names_.drop(workspace_, place);
        refresh();
        return;
    }
    const bool isLast = all && all->isObject() && all->asObject().size() == 1;
    std::vector<Edit> edits{{isLast ? keyPlace(*line.kind) : place, std::nullopt}};
    const QString what = tr("Remove the %1 %2").arg(titleOf(*line.kind), QString::fromStdString(line.name));
    std::vector<Problem> problems = workspace_.tryEdit(edits, what);
    if (!problems.empty()) {
        const std::vector<Edit> more = withoutRefused(edits, problems);
        if (more.size() > edits.size()) problems = workspace_.tryEdit(more, what);
    }
    if (Line* const left = lineOf(row); left && !problems.empty()) {
        left->nameProblem = problems.front().message;
        show(*left);
    }
}

void PartLines::refresh() {
    const std::string& model = workspace_.scene().model.type;
    QStringList titles;
    for (const PartKind& kind : partKinds())
        if (isOffered(kind, model) && titles.size() < 2) titles << titleOf(kind);
    add_->setText(QStringLiteral("+ ") + titles.join(", ") +
                  (titles.size() > 1 ? QStringLiteral(" ...") : QString()));
    std::vector<std::pair<const PartKind*, std::string>> wanted;
    for (const PartKind& kind : partKinds()) {
        if (!isOffered(kind, model)) continue;
        for (std::string& name : namesOf(workspace_, kind)) wanted.emplace_back(&kind, std::move(name));
        for (const auto& line : lines_) {
            const auto here = std::make_pair(line->kind, line->name);
            if (line->kind == &kind && line->isFresh &&
                std::find(wanted.begin(), wanted.end(), here) == wanted.end())
                wanted.push_back(here);
        }
    }
    rebuild(wanted);
    for (const auto& line : lines_) show(*line);
}

/// Lines that are still there stay, with their cursor; the others go.
void PartLines::rebuild(const std::vector<std::pair<const PartKind*, std::string>>& wanted) {
    const bool isSame = std::equal(
        lines_.begin(), lines_.end(), wanted.begin(), wanted.end(),
        [](const auto& line, const auto& w) { return line->kind == w.first && line->name == w.second; });
    if (!isSame) {
        std::vector<std::unique_ptr<Line>> before = std::move(lines_);
        lines_.clear();
        for (const auto& [kind, name] : wanted) {
            const auto kept = std::find_if(
                before.begin(), before.end(),
                [&, k = kind, &n = name](const auto& l) { return l && l->kind == k && l->name == n; });
            if (kept != before.end())
                lines_.push_back(std::move(*kept));
            else
                makeLine(*kind, name, false);
        }
        for (const auto& gone : before) {
            if (!gone) continue;
            gone->row->hide();
            gone->row->deleteLater();
        }
    }
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        QWidget* const row = lines_[i]->row;
        if (column_->indexOf(row) == static_cast<int>(i)) continue;
        column_->removeWidget(row);
        column_->insertWidget(static_cast<int>(i), row);
        row->show();
    }
}

void PartLines::show(Line& line) {
    if (line.nameEdit && !line.nameEdit->hasFocus() && line.nameProblem.empty())
        line.nameEdit->setText(QString::fromStdString(line.name));
    QString shown;
    for (Field& field : line.fields) {
        const std::string place = placeOf(line, field);
        const Value* const draft = workspace_.draftAt(place);
        const Value* value = draft ? draft : valueAt(workspace_.document(), place);
        const Value* const whole = valueAt(workspace_.document(), placeOf(line));
        // A wall that is one formula is its gap; a control can be a table, which is no formula.
        if (!value && whole && whole->isString() && &field == &line.fields.front()) value = whole;
        const bool isTable = value && value->isObject();
        field.edit->setReadOnly(isTable);
        if (isTable) field.edit->setPlaceholderText(tr("a table in the scene"));
        const std::string text = textOf(value);
        const std::string typed = formulaOfText(field.edit->toPlainText().trimmed().toStdString());
        if (value && !field.isPending && (typed != text || isTable)) {
            const QSignalBlocker block(field.edit);
            field.edit->setPlainText(QString::fromStdString(text));
        }
        const std::vector<Problem> problems = draft ? workspace_.refusalAt(place) : std::vector<Problem>{};
        field.edit->setWrong(!problems.empty());
        std::optional<std::size_t> caret;
        if (!problems.empty()) {
            workspace_.claimRefusal(place);
            const Problem& first = problems.front();
            const bool isHere = first.pointer.starts_with(placeOf(line));
            if (isHere) caret = caretOf(first.message, text);
            Problem plain = first;
            plain.message = first.message.substr(0, first.message.find('\n'));
            const QString where = isHere ? QString() : workspace_.placeName(first.pointer) + ": ";
            shown = (caret ? caretHtml(*field.edit, text, *caret, width()) : QString()) +
                    problemText(plain, where);
        }
        // Of TeX the place is another one.
        const bool isSame = field.edit->toPlainText().toStdString() == text;
        field.edit->mark(caret && isSame ? std::optional(static_cast<int>(*caret)) : std::nullopt);
    }
    if (shown.isEmpty() && !line.nameProblem.empty())
        shown = QString::fromStdString(line.nameProblem).toHtmlEscaped();
    line.problem->setText(shown);
    line.problem->setVisible(!shown.isEmpty());
}

}  // namespace extremal
