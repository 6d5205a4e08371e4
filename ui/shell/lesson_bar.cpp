// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/shell/lesson_bar.hpp"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>

#include "ui/base/card.hpp"
#include "ui/base/theme.hpp"
#include "ui/text/text_view.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

LessonBar::LessonBar(Workspace& workspace, Playback& playback, QWidget* parent)
    : QFrame(parent), workspace_(workspace), playback_(playback) {
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
    do_ = button(tr("Do it for me"), "", &LessonBar::doStep);
    back_ = button(tr("Back"), "", &LessonBar::back);
    next_ = button(tr("Next"), "primary", &LessonBar::next);
    button(tr("End"), "flat", &LessonBar::end)->setAccessibleName(tr("End the lesson"));
    column->addLayout(row);
    hide();
    connect(&workspace_, &Workspace::opened, this, &LessonBar::end);
    connect(&workspace_, &Workspace::sceneChanged, this, &LessonBar::showState);
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
    if (isRunning()) emit viewPointed({});
    at_ = -1;
    hide();
}

}  // namespace extremal
