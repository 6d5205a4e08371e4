#include "ui/shell/palette_dialog.hpp"

#include <QKeyEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <vector>

#include "engine/scene/preset.hpp"
#include "ui/shell/actions.hpp"

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

PaletteDialog::PaletteDialog(const Actions& actions, QWidget* parent) : QDialog(parent), actions_(actions) {
    setWindowTitle(tr("Find an action"));
    resize(520, 380);
    auto* layout = new QVBoxLayout(this);
    input_ = new QLineEdit(this);
    input_->setPlaceholderText(tr("Find an action or a preset"));
    input_->setAccessibleName(tr("Find an action or a preset"));
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
    struct Found {
        int points;
        QString text;
        QVariant data;
        bool isEnabled;
    };
    std::vector<Found> found;
    const auto& all = actions_.all();
    for (int i = 0; i < all.size(); ++i) {
        const QString name = QString(all[i]->text()).remove('&');
        const QString keys = all[i]->shortcut().toString(QKeySequence::NativeText);
        if (const int points = score(name, text); points >= 0)
            found.push_back({points, keys.isEmpty() ? name : name + QStringLiteral("    ") + keys, i,
                             all[i]->isEnabled()});
    }
    for (const Preset& p : presets()) {
        const QString name = QString::fromUtf8(p.id.data(), static_cast<qsizetype>(p.id.size()));
        if (const int points = score(name, text); points >= 0)
            found.push_back({points, tr("Open preset: %1").arg(name), name, true});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Found& a, const Found& b) { return a.points > b.points; });
    for (const Found& f : found) {
        auto* item = new QListWidgetItem(f.text, list_);
        item->setData(Qt::UserRole, f.data);
        if (!f.isEnabled) item->setFlags(item->flags() & ~Qt::ItemIsEnabled);
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
    if (!item) return;
    const QVariant chosen = item->data(Qt::UserRole);
    accept();
    if (chosen.typeId() == QMetaType::Int)
        actions_.all()[chosen.toInt()]->trigger();
    else
        emit presetChosen(chosen.toString());
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
