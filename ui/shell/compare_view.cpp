#include "ui/shell/compare_view.hpp"

#include <QGridLayout>
#include <QMenu>
#include <QScrollArea>
#include <QTimer>

#include <algorithm>

#include "engine/figure/figure.hpp"
#include "engine/core/text.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/map_grid.hpp"
#include "engine/view/axes.hpp"
#include "ui/panels/card.hpp"
#include "ui/plots/plot_group.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/playback.hpp"
#include "ui/shell/plot_edits.hpp"
#include "ui/shell/run_control.hpp"
#include "ui/shell/scheme_edits.hpp"
#include "ui/shell/workspace.hpp"
#include "ui/stage/stage_widget.hpp"

namespace extremal {
namespace {

/// Views of the same plot: their part and curve may differ, which follow the parameters, but for keys that
/// choose its axes.
bool isSameCard(const View& a, const View& b) {
    return a.id == b.id && a.x == b.x && a.y == b.y && a.at == b.at && a.scheme == b.scheme &&
           (a.id == mapView || a.keys == b.keys);
}

}  // namespace

CompareView::CompareView(Workspace& workspace, RunControl& run, Playback& playback, const Theme& theme,
                         QWidget* parent)
    : QWidget(parent),
      workspace_(workspace),
      run_(run),
      playback_(playback),
      theme_(&theme),
      group_(new PlotGroup(this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    auto* scroll = new QScrollArea;
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    inside_ = new QWidget;
    inside_->setProperty("ground", "window");
    grid_ = new QGridLayout(inside_);
    grid_->setContentsMargins(0, 0, 2, 0);
    grid_->setSpacing(10);
    scroll->setWidget(inside_);
    layout->addWidget(scroll);

    stageCard_ = new Card(tr("Stage"), inside_);
    stage_ = new StageWidget;
    stage_->setTheme(theme);
    stage_->setAccessibleName(tr("Stage"));
    stageCard_->body()->addWidget(stage_, 1);
    stageCard_->menu()->addAction(tr("Fit"), stage_, &StageWidget::fit);

    connect(&workspace_, &Workspace::sceneChanged, this, &CompareView::rebuild);
    connect(&workspace_, &Workspace::selectionChanged, this, [this] {
        const int i = workspace_.selectedScheme();
        const auto& schemes = workspace_.scene().schemes;
        const QString label = i >= 0 && i < static_cast<int>(schemes.size())
                                  ? QString::fromStdString(schemes[static_cast<std::size_t>(i)].label)
                                  : QString();
        for (const Slot& s : slots_) s.plot->setHighlighted(label);
    });
    connect(&run_, &RunControl::resultsChanged, this, &CompareView::refresh);
    connect(&run_, &RunControl::stateChanged, this, [this] {
        for (const Slot& s : slots_) s.plot->setStale(run_.isStale());
    });
    connect(&playback_, &Playback::timeChanged, this, [this](double t) {
        stage_->setTime(t);
        group_->setCursor(t);
    });
    connect(group_, &PlotGroup::cursorMoved, &playback_, &Playback::setTime);
    connect(group_, &PlotGroup::pointClicked, &workspace_, &Workspace::selectScheme);
    connect(group_, &PlotGroup::saveFailed, this, &CompareView::saveFailed);
}

void CompareView::setTheme(const Theme& theme) {
    theme_ = &theme;
    stage_->setTheme(theme);
    for (const Slot& s : slots_) s.plot->setTheme(theme);
}

void CompareView::rebuild() {
    if (!workspace_.hasScene()) return;
    std::vector<View> views{{"work-precision", "", ""}};
    for (View& v : plotViews(workspace_.scene()))
        if (v.id != "work-precision")
            views.push_back(std::move(v));
        else
            views.front() = std::move(v);
    const bool isSameCards =
        std::equal(views.begin(), views.end(), shownViews_.begin(), shownViews_.end(), isSameCard);
    shownViews_ = views;
    if (isSameCards) {
        for (std::size_t i = 0; i < views.size(); ++i) slots_[i].view = views[i];
        return refresh();
    }
    for (const Slot& s : slots_) delete s.card;
    slots_.clear();
    for (const View& view : views) {
        auto* card = new Card({}, inside_);
        auto* plot = new PlotWidget(*theme_);
        card->body()->addWidget(plot, 1);
        QMenu* menu = card->menu();
        menu->addAction(tr("Fit"), plot, &PlotWidget::fit);
        menu->addAction(tr("Previous view"), plot, &PlotWidget::back);
        menu->addSeparator();
        const std::size_t slot = slots_.size();
        slots_.push_back({view, card, plot});
        addSceneActions(*menu, slot);
        menu->addSeparator();
        addChoices(*menu, workspace_, view.id, [this, slot] { return slots_[slot].view; });
        addNames(*menu, workspace_, view.id, [this, slot] { return slots_[slot].view; });
        menu->addSeparator();
        menu->addAction(tr("Copy picture"), plot, &PlotWidget::copyImage);
        menu->addAction(tr("Save as..."), plot, &PlotWidget::saveDialog);
        group_->add(plot);
        connect(plot, &PlotWidget::cellChosen, this,
                [this, view](double value, double step) { loadCase(view, value, step); });
    }
    columns_ = 0;
    arrange();
    refresh();
}

/// What the scene keeps of a plot; offered where it can be. The edits come after the menu has closed, as they
/// may replace it.
void CompareView::addSceneActions(QMenu& menu, std::size_t slot) {
    QAction* all = menu.addAction(tr("Show all data"), this, [this, slot] { slots_[slot].plot->showAll(); });
    QAction* keep = menu.addAction(tr("Store this range in the scene"), this, [this, slot] {
        keepPart(workspace_, slots_[slot].view, *slots_[slot].plot);
    });
    QAction* forget = menu.addAction(tr("Remove the range from the scene"), this, [this, slot] {
        View after = slots_[slot].view;
        after.xRange = after.yRange = {};
        slots_[slot].plot->fit();
        workspace_.edit(editsForPlot(workspace_.scene(), slots_[slot].view, after), tr("Show all data"));
    });
    QAction* curve = menu.addAction(tr("Compare with a curve..."), this,
                                    [this, slot] { askForCurve(workspace_, slots_[slot].view, this); });
    connect(&menu, &QMenu::aboutToShow, this, [this, slot, all, keep, forget, curve] {
        const View& view = slots_[slot].view;
        const ViewAxes axes = axesOf(view, system_);
        const bool hasPart = view.xRange || view.yRange;
        all->setVisible(hasPart);
        forget->setVisible(hasPart);
        keep->setVisible(axes.hasScales);
        keep->setEnabled(slots_[slot].plot->isUserZoomed());
        curve->setVisible(!axes.variable.empty());
    });
}

void CompareView::arrange() {
    const int columns = width() >= 500 ? 2 : 1;
    if (columns == columns_) return;
    columns_ = columns;
    while (QLayoutItem* item = grid_->takeAt(0)) delete item;
    // Six half-columns: the stage is a little wider than what stands beside it.
    const int plotHeight = 168;
    stageCard_->setMinimumHeight(columns == 2 ? 225 : 240);
    stageCard_->setVisible(hasStage_);
    int row = 0;
    if (!hasStage_) {
        if (!slots_.empty()) grid_->addWidget(slots_[0].card, 0, 0, 1, 12);
    } else if (columns == 2) {
        grid_->addWidget(stageCard_, 0, 0, 1, 7);
        if (!slots_.empty()) grid_->addWidget(slots_[0].card, 0, 7, 1, 5);
    } else {
        grid_->addWidget(stageCard_, 0, 0, 1, 12);
        if (!slots_.empty()) grid_->addWidget(slots_[0].card, ++row, 0, 1, 12);
    }
    grid_->setRowStretch(0, 6);
    for (std::size_t i = 1; i < slots_.size(); ++i) {
        const bool isLastAlone = columns == 2 && i + 1 == slots_.size() && i % 2 == 1;
        if (columns == 1 || i % 2 == 1) ++row;
        if (columns == 1 || isLastAlone)
            grid_->addWidget(slots_[i].card, row, 0, 1, 12);
        else
            grid_->addWidget(slots_[i].card, row, i % 2 == 1 ? 0 : 6, 1, 6);
        grid_->setRowStretch(row, 5);
    }
    for (const Slot& s : slots_) s.card->setMinimumHeight(plotHeight);
    for (int c = 0; c < 12; ++c) {
        grid_->setColumnStretch(c, 1);
        grid_->setColumnMinimumWidth(c, 1);
    }
}

void CompareView::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    arrange();
}

void CompareView::refresh() {
    const auto results = run_.results();
    stage_->setComparison(results);
    stage_->setTime(playback_.time());
    if (!results) return;
    if (!(systemModel_ == results->scene.model) || system_.id.empty()) {
        system_ = results->system ? *results->system : makeSystem(results->scene);
        systemModel_ = results->scene.model;
        if (const bool draws = system_.independent == "t";
            draws != hasStage_) {  // nothing moves along a place
            hasStage_ = draws;
            columns_ = 0;
            arrange();
        }
    }
    for (const Slot& s : slots_) {
        const Figure figure = makeFigure(*results, s.view, &system_);
        s.card->setTitle(QString::fromStdString(figure.title));
        s.card->setSubtitle(QString::fromStdString(figure.subtitle));
        s.plot->setFigure(figure);
        s.plot->setStale(run_.isStale());
    }
    QTimer::singleShot(0, this, &CompareView::alignMargins);
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

void CompareView::alignMargins() {
    // Plots above each other share their left edge: the widest margin of each column.
    for (const int parity : {0, 1}) {
        int widest = 0;
        for (std::size_t i = 1; i < slots_.size(); ++i)
            if (columns_ == 1 || static_cast<int>(i % 2) == parity)
                widest = std::max(widest, slots_[i].plot->leftMargin());
        for (std::size_t i = 1; i < slots_.size(); ++i)
            if (columns_ == 1 || static_cast<int>(i % 2) == parity)
                slots_[i].plot->setLeftMargin(std::min(widest, 90));
    }
}

void CompareView::fitAll() {
    group_->fitAll();
    stage_->fit();
}

PlotWidget* CompareView::currentPlot() const {
    for (const Slot& s : slots_)
        if (s.plot->hasFocus()) return s.plot;
    return slots_.size() > 1 ? slots_[1].plot : slots_.empty() ? nullptr : slots_[0].plot;
}

std::vector<PlotWidget*> CompareView::plots() const {
    std::vector<PlotWidget*> all;
    for (const Slot& s : slots_) all.push_back(s.plot);
    return all;
}

}  // namespace extremal
