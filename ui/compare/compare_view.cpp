// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/compare/compare_view.hpp"

#include <QEvent>
#include <QMenu>
#include <QPointer>
#include <QScrollArea>
#include <QTimer>

#include <algorithm>

#include "engine/figure/figure.hpp"
#include "engine/figure/panels.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/map_grid.hpp"
#include "engine/view/axes.hpp"
#include "ui/base/background.hpp"
#include "ui/base/card.hpp"
#include "ui/base/steady_scroll_area.hpp"
#include "ui/compare/body_dragging.hpp"
#include "ui/compare/case_preview.hpp"
#include "ui/compare/plot_edits.hpp"
#include "ui/compare/starting.hpp"
#include "ui/plots/plot_group.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/sketch/mechanism_sketch.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

constexpr int wideWidth = 1250;  // of the page, from which three columns have room

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
    auto* scroll = scroll_ = new SteadyScrollArea;
    scroll->setAccessibleName(tr("Plots"));
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    inside_ = new QWidget;
    inside_->setProperty("ground", "window");
    cardLayout_ = new CardLayout(inside_);
    cardLayout_->setContentsMargins(0, 0, 2, 0);
    // Another height or width of a card gives other ticks, and these other margins.
    align_.setSingleShot(true);
    connect(&align_, &QTimer::timeout, this, &CompareView::alignMargins);
    cardLayout_->setPlaced([this] { align_.start(); });
    scroll->setWidget(inside_);
    scroll->installEventFilter(this);
    layout->addWidget(scroll);
    makeStage();
    connectState();
}

CompareView::~CompareView() = default;

void CompareView::connectState() {
    connect(&workspace_, &Workspace::opened, this, [this] {  // another scene has no zoom yet
        arranged_.clear();
        forgetSizes();
        stageSize_ = {};
        group_->setPinned({});
        for (auto& s : slots_) discard(std::move(s));
        slots_.clear();
        maximized_ = nullptr;
        group_->forget();
        times_.reset();
    });
    connect(&workspace_, &Workspace::sceneChanged, this, &CompareView::rebuild);
    connect(&workspace_, &Workspace::selectionChanged, this, [this] {
        for (const auto& s : slots_) s->plot->setHighlighted(selectedLabel());
    });
    connect(&run_, &RunControl::resultsChanged, this, &CompareView::refresh);
    connect(&run_, &RunControl::stateChanged, this, [this] {
        for (const auto& s : slots_) {
            s->plot->setStale(run_.isStale());
            if (!s->shown) s->plot->setFigure(figureToCome(s->view, run_.state()));
        }
    });
    connect(&playback_, &Playback::timeChanged, this, [this](double t) {
        if (!preview_->isShown()) stage_->setTime(t);
        group_->setCursor(t);
    });
    connect(group_, &PlotGroup::cursorMoved, &playback_, &Playback::setTime);
    connect(group_, &PlotGroup::pointClicked, this, [this](int style) {
        const auto& schemes = workspace_.scene().schemes;
        for (std::size_t i = 0; i < schemes.size(); ++i)
            if (styleOf(schemes[i], i) == style) return workspace_.selectScheme(static_cast<int>(i));
    });
    connect(group_, &PlotGroup::saveFailed, this, &CompareView::saveFailed);
    connect(group_, &PlotGroup::timeRangeChanged, this, &CompareView::showTimes);
}

QString CompareView::selectedLabel() const {
    const int i = workspace_.selectedScheme();
    const auto& schemes = workspace_.scene().schemes;
    return i >= 0 && i < static_cast<int>(schemes.size())
               ? QString::fromStdString(schemes[static_cast<std::size_t>(i)].label)
               : QString();
}

std::vector<std::function<void()>> CompareView::partsOfTheme(const Theme& theme) {
    theme_ = &theme;
    std::vector<std::function<void()>> parts;
    parts.emplace_back([this, &theme] {
        stage_->setTheme(theme);
        sketch_->setTheme(theme);
    });
    for (const auto& s : slots_)
        parts.emplace_back([plot = QPointer(s->plot), &theme] {
            if (plot) plot->setTheme(theme);
        });
    return parts;
}

void CompareView::rebuild() {
    if (!workspace_.hasScene()) return;
    std::vector<View> views{{"work-precision", "", ""}};
    for (View& v : plotViews(workspace_.scene()))
        if (v.id != "work-precision")
            views.push_back(std::move(v));
        else
            views.front() = std::move(v);
    // Cards whose view is still there stay, with their zoom; the others go.
    std::vector<std::unique_ptr<Slot>> before = std::move(slots_);
    slots_.clear();
    bool isSameSet = before.size() == views.size();
    for (std::size_t i = 0; i < views.size(); ++i) {
        const auto kept = std::find_if(before.begin(), before.end(), [&](const auto& slot) {
            return slot && isSameCard(slot->view, views[i]);
        });
        isSameSet = isSameSet && kept - before.begin() == static_cast<std::ptrdiff_t>(i);
        if (kept == before.end()) {
            makeSlot(views[i]);
        } else {
            slots_.push_back(std::move(*kept));
            slots_.back()->view = views[i];
        }
    }
    for (auto& slot : before) {
        if (!slot) continue;
        if (slot->card == maximized_) maximized_ = nullptr;
        std::erase_if(arranged_, [&](const auto& c) { return c.first == slot->card; });
        discard(std::move(slot));
    }
    takeSizes();
    if (!isSameSet) arrange();
    refresh();
}

/// A card that goes may be the one that is pressed: the press has left a field, and what was typed there took
/// the card away. It leaves the page at once, and ends when the press is over.
void CompareView::discard(std::unique_ptr<Slot> slot) {
    Slot* const last = slot.release();
    last->plot->disconnect(this);
    connect(last->card, &QObject::destroyed, [last] { delete last; });
    last->card->hide();
    last->card->setParent(nullptr);
    last->card->deleteLater();
}

void CompareView::makeMaximizable(Card& card) {
    QAction* action = card.menu()->addAction(tr("Maximise"), this, [this, &card] { maximize(&card); });
    connect(card.menu(), &QMenu::aboutToShow, &card, [this, &card, action] {
        action->setText(maximized_ == &card ? tr("Restore (Esc)") : tr("Maximise"));
    });
    connect(&card, &Card::headerDoubleClicked, this, [this, &card] { maximize(&card); });
}

void CompareView::maximize(Card* card) {
    maximized_ = maximized_ == card ? nullptr : card;
    arrange();
}

bool CompareView::restore() {
    if (!maximized_) return false;
    maximize(maximized_);
    return true;
}

CompareView::Slot& CompareView::makeSlot(const View& view) {
    auto* card = new Card({}, inside_);
    auto* plot = new PlotWidget(*theme_);
    card->body()->addWidget(plot, 1);
    Slot& slot = *slots_.emplace_back(new Slot{nextNumber_++, view, card, plot});
    const Figure coming = figureToCome(view, run_.state());
    card->setTitle(QString::fromStdString(coming.title));
    plot->setFigure(coming);
    QMenu* menu = card->menu();
    menu->addAction(tr("Fit"), plot, &PlotWidget::fit);
    menu->addAction(tr("Previous view"), plot, &PlotWidget::back);
    makeMaximizable(*card);
    addPlaceActions(*menu, slot);
    menu->addSeparator();
    addSceneActions(*menu, slot);
    menu->addSeparator();
    addChoices(*menu, workspace_, view.id, [&slot] { return slot.view; });
    addNames(*menu, workspace_, view.id, [&slot] { return slot.view; });
    addStartActions(*menu, workspace_, [&slot] { return slot.view; });
    menu->addSeparator();
    menu->addAction(tr("Copy picture"), plot, &PlotWidget::copyImage);
    menu->addAction(tr("Save as..."), plot, &PlotWidget::saveDialog);
    group_->add(plot);
    plot->setHighlighted(selectedLabel());
    connect(plot, &PlotWidget::levelMoved, this, &CompareView::wantedMoved);
    connectCases(slot);
    connectStarting(slot);
    return slot;
}

const System* CompareView::systemOfScene() const {
    const auto results = run_.results();
    const bool isOfScene =
        results && system_ && workspace_.hasScene() && results->scene.model == workspace_.scene().model;
    return isOfScene ? system_.get() : nullptr;
}

void CompareView::connectStarting(Slot& slot) {
    connect(slot.plot, &PlotWidget::placeClicked, this, [this, &slot](double x, double y) {
        const System* const system = systemOfScene();
        if (!system) return;
        const StartEdits start =
            editsForStart(workspace_.scene(), slot.view, *system, roundedPlace({x, y}, *slot.plot));
        if (!start.problem.isEmpty()) return emit startRefused(start.problem);
        if (!start.edits.empty()) workspace_.edit(start.edits, tr("Add a start"));
    });
    connect(slot.plot, &PlotWidget::orbitAsked, this, [this, &slot](double x, double y) {
        const System* const system = systemOfScene();
        if (!system) return;
        const StartEdits start =
            editsForMove(workspace_.scene(), slot.view, *system, roundedPlace({x, y}, *slot.plot));
        if (!start.problem.isEmpty()) return emit startRefused(start.problem);
        if (!start.edits.empty()) emit orbitAsked(start.edits);
    });
    connect(slot.plot, &PlotWidget::handleMoved, this, [this, &slot](double x, double y) {
        const System* const system = systemOfScene();
        if (!system) return;
        const StartEdits move =
            editsForMove(workspace_.scene(), slot.view, *system, roundedPlace({x, y}, *slot.plot));
        if (!move.edits.empty()) workspace_.edit(move.edits, tr("Move the start"), QStringLiteral("start"));
    });
}

void CompareView::showStarts() {
    const System* const system = systemOfScene();
    for (const auto& s : slots_) {
        const bool isDrawn = !isEmpty(s->plot->figure());
        s->plot->setHandle(system && isDrawn ? startInView(workspace_.scene(), s->view, *system)
                                             : std::nullopt);
        s->plot->setClickable(system && takesStarts(s->view, *system));
    }
}

/// What the scene keeps of a plot; offered where it can be. The edits come after the menu has closed, as they
/// may replace it.
void CompareView::addSceneActions(QMenu& menu, Slot& slot) {
    QAction* all = menu.addAction(tr("Show all data"), this, [&slot] { slot.plot->showAll(); });
    QAction* keep = menu.addAction(tr("Store this range in the scene"), this, [this, &slot] {
        workspace_.edit(editsForPlot(workspace_.scene(), slot.view, withPart(slot.view, *slot.plot)),
                        tr("Store the range of a plot"));
    });
    QAction* forget = menu.addAction(tr("Remove the range from the scene"), this, [this, &slot] {
        View after = slot.view;
        after.xRange = after.yRange = {};
        slot.plot->fit();
        workspace_.edit(editsForPlot(workspace_.scene(), slot.view, after), tr("Show all data"));
    });
    QAction* curve = menu.addAction(tr("Compare with a curve..."), this,
                                    [this, &slot] { askForCurve(workspace_, slot.view, this); });
    connect(&menu, &QMenu::aboutToShow, this, [this, &slot, all, keep, forget, curve] {
        const View& view = slot.view;
        const ViewAxes axes = system_ ? axesOf(view, *system_) : ViewAxes{};
        const bool hasPart = view.xRange || view.yRange;
        all->setVisible(hasPart);
        forget->setVisible(hasPart);
        keep->setVisible(axes.hasScales);
        keep->setEnabled(slot.plot->isUserZoomed());
        curve->setVisible(!axes.variable.empty());
    });
}

int CompareView::columns() const {
    if (isPresented_) return width() >= height() ? 2 : 1;
    switch (pageLayout_) {
        case PageLayout::oneColumn:
            return 1;
        case PageLayout::twoColumns:
            return 2;
        case PageLayout::threeColumns:
            return 3;
        default:
            return width() >= wideWidth ? 3 : width() >= 470 ? 2 : 1;
    }
}

void CompareView::setPageLayout(PageLayout layout) {
    pageLayout_ = layout;
    arrange();
}

/// Puts the cards in their places, if anything that decides on these has changed.
void CompareView::arrange() {
    const bool showsStage = hasStage_ && pageLayout_ != PageLayout::plotsOnly;
    std::vector<std::pair<Card*, CardShape>> cards;
    if (maximized_) {
        cards.emplace_back(maximized_, CardShape::plot);
    } else {
        if (showsStage) cards.emplace_back(stageCard_, CardShape::stage);
        const bool hasPresented =
            isPresented_ && std::any_of(slots_.begin(), slots_.end(),
                                        [&](const auto& s) { return s->number == presentedSlot_; });
        for (const auto& s : slots_) {
            if (isPresented_ && (hasPresented ? s->number != presentedSlot_ : s != slots_.front())) continue;
            cards.emplace_back(s->card, shapeOf(*s));
        }
    }
    if (columns() == columns_ && cards == arranged_) return;
    columns_ = columns();
    arranged_ = std::move(cards);
    cardLayout_->clear();
    cardLayout_->setColumns(columns_);
    const auto isPlaced = [&](const Card* card) {
        return std::any_of(arranged_.begin(), arranged_.end(),
                           [&](const auto& c) { return c.first == card; });
    };
    for (const auto& [card, shape] : arranged_) cardLayout_->addCard(card, shape);
    stageCard_->setVisible(isPlaced(stageCard_));
    for (const auto& s : slots_) s->card->setVisible(isPlaced(s->card));
    align_.start();
}

/// Before the scroll area has decided on its bar: with the sight of the size before, its rows could need the
/// bar where it is not, and not need it where it is.
bool CompareView::eventFilter(QObject* watched, QEvent* event) {
    if (watched == scroll_ && event->type() == QEvent::Resize)
        cardLayout_->setSight(scroll_->height(), scroll_->width());
    return QWidget::eventFilter(watched, event);
}

void CompareView::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    arrange();
}

void CompareView::refresh() {
    const auto results = shownResults();
    if (!results) {
        staged_.reset();
        stage_->setPlayer({});
        return;
    }
    for (const auto& s : slots_) s->plot->setStale(run_.isStale() || isPreviewing());
    if (!system_ || results->system != system_) {
        system_ =
            results->system ? results->system : std::make_shared<const System>(makeSystem(results->scene));
        // Nothing moves along a place.
        if (const bool draws = system_->independent == "t" && system_->draw; draws != hasStage_) {
            hasStage_ = draws;
            arrange();
        }
    }
    showStarts();
    tellOfHand();
    startJob();
}

/// What has to be made for the latest results.
FigureJob CompareView::missing() const {
    FigureJob job{shownResults(), {}, false};
    if (!job.results) return job;
    for (const auto& s : slots_)
        if (!s->shown || !(s->shownView == s->view) || !isSameData(*s->shown, *job.results))
            job.views.emplace_back(s->number, s->view);
    job.makesStage = !preview_->isShown() && (!staged_ || !isSameData(*staged_, *job.results));
    return job;
}

bool CompareView::isCurrent() const {
    const FigureJob job = missing();
    return job.views.empty() && !job.makesStage;
}

/// One job at a time: what comes while it goes on is made after it, and what comes after that takes its
/// place.
void CompareView::startJob() {
    if (isJobRunning_) return;
    FigureJob job = missing();
    if (job.views.empty() && !job.makesStage) return;
    isJobRunning_ = true;
    runInBackground([self = QPointer(this), job = std::move(job)] {
        auto made = std::make_shared<FigureSet>(makeFigures(job));
        sendToWindow([self, made] {
            if (!self) return;
            self->isJobRunning_ = false;
            self->take(std::move(*made));
            self->startJob();
        });
    });
}

void CompareView::complete() {
    bodies_->cancel();
    if (run_.results()) take(makeFigures(missing()));
}

void CompareView::take(FigureSet made) {
    const auto latest = shownResults();
    // Of another scene: that one's are on their way.
    if (!made.job.results || !latest || !(latest->scene.model.type == made.job.results->scene.model.type))
        return;
    for (std::size_t i = 0; i < made.figures.size(); ++i) {
        const auto& [number, view] = made.job.views[i];
        const auto slot = std::find_if(slots_.begin(), slots_.end(),
                                       [n = number](const auto& s) { return s->number == n; });
        if (slot == slots_.end()) continue;
        Slot& s = **slot;
        s.shown = made.job.results;
        s.shownView = view;
        // A preview lacks what takes long, as errors do: such plots stay as they were, pale.
        if (isPreviewing() && (isEmpty(made.figures[i]) || view.id == "work-precision")) continue;
        addSweep(view, made.figures[i]);
        s.card->setTitle(QString::fromStdString(made.figures[i].title));
        s.card->setSubtitle(QString::fromStdString(made.figures[i].subtitle));
        s.whole = std::move(made.figures[i]);
        s.plot->setFigure(inTimes(*s.whole));
        if (!isPortrait(*s.whole)) s.whole.reset();
        ++figuresMade_;
    }
    if (made.player && !preview_->isShown()) {
        staged_ = made.job.results;
        stage_->setPlayer(std::move(*made.player));
        stage_->setTime(playback_.time());
        describeStage();
    }
    if (made.figures.empty()) return;
    arrange();
    showStarts();
    showWanted();
    align_.start();
    emit figuresChanged();
}

void CompareView::pointAt(const QString& view) {
    const auto mark = [&](Card* card, bool isMeant) {
        card->setSelected(isMeant);
        if (isMeant) scroll_->ensureWidgetVisible(card);
    };
    mark(stageCard_, view == "stage");
    bool isFirst = true;
    for (const auto& s : slots_) {
        const bool isMeant = isFirst && s->view.id == view.toStdString();
        if (isMeant && std::exchange(presentedSlot_, s->number) != s->number && isPresented_) arrange();
        mark(s->card, isMeant && !isPresented_);
        isFirst = isFirst && !isMeant;
    }
}

void CompareView::fitAll() {
    group_->fitAll();
    stage_->fit();
}

PlotWidget* CompareView::currentPlot() const {
    for (const auto& s : slots_)
        if (s->plot->hasFocus()) return s->plot;
    return slots_.size() > 1 ? slots_[1]->plot : slots_.empty() ? nullptr : slots_[0]->plot;
}

std::vector<PlotWidget*> CompareView::plots() const {
    std::vector<PlotWidget*> all;
    for (const auto& s : slots_) all.push_back(s->plot);
    return all;
}

}  // namespace extremal
