// SPDX-License-Identifier: GPL-3.0-or-later
/// What the palette offers: every action, preset and parameter, the schemes, the cells of the discretizer,
/// and the plots.
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QTabBar>
#include <QTextDocumentFragment>

#include <algorithm>

#include "engine/baseline/catalog.hpp"
#include "engine/family/scheme.hpp"
#include "engine/scene/preset.hpp"
#include "engine/view/catalog.hpp"
#include "ui/base/card.hpp"
#include "ui/base/value_edit.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/compare/plot_edits.hpp"
#include "ui/panels/discretizer.hpp"
#include "ui/panels/scheme_list.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/windows/palette_dialog.hpp"
#include "ui/workspace/scheme_edits.hpp"
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
        entries.push_back({MainWindow::tr("Change %1").arg(plainTextOf(*label)),
                           {},
                           true,
                           [&panel, field] {
                               panel.ensureWidgetVisible(field);
                               field->setFocus(Qt::ShortcutFocusReason);
                               // The window is not the active one yet, and selects nothing by itself.
                               if (auto* const line = qobject_cast<QLineEdit*>(field->focusProxy()))
                                   line->selectAll();
                           },
                           MainWindow::tr("Scene")});
    }
}

}  // namespace

namespace {

/// What a plot is drawn over, as the heading of its kind.
QString groupOf(const ViewEntry& entry) {
    if (!entry.scales.exist) return MainWindow::tr("Pictures without scales");
    switch (entry.scales.across) {
        case Across::time:
            return MainWindow::tr("Over time");
        case Across::column:
            return MainWindow::tr("Portraits and orbits");
        case Across::place:
            return MainWindow::tr("Over places");
        default:
            return MainWindow::tr("Of a step, a scheme or many runs");
    }
}

QString words(const std::string& text) { return QString::fromStdString(text); }

}  // namespace

/// The plots of the catalogue that the scene can have, by what they are drawn over.
std::vector<PaletteEntry> MainWindow::plotEntries() {
    std::vector<PaletteEntry> entries;
    const Scene& scene = workspace_->scene();
    for (const ViewEntry* const entry : offeredPlots(scene)) {
        const std::string id = entry->item.id;
        const bool isShown =
            std::any_of(scene.views.begin(), scene.views.end(), [&](const View& v) { return v.id == id; });
        entries.push_back({isShown ? tr("Hide the plot %1").arg(words(entry->item.title))
                                   : tr("Show the plot %1").arg(words(entry->item.title)),
                           isShown ? tr("shown") : QString(), true,
                           [this, id, isShown] {
                               workspace_->edit(editsForView(workspace_->scene(), id, !isShown),
                                                isShown ? tr("Hide a plot") : tr("Show a plot"));
                           },
                           groupOf(*entry), words(entry->item.description)});
    }
    std::stable_sort(entries.begin(), entries.end(),
                     [](const PaletteEntry& a, const PaletteEntry& b) { return a.group < b.group; });
    return entries;
}

/// Baselines and named schemes that the scene's model accepts, with what they are; cells of the discretizer.
void MainWindow::addSchemeEntries(std::vector<PaletteEntry>& entries) {
    const auto add = [&](const CatalogItem& item, const std::string& id, const QString& group, auto make) {
        entries.push_back({tr("Add %1").arg(words(item.title)), words(id), true,
                           [this, id, make] { schemes_->add(make(workspace_->scene(), id)); }, group,
                           words(item.description)});
    };
    for (const BaselineEntry* entry : fittingBaselines(workspace_->scene()))
        add(entry->item, entry->item.id, tr("Baselines"),
            [](const Scene& scene, const std::string& id) { return newBaseline(scene, id); });
    for (const SchemeEntry* entry : fittingSchemes(workspace_->scene()))
        if (entry->maxDegree == 0)
            add(entry->item, entry->item.id, tr("Named schemes"),
                [](const Scene& scene, const std::string& id) { return newNamed(scene, id); });
    for (DiscretizerCell* cell : discretizer_->findChildren<DiscretizerCell*>())
        if (cell->isEnabled())
            entries.push_back({tr("Add %1").arg(cell->accessibleName()),
                               {},
                               true,
                               [cell] { cell->click(); },
                               tr("Discretizer"),
                               cell->accessibleDescription()});
}

void MainWindow::addPlaceEntries(std::vector<PaletteEntry>& entries) {
    const auto& schemes = workspace_->scene().schemes;
    for (std::size_t i = 0; i < schemes.size(); ++i)
        entries.push_back({tr("Step of %1").arg(words(schemes[i].label)),
                           {},
                           true,
                           [this, i] { schemes_->editStep(static_cast<int>(i)); },
                           tr("Schemes of the scene")});
    for (PlotWidget* plot : compare_->plots()) {
        auto* const card = qobject_cast<Card*>(plot->parentWidget());
        if (!card) continue;
        entries.push_back({tr("Maximise the plot %1").arg(card->accessibleName()),
                           {},
                           true,
                           [this, plot, card] {
                               tabs_->setCurrentIndex(0);
                               compare_->restore();
                               compare_->maximize(card);
                               plot->setFocus();
                           },
                           tr("Plots of the scene"),
                           plot->accessibleDescription()});
    }
}

std::vector<PaletteEntry> MainWindow::paletteEntries() {
    std::vector<PaletteEntry> entries;
    for (QAction* action : actions_->all()) {
        const QString name = QString(action->text()).remove('&'), tip = action->toolTip();
        entries.push_back({name, action->shortcut().toString(QKeySequence::NativeText), action->isEnabled(),
                           [action] { action->trigger(); }, Actions::menuOf(action),
                           tip.startsWith(name) ? QString() : tip});
    }
    if (isSceneInSight()) {
        addFields(*left_, entries);
        addPlaceEntries(entries);
        for (PaletteEntry& entry : plotEntries()) entries.push_back(std::move(entry));
        addSchemeEntries(entries);
    }
    for (const Preset& preset : presets()) {
        const QString id = QString::fromUtf8(preset.id.data(), static_cast<qsizetype>(preset.id.size()));
        entries.push_back({tr("Open preset: %1").arg(id),
                           {},
                           true,
                           [this, id] { open(QStringLiteral("preset:") + id); },
                           tr("Presets")});
    }
    return entries;
}

/// The plots alone, for the key that chooses them.
void MainWindow::showPlotChoice() {
    if (!isSceneInSight()) return;
    auto* dialog = new PaletteDialog(plotEntries(), this, tr("Find a plot, or a word of what it shows"));
    dialog->setWindowTitle(tr("Choose plots"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

void MainWindow::showPalette() {
    auto* dialog = new PaletteDialog(paletteEntries(), this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

}  // namespace extremal
