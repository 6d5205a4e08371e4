// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/windows/help_window.hpp"

#include <QDesktopServices>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollBar>
#include <QShortcut>
#include <QTextBlock>
#include <QTextBrowser>
#include <QUrl>

#include <algorithm>

#include "engine/scene/preset.hpp"
#include "ui/base/card.hpp"
#include "ui/text/handbook_pages.hpp"
#include "ui/text/typeset.hpp"

namespace extremal {
namespace {

bool isPreset(const QString& id) { return findPreset(id.toStdString()) != nullptr; }

/// Replaces what a pattern finds outside fenced code.
template <class Change>
QString outsideCode(const QString& text, const QRegularExpression& pattern, const Change& change) {
    QStringList lines = text.split('\n');
    bool isCode = false;
    for (QString& line : lines) {
        if (line.startsWith(QLatin1String("```"))) isCode = !isCode;
        if (isCode) continue;
        QString out;
        qsizetype from = 0;
        for (auto it = pattern.globalMatch(line); it.hasNext();) {
            const QRegularExpressionMatch match = it.next();
            out += line.mid(from, match.capturedStart() - from) + change(match);
            from = match.capturedEnd();
        }
        line = out + line.mid(from);
    }
    return lines.join('\n');
}

QString link(const QString& id) { return QStringLiteral("[%1](preset:%1)").arg(id); }

}  // namespace

QString withPresetLinks(const QString& markdown) {
    static const QRegularExpression names(
        QStringLiteral(R"(\b([Pp]resets?) ((?:`[\w-]+`(?:, and |, | and )?)+))"));
    static const QRegularExpression quoted(QStringLiteral("`([\\w-]+)`"));
    QString text = outsideCode(markdown, names, [](const QRegularExpressionMatch& match) {
        return match.captured(1) + ' ' +
               outsideCode(match.captured(2), quoted, [](const QRegularExpressionMatch& name) {
                   return isPreset(name.captured(1)) ? link(name.captured(1)) : name.captured(0);
               });
    });
    static const QRegularExpression command(QStringLiteral("`([^`]*preset:([\\w-]+)[^`]*)`"));
    text = outsideCode(text, command, [](const QRegularExpressionMatch& match) {
        if (!isPreset(match.captured(2))) return match.captured(0);
        return match.captured(0) + QStringLiteral(" ([open](preset:%1))").arg(match.captured(2));
    });
    // Below a block of code, what it names.
    static const QRegularExpression inCode(QStringLiteral("preset:([\\w-]+)"));
    QStringList lines, open;
    bool isCode = false;
    for (const QString& line : text.split('\n')) {
        lines << line;
        if (line.startsWith(QLatin1String("```"))) {
            isCode = !isCode;
            if (!isCode && !open.isEmpty())
                lines << QString() << HelpWindow::tr("Open in the window: %1").arg(open.join(", "))
                      << QString();
            if (!isCode) open.clear();
        } else if (isCode) {
            for (auto it = inCode.globalMatch(line); it.hasNext();)
                if (const QString id = it.next().captured(1); isPreset(id) && !open.contains(link(id)))
                    open << link(id);
        }
    }
    return lines.join('\n');
}

QString helpPageOf(const QWidget* widget, const QWidget* otherwise) {
    for (const QWidget* inner : {widget, otherwise})
        for (; inner; inner = inner->parentWidget())
            if (const QVariant page = inner->property("help"); page.isValid()) return page.toString();
    return QStringLiteral("index");
}

HelpWindow::HelpWindow(QWidget* parent) : QWidget(parent, Qt::Window) {
    setWindowTitle(tr("Handbook"));
    resize(960, 720);
    auto* row = new QHBoxLayout(this);
    auto* left = new QVBoxLayout;
    auto* buttons = new QHBoxLayout;
    back_ = new QPushButton(tr("Back"));
    forward_ = new QPushButton(tr("Forward"));
    for (QPushButton* button : {back_, forward_}) buttons->addWidget(button);
    connect(back_, &QPushButton::clicked, this, &HelpWindow::back);
    connect(forward_, &QPushButton::clicked, this, &HelpWindow::forward);
    left->addLayout(buttons);
    search_ = new QLineEdit(this);
    search_->setObjectName("search");
    search_->setPlaceholderText(tr("Search the handbook"));
    search_->setAccessibleName(tr("Search the handbook"));
    search_->setClearButtonEnabled(true);
    left->addWidget(search_);
    found_ = makeLabel({}, "caption");
    found_->hide();
    left->addWidget(found_);
    pages_ = new QListWidget(this);
    pages_->setAccessibleName(tr("Pages"));
    left->addWidget(pages_, 1);
    auto* side = new QWidget(this);
    side->setLayout(left);
    side->setProperty("room", "side");
    left->setContentsMargins(0, 0, 0, 0);
    text_ = new QTextBrowser(this);
    text_->setAccessibleName(tr("Page"));
    text_->setOpenLinks(false);
    text_->setSearchPaths({QStringLiteral(":/handbook")});  // of pictures
    row->addWidget(side);
    row->addWidget(text_, 1);
    for (const QString& page : handbookPages()) {
        const QString title = handbookTitle(page);
        if (!title.isEmpty()) (new QListWidgetItem(title, pages_))->setData(Qt::UserRole, page);
    }
    connect(pages_, &QListWidget::itemClicked, this,
            [this](QListWidgetItem* item) { goTo(item->data(Qt::UserRole).toString()); });
    connect(pages_, &QListWidget::itemActivated, this,
            [this](QListWidgetItem* item) { goTo(item->data(Qt::UserRole).toString()); });
    connect(text_, &QTextBrowser::anchorClicked, this, &HelpWindow::follow);
    connect(search_, &QLineEdit::textChanged, this, &HelpWindow::filter);
    connect(search_, &QLineEdit::returnPressed, this, &HelpWindow::findNext);
    const auto key = [this](const QKeySequence& keys, auto act) {
        connect(new QShortcut(keys, this), &QShortcut::activated, this, act);
    };
    key(QKeySequence(Qt::ALT | Qt::Key_Left), &HelpWindow::back);
    key(QKeySequence(Qt::ALT | Qt::Key_Right), &HelpWindow::forward);
    key(QKeySequence::Find, &HelpWindow::focusSearch);
    key(QKeySequence(Qt::Key_Escape), [this] { close(); });
    goTo(QStringLiteral("index"));
}

QString HelpWindow::page() const {
    return at_ >= 0 ? places_[static_cast<std::size_t>(at_)].page : QString();
}

void HelpWindow::showPage(const QString& page) {
    for (int i = 0; i < pages_->count(); ++i)
        if (pages_->item(i)->data(Qt::UserRole).toString() == page) pages_->setCurrentRow(i);
    showMarkdown(*text_, withPresetLinks(handbookPage(page)));
    back_->setEnabled(at_ > 0);
    forward_->setEnabled(at_ + 1 < static_cast<int>(places_.size()));
}

void HelpWindow::leave() {
    if (at_ >= 0) places_[static_cast<std::size_t>(at_)].scroll = text_->verticalScrollBar()->value();
}

void HelpWindow::goTo(const QString& place) {
    const QString name = place.section('#', 0, 0), heading = place.section('#', 1);
    if (handbookPage(name).isEmpty()) return;
    if (name != page()) {
        leave();
        places_.resize(static_cast<std::size_t>(at_ + 1));
        places_.push_back({name});
        ++at_;
        showPage(name);
    }
    for (QTextBlock block = text_->document()->begin(); block.isValid() && !heading.isEmpty();
         block = block.next())
        if (block.blockFormat().headingLevel() > 0 && handbookAnchor(block.text()) == heading) {
            text_->setTextCursor(QTextCursor(block));
            text_->verticalScrollBar()->setValue(text_->verticalScrollBar()->value() +
                                                 text_->cursorRect().top());
            break;
        }
}

void HelpWindow::open(const QString& place) {
    goTo(place);
    show();
    raise();
    activateWindow();
}

void HelpWindow::go(int by) {
    if (at_ + by < 0 || at_ + by >= static_cast<int>(places_.size())) return;
    leave();
    at_ += by;
    showPage(page());
    text_->verticalScrollBar()->setValue(places_[static_cast<std::size_t>(at_)].scroll);
}

void HelpWindow::back() { go(-1); }
void HelpWindow::forward() { go(1); }

void HelpWindow::follow(const QUrl& url) {
    if (url.scheme() == QLatin1String("preset"))
        emit presetRequested(url.path());
    else if (!url.isRelative())
        QDesktopServices::openUrl(url);
    else if (url.path().isEmpty())
        goTo(page() + '#' + url.fragment());
    else
        goTo(url.path().section('/', -1).section('.', 0, 0) +
             (url.hasFragment() ? '#' + url.fragment() : QString()));
}

void HelpWindow::search(const QString& text) { search_->setText(text); }

void HelpWindow::focusSearch() {
    search_->setFocus();
    search_->selectAll();
}

/// Pages without the words are hidden; the first one that has them is shown.
void HelpWindow::filter() {
    const QStringList words = search_->text().toLower().split(' ', Qt::SkipEmptyParts);
    QStringList found;
    for (int i = 0; i < pages_->count(); ++i) {
        const QString name = pages_->item(i)->data(Qt::UserRole).toString(),
                      text = handbookPage(name).toLower();
        const bool has =
            std::all_of(words.begin(), words.end(), [&](const QString& word) { return text.contains(word); });
        pages_->item(i)->setHidden(!has);
        if (has) found << name;
    }
    found_->setVisible(!words.isEmpty());
    found_->setText(found.isEmpty() ? tr("No page has these words")
                                    : tr("%n pages", nullptr, static_cast<int>(found.size())));
    if (!words.isEmpty() && !found.isEmpty() && !found.contains(page())) goTo(found.front());
    mark(words);
    QTextCursor first = words.isEmpty() ? QTextCursor() : text_->document()->find(words.front());
    if (first.isNull()) first = nextMark(0);  // the other words may be there
    if (!first.isNull()) text_->setTextCursor(first);
}

/// Marks every place of the page that has one of the words.
void HelpWindow::mark(const QStringList& words) {
    QList<QTextEdit::ExtraSelection> marks;
    for (const QString& word : words)
        for (QTextCursor at = text_->document()->find(word); !at.isNull();
             at = text_->document()->find(word, at)) {
            QTextEdit::ExtraSelection mark;
            mark.cursor = at;
            mark.format.setBackground(palette().highlight());
            mark.format.setForeground(palette().highlightedText());
            marks << mark;
        }
    text_->setExtraSelections(marks);
}

/// The first mark that begins at a position of the page or behind it; null: there is no further one.
QTextCursor HelpWindow::nextMark(int position) const {
    QTextCursor next;
    for (const QTextEdit::ExtraSelection& mark : text_->extraSelections())
        if (const int start = mark.cursor.selectionStart();
            start >= position && (next.isNull() || start < next.selectionStart()))
            next = mark.cursor;
    return next;
}

/// The next place with one of the words; after the last one of a page, the next page that has them.
void HelpWindow::findNext() {
    const QStringList words = search_->text().toLower().split(' ', Qt::SkipEmptyParts);
    if (words.isEmpty()) return;
    QTextCursor next = nextMark(text_->textCursor().selectionEnd());
    for (int i = pages_->currentRow() + 1; i < pages_->count() && next.isNull(); ++i) {
        if (pages_->item(i)->isHidden()) continue;
        goTo(pages_->item(i)->data(Qt::UserRole).toString());
        mark(words);
        next = nextMark(0);
    }
    if (next.isNull()) next = nextMark(0);
    if (!next.isNull()) text_->setTextCursor(next);
}

}  // namespace extremal
