/// The page of studies: schemes of the scene over many steps, their plot, and what is worth its cost; a row
/// of the table can be put into the scene.
#pragma once

#include <QWidget>

#include <optional>
#include <string>
#include <vector>

#include "engine/study/catalog.hpp"
#include "ui/shell/document.hpp"
#include "ui/study/study_job.hpp"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QTableWidget;

namespace extremal {

class Card;
class PlotWidget;
class Workspace;
struct Theme;

/// Gives a scheme, by its label, this step or tolerance (the other one is 0) and switches it on; empty where
/// the scene has no such scheme.
std::vector<Edit> editsForPoint(const Scene& scene, const std::string& label, double step, double tolerance);

class StudyPage : public QWidget {
    Q_OBJECT
public:
    StudyPage(Workspace& workspace, const Theme& theme, QWidget* parent = nullptr);

    /// Runs the study that is chosen; what is wrong with its options stands below them.
    void start();
    /// False if there is nothing to stop.
    bool stop();
    const StudyJob& job() const { return *job_; }
    void setTheme(const Theme& theme);

signals:
    void pointUsed(const QString& what);  ///< a row was put into the scene

protected:
    void showEvent(QShowEvent* event) override;

private:
    void makeOptions();
    void makeResults(const Theme& theme);
    void showScene();
    void showOptions();
    void showStudy();
    void showState();
    void showTable();
    void use();
    const StudyEntry& chosen() const;
    SweepOptions options() const;

    Workspace& workspace_;
    StudyJob* job_;
    const StudyEntry* shown_ = nullptr;  ///< what the job computes
    std::optional<Scene> studied_;       ///< the scene that it is of
    QComboBox *kind_, *metric_;
    QLabel *errorLabel_, *state_;
    QLineEdit* error_;
    QCheckBox* isAtEnd_;
    QPushButton *run_, *use_;
    QProgressBar* progress_;
    Card *plotCard_, *tableCard_;
    PlotWidget* plot_;
    QTableWidget* table_;
};

}  // namespace extremal
