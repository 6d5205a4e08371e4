// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/windows/palette_dialog.hpp"

#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

#include "ui/base/card.hpp"

namespace extremal {
namespace {

/// The letters of the pattern appear in this order; better where they follow each other and start words. -1:
/// no match.
int score(const QString& text, const QString& pattern) {
    int points = 0, at = 0, last = -2;
    for (const QChar c : pattern) {
        if (c.isSpace()) continue;
        const int found = static_cast<int>(text.indexOf(c, at, Qt::CaseInsensitive));
        if (found < 0) return -1;
        points += found == last + 1 ? 4 : 1;
        if (found == 0 || !text[found - 1].isLetterOrNumber()) points += 3;
        last = found;
        at = found + 1;
    }
    return points;
}

/// "Stormer" of "Störmer": letters are typed as they are on a keyboard.
QString plain(const QString& text) {
    QString letters = text.normalized(QString::NormalizationForm_D);
    letters.removeIf([](QChar c) { return c.category() == QChar::Mark_NonSpacing; });
    return letters;
}

}  // namespace

PaletteDialog::PaletteDialog(std::vector<PaletteEntry> entries, QWidget* parent, const QString& prompt)
    : QDialog(parent), entries_(std::move(entries)) {
    for (const PaletteEntry& entry : entries_) sought_.push_back({plain(entry.text), plain(entry.about)});
    setWindowTitle(tr("Find an action"));
    resize(580, 460);
    auto* layout = new QVBoxLayout(this);
    input_ = new QLineEdit(this);
    input_->setPlaceholderText(
        prompt.isEmpty() ? tr("Find an action, a preset, a parameter, a scheme or a plot") : prompt);
    input_->setAccessibleName(input_->placeholderText());
    list_ = new QListWidget(this);
    list_->setAccessibleName(tr("Found"));
    about_ = makeWrappedLabel({}, "caption", this);
    constexpr int aboutHeight = 46;
    about_->setFixedHeight(aboutHeight);
    about_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    layout->addWidget(input_);
    layout->addWidget(list_, 1);
    layout->addWidget(about_);
    input_->installEventFilter(this);
    connect(input_, &QLineEdit::textChanged, this, &PaletteDialog::filter);
    connect(input_, &QLineEdit::returnPressed, this, &PaletteDialog::choose);
    connect(list_, &QListWidget::itemActivated, this, &PaletteDialog::choose);
    connect(list_, &QListWidget::itemClicked, this, &PaletteDialog::choose);
    connect(list_, &QListWidget::currentRowChanged, this, &PaletteDialog::showAbout);
    filter({});
}

void PaletteDialog::addRow(int i) {
    const PaletteEntry& entry = entries_[static_cast<std::size_t>(i)];
    auto* item = new QListWidgetItem(
        entry.note.isEmpty() ? entry.text : entry.text + QStringLiteral("    ") + entry.note, list_);
    item->setData(Qt::UserRole, i);
    if (!entry.about.isEmpty()) item->setToolTip(entry.about);
    if (!entry.isEnabled) item->setFlags(item->flags() & ~Qt::ItemIsEnabled);
}

void PaletteDialog::addGroup(const QString& name) {
    auto* item = new QListWidgetItem(name, list_);
    item->setFlags(Qt::NoItemFlags);
    QFont font = list_->font();
    font.setWeight(QFont::DemiBold);
    item->setFont(font);
}

/// Names come first; behind them what only the explanation speaks of.
void PaletteDialog::filter(const QString& text) {
    list_->clear();
    std::vector<std::pair<int, int>> found;  // points, and which
    std::vector<int> explained;
    const QString wanted = plain(text);
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        if (const int points = score(sought_[i].text, wanted); points >= 0)
            found.emplace_back(points, static_cast<int>(i));
        else if (sought_[i].about.contains(wanted.trimmed(), Qt::CaseInsensitive))
            explained.push_back(static_cast<int>(i));
    }
    // Of two that match alike, the one with the fewer letters that were not asked for; of all, their order.
    const auto lengthOf = [&](int i) { return entries_[static_cast<std::size_t>(i)].text.size(); };
    if (!text.trimmed().isEmpty())
        std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) {
            return a.first != b.first ? a.first > b.first : lengthOf(a.second) < lengthOf(b.second);
        });
    QString group;
    for (const auto& [points, i] : found) {
        const QString& own = entries_[static_cast<std::size_t>(i)].group;
        if (text.trimmed().isEmpty() && own != group && !own.isEmpty()) addGroup(group = own);
        addRow(i);
    }
    for (const int i : explained) addRow(i);
    if (list_->count() == 0) return addGroup(tr("No matching action"));
    list_->setCurrentRow(-1);
    move(1);
}

/// To the next row that is an entry.
void PaletteDialog::move(int by) {
    for (int row = list_->currentRow() + by; row >= 0 && row < list_->count(); row += by)
        if (list_->item(row)->data(Qt::UserRole).isValid()) return list_->setCurrentRow(row);
}

void PaletteDialog::showAbout() {
    const QListWidgetItem* item = list_->currentItem();
    const bool isEntry = item && item->data(Qt::UserRole).isValid();
    about_->setText(isEntry ? entries_[item->data(Qt::UserRole).toUInt()].about : QString());
}

void PaletteDialog::choose() {
    const QListWidgetItem* item = list_->currentItem();
    if (!item || !item->data(Qt::UserRole).isValid()) return;
    const std::function<void()> act = entries_[item->data(Qt::UserRole).toUInt()].act;
    accept();
    act();
}

bool PaletteDialog::eventFilter(QObject* watched, QEvent* event) {
    if (watched == input_ && event->type() == QEvent::KeyPress) {
        const int key = static_cast<QKeyEvent*>(event)->key();
        if (key == Qt::Key_Down || key == Qt::Key_Up) {
            move(key == Qt::Key_Down ? 1 : -1);
            return true;
        }
    }
    return QDialog::eventFilter(watched, event);
}

}  // namespace extremal
