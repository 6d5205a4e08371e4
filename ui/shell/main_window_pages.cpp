// SPDX-License-Identifier: GPL-3.0-or-later
/// What the main window consists of: the bar at the top, and below it either the start page or the work page
/// with the scene on the left, plots and studies in the middle, and the schemes on the right.
#include <QEvent>
#include <QLabel>
#include <QScrollArea>
#include <QSplitter>
#include <QStackedWidget>
#include <QStatusBar>
#include <QTabBar>
#include <QVBoxLayout>

#include <algorithm>

#include "ui/base/card.hpp"
#include "ui/base/notices.hpp"
#include "ui/base/steady_scroll_area.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/compare/orbit_finder.hpp"
#include "ui/own/own_list.hpp"
#include "ui/panels/discretizer.hpp"
#include "ui/panels/scene_panel.hpp"
#include "ui/panels/scheme_list.hpp"
#include "ui/panels/values_table.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/banners.hpp"
#include "ui/shell/header_bar.hpp"
#include "ui/shell/lesson_bar.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/shell/notes_page.hpp"
#include "ui/shell/record_bar.hpp"
#include "ui/shell/start_page.hpp"
#include "ui/shell/timeline.hpp"
#include "ui/study/background_sweep.hpp"
#include "ui/study/cell_costs.hpp"
#include "ui/study/needs_card.hpp"
#include "ui/study/study_page.hpp"
#include "ui/text/text_view.hpp"
#include "ui/workspace/autosave.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/wanted.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

/// As high as what is in it, where there is room.
class SceneArea : public SteadyScrollArea {
public:
    QSize sizeHint() const override { return widget() ? widget()->sizeHint() : SteadyScrollArea::sizeHint(); }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
        if (watched == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
        return SteadyScrollArea::eventFilter(watched, event);
    }
};

/// Two that share the height: what is above has what it needs as long as the other keeps a bit more than
/// half, and each scrolls by itself.
class SharedPanel : public QWidget {
public:
    SharedPanel(QWidget& above, QWidget& below) : above_(above), below_(below) {
        above_.setParent(this);
        below_.setParent(this);
    }
    QSize sizeHint() const override {
        return {std::max(above_.sizeHint().width(), below_.sizeHint().width()),
                above_.sizeHint().height() + gap + below_.sizeHint().height()};
    }
    QSize minimumSizeHint() const override {
        constexpr int least = 300;
        return {0, least};
    }

protected:
    void resizeEvent(QResizeEvent*) override { share(); }
    bool event(QEvent* event) override {
        if (event->type() == QEvent::LayoutRequest) share();
        return QWidget::event(event);
    }

private:
    static constexpr int gap = 12;
    void share() {
        constexpr int percent = 55;
        const int room = height() - gap, wanted = below_.hasHeightForWidth() ? below_.heightForWidth(width())
                                                                             : below_.sizeHint().height();
        const int below = std::min(wanted, std::max(room - above_.sizeHint().height(), room * percent / 100));
        above_.setGeometry(0, 0, width(), room - below);
        below_.setGeometry(0, room - below + gap, width(), below);
    }
    QWidget &above_, &below_;
};

}  // namespace

void MainWindow::makePages() {
    auto* whole = new QWidget;
    auto* column = new QVBoxLayout(whole);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    auto* sweep = new BackgroundSweep(*run_, this);
    makeHeader(*sweep);
    column->addWidget(header_);
    QWidget* const work = makeWorkPage(*sweep);
    makeStartPage();
    for (const auto& [widget, page] : {std::pair<QWidget*, const char*>{left_, "models"},
                                       {discretizer_, "spaces"},
                                       {compare_, "observables"},
                                       {studies_, "studies"},
                                       {notesPage_, "scenes"},
                                       {schemes_, "schemes"},
                                       {startPage_, "tour"}})
        widget->setProperty("help", page);  // of F1
    stack_ = new QStackedWidget;
    stack_->addWidget(startPage_);
    stack_->addWidget(work);
    connect(stack_, &QStackedWidget::currentChanged, this, &MainWindow::showSight);
    column->addWidget(stack_, 1);
    setCentralWidget(whole);
    makeStatus();
}

void MainWindow::makeHeader(BackgroundSweep& sweep) {
    header_ = new HeaderBar(*workspace_, *run_, sweep, *wanted_);
    connect(header_, &HeaderBar::runRequested, run_, &RunControl::start);
    connect(header_, &HeaderBar::stopRequested, run_, &RunControl::stop);
    connect(header_, &HeaderBar::stepRequested, this, [this] { playback_->stepBy(1, rowStep()); });
    connect(header_, &HeaderBar::exportRequested, this, &MainWindow::exportDialog);
    connect(header_, &HeaderBar::paletteRequested, this, &MainWindow::showPalette);
}

QWidget* MainWindow::makeWorkPage(BackgroundSweep& sweep) {
    makeSceneColumn();
    QWidget* const centre = makeCentre(sweep);
    schemes_ = new SchemeList(*workspace_, *run_, theme_);
    connect(schemes_, &SchemeList::catalogueRequested, this, [this] { ownList().open(); });
    needs_ = new NeedsCard(*workspace_, *wanted_, theme_);
    needs_->setProperty("help", "studies");
    schemes_->addFoot(needs_);
    splitter_ = new QSplitter;
    splitter_->setChildrenCollapsible(false);
    splitter_->setHandleWidth(12);
    splitter_->addWidget(leftPanel_);
    splitter_->addWidget(centre);
    splitter_->addWidget(schemes_);
    splitter_->setStretchFactor(1, 1);
    tellOfNeeds();
    auto* work = new QWidget;
    auto* row = new QVBoxLayout(work);
    row->setContentsMargins(12, 12, 12, 4);
    row->addWidget(splitter_);
    return work;
}

void MainWindow::makeSceneColumn() {
    left_ = new SceneArea;
    left_->setAccessibleName(tr("Scene"));
    left_->setWidgetResizable(true);
    left_->setFrameShape(QFrame::NoFrame);
    left_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* inside = new QWidget;
    inside->setProperty("ground", "window");
    auto* column = new QVBoxLayout(inside);
    column->setContentsMargins(0, 0, 2, 0);
    column->setSpacing(12);
    discretizer_ = new Discretizer(*workspace_);
    discretizer_->setTheme(theme_);
    connect(discretizer_, &Discretizer::ownChosen, this, &MainWindow::showOwn);
    column->addWidget(new ScenePanel(*workspace_));
    column->addStretch();
    left_->setWidget(inside);
    leftPanel_ = new SharedPanel(*left_, *discretizer_);
    cellCosts_ = new CellCosts(*workspace_, *wanted_, *discretizer_, this);
}

QWidget* MainWindow::makeCentre(BackgroundSweep& sweep) {
    auto* centre = new QWidget;
    auto* column = new QVBoxLayout(centre);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
    tabs_ = new QTabBar;
    tabs_->setExpanding(false);
    tabs_->setDrawBase(false);
    for (const QString& title : {tr("Compare"), tr("Notes"), tr("Studies")}) tabs_->addTab(title);
    column->addWidget(tabs_);
    column->addWidget(new Banners(*notices_));
    const auto viewInSight = [this] {
        const PlotWidget* const plot = compare_->currentPlot();
        return plot ? plot->figure().view : std::string();
    };
    lesson_ = new LessonBar(*workspace_, *playback_, viewInSight);
    column->addWidget(lesson_);
    record_ = new RecordBar(*workspace_, *playback_, viewInSight);
    column->addWidget(record_);
    makeTabPages(sweep);
    column->addWidget(pages_, 1);
    timeline_ = new Timeline(*playback_);
    column->addWidget(timeline_);
    values_ = new ValuesTable;
    values_->hide();
    column->addWidget(values_);
    connect(tabs_, &QTabBar::currentChanged, this, &MainWindow::showPage);
    connect(lesson_, &LessonBar::viewPointed, this, [this](const QString& view) {
        if (!view.isEmpty()) tabs_->setCurrentIndex(0);
        compare_->pointAt(view);
    });
    tellOfPlots();
    tellOfStudies();
    return centre;
}

void MainWindow::makeTabPages(BackgroundSweep& sweep) {
    compare_ = new CompareView(*workspace_, *run_, *playback_, theme_);
    compare_->setSweep(sweep);
    compare_->setWanted(wanted_->error());
    connect(wanted_, &Wanted::changed, compare_, &CompareView::setWanted);
    connect(compare_, &CompareView::wantedMoved, wanted_, &Wanted::setError);
    notes_ = new TextView;
    notes_->setObjectName("notes");
    notes_->setAccessibleName(tr("Notes"));
    studies_ = new StudyPage(*workspace_, *wanted_, theme_);
    notesPage_ = new NotesPage(*workspace_, notes_);
    pages_ = new QStackedWidget;
    for (QWidget* page : {static_cast<QWidget*>(compare_), static_cast<QWidget*>(notesPage_),
                          static_cast<QWidget*>(studies_)})
        pages_->addWidget(page);
}

/// What comes of clicks in plots, as notices.
void MainWindow::tellOfPlots() {
    const auto tell = [this](const char* key, const QString& text, const QString& hint,
                             const std::vector<Notice::Choice>& choices = {}) {
        notices_->post({Notice::Kind::information, key, text, hint, choices});
    };
    connect(compare_, &CompareView::startRefused, this, [tell](const QString& reason) {
        tell("start", tr("No motion starts there: %1.").arg(reason),
             tr("choose a place inside the region that the energy admits"));
    });
    orbits_ = new OrbitFinder(*workspace_, *notices_, this);
    connect(compare_, &CompareView::orbitAsked, orbits_, &OrbitFinder::seek);
    connect(compare_, &CompareView::caseLoaded, this, [this, tell](const QString& text) {
        tell("case", tr("Loaded from the map: %1.").arg(text),
             tr("the dot in each map marks the scene; Ctrl+Z undoes this"),
             {{tr("Undo"), [this] { workspace_->undo(); }}});
    });
    connect(compare_, &CompareView::sketchRefused, this,
            [this](const QString& reason, const QString& remedy) {
                if (reason.isEmpty()) return notices_->dismiss(QStringLiteral("sketch"));
                notices_->post({Notice::Kind::warning,
                                "sketch",
                                tr("The drawing does not run: %1.").arg(reason),
                                remedy,
                                {},
                                "mechanisms"});
            });
    connect(compare_, &CompareView::saveFailed, this, [this](const QString& reason) {
        notices_->post(
            {Notice::Kind::error, "save", tr("The plot could not be saved: %1").arg(reason), {}, {}});
    });
}

/// What has come from a study into the scene, as a notice that offers the other page.
void MainWindow::tellOfStudies() {
    const auto tell = [this](const QString& text, const QString& otherPage, int tab) {
        notices_->post({Notice::Kind::information,
                        "study",
                        text,
                        tr("Ctrl+Z undoes this"),
                        {{otherPage, [this, tab] { tabs_->setCurrentIndex(tab); }},
                         {tr("Undo"), [this] { workspace_->undo(); }}}});
    };
    connect(studies_, &StudyPage::pointUsed, this,
            [tell](const QString& text) { tell(tr("In the scene now: %1.").arg(text), tr("Compare"), 0); });
    connect(studies_, &StudyPage::runLoaded, this, [this, tell](const QString& text) {
        tabs_->setCurrentIndex(0);
        tell(tr("Loaded from the study: %1.").arg(text), tr("Studies"), 2);
    });
    connect(studies_, &StudyPage::problemFound, this, [this](const QString& text, const QString& hint) {
        notices_->post({Notice::Kind::error, "studyProblem", text, hint, {}});
    });
}

/// What has come from the stair of needs into the scene.
void MainWindow::tellOfNeeds() {
    connect(needs_, &NeedsCard::used, this, [this](const QString& what) {
        notices_->post({Notice::Kind::information,
                        "study",
                        tr("In the scene now: %1.").arg(what),
                        tr("Ctrl+Z undoes this"),
                        {{tr("Undo"), [this] { workspace_->undo(); }}}});
    });
    connect(needs_, &NeedsCard::problemFound, this, [this](const QString& text, const QString& hint) {
        notices_->post({Notice::Kind::error, "studyProblem", text, hint, {}});
    });
}

void MainWindow::makeStartPage() {
    startPage_ = new StartPage(theme_, *notices_);
    connect(startPage_, &StartPage::restoreRequested, this, [this](const UnsavedScene& scene) {
        if (mayLeaveScene() && autosave_->restore(scene)) offerUnsaved();
    });
    connect(startPage_, &StartPage::discardRequested, this, [this](const UnsavedScene& scene) {
        autosave_->discard(scene);
        offerUnsaved();
    });
    connect(startPage_, &StartPage::presetChosen, this,
            [this](const QString& name) { open("preset:" + name); });
    connect(startPage_, &StartPage::lessonChosen, this, [this](const QString& name) {
        if (open("preset:" + name)) startLesson();
    });
    connect(startPage_, &StartPage::backRequested, this, &MainWindow::goBack);
    connect(startPage_, &StartPage::openRequested, this, &MainWindow::openDialog);
    connect(startPage_, &StartPage::newRequested, this, &MainWindow::newFromLagrangian);
    connect(startPage_, &StartPage::fileChosen, this, [this](const QString& path) { open(path); });
}

void MainWindow::makeStatus() {
    status_ = makeLabel({}, "caption", this);
    status_->setObjectName("status");
    status_->setContentsMargins(14, 0, 0, 0);
    statusBar()->addWidget(status_, 1);
    // Below a message the bar hides the label, and shows it again with the next change of its layout, though
    // the message is still there. What is hidden explicitly stays hidden.
    connect(statusBar(), &QStatusBar::messageChanged, status_,
            [this](const QString& message) { status_->setVisible(message.isEmpty()); });
    statusBar()->setSizeGripEnabled(false);
}

}  // namespace extremal
