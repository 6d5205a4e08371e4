// SPDX-License-Identifier: GPL-3.0-or-later
/// The sizes of cards that a hand gave them, or the scene, and of their margins; and what is seen of the
/// page, for the scene.
#include <QApplication>

#include <algorithm>
#include <map>
#include <utility>

#include "ui/base/card.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/compare/plot_edits.hpp"
#include "ui/plots/plot_group.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

void CompareView::growRow(int by) {
    const QWidget* const focus = QApplication::focusWidget();
    const auto holdsFocus = [&](const auto& s) { return s->card->isAncestorOf(focus); };
    const auto found = std::find_if(slots_.begin(), slots_.end(), holdsFocus);
    cardLayout_->grow(found == slots_.end() ? stageCard_ : (*found)->card, by);
}

void CompareView::forgetSizes() { cardLayout_->forgetSizes(); }

void CompareView::takeSizes() {
    const auto& views = workspace_.scene().views;
    const auto stage =
        std::find_if(views.begin(), views.end(), [](const View& v) { return v.id == "stage"; });
    const auto take = [this](const QWidget* card, CardSize& known, CardSize size) {
        if (std::exchange(known, size) != size) cardLayout_->setSize(card, size);
    };
    take(stageCard_, stageSize_, stage == views.end() ? CardSize() : stage->size);
    for (const auto& s : slots_) take(s->card, s->size, s->view.size);
}

void CompareView::setPinned(std::optional<double> t) { group_->setPinned(t); }

std::optional<double> CompareView::pinned() const { return group_->pinned(); }

std::vector<View> CompareView::seenViews() const {
    Scene scene = workspace_.scene();
    for (const auto& s : slots_) {
        View after = withPart(s->view, *s->plot);
        after.size = cardLayout_->sizeOf(s->card);
        if (!(after == s->view)) scene.views = viewsForPlot(scene, s->view, after);
    }
    const CardSize size = cardLayout_->sizeOf(stageCard_);
    const auto stage =
        std::find_if(scene.views.begin(), scene.views.end(), [](const View& v) { return v.id == "stage"; });
    if (stage != scene.views.end())
        stage->size = size;
    else if (size != CardSize())
        scene.views.insert(scene.views.begin(), View{"stage", "", ""})->size = size;
    return std::move(scene.views);
}

/// Plots below each other share their left edge: the widest margin of those that begin at the same place.
void CompareView::alignMargins() {
    std::map<int, int> widest;
    for (const auto& s : slots_) {
        int& margin = widest[s->card->x()];
        margin = std::max(margin, s->plot->leftMargin());
    }
    for (const auto& s : slots_) s->plot->setLeftMargin(std::min(widest[s->card->x()], 90));
}

}  // namespace extremal
