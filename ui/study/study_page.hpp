// SPDX-License-Identifier: GPL-3.0-or-later
/// The page of studies: schemes of the scene over many steps, or numbers of the scene over which they are
/// stable; their plot, and what is worth its cost. A point of the plot, or a row of the table, is a run that
/// can be put into the scene.
#pragma once

#include <QWidget>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/study/catalog.hpp"
#include "engine/study/search/proposal.hpp"
#include "ui/study/study_job.hpp"

class QLabel;
class QPushButton;
class QTableWidget;

namespace extremal {

class Card;
class PlotWidget;
class StudyForm;
class Wanted;
class WantedError;
class Workspace;
struct Theme;

class StudyPage : public QWidget {
    Q_OBJECT
public:
    StudyPage(Workspace& workspace, Wanted& wanted, const Theme& theme, QWidget* parent = nullptr);

    /// Runs the study that is chosen; what is wrong with its options is told by problemFound().
    void start();
    /// False if there is nothing to stop.
    bool stop();
    /// Runs the schemes at what each needs for the wanted error.
    void measureCheapest();
    /// Puts the selected row of the table into the scene.
    void useSelected();
    /// The same, and asks to see it.
    void loadSelected();
    void openChoices();
    void askForError();
    const StudyJob& job() const { return *job_; }
    StudyForm& form() const { return *form_; }
    PlotWidget& plot() const { return *plot_; }
    int figuresMade() const { return figuresMade_; }  ///< so far
    void setTheme(const Theme& theme);

signals:
    void pointUsed(const QString& what);  ///< a run is in the scene
    void runLoaded(const QString& what);  ///< a run is in the scene, and wants to be seen
    void problemFound(const QString& what, const QString& hint);

protected:
    void showEvent(QShowEvent* event) override;

private:
    /// A run of a study, as numbers of the scene; without any there is nothing to load.
    struct LoadableRun {
        std::string label;
        std::vector<std::pair<std::string, double>> numbers;
        std::optional<SchemeSpec> scheme = {};  ///< a smaller one in its place, with these numbers
    };

    void makeResults(const Theme& theme);
    void makePlots(const Theme& theme);
    void makeTable();
    void connectResults();
    void showScene();
    void showKind();
    void showFigure();
    void showTable();
    void showWanted();
    void showSelection();
    void showMapOf(const std::string& label);
    void showState();
    void fill(const StudyTable& table);
    StudyTable proposalTable() const;
    QString answer() const;
    bool hasWantedError() const;
    bool isCheapest() const;
    LoadableRun selectedRun() const;
    LoadableRun runOfRow(std::size_t row) const;
    bool use(const LoadableRun& run, QString& text);
    void load(const LoadableRun& run);

    Workspace& workspace_;
    Wanted& wanted_;
    StudyJob* job_;
    const StudyEntry* shown_ = nullptr;  ///< what the job computes
    std::optional<Scene> studied_;       ///< the scene that it is of
    std::vector<Proposal> proposals_;    ///< of the wanted error
    std::string mapped_;                 ///< the scheme of the map that is shown
    int figuresMade_ = 0;
    StudyForm* form_;
    WantedError* wantedEdit_;
    QLabel* answer_;
    QPushButton *measure_, *use_, *load_;
    Card *plotCard_, *tableCard_;
    PlotWidget *plot_, *beside_;  ///< the second one of studies with two plots
    QTableWidget* table_;
};

}  // namespace extremal
