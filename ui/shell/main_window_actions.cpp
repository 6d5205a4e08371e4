// SPDX-License-Identifier: GPL-3.0-or-later
/// Everything the main window can do, each with its key.
#include <QApplication>
#include <QDesktopServices>
#include <QFileDialog>
#include <QMenu>
#include <QMessageBox>
#include <QScrollArea>
#include <QSettings>
#include <QStatusBar>
#include <QTabBar>
#include <QTimer>

#include "engine/core/text/text.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/map_grid.hpp"
#include "engine/scene/view_choices.hpp"
#include "engine/view/catalog.hpp"
#include "ui/base/notices.hpp"
#include "ui/base/save_dialog.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/compare/orbit_finder.hpp"
#include "ui/compare/plot_edits.hpp"
#include "ui/compare/starting.hpp"
#include "ui/own/own_list.hpp"
#include "ui/panels/scheme_list.hpp"
#include "ui/panels/values_table.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/lesson_bar.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/shell/notes_page.hpp"
#include "ui/shell/record_bar.hpp"
#include "ui/shell/start_page.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/study/cell_costs.hpp"
#include "ui/study/needs_card.hpp"
#include "ui/study/study_page.hpp"
#include "ui/windows/about.hpp"
#include "ui/windows/copies_window.hpp"
#include "ui/windows/help_window.hpp"
#include "ui/windows/fit_window.hpp"
#include "ui/windows/inspector_window.hpp"
#include "ui/windows/passport_window.hpp"
#include "ui/windows/race_window.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/workspace.hpp"

#include <QStackedWidget>

#include <algorithm>
#include <functional>
#include <tuple>

namespace extremal {

void MainWindow::makeActions() {
    addFileActions();
    addEditActions();
    addViewActions();
    addRunActions();
    addStudyActions();
    addLessonActions();
    actions_->add("help", tr("Help"), tr("Handbook, for what has the focus"), {QKeySequence(Qt::Key_F1)},
                  [this] {
                      const QWidget* shown = stack_->currentWidget();
                      if (shown != startPage_) shown = pages_->currentWidget();
                      showHelp(helpPageOf(QApplication::focusWidget(), shown));
                  });
    actions_->add("searchHelp", tr("Help"), tr("Search the handbook..."),
                  {QKeySequence(Qt::CTRL | Qt::Key_F)}, [this] {
                      showHelp(QStringLiteral("index"));
                      help_->focusSearch();
                  });
    actions_->add("paper", tr("Help"), tr("Map of the paper"), {QKeySequence(Qt::ALT | Qt::Key_F1)},
                  [this] { showHelp(QStringLiteral("paper")); });
    actions_->add("keys", tr("Help"), tr("Keys"), {QKeySequence(Qt::SHIFT | Qt::Key_F1)},
                  [this] { showHelp(QStringLiteral("keys")); });
    actions_->add("log", tr("Help"), tr("Log"), {QKeySequence(Qt::CTRL | Qt::Key_L)}, [this] { showLog(); });
    actions_->add("about", tr("Help"), tr("About Extremal"), {QKeySequence(Qt::CTRL | Qt::Key_F1)}, [this] {
        QMessageBox::about(this, tr("About Extremal"), aboutText(compare_->stage()->drawingBackend()));
    });
    QDesktopServices::setUrlHandler(QStringLiteral("handbook"), this, "openHandbook");
    QDesktopServices::setUrlHandler(QStringLiteral("preset"), this, "openPreset");
    // All others are of the scene.
    actions_->keepWithoutScene({"gallery", "newLagrangian", "drawMechanism", "open", "pasteScene", "quit",
                                "palette", "theme", "larger", "smaller", "fullScreen", "ownSchemes", "help",
                                "searchHelp", "paper", "keys", "log", "about"});
}

void MainWindow::openHandbook(const QUrl& url) {
    showHelp(url.hasFragment() ? url.path() + '#' + url.fragment() : url.path());
}

void MainWindow::openPreset(const QUrl& url) { open("preset:" + url.path()); }

void MainWindow::showHelp(const QString& page) {
    if (!help_) {
        help_ = new HelpWindow(this);
        connect(help_, &HelpWindow::presetRequested, this, [this](const QString& id) {
            if (!open("preset:" + id)) return;
            raise();
            activateWindow();
        });
    }
    help_->open(page);
}

void MainWindow::addFileActions() {
    const QString menu = tr("File");
    actions_->add("gallery", menu, tr("New from the gallery"), {QKeySequence::New},
                  [this] { showStartPage(); });
    actions_->add("newLagrangian", menu, tr("New from a Lagrangian"),
                  {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_N)}, [this] { newFromLagrangian(); });
    actions_->add(
        "drawMechanism", menu, tr("Draw a mechanism"), {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_M)},
        [this] { drawMechanism(); },
        tr("Points, rods, springs, dampers, motors and walls, drawn on the stage"));
    actions_->add("open", menu, tr("Open..."), {QKeySequence::Open}, [this] { openDialog(); });
    actions_->add("save", menu, tr("Save"), {QKeySequence::Save}, [this] { save(false); });
    actions_->add("saveAs", menu, tr("Save as..."), {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_S)},
                  [this] { save(true); });
    actions_->addSeparator(menu);
    actions_->add("exportPlot", menu, tr("Export plot..."), {QKeySequence(Qt::CTRL | Qt::Key_E)}, [this] {
        if (PlotWidget* plot = compare_->currentPlot()) plot->saveDialog();
    });
    actions_->add(
        "figureSheet", menu, tr("Figure for a paper..."), {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_P)},
        [this] { showFigureSheet(); },
        tr("Panels of the width of a column, in the letters of the document, with data and caption"));
    actions_->add(
        "exportFrames", menu, tr("Export the stage as frames..."),
        {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_F)}, [this] { exportFrames(); },
        tr("Pictures from the start to the end, for a film"));
    actions_->add("exportAll", menu, tr("Export everything..."),
                  {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_E)}, [this] { exportDialog(); });
    actions_->add(
        "report", menu, tr("Save a page for browsers..."), {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_E)},
        [this] { exportReport(); }, tr("Notes, schemes and pictures in one HTML file"));
    actions_->addSeparator(menu);
    actions_->add("copyScene", menu, tr("Copy the scene as text"),
                  {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_C)}, [this] { copyScene(); });
    actions_->add("pasteScene", menu, tr("Paste a scene"), {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_V)},
                  [this] { pasteScene(); });
    actions_->addSeparator(menu);
    actions_->add("quit", menu, tr("Quit"), {QKeySequence(Qt::CTRL | Qt::Key_Q)}, [this] { close(); });
}

void MainWindow::addEditActions() {
    const QString menu = tr("Edit");
    actions_->add("undo", menu, tr("Undo"), {QKeySequence::Undo}, [this] { workspace_->undo(); });
    actions_->add("redo", menu, tr("Redo"), {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_Z)},
                  [this] { workspace_->redo(); });
    actions_->addSeparator(menu);
    actions_->add("add", menu, tr("Add scheme"), {QKeySequence(Qt::CTRL | Qt::Key_Plus)},
                  [this] { schemes_->openAddMenu(); });
    actions_->add("editScheme", menu, tr("Edit scheme"), {QKeySequence(Qt::Key_F3)},
                  [this] { schemes_->editSelected(); });
    actions_->add("passport", menu, tr("Passport of the scheme"), {QKeySequence(Qt::Key_F4)}, [this] {
        if (!passport_) passport_ = new PassportWindow(*workspace_, *notices_, this);
        passport_->open();
    });
    actions_->add(
        "inspect", menu, tr("Inspect one step"), {QKeySequence(Qt::Key_F6)},
        [this] {
            if (!inspector_) inspector_ = new InspectorWindow(*workspace_, *run_, *playback_, theme_, this);
            inspector_->open();
        },
        tr("The step of the selected scheme at the cursor: motion, functions, iteration, equations"));
    actions_->add("own", menu, tr("Own space and rule..."), {QKeySequence(Qt::CTRL | Qt::Key_F3)},
                  [this] { showOwn(); });
    actions_->add("ownSchemes", menu, tr("Your schemes..."), {QKeySequence(Qt::SHIFT | Qt::Key_F3)},
                  [this] { ownList().open(); });
    actions_->add("rename", menu, tr("Rename scheme"), {QKeySequence(Qt::Key_F2)},
                  [this] { schemes_->renameSelected(); });
    actions_->add("duplicate", menu, tr("Duplicate scheme"), {QKeySequence(Qt::CTRL | Qt::Key_D)},
                  [this] { schemes_->duplicateSelected(); });
    actions_->add("remove", menu, tr("Remove scheme"), {QKeySequence(Qt::Key_Delete)},
                  [this] { schemes_->removeSelected(); });
    actions_->add("up", menu, tr("Move scheme up"), {QKeySequence(Qt::CTRL | Qt::Key_Up)},
                  [this] { schemes_->moveSelected(-1); });
    actions_->add("down", menu, tr("Move scheme down"), {QKeySequence(Qt::CTRL | Qt::Key_Down)},
                  [this] { schemes_->moveSelected(1); });
    actions_->add("solo", menu, tr("Selected scheme alone, or all"), {QKeySequence(Qt::Key_S)},
                  [this] { schemes_->soloSelected(); });
    for (int i = 0; i < 9; ++i)
        actions_->add(QStringLiteral("toggle%1").arg(i + 1), menu,
                      tr("Switch scheme %1 on or off").arg(i + 1), {QKeySequence(Qt::Key_1 + i)},
                      [this, i] { toggleScheme(i); });
}

/// Says what a digit has done, as it may have been meant for something else.
void MainWindow::toggleScheme(int index) {
    const auto& schemes = workspace_->scene().schemes;
    if (!workspace_->hasScene() || index >= static_cast<int>(schemes.size())) return;
    schemes_->toggle(index);
    const SchemeSpec& scheme = schemes[static_cast<std::size_t>(index)];
    const QString name = QString::fromStdString(scheme.label);
    statusBar()->showMessage(scheme.isEnabled
                                 ? tr("%1 is on again").arg(name)
                                 : tr("%1 is off: the key %2 switches it on again").arg(name).arg(index + 1),
                             6000);
}

/// The plots of the catalogue, checked where the scene has them.
void MainWindow::fillPlots(QMenu& menu) {
    menu.clear();
    if (!isSceneInSight()) return;
    const Scene& scene = workspace_->scene();
    for (const ViewEntry* const offered : offeredPlots(scene)) {
        const ViewEntry& entry = *offered;
        const std::string id = entry.item.id;
        const bool isShown =
            std::any_of(scene.views.begin(), scene.views.end(), [&](const View& v) { return v.id == id; });
        QAction* action = menu.addAction(QString::fromStdString(entry.item.title));
        action->setCheckable(true);
        action->setChecked(isShown);
        action->setToolTip(QString::fromStdString(entry.item.description));
        connect(action, &QAction::triggered, this, [this, id, isShown] {
            workspace_->edit(editsForView(workspace_->scene(), id, !isShown),
                             isShown ? tr("Hide a plot") : tr("Show a plot"));
        });
    }
    menu.setToolTipsVisible(true);
}

/// What the stage shows; its card has the same in its menu.
void MainWindow::addStageActions(const QString& menu) {
    actions_->add(
        "sideBySide", menu, tr("Schemes side by side on the stage"), {QKeySequence(Qt::Key_B)},
        [this] { compare_->toggleSideBySide(); }, tr("Each scheme in a place of its own, or all in one"));
    actions_->add(
        "trails", menu, tr("Longer or shorter trails"), {QKeySequence(Qt::Key_T)},
        [this] { compare_->changeTrails(); },
        tr("Trails on the stage that fade, ten times as long, or from the start"));
    actions_->add(
        "poke", menu, tr("Poke the field"), {QKeySequence(Qt::Key_K)}, [this] { compare_->togglePoking(); },
        tr("Whether clicks on the stage, and Enter, add a pulse to the field and start from there"));
    actions_->add(
        "potential", menu, tr("Potential on the stage"), {QKeySequence(Qt::Key_U)},
        [this] { compare_->togglePotential(); },
        tr("Level lines or the graph of the potential behind motions in one or two dimensions"));
}

void MainWindow::addViewActions() {
    const QString menu = tr("View");
    actions_->add(
        "back", menu, tr("Back to the scene"), {QKeySequence(Qt::Key_Escape)}, [this] { goBack(); },
        tr("From the start page to the scene that was open, as it was"));
    actions_->add("palette", menu, tr("Find an action..."), {QKeySequence(Qt::CTRL | Qt::Key_K)},
                  [this] { showPalette(); });
    actions_->add("fit", menu, tr("Fit all"), {QKeySequence(Qt::Key_A)}, [this] { compare_->fitAll(); });
    addStageActions(menu);
    actions_->add(
        "wideDiscretizer", menu, tr("Wide or narrow discretizer"), {QKeySequence(Qt::Key_G)},
        [this] { toggleWideDiscretizer(); }, tr("With room for words in its cells, or as wide as usual"));
    actions_->add(
        "writeNotes", menu, tr("Write the notes"), {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_2)},
        [this] {
            tabs_->setCurrentIndex(1);
            notesPage_->write();
        },
        tr("The notes of the scene as Markdown"));
    actions_->add("values", menu, tr("Values at the cursor"), {QKeySequence(Qt::Key_V)}, [this] {
        values_->setVisible(values_->isHidden());
        showValues();
    });
    for (const auto& [index, id, text] :
         {std::tuple{0, "compare", tr("Compare")}, {1, "notes", tr("Notes")}, {2, "studies", tr("Studies")}})
        actions_->add(id, menu, text, {QKeySequence(Qt::CTRL | (Qt::Key_1 + index))},
                      [this, index = index] { tabs_->setCurrentIndex(index); });
    auto* plots = new QMenu(tr("Plots"), this);
    connect(plots, &QMenu::aboutToShow, this, [this, plots] { fillPlots(*plots); });
    actions_->addSubmenu(menu, plots);
    actions_->add("plots", menu, tr("Choose plots..."), {QKeySequence(Qt::Key_P)},
                  [this] { showPlotChoice(); });
    addLayoutActions(menu);
    actions_->add("theme", menu, tr("Light or dark"), {QKeySequence(Qt::CTRL | Qt::Key_T)}, [this] {
        Theme theme = theme_.isDark ? Theme::light() : Theme::dark();
        theme.fontScale = theme_.fontScale;
        setTheme(theme);
    });
    const auto scaleBy = [this](double factor) {
        Theme theme = theme_;
        theme.fontScale = std::clamp(theme_.fontScale * factor, 0.7, 2.0);
        setTheme(theme);
    };
    actions_->add("larger", menu, tr("Larger text"), {QKeySequence(Qt::CTRL | Qt::Key_BracketRight)},
                  [scaleBy] { scaleBy(1.1); });
    actions_->add("smaller", menu, tr("Smaller text"), {QKeySequence(Qt::CTRL | Qt::Key_BracketLeft)},
                  [scaleBy] { scaleBy(1 / 1.1); });
    actions_->add("resetLayout", menu, tr("Reset layout"), {QKeySequence(Qt::CTRL | Qt::Key_0)}, [this] {
        Theme theme = theme_.isDark ? Theme::dark() : Theme::light();
        setTheme(theme);
        actions_->find("layout0")->trigger();
        compare_->forgetSizes();
        for (const char* panel : {"scenePanel", "schemesPanel"})
            if (QAction* action = actions_->find(panel); !action->isChecked()) action->trigger();
        showNormal();
        resize(1600, 1000);
    });
    addPresentationActions(menu);
}

void MainWindow::addRunActions() {
    const QString menu = tr("Run");
    actions_->add("play", menu, tr("Play or pause"), {QKeySequence(Qt::Key_Space)},
                  [this] { playback_->setPlaying(!playback_->isPlaying()); });
    const auto move = [this](int rows) { return [this, rows] { playback_->stepBy(rows, rowStep()); }; };
    const auto turn = [this, move](int rows, void (LessonBar::*act)()) {
        return [this, rows, act, go = move(rows)] {
            presentation_ && lesson_->isRunning() ? std::invoke(act, lesson_) : go();
        };
    };
    actions_->add("stepForward", menu, tr("One row forward, presented the next step"),
                  {QKeySequence(Qt::Key_Right)}, turn(1, &LessonBar::next));
    actions_->add("stepBack", menu, tr("One row back, presented the step before"),
                  {QKeySequence(Qt::Key_Left)}, turn(-1, &LessonBar::back));
    actions_->add("pageForward", menu, tr("50 rows forward"), {QKeySequence(Qt::Key_PageDown)}, move(50));
    actions_->add("pageBack", menu, tr("50 rows back"), {QKeySequence(Qt::Key_PageUp)}, move(-50));
    actions_->add("home", menu, tr("To the start"), {QKeySequence(Qt::Key_Home)},
                  [this] { playback_->setTime(playback_->start()); });
    actions_->add("end", menu, tr("To the end"), {QKeySequence(Qt::Key_End)},
                  [this] { playback_->setTime(playback_->end()); });
    actions_->add(
        "startHere", menu, tr("Start from the state at the cursor"), {QKeySequence(Qt::CTRL | Qt::Key_I)},
        [this] { startFromCursor(); },
        tr("The initial data are where the selected scheme, or the first one, is at the cursor"));
    actions_->add(
        "periodicOrbit", menu, tr("Periodic orbit near the start"),
        {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_C)}, [this] { orbits_->seek({}); },
        tr("Newton's method on the tangent map of the selected scheme, or of the first one that is on"));
    QAction* const plays = actions_->add(
        "playWhenOpened", menu, tr("Play when a scene opens"), {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_O)},
        [this] {
            playsWhenOpened_ = !playsWhenOpened_;
            if (isRemembered_) QSettings().setValue("window/plays", playsWhenOpened_);
        },
        tr("The stage moves as soon as there are results"));
    plays->setCheckable(true);
    playsWhenOpened_ = isRemembered_ && QSettings().value("window/plays", true).toBool();
    plays->setChecked(playsWhenOpened_);
    actions_->addSeparator(menu);
    actions_->add("restart", menu, tr("Compute again"), {QKeySequence(Qt::Key_R)}, [this] { run_->start(); });
    actions_->add("stop", menu, tr("Stop computing"), {QKeySequence(Qt::Key_Escape)}, [this] {
        if (endPresentation()) return;
        if (needs_->stop() || cellCosts_->stop() || orbits_->stop() || (fit_ && fit_->stop())) return;
        if (studies_->isVisible() && studies_->stop()) return;
        if (compare_->restore()) return;
        if (!run_->isRunning() && !schemes_->closeEditors()) workspace_->selectScheme(-1);
        run_->stop();
    });
}

void MainWindow::startFromCursor() {
    const auto results = run_->results();
    if (!results || results->schemes.empty() || !results->system) return;
    const StartEdits start =
        editsForStartAt(*results->system, resultToStartFrom(*workspace_, *results), playback_->time());
    if (start.problem.isEmpty())
        workspace_->edit(start.edits, tr("Start from the cursor"));
    else
        notices_->post({Notice::Kind::information,
                        "start",
                        tr("No motion starts there: %1.").arg(start.problem),
                        tr("models with coordinates and fields can be started from the cursor"),
                        {}});
}

void MainWindow::addStudyActions() {
    const QString menu = tr("Analyse");
    const auto onPage = [this](void (StudyPage::*act)()) {
        return [this, act] {
            if (!workspace_->hasScene()) return;
            tabs_->setCurrentIndex(2);
            std::invoke(act, studies_);
        };
    };
    actions_->add("runStudy", menu, tr("Run the study"), {QKeySequence(Qt::CTRL | Qt::Key_R)},
                  onPage(&StudyPage::start),
                  tr("Every scheme that is on over many steps: errors, costs, and what is worth it"));
    actions_->add("chooseStudy", menu, tr("Choose the study..."),
                  {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_R)}, onPage(&StudyPage::openChoices));
    actions_->add("wantedError", menu, tr("Wanted error"), {QKeySequence(Qt::Key_W)},
                  onPage(&StudyPage::askForError), tr("The error that the cheapest scheme is to reach"));
    actions_->add("measureCheapest", menu, tr("Measure the cheapest scheme"),
                  {QKeySequence(Qt::CTRL | Qt::Key_M)}, onPage(&StudyPage::measureCheapest),
                  tr("Runs every scheme that is on at the step that the wanted error needs"));
    actions_->add(
        "needs", menu, tr("What the scene needs"), {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_L)},
        [this] {
            if (schemes_->isHidden()) actions_->find("schemesPanel")->trigger();
            needs_->measure();
        },
        tr("For each error the cheapest model and scheme: what may be left out, and what it saves"));
    actions_->add(
        "cellCosts", menu, tr("Costs of the discretizer's cells"),
        {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_D)}, [this] { cellCosts_->toggle(); },
        tr("Shades the cells by what the wanted error costs with each, as measured"));
    actions_->add(
        "fitMeasurements", menu, tr("Fit to measurements..."), {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_D)},
        [this] { fitWindow().open(); },
        tr("Parameters and initial values from a CSV file, which may be dropped on the window as well"));
    actions_->add(
        "race", menu, tr("Race"), {QKeySequence(Qt::Key_F9)},
        [this] {
            if (!race_) race_ = new RaceWindow(*run_, *wanted_, theme_, this);
            race_->open();
        },
        tr("A stage for each scheme, all with the same processor time; the wanted error is the finish line"));
    actions_->add(
        "perturb", menu, tr("Perturb and watch"), {QKeySequence(Qt::Key_F10)},
        [this] {
            if (!copies_) copies_ = new CopiesWindow(*workspace_, *playback_, theme_, this);
            copies_->open();
        },
        tr("The motion of the selected scheme and a copy that starts a little apart"));
    actions_->addSeparator(menu);
    actions_->add("useResult", menu, tr("Use the selected result"), {QKeySequence(Qt::CTRL | Qt::Key_U)},
                  onPage(&StudyPage::useSelected));
    actions_->add("loadResult", menu, tr("Show the selected result in Compare"),
                  {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_U)}, onPage(&StudyPage::loadSelected));
}

FitWindow& MainWindow::fitWindow() {
    if (!fit_) fit_ = new FitWindow(*workspace_, *notices_, theme_, this);
    return *fit_;
}

void MainWindow::openDialog() {
    const QString path =
        QFileDialog::getOpenFileName(this, tr("Open scene"), {}, tr("Scenes (*.json);;All files (*)"));
    if (!path.isEmpty()) open(path);
}

void MainWindow::save(bool asksName) {
    if (!workspace_->hasScene()) return;
    if (!asksName && !workspace_->path().isEmpty()) {
        workspace_->save();
        return;
    }
    const QString path = askForSave(this, tr("Save scene"), workspace_->fileName(), tr("Scenes (*.json)"));
    if (!path.isEmpty()) workspace_->saveAs(path);
}

}  // namespace extremal
