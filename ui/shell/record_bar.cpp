// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/shell/record_bar.hpp"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

#include <utility>

#include "ui/base/card.hpp"
#include "ui/base/format.hpp"
#include "ui/workspace/changes.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

/// Words of a document, which a step does not ask the reader to change.
bool isOfWords(const std::string& pointer) {
    for (const char* key : {"/steps", "/title", "/notes", "/lesson", "/source"})
        if (pointer.starts_with(key)) return true;
    return false;
}

bool isPlain(const Value& value) { return value.isNumber() || value.isString() || value.isBool(); }

}  // namespace

RecordBar::RecordBar(Workspace& workspace, Playback& playback, std::function<std::string()> viewInSight,
                     QWidget* parent)
    : QFrame(parent), workspace_(workspace), playback_(playback), viewInSight_(std::move(viewInSight)) {
    setObjectName("record");
    setProperty("card", true);
    setProperty("selected", true);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(14, 8, 14, 8);
    count_ = makeLabel({}, "strong", this);
    row->addWidget(count_);
    text_ = new QLineEdit(this);
    text_->setObjectName("stepText");
    text_->setAccessibleName(tr("What the reader is told"));
    text_->setPlaceholderText(tr("What the reader is told; change the scene, select a scheme, click a plot"));
    row->addWidget(text_, 1);
    const auto button = [&](const QString& text, const char* kind, void (RecordBar::*act)()) {
        auto* made = new QPushButton(text, this);
        if (*kind) made->setProperty("kind", kind);
        made->setFocusPolicy(Qt::TabFocus);
        connect(made, &QPushButton::clicked, this, act);
        row->addWidget(made);
    };
    button(tr("Record this step"), "primary", &RecordBar::recordStep);
    button(tr("Finish"), "", &RecordBar::finish);
    button(tr("Cancel"), "flat", &RecordBar::cancel);
    hide();
    connect(&workspace_, &Workspace::opened, this, &RecordBar::cancel);
}

void RecordBar::start() {
    if (!workspace_.hasScene() || isRecording()) return;
    before_ = last_ = workspace_.document();
    steps_.clear();
    text_->clear();
    show();
    QFrame::show();
    text_->setFocus();
}

Value RecordBar::stepNow() const {
    Value step(Value::Object{});
    Value::Object set, until;
    QStringList names;
    for (const Edit& edit : changesBetween(last_, workspace_.document())) {
        if (isOfWords(edit.pointer) || !edit.value) continue;
        set.emplace_back(edit.pointer, *edit.value);
        if (!isPlain(*edit.value)) continue;
        until.emplace_back(edit.pointer, *edit.value);
        names << tr("**%1** to %2").arg(workspace_.placeName(edit.pointer), fieldText(*edit.value));
    }
    const QString told = text_->text().trimmed();
    step.set("text", (!told.isEmpty()    ? told
                      : !names.isEmpty() ? tr("Change %1.").arg(names.join(tr(", and ")))
                                         : tr("Look at this."))
                         .toStdString());
    const int scheme = workspace_.selectedScheme();
    if (scheme >= 0) step.set("scheme", workspace_.scene().schemes[static_cast<std::size_t>(scheme)].label);
    if (const std::string view = viewInSight_(); !view.empty()) step.set("view", view);
    if (!playback_.isPlaying() && playback_.time() > playback_.start()) step.set("time", playback_.time());
    if (!set.empty()) step.set("set", std::move(set));
    if (!until.empty()) step.set("until", std::move(until));
    return step;
}

void RecordBar::recordStep() {
    if (!isRecording()) return;
    steps_.push_back(stepNow());
    last_ = workspace_.document();
    text_->clear();
    show();
}

void RecordBar::finish() {
    if (!isRecording()) return;
    if (!steps_.empty()) {
        Value after = before_;
        Value::Array all;
        if (const Value* had = after.find("steps"); had && had->isArray()) all = had->asArray();
        all.insert(all.end(), steps_.begin(), steps_.end());
        after.set("steps", std::move(all));
        workspace_.edit(changesBetween(workspace_.document(), after), tr("Record a lesson"));
    }
    cancel();
}

void RecordBar::cancel() {
    before_ = last_ = Value();
    steps_.clear();
    hide();
}

void RecordBar::show() {
    count_->setText(steps_.empty() ? tr("Recording a lesson")
                                   : tr("%n steps recorded", nullptr, static_cast<int>(steps_.size())));
}

}  // namespace extremal
