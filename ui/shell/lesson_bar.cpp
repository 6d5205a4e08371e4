// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/shell/lesson_bar.hpp"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>

#include "ui/base/card.hpp"
#include "ui/base/theme.hpp"
#include "ui/text/text_view.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

LessonBar::LessonBar(Workspace& workspace, Playback& playback, std::function<std::string()> viewInSight,
                     QWidget* parent)
    : QFrame(parent), workspace_(workspace), playback_(playback), viewInSight_(std::move(viewInSight)) {
    setObjectName("lesson");
    setProperty("card", true);
    setProperty("selected", true);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(14, 10, 14, 10);
    column->setSpacing(6);
    text_ = new TextView(this);
    text_->setObjectName("lessonText");
    text_->setAccessibleName(tr("What to do next"));
    text_->setFocusPolicy(Qt::ClickFocus);  // keys stay with the window
    constexpr int mostLines = 12;
    text_->setFitted(mostLines);
    column->addWidget(text_);
    edit_ = new QPlainTextEdit(this);
    edit_->setObjectName("lessonWritten");
    edit_->setAccessibleName(tr("What the reader is told, as Markdown"));
    edit_->setTabChangesFocus(true);
    constexpr int editHeight = 96;
    edit_->setFixedHeight(editHeight);
    edit_->hide();
    edit_->installEventFilter(this);
    column->addWidget(edit_);
    auto* row = new QHBoxLayout;
    place_ = makeLabel({}, "caption", this);
    state_ = makeLabel({}, "strong", this);
    row->addWidget(place_);
    row->addWidget(state_);
    row->addStretch();
    const auto button = [&](const QString& text, const char* kind, void (LessonBar::*act)()) {
        auto* made = new QPushButton(text, this);
        if (*kind) made->setProperty("kind", kind);
        made->setFocusPolicy(Qt::NoFocus);  // keys stay with the window
        connect(made, &QPushButton::clicked, this, act);
        row->addWidget(made);
        return made;
    };
    auto* const change = new QPushButton(tr("Edit"), this);
    change->setObjectName("lessonEdit");
    change->setProperty("kind", "flat");
    change->setFocusPolicy(Qt::TabFocus);
    makeMenu(*change);
    row->addWidget(change);
    do_ = button(tr("Do it for me"), "", &LessonBar::doStep);
    back_ = button(tr("Back"), "", &LessonBar::back);
    next_ = button(tr("Next"), "primary", &LessonBar::next);
    button(tr("End"), "flat", &LessonBar::end)->setAccessibleName(tr("End the lesson"));
    column->addLayout(row);
    hide();
    connect(&workspace_, &Workspace::opened, this, &LessonBar::end);
    connect(&workspace_, &Workspace::sceneChanged, this, &LessonBar::showScene);
}

bool LessonBar::hasLesson() const {
    const Value* steps = workspace_.hasScene() ? workspace_.document().find("steps") : nullptr;
    return steps && steps->isArray() && !steps->asArray().empty();
}

void LessonBar::start() {
    if (!hasLesson()) return;
    steps_ = lessonSteps(workspace_.document(), workspace_.scene());
    if (!steps_.empty()) go(0);
}

void LessonBar::go(int step) {
    finishWriting();
    at_ = step;
    const LessonStep& now = steps_[static_cast<std::size_t>(at_)];
    text_->showText(QString::fromStdString(now.text));
    const auto& schemes = workspace_.scene().schemes;
    const auto scheme = std::find_if(schemes.begin(), schemes.end(),
                                     [&](const SchemeSpec& s) { return s.label == now.scheme; });
    workspace_.selectScheme(scheme == schemes.end() ? -1 : static_cast<int>(scheme - schemes.begin()));
    if (now.time) {
        playback_.setPlaying(false);
        playback_.setTime(*now.time);
    }
    emit viewPointed(QString::fromStdString(now.view));
    showState();
    show();
}

void LessonBar::showState() {
    if (!isRunning()) return;
    const LessonStep& now = steps_[static_cast<std::size_t>(at_)];
    place_->setText(tr("Step %1 of %2").arg(at_ + 1).arg(steps_.size()));
    const bool isDone = isReached(now, workspace_.document());
    state_->setText(now.until.empty() ? QString() : isDone ? tr("✓ done") : QString());
    do_->setVisible(!now.set.empty());
    do_->setEnabled(now.until.empty() || !isDone);
    back_->setEnabled(at_ > 0);
    next_->setText(at_ + 1 < static_cast<int>(steps_.size()) ? tr("Next") : tr("Finish"));
}

void LessonBar::next() {
    if (!isRunning()) return;
    at_ + 1 < static_cast<int>(steps_.size()) ? go(at_ + 1) : end();
}

void LessonBar::back() {
    if (isRunning() && at_ > 0) go(at_ - 1);
}

void LessonBar::doStep() {
    if (!isRunning()) return;
    std::vector<Edit> edits;
    for (const auto& [pointer, value] : steps_[static_cast<std::size_t>(at_)].set)
        edits.push_back({pointer, value});
    if (!edits.empty()) workspace_.edit(edits, tr("a step of the lesson"));
}

void LessonBar::end() {
    finishWriting();
    if (isRunning()) emit viewPointed({});
    at_ = -1;
    hide();
}

/// What the author of a lesson changes on the step that is shown.
void LessonBar::makeMenu(QPushButton& button) {
    auto* const menu = new QMenu(&button);
    menu->addAction(tr("Write this step (Ctrl+Alt+W)"), this, &LessonBar::write);
    menu->addSeparator();
    menu->addAction(tr("Point at the plot that was clicked last"), this, [this] {
        editStep([view = viewInSight_()](Value& step) { step.set("view", view); }, tr("Plot of a step"));
    });
    menu->addAction(tr("Show the time of the cursor"), this, [this] {
        editStep([t = playback_.time()](Value& step) { step.set("time", t); }, tr("Time of a step"));
    });
    menu->addAction(tr("Select the scheme that is selected now"), this, [this] {
        const int at = workspace_.selectedScheme();
        if (at < 0) return;
        const std::string label = workspace_.scene().schemes[static_cast<std::size_t>(at)].label;
        editStep([label](Value& step) { step.set("scheme", label); }, tr("Scheme of a step"));
    });
    menu->addSeparator();
    menu->addAction(tr("Move it earlier"), this, [this] { moveStep(-1); });
    menu->addAction(tr("Move it later"), this, [this] { moveStep(1); });
    menu->addAction(tr("Remove this step"), this, &LessonBar::removeStep);
    button.setMenu(menu);
}

void LessonBar::showScene() {
    if (!isRunning()) return;
    const std::string before = steps_[static_cast<std::size_t>(at_)].text;
    steps_ = hasLesson() ? lessonSteps(workspace_.document(), workspace_.scene()) : std::vector<LessonStep>();
    if (steps_.empty()) return end();
    at_ = std::min(at_, static_cast<int>(steps_.size()) - 1);
    if (const std::string& text = steps_[static_cast<std::size_t>(at_)].text; text != before)
        text_->showText(QString::fromStdString(text));
    showState();
}

bool LessonBar::isWriting() const { return !edit_->isHidden(); }

void LessonBar::write() {
    if (!isRunning() || isWriting()) return;
    edit_->setPlainText(QString::fromStdString(steps_[static_cast<std::size_t>(at_)].text));
    text_->hide();
    edit_->show();
    edit_->setFocus();
}

/// An empty text leaves the step as it is: a step has to say something.
void LessonBar::finishWriting() {
    if (!isWriting()) return;
    const QString written = edit_->toPlainText().trimmed();
    edit_->hide();
    text_->show();
    if (!isRunning() || written.isEmpty()) return;
    if (written.toStdString() == steps_[static_cast<std::size_t>(at_)].text) return;
    editStep([&](Value& step) { step.set("text", written.toStdString()); }, tr("Write a step"));
}

/// The steps of the document, which all are right, are those of the bar.
void LessonBar::editStep(const std::function<void(Value&)>& change, const QString& what) {
    if (!isRunning()) return;
    Value::Array all = workspace_.document().find("steps")->asArray();
    change(all[static_cast<std::size_t>(at_)]);
    workspace_.edit({{"/steps", Value(std::move(all))}}, what);
}

void LessonBar::moveStep(int by) {
    const int to = at_ + by;
    if (!isRunning() || to < 0 || to >= static_cast<int>(steps_.size())) return;
    Value::Array all = workspace_.document().find("steps")->asArray();
    std::swap(all[static_cast<std::size_t>(at_)], all[static_cast<std::size_t>(to)]);
    if (workspace_.edit({{"/steps", Value(std::move(all))}}, tr("Move a step"))) go(to);
}

void LessonBar::removeStep() {
    if (!isRunning()) return;
    Value::Array all = workspace_.document().find("steps")->asArray();
    all.erase(all.begin() + at_);
    const bool isLast = all.empty();
    workspace_.edit({{"/steps", isLast ? std::nullopt : std::optional<Value>(std::move(all))}},
                    tr("Remove a step"));
}

bool LessonBar::eventFilter(QObject* watched, QEvent* event) {
    if (watched != edit_) return QFrame::eventFilter(watched, event);
    if (event->type() == QEvent::FocusOut && isActiveWindow()) finishWriting();
    if (event->type() == QEvent::KeyPress) {
        const auto* const key = static_cast<QKeyEvent*>(event);
        const bool isTaken = key->key() == Qt::Key_Escape ||
                             (key->key() == Qt::Key_Return && key->modifiers() == Qt::ControlModifier);
        if (!isTaken) return false;
        finishWriting();
        return true;
    }
    return false;
}

}  // namespace extremal
