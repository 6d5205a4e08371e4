// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/shell/main_window.hpp"

#include <QApplication>
#include <QCloseEvent>
#include <QFileInfo>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QPlainTextEdit>
#include <QScrollArea>
#include <QSettings>
#include <QSplitter>
#include <QStackedWidget>
#include <QStatusBar>
#include <QTabBar>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <thread>

#include "engine/scene/bind.hpp"
#include "engine/scene/resolve.hpp"
#include "ui/base/card.hpp"
#include "ui/own/own_list.hpp"
#include "ui/own/own_window.hpp"
#include "ui/panels/discretizer.hpp"
#include "ui/base/format.hpp"
#include "ui/panels/scene_panel.hpp"
#include "ui/panels/scheme_list.hpp"
#include "ui/panels/values_table.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/workspace/autosave.hpp"
#include "ui/shell/banners.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/windows/copies_window.hpp"
#include "ui/shell/header_bar.hpp"
#include "ui/windows/inspector_window.hpp"
#include "ui/shell/lesson_bar.hpp"
#include "ui/windows/log_window.hpp"
#include "ui/base/notices.hpp"
#include "ui/base/plain_tips.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/windows/race_window.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/scheme_edits.hpp"
#include "ui/shell/start_page.hpp"
#include "ui/shell/theme_switch.hpp"
#include "ui/text/text_view.hpp"
#include "ui/shell/timeline.hpp"
#include "ui/workspace/workspace.hpp"
#include "ui/study/background_sweep.hpp"
#include "ui/study/study_page.hpp"

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

MainWindow::~MainWindow() = default;

void MainWindow::makePages() {
    auto* whole = new QWidget;
    auto* column = new QVBoxLayout(whole);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    auto* sweep = new BackgroundSweep(*run_, this);
    auto* header = header_ = new HeaderBar(*workspace_, *run_, *sweep);
    connect(header, &HeaderBar::runRequested, run_, &RunControl::start);
    connect(header, &HeaderBar::stopRequested, run_, &RunControl::stop);
    connect(header, &HeaderBar::stepRequested, this, [this] { playback_->stepBy(1, rowStep()); });
    connect(header, &HeaderBar::exportRequested, this, &MainWindow::exportDialog);
    connect(header, &HeaderBar::paletteRequested, this, &MainWindow::showPalette);
    column->addWidget(header);

    auto* left = new QScrollArea;
    left->setWidgetResizable(true);
    left->setFrameShape(QFrame::NoFrame);
    left->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* leftInside = new QWidget;
    leftInside->setProperty("ground", "window");
    auto* leftColumn = new QVBoxLayout(leftInside);
    leftColumn->setContentsMargins(0, 0, 2, 0);
    leftColumn->setSpacing(12);
    discretizer_ = new Discretizer(*workspace_);
    discretizer_->setTheme(theme_);
    connect(discretizer_, &Discretizer::ownChosen, this, &MainWindow::showOwn);
    leftColumn->addWidget(new ScenePanel(*workspace_));
    leftColumn->addWidget(discretizer_);
    leftColumn->addStretch();
    left->setWidget(leftInside);

    auto* centre = new QWidget;
    auto* centreColumn = new QVBoxLayout(centre);
    centreColumn->setContentsMargins(0, 0, 0, 0);
    centreColumn->setSpacing(8);
    tabs_ = new QTabBar;
    tabs_->setExpanding(false);
    tabs_->setDrawBase(false);
    tabs_->addTab(tr("Compare"));
    tabs_->addTab(tr("Notes"));
    tabs_->addTab(tr("Studies"));
    centreColumn->addWidget(tabs_);
    centreColumn->addWidget(new Banners(*notices_));
    lesson_ = new LessonBar(*workspace_, *playback_);
    centreColumn->addWidget(lesson_);
    pages_ = new QStackedWidget;
    compare_ = new CompareView(*workspace_, *run_, *playback_, theme_);
    compare_->setSweep(*sweep);
    compare_->setWanted(header->wantedError());
    connect(header, &HeaderBar::wantedChanged, compare_, &CompareView::setWanted);
    connect(compare_, &CompareView::wantedMoved, header, &HeaderBar::setWantedError);
    notes_ = new TextView;
    notes_->setObjectName("notes");
    notes_->setAccessibleName(tr("Notes"));
    pages_->addWidget(compare_);
    studies_ = new StudyPage(*workspace_, theme_);
    pages_->addWidget(notes_);
    pages_->addWidget(studies_);
    centreColumn->addWidget(pages_, 1);
    timeline_ = new Timeline(*playback_);
    centreColumn->addWidget(timeline_);
    values_ = new ValuesTable;
    values_->hide();
    centreColumn->addWidget(values_);
    connect(tabs_, &QTabBar::currentChanged, this, &MainWindow::showPage);
    connect(lesson_, &LessonBar::viewPointed, this, [this](const QString& view) {
        if (!view.isEmpty()) tabs_->setCurrentIndex(0);
        compare_->pointAt(view);
    });
    connect(compare_, &CompareView::startRefused, this, [this](const QString& reason) {
        notices_->post({Notice::Kind::information,
                        "start",
                        tr("No motion starts there: %1.").arg(reason),
                        tr("choose a place inside the region that the energy admits"),
                        {}});
    });
    connect(compare_, &CompareView::caseLoaded, this, [this](const QString& text) {
        notices_->post({Notice::Kind::information,
                        "case",
                        tr("Loaded from the map: %1.").arg(text),
                        tr("the dot in each map marks the scene; Ctrl+Z undoes this"),
                        {{tr("Undo"), [this] { workspace_->undo(); }}}});
    });
    connect(studies_, &StudyPage::pointUsed, this, [this](const QString& text) {
        notices_->post({Notice::Kind::information,
                        "study",
                        tr("In the scene now: %1.").arg(text),
                        tr("Ctrl+Z undoes this"),
                        {{tr("Compare"), [this] { tabs_->setCurrentIndex(0); }},
                         {tr("Undo"), [this] { workspace_->undo(); }}}});
    });
    connect(studies_, &StudyPage::runLoaded, this, [this](const QString& text) {
        tabs_->setCurrentIndex(0);
        notices_->post({Notice::Kind::information,
                        "study",
                        tr("Loaded from the study: %1.").arg(text),
                        tr("Ctrl+Z undoes this"),
                        {{tr("Studies"), [this] { tabs_->setCurrentIndex(2); }},
                         {tr("Undo"), [this] { workspace_->undo(); }}}});
    });
    connect(studies_, &StudyPage::problemFound, this, [this](const QString& text, const QString& hint) {
        notices_->post({Notice::Kind::error, "studyProblem", text, hint, {}});
    });
    connect(compare_, &CompareView::saveFailed, this, [this](const QString& reason) {
        notices_->post(
            {Notice::Kind::error, "save", tr("The plot could not be saved: %1").arg(reason), {}, {}});
    });

    schemes_ = new SchemeList(*workspace_, *run_, theme_);
    connect(schemes_, &SchemeList::catalogueRequested, this, [this] { ownList().open(); });
    splitter_ = new QSplitter;
    splitter_->setChildrenCollapsible(false);
    splitter_->setHandleWidth(12);
    splitter_->addWidget(left);
    splitter_->addWidget(centre);
    splitter_->addWidget(schemes_);
    splitter_->setStretchFactor(1, 1);
    left_ = left;
    auto* work = new QWidget;
    auto* workRow = new QVBoxLayout(work);
    workRow->setContentsMargins(12, 12, 12, 4);
    workRow->addWidget(splitter_);

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
    for (const auto& [widget, page] : {std::pair<QWidget*, const char*>{left_, "models"},
                                       {discretizer_, "spaces"},
                                       {compare_, "observables"},
                                       {studies_, "studies"},
                                       {notes_, "scenes"},
                                       {schemes_, "schemes"},
                                       {startPage_, "tour"}})
        widget->setProperty("help", page);  // of F1
    stack_ = new QStackedWidget;
    stack_->addWidget(startPage_);
    stack_->addWidget(work);
    connect(stack_, &QStackedWidget::currentChanged, this, &MainWindow::showSight);
    column->addWidget(stack_, 1);
    setCentralWidget(whole);
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
    });
}

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
    parts.emplace_back([this] { startPage_->setTheme(theme_); });
    parts.emplace_back([this] {
        if (inspector_) inspector_->setTheme(theme_);
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
    if (event->mimeData()->hasUrls()) open(event->mimeData()->urls().first().toLocalFile());
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
    left_->setMinimumWidth(left);
    schemes_->setMinimumWidth(scaled(208));
    const int side =
        left_->isHidden() ? 0 : std::clamp(width() * 18 / 100, left, std::max(left, scaled(300)));
    const int right = schemes_->isHidden() ? 0 : std::clamp(width() * 19 / 100, scaled(208), scaled(310));
    splitter_->setSizes({side, width() - side - right - frame, right});
}

}  // namespace extremal
