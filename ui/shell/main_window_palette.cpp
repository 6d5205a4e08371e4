// SPDX-License-Identifier: GPL-3.0-or-later
/// What the palette offers: every action, preset and parameter, the schemes, the cells of the discretizer,
/// and the plots.
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QTabBar>
#include <QTextDocumentFragment>

#include "engine/scene/preset.hpp"
#include "ui/base/card.hpp"
#include "ui/base/value_edit.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/panels/discretizer.hpp"
#include "ui/panels/scheme_list.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/windows/palette_dialog.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

/// A label's text; no document is behind it that could load what the text names.
QString plainTextOf(const QLabel& label) {
    return label.textFormat() == Qt::PlainText ? label.text()
                                               : QTextDocumentFragment::fromHtml(label.text()).toPlainText();
}

/// The fields of the panel of the scene, under the words beside them.
void addFields(QScrollArea& panel, std::vector<PaletteEntry>& entries) {
    for (const QLabel* label : panel.findChildren<QLabel*>()) {
        auto* const field = qobject_cast<ValueEdit*>(label->buddy());
        if (!field || !field->isVisibleTo(&panel)) continue;
        entries.push_back({MainWindow::tr("Change %1").arg(plainTextOf(*label)), {}, true, [&panel, field] {
                               panel.ensureWidgetVisible(field);
                               field->setFocus(Qt::ShortcutFocusReason);
                               // The window is not the active one yet, and selects nothing by itself.
                               if (auto* const line = qobject_cast<QLineEdit*>(field->focusProxy()))
                                   line->selectAll();
                           }});
    }
}

}  // namespace

std::vector<PaletteEntry> MainWindow::paletteEntries() {
    std::vector<PaletteEntry> entries;
    for (QAction* action : actions_->all())
        entries.push_back({QString(action->text()).remove('&'),
                           action->shortcut().toString(QKeySequence::NativeText), action->isEnabled(),
                           [action] { action->trigger(); }});
    for (const Preset& preset : presets()) {
        const QString id = QString::fromUtf8(preset.id.data(), static_cast<qsizetype>(preset.id.size()));
        entries.push_back(
            {tr("Open preset: %1").arg(id), {}, true, [this, id] { open(QStringLiteral("preset:") + id); }});
    }
    if (!isSceneInSight()) return entries;
    addFields(*left_, entries);
    const auto& schemes = workspace_->scene().schemes;
    for (std::size_t i = 0; i < schemes.size(); ++i)
        entries.push_back(
            {tr("Step of %1").arg(QString::fromStdString(schemes[i].label)), {}, true, [this, i] {
                 schemes_->editStep(static_cast<int>(i));
             }});
    for (DiscretizerCell* cell : discretizer_->findChildren<DiscretizerCell*>())
        if (cell->isEnabled())
            entries.push_back(
                {tr("Add %1").arg(cell->accessibleName()), {}, true, [cell] { cell->click(); }});
    for (PlotWidget* plot : compare_->plots()) {
        auto* const card = qobject_cast<Card*>(plot->parentWidget());
        if (card)
            entries.push_back(
                {tr("Maximise the plot %1").arg(card->accessibleName()), {}, true, [this, plot, card] {
                     tabs_->setCurrentIndex(0);
                     compare_->restore();
                     compare_->maximize(card);
                     plot->setFocus();
                 }});
    }
    return entries;
}

void MainWindow::showPalette() {
    auto* dialog = new PaletteDialog(paletteEntries(), this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

}  // namespace extremal
