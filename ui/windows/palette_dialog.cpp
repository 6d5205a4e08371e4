// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/windows/palette_dialog.hpp"

#include <QKeyEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

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

}  // namespace

PaletteDialog::PaletteDialog(std::vector<PaletteEntry> entries, QWidget* parent)
    : QDialog(parent), entries_(std::move(entries)) {
    setWindowTitle(tr("Find an action"));
    resize(520, 380);
    auto* layout = new QVBoxLayout(this);
    input_ = new QLineEdit(this);
    input_->setPlaceholderText(tr("Find an action, a preset, a parameter, a scheme or a plot"));
    input_->setAccessibleName(input_->placeholderText());
    list_ = new QListWidget(this);
    list_->setAccessibleName(tr("Found"));
    layout->addWidget(input_);
    layout->addWidget(list_);
    input_->installEventFilter(this);
    connect(input_, &QLineEdit::textChanged, this, &PaletteDialog::filter);
    connect(input_, &QLineEdit::returnPressed, this, &PaletteDialog::choose);
    connect(list_, &QListWidget::itemActivated, this, &PaletteDialog::choose);
    connect(list_, &QListWidget::itemClicked, this, &PaletteDialog::choose);
    filter({});
}

void PaletteDialog::filter(const QString& text) {
    list_->clear();
    std::vector<std::pair<int, int>> found;  // points, and which
    for (std::size_t i = 0; i < entries_.size(); ++i)
        if (const int points = score(entries_[i].text, text); points >= 0)
            found.emplace_back(points, static_cast<int>(i));
    // Of two that match alike, the one with the fewer letters that were not asked for.
    const auto lengthOf = [&](int i) { return entries_[static_cast<std::size_t>(i)].text.size(); };
    std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) {
        return a.first != b.first ? a.first > b.first : lengthOf(a.second) < lengthOf(b.second);
    });
    for (const auto& [points, i] : found) {
        const PaletteEntry& entry = entries_[static_cast<std::size_t>(i)];
        auto* item = new QListWidgetItem(
            entry.note.isEmpty() ? entry.text : entry.text + QStringLiteral("    ") + entry.note, list_);
        item->setData(Qt::UserRole, i);
        if (!entry.isEnabled) item->setFlags(item->flags() & ~Qt::ItemIsEnabled);
    }
    if (found.empty()) {
        auto* item = new QListWidgetItem(tr("No matching action"), list_);
        item->setFlags(Qt::NoItemFlags);
        return;
    }
    list_->setCurrentRow(0);
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
            const int row = list_->currentRow() + (key == Qt::Key_Down ? 1 : -1);
            list_->setCurrentRow(std::clamp(row, 0, std::max(0, list_->count() - 1)));
            return true;
        }
    }
    return QDialog::eventFilter(watched, event);
}

}  // namespace extremal
