// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/shell/main_window.hpp"

#include <QApplication>
#include <QCloseEvent>
#include <QDesktopServices>
#include <QFileInfo>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QPlainTextEdit>
#include <QScrollArea>
#include <QSettings>
#include <QSplitter>
#include <QStyle>
#include <QTimer>

#include <algorithm>
#include <cmath>
#include <thread>

#include "engine/scene/bind.hpp"
#include "engine/scene/resolve.hpp"
#include "ui/base/format.hpp"
#include "ui/base/notices.hpp"
#include "ui/base/plain_tips.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/own/own_list.hpp"
#include "ui/own/own_window.hpp"
#include "ui/panels/discretizer.hpp"
#include "ui/panels/scheme_list.hpp"
#include "ui/panels/values_table.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/start_page.hpp"
#include "ui/shell/theme_switch.hpp"
#include "ui/shell/timeline.hpp"
#include "ui/sketch/mechanism_sketch.hpp"
#include "ui/study/needs_card.hpp"
#include "ui/study/study_page.hpp"
#include "ui/text/text_view.hpp"
#include "ui/windows/copies_window.hpp"
#include "ui/windows/fit_window.hpp"
#include "ui/windows/inspector_window.hpp"
#include "ui/windows/log_window.hpp"
#include "ui/windows/race_window.hpp"
#include "ui/workspace/autosave.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/workspace/wanted.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

MainWindow::MainWindow(const Theme& theme, bool isRemembered) : theme_(theme), isRemembered_(isRemembered) {
    showTipsAsPlainText(*qApp);
    setAcceptDrops(true);
    setMinimumSize(760, 520);
    resize(1600, 1000);
    themeSwitch_ = new ThemeSwitch(this);
    notices_ = new Notices(this);
    workspace_ = new Workspace(*notices_, this);
    run_ = new RunControl(*workspace_, *notices_, this);
    playback_ = new Playback(this);
    wanted_ = new Wanted(this);
    actions_ = new Actions(*this);
    makePages();
    makeActions();
    actions_->fill(*menuBar());
    connectState();
    if (isRemembered_) {
        const QSettings settings;
        restoreGeometry(settings.value("window/geometry").toByteArray());
        autosave_ = new Autosave(*workspace_, *notices_, Autosave::defaultDirectory(), this);
        offerUnsaved();
        keepRecent();
    }
    showScene();
    showStatus();
    showSight();
    startPage_->setFocus();
}

MainWindow::~MainWindow() {
    QDesktopServices::unsetUrlHandler(QStringLiteral("handbook"));
    QDesktopServices::unsetUrlHandler(QStringLiteral("preset"));
}

void MainWindow::connectState() {
    connect(workspace_, &Workspace::sceneChanged, this, &MainWindow::showScene);
    connect(workspace_, &Workspace::fileChanged, this, &MainWindow::showScene);
    connect(workspace_, &Workspace::fileChanged, this, &MainWindow::keepRecent);
    connect(workspace_, &Workspace::opened, this, &MainWindow::keepRecent);
    connect(workspace_, &Workspace::opened, this, &MainWindow::showWork);
    connect(workspace_, &Workspace::saveAsWanted, this, [this] { save(true); });
    connect(workspace_, &Workspace::agreedToRead, this, [this](const QString& name) { open(name, true); });
    connect(notices_, &Notices::logRequested, this, &MainWindow::showLog);
    connect(run_, &RunControl::stateChanged, this, &MainWindow::showStatus);
    connect(run_, &RunControl::progressed, this, &MainWindow::showStatus);
    connect(playback_, &Playback::timeChanged, this, &MainWindow::showValues);
    connect(compare_, &CompareView::figuresChanged, this, &MainWindow::showValues);
    connect(run_, &RunControl::resultsChanged, this, [this] {
        double computed = workspace_->scene().start.value;
        if (const auto results = run_->results())
            for (const auto& s : results->schemes)
                if (std::isfinite(s->summary.tEnd)) computed = std::max(computed, s->summary.tEnd);
        playback_->setComputedEnd(computed);
        showStatus();
        playWhenOpened();
    });
    connect(workspace_, &Workspace::opened, this, [this] {
        isToPlay_ = playsWhenOpened_;
        shown_.reset();
    });
}

/// The stage moves as soon as there is something to move; not where the desktop asks for little motion.
void MainWindow::playWhenOpened() {
    if (!isToPlay_ || run_->isStale() || !(playback_->computedEnd() > playback_->start())) return;
    isToPlay_ = false;
    const bool isCalm = style()->styleHint(QStyle::SH_Widget_Animation_Duration, nullptr, this) == 0;
    if (isCalm || !compare_->hasStage() || !isSceneInSight() || playback_->isPlaying()) return;
    playback_->setTime(playback_->start());
    playback_->setPlaying(true);
}

void MainWindow::setPlaysWhenOpened(bool plays) { playsWhenOpened_ = plays; }

void MainWindow::offerUnsaved() { startPage_->offer(autosave_->unsaved()); }

bool MainWindow::open(const QString& scene, bool isTrusted) {
    if (!mayLeaveScene()) return false;
    return workspace_->open(scene, isTrusted);
}

void MainWindow::newFromLagrangian() {
    if (!mayLeaveScene()) return;
    workspace_->adopt(newLagrangianScene());
    if (auto* const formula = left_->findChild<QPlainTextEdit*>(QStringLiteral("field.lagrangian"))) {
        formula->setFocus();
        formula->selectAll();
    }
}

/// The mechanism of the scene, or a new one on an empty sheet.
void MainWindow::drawMechanism() {
    const bool isNew = !isSceneInSight() || workspace_->scene().model.type != "mechanism";
    if (isNew && (!mayLeaveScene() || !workspace_->adopt(newMechanismScene()))) return;
    tabs_->setCurrentIndex(0);
    compare_->drawMechanism(isNew);
}

/// Files that were opened or saved, the latest first; of the last session as well.
void MainWindow::keepRecent() {
    if (!isRemembered_) return;
    constexpr qsizetype most = 8;
    QSettings settings;
    QStringList files = settings.value("window/recent").toStringList();
    if (const QString path = workspace_->path(); !path.isEmpty()) {
        const QString file = QFileInfo(path).absoluteFilePath();
        files.removeAll(file);
        files.prepend(file);
    }
    files.removeIf([](const QString& file) { return !QFileInfo::exists(file); });
    files = files.mid(0, most);
    settings.setValue("window/recent", files);
    startPage_->setRecent(files);
}

void MainWindow::setTheme(const Theme& theme) {
    const bool isOfColours = theme.fontScale == theme_.fontScale;
    theme_ = theme;
    std::vector<std::function<void()>> parts;
    parts.emplace_back([this] { discretizer_->setTheme(theme_); });
    parts.emplace_back([this] { schemes_->setTheme(theme_); });
    for (auto& part : compare_->partsOfTheme(theme_)) parts.push_back(std::move(part));
    parts.emplace_back([this] { studies_->setTheme(theme_); });
    parts.emplace_back([this] { needs_->setTheme(theme_); });
    parts.emplace_back([this] { startPage_->setTheme(theme_); });
    parts.emplace_back([this] {
        if (inspector_) inspector_->setTheme(theme_);
        if (fit_) fit_->setTheme(theme_);
        if (own_) own_->setTheme(theme_);
        if (race_) race_->setTheme(theme_);
        if (copies_) copies_->setTheme(theme_);
    });
    if (isOfColours) {
        themeSwitch_->start(theme_, parts);
    } else {
        applyTheme(*qApp, theme_);
        for (const auto& part : parts) part();
        shareWidth();
    }
    if (isRemembered_) {
        QSettings settings;
        settings.setValue("window/dark", theme_.isDark);
        settings.setValue("window/fontScale", theme_.fontScale);
    }
}

OwnList& MainWindow::ownList() {
    if (!ownList_) ownList_ = new OwnList(*workspace_, *notices_, this);
    return *ownList_;
}

/// The editor of the selected scheme's space and rule.
void MainWindow::showOwn() {
    if (!own_) {
        own_ = new OwnWindow(*workspace_, *notices_, theme_, this);
        connect(own_, &OwnWindow::keepRequested, this,
                [this](const Value& scheme) { ownList().keep(scheme); });
    }
    own_->open();
}

void MainWindow::showScene() {
    if (!workspace_->hasScene()) {
        setWindowTitle(tr("Extremal"));
        return;
    }
    const Scene& scene = workspace_->scene();
    setWindowTitle(tr("%1[*] - Extremal").arg(workspace_->fileName()));
    setWindowModified(workspace_->isDirty());
    playback_->setRange(timeSpan(scene).first, timeSpan(scene).last);
    timeline_->setUnit(QString::fromStdString(workspace_->resolved()->system->timeUnit));
    takeShown();
    QString notes = QString::fromStdString("# " + scene.title + "\n\n");
    if (!scene.lesson.empty()) notes += "*" + QString::fromStdString(scene.lesson) + "*\n\n";
    notes += QString::fromStdString(scene.notes);
    if (!scene.source.empty()) notes += tr("\n\nSource: %1").arg(QString::fromStdString(scene.source));
    // Typesetting takes a while: in a turn of its own, and only for other notes.
    if (shownNotes_ == notes) return;
    shownNotes_ = notes;
    QTimer::singleShot(0, notes_, [this, notes] {
        if (shownNotes_ == notes) notes_->showText(notes);
    });
}

void MainWindow::showStatus() {
    QStringList parts;
    if (const auto results = run_->results()) {
        int done = 0;
        double cpu = 0;
        for (const auto& s : results->schemes) {
            done += s->summary.status == RunStatus::done;
            cpu += s->summary.cpuSeconds;
        }
        parts << tr("%1 of %2 done").arg(done).arg(results->schemes.size())
              << tr("%1 CPU").arg(shortTime(cpu));
        parts << tr("%n cores", nullptr, static_cast<int>(std::thread::hardware_concurrency()));
        if (results->reference.type != "none")
            parts << tr("reference: %1").arg(QString::fromStdString(results->reference.description));
        if (!results->reference.caution.empty()) parts << QString::fromStdString(results->reference.caution);
    }
    switch (run_->state()) {
        case RunControl::State::running:
            parts << (run_->isPreparing() ? tr("computing the reference")
                                          : tr("running, %1 %").arg(std::lround(100 * run_->fraction())));
            break;
        case RunControl::State::offered:
            parts << tr("waiting for Run: this takes a while");
            break;
        case RunControl::State::stopped:
            parts << tr("stopped");
            break;
        default:
            break;
    }
    status_->setText(parts.join(QStringLiteral("   ·   ")));
}

void MainWindow::showValues() {
    if (values_->isHidden()) return;
    std::vector<const Figure*> figures;
    for (const PlotWidget* plot : compare_->plots()) figures.push_back(&plot->figure());
    values_->show(figures, playback_->time(), theme_);
}

double MainWindow::rowStep() const {
    if (const auto results = run_->results())
        for (const auto& s : results->schemes)
            if (const auto t = s->trajectory["t"]; t.size() > 1) return t[1] - t[0];
    return (playback_->end() - playback_->start()) / 1000;
}

/// False if the user wants to stay with changes that are not saved.
bool MainWindow::mayLeaveScene() {
    if (!isRemembered_ || !(workspace_->isDirty() || workspace_->hasDrafts())) return true;
    QMessageBox box(QMessageBox::Question, tr("Extremal"),
                    tr("%1 has changes that are not saved.").arg(workspace_->fileName()),
                    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, this);
    box.setTextFormat(Qt::PlainText);  // a name of a file can look like HTML
    box.setDefaultButton(QMessageBox::Save);
    const int answer = box.exec();
    if (answer == QMessageBox::Save) save(false);
    return answer == QMessageBox::Discard || (answer == QMessageBox::Save && !workspace_->isDirty());
}

void MainWindow::showLog() {
    if (!log_) log_ = new LogWindow(*notices_, this);
    log_->open();
}

void MainWindow::closeEvent(QCloseEvent* event) {
    if (!mayLeaveScene()) {
        event->ignore();
        return;
    }
    run_->stop();
    if (isRemembered_) QSettings().setValue("window/geometry", saveGeometry());
    event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    if (event->mimeData()->hasUrls() && event->mimeData()->urls().first().isLocalFile())
        event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
    if (!event->mimeData()->hasUrls()) return;
    const QString path = event->mimeData()->urls().first().toLocalFile();
    if (workspace_->hasScene() && path.endsWith(QLatin1String(".csv"), Qt::CaseInsensitive))
        return fitWindow().open(path);
    open(path);
}

void MainWindow::resizeEvent(QResizeEvent* event) {
    QMainWindow::resizeEvent(event);
    shareWidth();
}

/// The side panels are as wide as their texts ask for, unless they are folded.
void MainWindow::shareWidth() {
    if (splitter_->count() < 3) return;
    const double scale = std::max(1.0, theme_.fontScale);
    const auto scaled = [&](int width) { return static_cast<int>(std::lround(scale * width)); };
    // The discretizer's seven columns and a scroll bar; with large letters in a small window, what is left of
    // their width, of which plots then take less.
    constexpr int frame = 46, leastPanel = 150;
    const int wanted = scaled(280), centre = std::max(264, scaled(209)),
              left = std::clamp(width() - scaled(208) - centre - frame, leastPanel, wanted);
    left_->setHorizontalScrollBarPolicy(left < wanted ? Qt::ScrollBarAsNeeded : Qt::ScrollBarAlwaysOff);
    leftPanel_->setMinimumWidth(left);
    schemes_->setWidths(scaled(208), width() - left - centre - frame);
    const int usual = std::clamp(width() * 18 / 100, left, std::max(left, scaled(300)));
    const int wide = std::max(usual, width() * 55 / 100);  // room for words in the cells of the discretizer
    const int side = leftPanel_->isHidden() ? 0 : isDiscretizerWide_ ? wide : usual;
    const int right = schemes_->isHidden() ? 0 : std::clamp(width() * 19 / 100, scaled(208), scaled(310));
    splitter_->setSizes({side, width() - side - right - frame, right});
}

void MainWindow::toggleWideDiscretizer() {
    isDiscretizerWide_ = !isDiscretizerWide_;
    if (isDiscretizerWide_ && leftPanel_->isHidden()) actions_->find("scenePanel")->trigger();
    shareWidth();
}

}  // namespace extremal
