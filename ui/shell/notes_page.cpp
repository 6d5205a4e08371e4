// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/shell/notes_page.hpp"

#include <QEvent>
#include <QHBoxLayout>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QStackedWidget>
#include <QVBoxLayout>

#include "ui/text/text_view.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

NotesPage::NotesPage(Workspace& workspace, TextView* view, QWidget* parent)
    : QWidget(parent), workspace_(workspace), view_(view) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    auto* row = new QHBoxLayout;
    button_ = new QPushButton;
    button_->setObjectName("writeNotes");
    button_->setFocusPolicy(Qt::TabFocus);
    row->addStretch(1);
    row->addWidget(button_);
    column->addLayout(row);
    stack_ = new QStackedWidget;
    text_ = new QPlainTextEdit;
    text_->setObjectName("notesText");
    text_->setAccessibleName(tr("Notes, as Markdown"));
    text_->setPlaceholderText(tr("Markdown, with formulas between dollar signs"));
    text_->setTabChangesFocus(true);
    stack_->addWidget(view_);
    stack_->addWidget(text_);
    column->addWidget(stack_, 1);
    setFocusProxy(view_);
    view_->viewport()->installEventFilter(this);
    text_->installEventFilter(this);
    connect(button_, &QPushButton::clicked, this, [this] {
        if (!finish()) write();
    });
    connect(&workspace_, &Workspace::opened, this, [this] { stack_->setCurrentWidget(view_); });
    connect(stack_, &QStackedWidget::currentChanged, this, [this] {
        button_->setText(isWriting() ? tr("Done") : tr("Write"));
        setFocusProxy(isWriting() ? static_cast<QWidget*>(text_) : view_);
    });
    button_->setText(tr("Write"));
}

bool NotesPage::isWriting() const { return stack_->currentWidget() == text_; }

void NotesPage::write() {
    if (!workspace_.hasScene()) return;
    text_->setPlainText(QString::fromStdString(workspace_.scene().notes));
    stack_->setCurrentWidget(text_);
    text_->setFocus();
}

bool NotesPage::finish() {
    if (!isWriting()) return false;
    stack_->setCurrentWidget(view_);
    const std::string written = text_->toPlainText().toStdString();
    if (workspace_.hasScene() && written != workspace_.scene().notes)
        workspace_.edit({{"/notes", written.empty() ? std::nullopt : std::optional<Value>(written)}},
                        tr("Write the notes"));
    return true;
}

/// Leaving the text takes what was written, as leaving a field does.
bool NotesPage::eventFilter(QObject* watched, QEvent* event) {
    if (watched == view_->viewport() && event->type() == QEvent::MouseButtonDblClick) {
        write();
        return true;
    }
    if (watched == text_ && event->type() == QEvent::FocusOut && isActiveWindow()) finish();
    return QWidget::eventFilter(watched, event);
}

}  // namespace extremal
