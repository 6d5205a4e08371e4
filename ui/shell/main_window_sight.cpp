// SPDX-License-Identifier: GPL-3.0-or-later
/// What of the window is in sight, the start page or the scene, and where the focus is then.
#include <QApplication>
#include <QStackedWidget>
#include <QTabBar>

#include "ui/compare/compare_view.hpp"
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
