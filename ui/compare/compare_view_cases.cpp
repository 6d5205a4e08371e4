// SPDX-License-Identifier: GPL-3.0-or-later
/// Cases of maps of parameters: on the stage while the pointer is on them, and into the scene by a click.
#include <algorithm>

#include "engine/core/text/text.hpp"
#include "ui/base/card.hpp"
#include "ui/compare/case_preview.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

void CompareView::connectPreview() {
    preview_ = new CasePreview(workspace_, *stage_, this);
    connect(preview_, &CasePreview::shown, this,
            [this] { stageCard_->setSubtitle(tr("the case under the pointer")); });
    connect(preview_, &CasePreview::hidden, this, [this] {
        stageCard_->setSubtitle({});
        staged_.reset();
        startJob();
    });
    connect(&workspace_, &Workspace::opened, preview_, &CasePreview::hide);
    // A map that an edit takes away does not say that the pointer has left it.
    connect(&workspace_, &Workspace::sceneChanged, preview_, &CasePreview::hide);
}

void CompareView::connectCases(Slot& slot) {
    connect(slot.plot, &PlotWidget::cellHovered, this, [this, &slot](double value, double step) {
        if (stageCard_->isVisible()) preview_->show(slot.view, value, step);
    });
    connect(slot.plot, &PlotWidget::cellLeft, preview_, &CasePreview::hide);
    connect(slot.plot, &PlotWidget::cellChosen, this,
            [this, &slot](double value, double step) { loadCase(slot.view, value, step); });
}

void CompareView::loadCase(const View& view, double value, double step) {
    const std::vector<Edit> edits = editsForCase(workspace_.scene(), view, value, step);
    const QString text =
        tr("%1 = %2 and the step %3 of %4")
            .arg(QString::fromStdString(view.keys.text("parameter")),
                 QString::fromStdString(formatNumber(value)), QString::fromStdString(formatNumber(step)),
                 QString::fromStdString(view.scheme));
    if (edits.empty() || !workspace_.edit(edits, tr("Load a case of a map"))) return;
    const auto& schemes = workspace_.scene().schemes;
    const auto own = std::find_if(schemes.begin(), schemes.end(),
                                  [&](const SchemeSpec& s) { return s.label == view.scheme; });
    workspace_.selectScheme(static_cast<int>(own - schemes.begin()));
    emit caseLoaded(text);
}

}  // namespace extremal
