// SPDX-License-Identifier: GPL-3.0-or-later
/// What of the window is in sight, the start page or the scene, how its cards are laid out, what of that the
/// scene keeps, and where the focus is then.
#include <QActionGroup>
#include <QApplication>
#include <QSettings>
#include <QStackedWidget>
#include <QStatusBar>
#include <QTabBar>

#include "ui/compare/compare_view.hpp"
#include "ui/compare/plot_edits.hpp"
#include "ui/panels/scheme_list.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/header_bar.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/shell/start_page.hpp"
#include "ui/shell/timeline.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

constexpr int startPlace = 0, workPlace = 1;  // in the stack

}  // namespace

bool MainWindow::isSceneInSight() const {
    return workspace_->hasScene() && stack_->currentIndex() == workPlace;
}

/// The scene stays as it is, for the way back.
void MainWindow::showStartPage() {
    if (stack_->currentIndex() == startPlace) return;
    QWidget* const had = QApplication::focusWidget();
    focusBefore_ = had && had->window() == this ? had : nullptr;
    if (focusBefore_) focusBefore_->clearFocus();  // what was typed is taken
    wasPlaying_ = playback_->isPlaying();
    playback_->setPlaying(false);
    stack_->setCurrentIndex(startPlace);
    startPage_->setFocus();
}

/// Another scene has been opened.
void MainWindow::showWork() {
    focusBefore_.clear();
    wasPlaying_ = false;
    stack_->setCurrentIndex(workPlace);
    focusStage();
}

/// To the scene that the start page hides, as it was.
void MainWindow::goBack() {
    if (!workspace_->hasScene() || isSceneInSight()) return;
    stack_->setCurrentIndex(workPlace);
    if (focusBefore_ && focusBefore_->isVisibleTo(this))
        focusBefore_->setFocus();
    else
        focusStage();
    playback_->setPlaying(wasPlaying_);
}

/// Keys and buttons act on what can be seen.
void MainWindow::showSight() {
    const bool isInSight = isSceneInSight();
    actions_->setSceneInSight(isInSight);
    actions_->find("back")->setEnabled(workspace_->hasScene() && !isInSight);
    header_->setSceneInSight(isInSight);
    if (isInSight) return;
    const QString title = QString::fromStdString(workspace_->scene().title);
    startPage_->setBack(!workspace_->hasScene() ? QString()
                        : title.isEmpty()       ? workspace_->fileName()
                                                : title);
}

/// Compare, Notes or Studies. What had the focus may be hidden now; then no field of the page takes its
/// place.
void MainWindow::showPage(int page) {
    const QWidget* const had = QApplication::focusWidget();
    const bool wasInPages = had && pages_->isAncestorOf(had);
    pages_->setCurrentIndex(page);
    timeline_->setVisible(page == 0);  // nothing else follows the time
    if (wasInPages) focusStage();
}

/// To where no key changes anything but the playback.
void MainWindow::focusStage() {
    if (pages_->currentWidget() == compare_)
        compare_->stage()->setFocus();
    else
        pages_->currentWidget()->setFocus();
}

/// The layout of the Compare page and the side panels, which the next session finds as they are.
void MainWindow::addLayoutActions(const QString& menu) {
    actions_->addSeparator(menu);
    auto* group = new QActionGroup(this);
    const QStringList names{tr("Layout: automatic"), tr("Layout: one column"), tr("Layout: two columns"),
                            tr("Layout: three columns"), tr("Layout: plots only")};
    for (int i = 0; i < names.size(); ++i) {
        QAction* action = actions_->add(QStringLiteral("layout%1").arg(i), menu, names[i],
                                        {QKeySequence(Qt::ALT | (Qt::Key_1 + i))}, [this, i] {
                                            ownLayout_ = static_cast<PageLayout>(i);
                                            compare_->setPageLayout(ownLayout_);
                                            if (isRemembered_) QSettings().setValue("window/layout", i);
                                        });
        action->setCheckable(true);
        group->addAction(action);
    }
    constexpr int more = 40;  // pixels
    actions_->add("taller", menu, tr("Row of the plot higher"),
                  {QKeySequence(Qt::ALT | Qt::Key_Plus), QKeySequence(Qt::ALT | Qt::Key_Equal)},
                  [this] { compare_->growRow(more); });
    actions_->add("lower", menu, tr("Row of the plot lower"), {QKeySequence(Qt::ALT | Qt::Key_Minus)},
                  [this] { compare_->growRow(-more); });
    actions_->add("sizes", menu, tr("Plots in their own sizes"), {QKeySequence(Qt::ALT | Qt::Key_0)},
                  [this] { compare_->forgetSizes(); });
    actions_->add(
        "storeSeen", menu, tr("Store what is seen"), {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_K)},
        [this] { storeSeen(); },
        tr("The cursors, the parts of plots, the layout and the sizes of plots become part of the scene"));
    actions_->add(
        "forgetSeen", menu, tr("Remove what was stored"), {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_K)},
        [this] { forgetSeen(); },
        tr("The scene opens as it would without stored times, parts, layout and sizes"));
    const int last = isRemembered_ ? QSettings().value("window/layout").toInt() : 0;
    group->actions().at(std::clamp(last, 0, static_cast<int>(names.size()) - 1))->trigger();
    const auto addPanel = [&](const char* id, const QString& text, const QKeySequence& key, QWidget* panel) {
        QAction* action = actions_->add(id, menu, text, {key}, [this, id, panel] {
            panel->setVisible(panel->isHidden());
            shareWidth();
            if (isRemembered_) QSettings().setValue(QStringLiteral("window/%1").arg(id), !panel->isHidden());
        });
        action->setCheckable(true);
        const bool isShown =
            !isRemembered_ || QSettings().value(QStringLiteral("window/%1").arg(id), true).toBool();
        panel->setVisible(isShown);
        action->setChecked(isShown);
    };
    addPanel("scenePanel", tr("Panel of the scene"), QKeySequence(Qt::Key_F7), leftPanel_);
    addPanel("schemesPanel", tr("Panel of the schemes"), QKeySequence(Qt::Key_F8), schemes_);
    actions_->addSeparator(menu);
}

/// The cursors and the layout that the scene has, when it is opened and when these are edited.
void MainWindow::takeShown() {
    const Shown& now = workspace_->scene().shown;
    const Shown before = shown_.value_or(Shown());
    const bool isOpened = !shown_;
    shown_ = now;
    if (isOpened || now.layout != before.layout) {
        const auto layout = now.layout.value_or(ownLayout_);
        compare_->setPageLayout(layout);
        actions_->find(QStringLiteral("layout%1").arg(static_cast<int>(layout)))->setChecked(true);
    }
    if (now.pinned != before.pinned)
        compare_->setPinned(now.pinned ? std::optional(now.pinned->value) : std::nullopt);
    if (!now.time || now.time == before.time) return;
    isToPlay_ = false;
    playback_->stopAt(now.time->value);
}

/// The part of each plot, the cursors, the layout and the sizes of cards become those of the scene: one edit.
void MainWindow::storeSeen() {
    Scene seen = workspace_->scene();
    seen.views = compare_->seenViews();
    const auto number = [](double t) { return Number{t, {}}; };
    seen.shown.time = number(playback_->time());
    seen.shown.pinned = compare_->pinned() ? std::optional(number(*compare_->pinned())) : std::nullopt;
    const PageLayout layout = compare_->pageLayout();
    seen.shown.layout = layout == PageLayout::automatic ? std::nullopt : std::optional(layout);
    workspace_->edit(editsForSeen(seen), tr("Store what is seen"));
    statusBar()->showMessage(tr("Stored in the scene: times, parts of plots, layout and sizes"), 6000);
}

void MainWindow::forgetSeen() {
    Scene scene = workspace_->scene();
    scene.shown = {};
    for (View& view : scene.views) {
        view.size = {};
        view.xRange = view.yRange = {};
    }
    compare_->fitAll();
    compare_->setPinned({});
    workspace_->edit(editsForSeen(scene), tr("Remove what was stored"));
}

/// What has the focus and is hidden or switched off gives it to the next field, where Space and the arrows
/// would change what the user has not pointed at: to the stage instead. The keys Tab and Backtab move it as
/// usual.
bool MainWindow::focusNextPrevChild(bool next) {
    const QWidget* const had = QApplication::focusWidget();
    const bool isLost = had && had->window() == this && !(had->isVisible() && had->isEnabled());
    if (!isLost || !isSceneInSight()) return QMainWindow::focusNextPrevChild(next);
    focusStage();
    return true;
}

}  // namespace extremal
