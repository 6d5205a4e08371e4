// SPDX-License-Identifier: GPL-3.0-or-later
/// The card of the stage: schemes on top of each other or beside each other, the length of their trails, and
/// the potential behind the motion.
#include <QAction>
#include <QActionGroup>
#include <QMenu>

#include "ui/base/card.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/stage/stage_widget.hpp"

namespace extremal {

void CompareView::makeStage() {
    stageCard_ = new Card(tr("Stage"), inside_);
    stage_ = new StageWidget;
    stage_->setTheme(*theme_);
    stage_->setAccessibleName(tr("Stage"));
    stage_->setFocusPolicy(Qt::ClickFocus);
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
    connectSketch();
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
