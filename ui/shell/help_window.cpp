#include "ui/shell/help_window.hpp"

#include <QDesktopServices>
#include <QFile>
#include <QHBoxLayout>
#include <QListWidget>
#include <QRegularExpression>
#include <QTextBrowser>
#include <QUrl>

#include "ui/shell/typeset.hpp"

namespace extremal {
namespace {

QString pageText(const QString& page) {
    QFile file(QStringLiteral(":/handbook/%1.md").arg(page));
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

}  // namespace

HelpWindow::HelpWindow(QWidget* parent) : QWidget(parent, Qt::Window) {
    setWindowTitle(tr("Handbook"));
    resize(960, 720);
    auto* row = new QHBoxLayout(this);
    pages_ = new QListWidget(this);
    pages_->setAccessibleName(tr("Pages"));
    pages_->setFixedWidth(190);
    text_ = new QTextBrowser(this);
    text_->setOpenLinks(false);
    text_->setSearchPaths({QStringLiteral(":/handbook")});  // of pictures
    row->addWidget(pages_);
    row->addWidget(text_, 1);
    const auto add = [this](const QString& page) {
        const QString title = pageText(page).section('\n', 0, 0).remove('#').trimmed();
        if (!title.isEmpty()) (new QListWidgetItem(title, pages_))->setData(Qt::UserRole, page);
    };
    add(QStringLiteral("index"));
    static const QRegularExpression link(QStringLiteral(R"(\]\(([\w-]+)\.md\))"));
    for (const QRegularExpressionMatch& match : link.globalMatch(pageText(QStringLiteral("index"))))
        add(match.captured(1));
    connect(pages_, &QListWidget::currentItemChanged, this, [this](QListWidgetItem* now) {
        if (now) showMarkdown(*text_, pageText(now->data(Qt::UserRole).toString()));
    });
    connect(text_, &QTextBrowser::anchorClicked, this, [this](const QUrl& url) {
        if (url.isRelative())
            open(url.path().section('/', -1).section('.', 0, 0));
        else
            QDesktopServices::openUrl(url);
    });
    pages_->setCurrentRow(0);
}

void HelpWindow::open(const QString& page) {
    for (int i = 0; i < pages_->count(); ++i)
        if (pages_->item(i)->data(Qt::UserRole).toString() == page) pages_->setCurrentRow(i);
    show();
    raise();
    activateWindow();
}

}  // namespace extremal
