#include "ui/shell/help_window.hpp"

#include <QDesktopServices>
#include <QFile>
#include <QHBoxLayout>
#include <QListWidget>
#include <QTextBrowser>
#include <QUrl>

#include "ui/shell/typeset.hpp"

namespace extremal {

HelpWindow::HelpWindow(const QString& keys, QWidget* parent) : QWidget(parent, Qt::Window), keys_(keys) {
    setWindowTitle(tr("Handbook"));
    resize(960, 720);
    auto* row = new QHBoxLayout(this);
    pages_ = new QListWidget(this);
    pages_->setAccessibleName(tr("Pages"));
    pages_->setFixedWidth(190);
    text_ = new QTextBrowser(this);
    text_->setOpenLinks(false);
    row->addWidget(pages_);
    row->addWidget(text_, 1);
    for (const char* page : {"index", "tour", "framework", "spaces", "quadratures", "schemes", "baselines", "models",
                             "observables", "scenes", "expressions", "command-line", "keys", "architecture", "extending"}) {
        const QString path = QStringLiteral(":/handbook/%1.md").arg(QLatin1String(page));
        QFile file(path);
        if (!file.open(QIODevice::ReadOnly)) continue;
        QString title = QString::fromUtf8(file.readLine()).remove('#').trimmed();
        auto* item = new QListWidgetItem(title, pages_);
        item->setData(Qt::UserRole, QString::fromLatin1(page));
    }
    auto* item = new QListWidgetItem(tr("All keys of this window"), pages_);
    item->setData(Qt::UserRole, QStringLiteral("#keys"));
    connect(pages_, &QListWidget::currentItemChanged, this, [this](QListWidgetItem* now) {
        if (!now) return;
        const QString page = now->data(Qt::UserRole).toString();
        QFile file(QStringLiteral(":/handbook/%1.md").arg(page));
        showMarkdown(*text_, page == "#keys"                  ? keys_
                             : file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll())
                                                              : QString());
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
