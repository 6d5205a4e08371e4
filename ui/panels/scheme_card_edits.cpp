// SPDX-License-Identifier: GPL-3.0-or-later
/// What is typed in a row, and its keys.
#include <QFocusEvent>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QToolTip>
#include <QVBoxLayout>

#include "engine/model/system.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/resolve.hpp"
#include "ui/base/format.hpp"
#include "ui/base/plain_tips.hpp"
#include "ui/base/scrub_label.hpp"
#include "ui/base/theme.hpp"
#include "ui/panels/scheme_card.hpp"
#include "ui/panels/scheme_editor.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

void SchemeCard::editName() {
    nameEdit_->setText(name_->text());
    name_->hide();
    nameEdit_->show();
    nameEdit_->selectAll();
    nameEdit_->setFocus();
}

void SchemeCard::finishName() {
    if (nameEdit_->isHidden()) return;
    nameEdit_->hide();
    name_->show();
    const std::string text = nameEdit_->text().trimmed().toStdString();
    if (text.empty() || text == spec().label) return;
    workspace_.edit(
        {{"/schemes/" + std::to_string(index_) + "/label", uniqueLabel(workspace_.scene(), text)}},
        tr("Rename scheme"));
}

void SchemeCard::editStep(const QString& typed) {
    stepEdit_->setText(typedStep());
    step_->hide();
    stepEdit_->show();
    stepEdit_->setFocus();
    stepEdit_->selectAll();
    if (!typed.isEmpty()) stepEdit_->insert(typed);
}

bool SchemeCard::hasElements() const {
    const auto& resolved = workspace_.resolved();
    return resolved && !resolved->system->isMotion();
}

/// What the field of the step begins with.
QString SchemeCard::typedStep() const {
    const SchemeSpec& s = spec();
    if (hasElements()) return QString::number(elementsOf(s));
    return s.tolerance ? shortNumber(*s.tolerance, 6) : numberText(s.step);
}

/// What is typed there means the tolerance, the number of elements or the step, whichever the scheme has.
Edit SchemeCard::stepEdit(const Value& typed) const {
    const std::string scheme = "/schemes/" + std::to_string(index_);
    if (!hasElements()) return {scheme + (spec().tolerance ? "/tolerance" : "/step"), typed};
    if (spec().space.find("elements")) return {scheme + "/space/elements", typed};
    const std::string number = typed.isString() ? "(" + typed.asString() + ")" : writeCompactJson(typed);
    return {scheme + "/step", Value("1/" + number)};
}

std::string SchemeCard::stepPlace() const { return stepEdit(Value()).pointer; }

void SchemeCard::finishStep() {
    if (stepEdit_->isHidden()) return;
    const Value value = numberOrExpression(stepEdit_->text());
    const Edit edit = stepEdit(value);
    const std::string& at = edit.pointer;
    const Value* const now = valueAt(workspace_.document(), at);
    const Value* const draft = workspace_.draftAt(at);
    const bool isChanged =
        !value.isNull() && stepEdit_->isModified() && !(now && edit.value && *now == *edit.value);
    if (draft && !stepEdit_->isModified()) return;  // what was refused stays until it is changed
    stepEdit_->hide();
    step_->show();
    if (!isChanged) return workspace_.dropDraft(at);
    workspace_.edit({edit}, hasElements() ? tr("Change the number of elements") : tr("Change the step"),
                    QString::fromStdString(at));
}

/// The digits are keys of the window as well: at a card that has the focus they are typed.
bool SchemeCard::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride) {
        auto* key = static_cast<QKeyEvent*>(event);
        const QString text = key->text();
        if (!(key->modifiers() & ~Qt::KeypadModifier) && text.size() == 1 &&
            (text[0].isDigit() || text == "."))
            key->accept();
    }
    return QFrame::event(event);
}

void SchemeCard::keyPressEvent(QKeyEvent* event) {
    const QString text = event->text();
    if (!(event->modifiers() & ~Qt::KeypadModifier) && text.size() == 1 && (text[0].isDigit() || text == "."))
        return editStep(text);
    // Keys that a field in the card has left over are not those of the row.
    const bool isPlain = hasFocus() && !(event->modifiers() & ~Qt::KeypadModifier);
    if (isPlain && (event->key() == Qt::Key_Up || event->key() == Qt::Key_Down))
        emit neighbourRequested(index_, event->key() == Qt::Key_Up ? -1 : 1);
    else if (isPlain && (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter))
        setEditing(!isEditing());
    else
        QFrame::keyPressEvent(event);
}

/// A row that is reached by the keyboard is chosen, as by a click. The focus that a window gives back when it
/// becomes active again chooses nothing.
void SchemeCard::focusInEvent(QFocusEvent* event) {
    if (event->reason() == Qt::TabFocusReason || event->reason() == Qt::BacktabFocusReason)
        workspace_.selectScheme(index_);
    QFrame::focusInEvent(event);
}

void SchemeCard::setEditing(bool isOpen) {
    if (isOpen == isEditing()) return;
    if (!isOpen) {
        editor_->deleteLater();
        editor_ = nullptr;
        return showRefusal();
    }
    editor_ = new SchemeEditor(workspace_, index_);
    connect(editor_, &SchemeEditor::closed, this, [this] { setEditing(false); });
    layout_->insertWidget(2, editor_);
    showRefusal();
}

/// A click on a number explains it at once. The release stops here: handed on to the row behind the number,
/// it would be one more click, with which Qt takes every tip away.
bool SchemeCard::eventFilter(QObject* watched, QEvent* event) {
    auto* const label = qobject_cast<QLabel*>(watched);
    if (event->type() != QEvent::MouseButtonRelease || !label) return QFrame::eventFilter(watched, event);
    QToolTip::showText(label->mapToGlobal(QPoint(0, label->height())), plainTip(label->toolTip()), label);
    return true;
}

}  // namespace extremal
