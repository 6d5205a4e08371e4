// SPDX-License-Identifier: GPL-3.0-or-later
/// What leaves the window: exports, pages for browsers, scenes as text.
#include <QApplication>
#include <QClipboard>
#include <QDesktopServices>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QInputDialog>
#include <QPointer>
#include <QSaveFile>
#include <QStackedWidget>
#include <QStandardPaths>
#include <QStatusBar>
#include <QTimer>
#include <QUrl>

#include "engine/scene/read/json.hpp"
#include "ui/base/background.hpp"
#include "ui/base/notices.hpp"
#include "ui/base/save_dialog.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/pictures/export_folder.hpp"
#include "ui/plots/plot_renderer.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/windows/figure_sheet.hpp"
#include "ui/windows/folder_dialog.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

void MainWindow::exportDialog() {
    if (!run_->results()) return;
    askForFolder(tr("Export everything into a folder"), QStringLiteral("export"),
                 [this](const QString& folder) { startExport(folder); });
}

/// Beside the scene, or among the documents of the user, a folder named after it is proposed.
void MainWindow::askForFolder(const QString& title, const QString& kind,
                              const std::function<void(const QString&)>& use) {
    const QString place = workspace_->path().isEmpty()
                              ? QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation)
                              : QFileInfo(workspace_->path()).absolutePath();
    const QString name = QFileInfo(workspace_->fileName()).completeBaseName();
    auto* dialog = new FolderDialog(title, place + '/' + name + '-' + kind, this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QDialog::accepted, this, [dialog, use] { use(dialog->folder()); });
    dialog->open();
}

/// Files of the run in another thread, then picture after picture, between which the window answers.
void MainWindow::startExport(const QString& folder) {
    const auto parts = partsOfExport();
    if (!parts) return;
    notices_->post({Notice::Kind::information, "export", tr("Exporting to %1 ...").arg(folder), {}, {}});
    auto steps = std::make_shared<std::deque<std::function<QString()>>>();
    for (auto& step : exportSteps(*parts, folder)) steps->push_back(std::move(step));
    runInBackground([self = QPointer(this), steps, folder] {
        const QString problem = steps->front()();
        sendToWindow([self, steps, folder, problem] {
            steps->pop_front();
            if (self) self->continueExport(steps, problem, folder);
        });
    });
}

void MainWindow::continueExport(const std::shared_ptr<std::deque<std::function<QString()>>>& steps,
                                const QString& problem, const QString& folder) {
    if (!problem.isEmpty() || steps->empty()) {
        tellOfExport(problem, folder, folder);
        return;
    }
    QTimer::singleShot(0, this, [this, steps, folder] {
        const QString next = steps->front()();
        steps->pop_front();
        continueExport(steps, next, folder);
    });
}

std::optional<ExportParts> MainWindow::partsOfExport() {
    const auto results = run_->results();
    if (!results) return {};
    compare_->complete();
    ExportParts parts;
    parts.comparison = results;
    for (const PlotWidget* plot : compare_->plots()) parts.figures.push_back(plot->figure());
    if (compare_->hasStage()) parts.stage = compare_->stage()->picture(2);
    return parts;
}

bool MainWindow::exportEverything(const QString& folder) {
    const auto parts = partsOfExport();
    return parts && tellOfExport(exportFolder(*parts, folder), folder, folder);
}

/// A banner says where it is, or what went wrong.
bool MainWindow::tellOfExport(const QString& problem, const QString& file, const QString& folder) {
    if (!problem.isEmpty()) {
        notices_->post({Notice::Kind::error,
                        "export",
                        tr("The export failed: %1").arg(problem),
                        tr("choose another folder"),
                        {}});
        return false;
    }
    notices_->post(
        {Notice::Kind::information,
         "export",
         tr("Exported to %1").arg(file),
         {},
         {{tr("Open folder"), [folder] { QDesktopServices::openUrl(QUrl::fromLocalFile(folder)); }}}});
    return true;
}

void MainWindow::exportReport() {
    if (!run_->results()) return;
    const QString path =
        askForSave(this, tr("Save a page for browsers"),
                   QFileInfo(workspace_->fileName()).completeBaseName() + ".html", tr("Pages (*.html)"));
    if (path.isEmpty()) return;
    notices_->post({Notice::Kind::information, "export", tr("Writing %1 ...").arg(path), {}, {}});
    runInBackground(
        [self = QPointer(this), parts = std::make_shared<const ExportParts>(*partsOfExport()), path] {
            QSaveFile file(path);
            const QByteArray page = reportPage(*parts).toUtf8();
            const bool isWritten =
                file.open(QIODevice::WriteOnly) && file.write(page) == page.size() && file.commit();
            sendToWindow([self, path, problem = isWritten ? QString() : file.errorString()] {
                if (self) self->tellOfExport(problem, path, QFileInfo(path).absolutePath());
            });
        });
}

void MainWindow::exportFrames() {
    if (!run_->results() || !compare_->hasStage()) return;
    bool isChosen = false;
    const int count = QInputDialog::getInt(this, tr("Stage as frames"),
                                           tr("Pictures, 2 to 5000, from the start to the end"), 240, 2, 5000,
                                           1, &isChosen);
    if (!isChosen) return;
    askForFolder(tr("Frames into a folder"), QStringLiteral("frames"),
                 [this, count](const QString& folder) { startFrames(folder, count); });
}

void MainWindow::startFrames(const QString& folder, int count) {
    if (!QDir().mkpath(folder)) {
        tellOfExport(tr("%1 cannot be made").arg(folder), folder, folder);
        return;
    }
    playback_->setPlaying(false);
    auto steps = std::make_shared<std::deque<std::function<QString()>>>();
    const auto picture = [this](double t) {
        playback_->setTime(t);
        return compare_->stage()->picture(2);
    };
    for (auto& step : frameSteps(folder, playback_->start(), playback_->end(), count, picture))
        steps->push_back(std::move(step));
    continueExport(steps, {}, folder);
}

/// With the plots as they are zoomed.
void MainWindow::showFigureSheet() {
    if (!run_->results()) return;
    compare_->complete();
    SheetContent content;
    content.title = workspace_->scene().title;
    content.scene = workspace_->path().isEmpty() ? workspace_->fileName() : workspace_->path();
    const PlotWidget* const current = compare_->currentPlot();
    for (const PlotWidget* plot : compare_->plots()) {
        if (plot == current) content.current = content.figures.size();
        content.figures.push_back(plot->visibleFigure());
        if (plot->figure().x.isTime && plot->isUserZoomed(PlotAxis::x))
            content.times = {plot->visibleRange(PlotAxis::x).low, plot->visibleRange(PlotAxis::x).high};
    }
    if (!figureSheet_) {
        figureSheet_ = new FigureSheet(this);
        connect(figureSheet_, &FigureSheet::saved, this, [this](const QString& file, const QString& problem) {
            tellOfExport(problem, file, QFileInfo(file).absolutePath());
        });
    }
    figureSheet_->open(std::move(content));
}

void MainWindow::copyScene() {
    if (!workspace_->hasScene()) return;
    QApplication::clipboard()->setText(QString::fromStdString(writeJson(workspace_->document())));
    statusBar()->showMessage(tr("The scene is on the clipboard, as text"), 6000);
}

void MainWindow::pasteScene() {
    const std::string text = QApplication::clipboard()->text().toStdString();
    QString problem;
    try {
        const Value document = parseJson(text);
        if (!mayLeaveScene()) return;
        if (workspace_->adopt(document)) return;
        problem = workspace_->openProblems().empty()
                      ? QString()
                      : QString::fromStdString(workspace_->openProblems().front().message);
    } catch (const InvalidScene& error) {
        problem = QString::fromStdString(error.problems().front().message);
    }
    notices_->post({Notice::Kind::error,
                    "paste",
                    tr("The clipboard has no scene: %1").arg(problem),
                    tr("copy the text of a scene file first"),
                    {}});
}

}  // namespace extremal
