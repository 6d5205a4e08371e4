// SPDX-License-Identifier: GPL-3.0-or-later
/// What the hand does on the page: bodies are dragged and the plots follow, initial profiles are drawn, and
/// rows have the sizes that it gave them.
#include <QAction>
#include <QMenu>

#include <algorithm>

#include "engine/model/parts/written_form.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/typed_scene.hpp"
#include "ui/base/card.hpp"
#include "ui/compare/body_dragging.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/compare/field_poking.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/sketch/mechanism_sketch.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

void CompareView::connectDrawing() {
    draw_ = stageCard_->menu()->addAction(tr("Draw the initial profile"));
    draw_->setCheckable(true);
    draw_->setToolTip(
        tr("Dragging on the stage changes u at the start; so does dragging with Ctrl at any time"));
    connect(draw_, &QAction::toggled, stage_, &StageWidget::setDrawing);
    connect(stageCard_->menu(), &QMenu::aboutToShow, this,
            [this] { draw_->setVisible(ProfileDrawing::of(workspace_.scene()).has_value()); });
    connect(stage_, &StageWidget::strokeStarted, this, [this] {
        drawing_ = workspace_.hasScene() ? ProfileDrawing::of(workspace_.scene()) : std::nullopt;
        if (!drawing_) return;
        playback_.setPlaying(false);
        playback_.setTime(workspace_.scene().start.value);
    });
    connect(stage_, &StageWidget::stroke, this, [this](const Point& from, const Point& to) {
        if (!drawing_) return;
        drawing_->stroke(from, to);
        stage_->setSketch(drawing_->line());
    });
    // One edit per stroke: the run starts anew when the mouse is let go.
    connect(stage_, &StageWidget::strokeEnded, this, [this] {
        stage_->setSketch({});
        if (drawing_) workspace_.edit(drawing_->edits(), tr("the initial profile"));
        drawing_.reset();
    });
}

void CompareView::connectBodies() {
    bodies_ = new BodyDragging(workspace_, run_, playback_, *stage_, this);
    connect(bodies_, &BodyDragging::refused, this, &CompareView::startRefused);
    connect(bodies_, &BodyDragging::previewed, this, [this] {
        stageCard_->setSubtitle(isPreviewing() ? tr("a short run from here") : QString());
        if (run_.results()) refresh();
    });
}

void CompareView::connectPoking() {
    poking_ = new FieldPoking(workspace_, run_, playback_, *stage_, this);
    connect(poking_, &FieldPoking::refused, this, &CompareView::startRefused);
    QAction* const pokes = stageCard_->menu()->addAction(tr("Poke the field (K)"));
    pokes->setCheckable(true);
    pokes->setToolTip(
        tr("A click on the stage adds a pulse, and the scene starts from there; so does a click "
           "with Shift at any time, and Enter in the middle"));
    connect(pokes, &QAction::toggled, poking_, &FieldPoking::setOn);
    connect(poking_, &FieldPoking::onChanged, this, [this, pokes](bool isOn) {
        pokes->setChecked(isOn);
        stageCard_->setSubtitle(isOn ? tr("a click pokes the field") : QString());
    });
    connect(stageCard_->menu(), &QMenu::aboutToShow, this, [this, pokes] {
        pokes->setVisible(workspace_.hasScene() && canBePoked(*workspace_.resolved()->system));
    });
}

void CompareView::togglePoking() {
    if (workspace_.hasScene() && canBePoked(*workspace_.resolved()->system))
        poking_->setOn(!poking_->isOn());
    else
        emit startRefused(tr("no field of this scene can be poked"));
}

void CompareView::connectSketch() {
    sketch_ = new MechanismSketch(workspace_, *stage_);
    sketch_->setTheme(*theme_);
    stageCard_->body()->insertWidget(1, sketch_);
    QAction* const draws = stageCard_->menu()->addAction(tr("Draw the mechanism"));
    draws->setCheckable(true);
    connect(draws, &QAction::triggered, this, [this] { drawMechanism(false); });
    QAction* const writes =
        stageCard_->menu()->addAction(tr("Write the mechanism as formulas"), this, [this] {
            const Value typed = typedScene(*workspace_.resolved());
            workspace_.edit({{"/model", *typed.find("model")}, {"/initial", *typed.find("initial")}},
                            tr("Write the mechanism as formulas"));
        });
    connect(stageCard_->menu(), &QMenu::aboutToShow, this, [this, draws, writes] {
        const bool isDrawn =
            workspace_.hasScene() && workspace_.resolved()->system->parts.find<WrittenForm>();
        draws->setVisible(isDrawn);
        writes->setVisible(isDrawn);
        draws->setChecked(sketch_->isOpen());
    });
    // The sheet has the whole page, as far as the stage has not been given it before.
    connect(sketch_, &MechanismSketch::openChanged, this, [this](bool isOpen) {
        if ((maximized_ == stageCard_) != isOpen) maximize(stageCard_);
    });
    connect(sketch_, &MechanismSketch::refused, this, &CompareView::sketchRefused);
    connect(sketch_, &MechanismSketch::accepted, this, [this] { emit sketchRefused({}, {}); });
    connect(sketch_, &MechanismSketch::played, this, [this] {
        playback_.setTime(playback_.start());
        playback_.setPlaying(true);
    });
}

void CompareView::drawMechanism(bool isEmpty) {
    if (sketch_->isOpen())
        sketch_->end();
    else
        sketch_->begin(isEmpty);
}

/// Cards stay where they are while a body is dragged, although a short run may be about square, or not.
CardShape CompareView::shapeOf(const Slot& slot) const {
    const auto before = std::find_if(arranged_.begin(), arranged_.end(),
                                     [&](const auto& card) { return card.first == slot.card; });
    if (isPreviewing() && before != arranged_.end()) return before->second;
    const Figure& figure = slot.plot->figure();
    return figure.aspect == Aspect::equal && !isEmpty(figure) ? CardShape::square : CardShape::plot;
}

bool CompareView::isPreviewing() const { return bodies_->preview() != nullptr; }

std::shared_ptr<const Comparison> CompareView::shownResults() const {
    return isPreviewing() ? bodies_->preview() : run_.results();
}

void CompareView::tellOfHand() {
    if (!system_) return;
    const bool isByHand = hasMovableBodies(*system_);
    stage_->setToolTip(
        isByHand ? QString()
        : system_->field.isGraph
            ? tr("Drag with Ctrl to draw the initial profile.")
            : tr("What this model draws is not dragged. Its start is set in the form on the left."));
}

}  // namespace extremal
