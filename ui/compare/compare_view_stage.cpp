// SPDX-License-Identifier: GPL-3.0-or-later
/// The card of the stage: schemes on top of each other or beside each other, the length of their trails, and
/// the potential behind the motion.
#include <QAction>
#include <QActionGroup>
#include <QMenu>

#include <algorithm>

#include "ui/base/card.hpp"
#include "ui/base/format.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/playback.hpp"

namespace extremal {

void CompareView::makeStage() {
    stageCard_ = new Card(tr("Stage"), inside_);
    stage_ = new StageWidget;
    stage_->setTheme(*theme_);
    stage_->setAccessibleName(tr("Stage"));
    stage_->setFocusPolicy(Qt::StrongFocus);
    connect(&playback_, &Playback::timeChanged, this, &CompareView::describeStage);
    stage_->setPotentialShown(true);
    stageCard_->body()->addWidget(stage_, 1);
    QMenu* const menu = stageCard_->menu();
    menu->addAction(tr("Fit"), stage_, &StageWidget::fit);
    makeMaximizable(*stageCard_);
    menu->addSeparator();
    const auto addSwitch = [&](const QString& text, void (CompareView::*act)(), auto isOn) {
        QAction* const action = menu->addAction(text, this, act);
        action->setCheckable(true);
        connect(menu, &QMenu::aboutToShow, action, [action, isOn] { action->setChecked(isOn()); });
        return action;
    };
    addSwitch(tr("Schemes side by side (B)"), &CompareView::toggleSideBySide,
              [this] { return stage_->isSideBySide(); });
    QAction* const potential = addSwitch(tr("Potential (U)"), &CompareView::togglePotential,
                                         [this] { return stage_->isPotentialShown(); });
    connect(menu, &QMenu::aboutToShow, potential,
            [this, potential] { potential->setVisible(stage_->hasPotential()); });
    menu->addSection(tr("Trails (T)"));
    for (const auto& [text, trails] : {std::pair{tr("Fading trails"), StageTrails::fading},
                                       {tr("Trails ten times as long"), StageTrails::longer},
                                       {tr("Trails from the start"), StageTrails::whole}}) {
        QAction* const action =
            menu->addAction(text, this, [this, trails = trails] { stage_->setTrails(trails); });
        action->setCheckable(true);
        connect(menu, &QMenu::aboutToShow, action,
                [this, action, trails = trails] { action->setChecked(stage_->trails() == trails); });
    }
    menu->addSeparator();
    connectDrawing();
    connectPreview();
    connectBodies();
    connectPoking();
    connectSketch();
}

/// What is seen, in words: of each scheme the state at the time of the cursor. Only while the motion stands
/// still, as it could not be listened to otherwise.
void CompareView::describeStage() {
    const auto results = shownResults();
    if (!results || playback_.isPlaying()) return;
    QStringList parts{tr("t = %1").arg(shortNumber(playback_.time()))};
    constexpr std::size_t most = 4;  // coordinates of a scheme
    for (const auto& scheme : results->schemes) {
        const auto& columns = scheme->trajectory.columns;
        if (columns.empty() || columns[0].values.empty()) continue;
        const auto& t = columns[0].values;
        const auto at = std::min<std::ptrdiff_t>(
            std::lower_bound(t.begin(), t.end(), playback_.time()) - t.begin(), std::ssize(t) - 1);
        QStringList values;
        for (std::size_t c = 1; c < columns.size() && c <= most; ++c)
            if (columns[c].name.starts_with("q."))
                values << QString::fromStdString(columns[c].symbol) + " " +
                              shortNumber(columns[c].values[static_cast<std::size_t>(at)]);
        parts << QString::fromStdString(scheme->spec.label) +
                     (values.isEmpty() ? QString() : ": " + values.join(", "));
    }
    stage_->setAccessibleDescription(parts.join("; "));
}

void CompareView::toggleSideBySide() { stage_->setSideBySide(!stage_->isSideBySide()); }

void CompareView::togglePotential() { stage_->setPotentialShown(!stage_->isPotentialShown()); }

void CompareView::changeTrails() {
    const StageTrails now = stage_->trails();
    stage_->setTrails(now == StageTrails::fading   ? StageTrails::longer
                      : now == StageTrails::longer ? StageTrails::whole
                                                   : StageTrails::fading);
}

}  // namespace extremal
