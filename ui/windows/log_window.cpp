// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/windows/log_window.hpp"

#include <QPlainTextEdit>
#include <QScrollBar>
#include <QVBoxLayout>

#include "ui/base/notices.hpp"
#include "ui/base/tool_window.hpp"

namespace extremal {

LogWindow::LogWindow(Notices& notices, QWidget* parent)
    : QWidget(parent, Qt::Window), notices_(notices), text_(new QPlainTextEdit(this)) {
    setObjectName("log");
    setWindowTitle(tr("Log"));
    resize(760, 420);
    closeOnEscape(*this);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    text_->setReadOnly(true);
    text_->setAccessibleName(tr("Log"));
    layout->addWidget(text_);
    connect(&notices_, &Notices::logChanged, this, &LogWindow::refresh);
    refresh();
}

void LogWindow::open() {
    show();
    raise();
    activateWindow();
}

void LogWindow::refresh() {
    text_->setPlainText(notices_.log().isEmpty() ? tr("Nothing has been reported in this session.")
                                                 : notices_.log().join('\n'));
    text_->verticalScrollBar()->setValue(text_->verticalScrollBar()->maximum());
}

}  // namespace extremal
