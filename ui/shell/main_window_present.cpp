// SPDX-License-Identifier: GPL-3.0-or-later
/// Lessons, and presentation: the stage and one plot in large type, without the panels. The lesson goes on
/// with one key, Esc brings everything back as it was.
#include <QMenuBar>
#include <QStatusBar>
#include <QTabBar>

#include <algorithm>

#include "ui/base/notices.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/panels/scheme_list.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/header_bar.hpp"
#include "ui/shell/lesson_bar.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/shell/record_bar.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

void MainWindow::startLesson() {
    if (!lesson_->hasLesson()) {
        notices_->post({Notice::Kind::information,
                        "lesson",
                        tr("This scene has no lesson."),
                        tr("the start page marks the presets that have one"),
                        {{tr("Start page"), [this] { showStartPage(); }}}});
        return;
    }
    tabs_->setCurrentIndex(0);
    isToPlay_ = false;  // the lesson says when
    lesson_->start();
}

void MainWindow::addLessonActions() {
    const QString menu = tr("Help");
    actions_->add(
        "lesson", menu, tr("Start the lesson"), {QKeySequence(Qt::ALT | Qt::Key_L)},
        [this] { startLesson(); }, tr("What this scene teaches, step by step"));
    actions_->add(
        "recordLesson", menu, tr("Record a lesson"), {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_L)},
        [this] { record_->start(); }, tr("What you do becomes the steps of a lesson of this scene"));
    actions_->add("recordStep", menu, tr("Record this step"), {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_R)},
                  [this] { record_->isRecording() ? record_->recordStep() : record_->start(); });
    actions_->add("writeStep", menu, tr("Write this step of the lesson"),
                  {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_W)}, [this] { lesson_->write(); });
    actions_->add("lessonNext", menu, tr("Next step of the lesson"), {QKeySequence(Qt::ALT | Qt::Key_Right)},
                  [this] { lesson_->next(); });
    actions_->add("lessonBack", menu, tr("Step back in the lesson"), {QKeySequence(Qt::ALT | Qt::Key_Left)},
                  [this] { lesson_->back(); });
    actions_->add("lessonDo", menu, tr("Do the step of the lesson"), {QKeySequence(Qt::ALT | Qt::Key_Return)},
                  [this] { lesson_->doStep(); });
}

void MainWindow::addPresentationActions(const QString& menu) {
    actions_->add("nextPlot", menu, tr("Next plot"), {QKeySequence(Qt::CTRL | Qt::Key_PageDown)},
                  [this] { showOtherPlot(1); });
    actions_->add("previousPlot", menu, tr("Previous plot"), {QKeySequence(Qt::CTRL | Qt::Key_PageUp)},
                  [this] { showOtherPlot(-1); });
    actions_->add(
        "present", menu, tr("Present"), {QKeySequence(Qt::Key_F11)}, [this] { togglePresentation(); },
        tr("The stage and one plot in large type; Right is the next step of the lesson, Esc comes back"));
    actions_->add("fullScreen", menu, tr("Full screen"), {QKeySequence(Qt::SHIFT | Qt::Key_F11)}, [this] {
        if (isFullScreen())
            showNormal();
        else
            showFullScreen();
    });
}

void MainWindow::togglePresentation() {
    if (presentation_)
        endPresentation();
    else if (isSceneInSight())
        startPresentation();
}

void MainWindow::startPresentation() {
    constexpr double larger = 1.8, largest = 2.4;
    presentation_.emplace();
    presentation_->fontScale = theme_.fontScale;
    presentation_->wasFullScreen = isFullScreen();
    tabs_->setCurrentIndex(0);
    for (QWidget* part :
         {static_cast<QWidget*>(header_), leftPanel_, static_cast<QWidget*>(schemes_),
          static_cast<QWidget*>(tabs_), static_cast<QWidget*>(statusBar()), static_cast<QWidget*>(menuBar())})
        if (!part->isHidden()) {
            presentation_->hidden.emplace_back(part);
            part->hide();
        }
    compare_->setPresented(true);
    scaleLetters(std::min(larger * theme_.fontScale, largest));
    if (!isFullScreen()) showFullScreen();
    if (lesson_->hasLesson() && !lesson_->isRunning()) startLesson();
    focusStage();
}

/// False if nothing was presented.
bool MainWindow::endPresentation() {
    if (!presentation_) return false;
    const Presentation before = std::move(*presentation_);
    presentation_.reset();
    lesson_->end();
    compare_->setPresented(false);
    for (const auto& part : before.hidden)
        if (part) part->show();
    scaleLetters(before.fontScale);
    if (!before.wasFullScreen) showNormal();
    focusStage();
    return true;
}

/// By keys: the plot gets the focus and says what it shows.
void MainWindow::showOtherPlot(int by) {
    tabs_->setCurrentIndex(0);
    compare_->showOtherPlot(by);
}

/// For this session alone: the size that the user has set is stored by setTheme().
void MainWindow::scaleLetters(double scale) {
    const bool wasRemembered = std::exchange(isRemembered_, false);
    Theme theme = theme_;
    theme.fontScale = scale;
    setTheme(theme);
    isRemembered_ = wasRemembered;
}

}  // namespace extremal
