// SPDX-License-Identifier: GPL-3.0-or-later
/// What the scene needs, as a stair: for each error the cheapest model and scheme, what it leaves out, and
/// what the next digits cost. A click on a step puts its scheme into the scene. The step that the wanted
/// error stands on is marked, and its answer is for that error.
#pragma once

#include <QAbstractButton>

#include <vector>

#include "ui/base/card.hpp"
#include "ui/study/needs_job.hpp"

class QLabel;
class QProgressBar;
class QPushButton;
class QVBoxLayout;

namespace extremal {

class MetricBox;
class SidewaysArea;
struct Theme;
class Wanted;
class Workspace;

/// One step of the stair.
class NeedsStep : public QAbstractButton {
    Q_OBJECT
public:
    explicit NeedsStep(QWidget* parent = nullptr);
    void setTheme(const Theme& theme);
    /// `share`: of the width that its tread takes, 0..1. `isChosen`: the wanted error stands on it.
    void show(const NeedsRung& rung, const NeedsAnswer& answer, double share, bool isChosen);
    bool isChosen() const { return isChosen_; }
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return {120, sizeHint().height()}; }

protected:
    void paintEvent(QPaintEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    const Theme* theme_ = nullptr;
    QString title_, cost_, left_, times_;
    double share_ = 0;
    bool isChosen_ = false, isReached_ = true;
};

class NeedsCard : public Card {
    Q_OBJECT
public:
    NeedsCard(Workspace& workspace, Wanted& wanted, const Theme& theme, QWidget* parent = nullptr);
    void setTheme(const Theme& theme);
    /// Searches, or stops the search.
    void measure();
    /// False if there is nothing to stop.
    bool stop();
    const NeedsJob& job() const { return *job_; }
    /// The steps in sight.
    std::vector<NeedsStep*> steps() const;

signals:
    void used(const QString& what);  ///< a scheme is in the scene
    void problemFound(const QString& what, const QString& hint);

private:
    void showScene();
    void showJob();
    void showSteps();
    QString stateText() const;
    void use(std::size_t rung);

    Workspace& workspace_;
    Wanted& wanted_;
    const Theme* theme_;
    NeedsJob* job_;
    QPushButton* measure_;
    MetricBox* metric_;
    QProgressBar* progress_;
    QLabel* state_;
    SidewaysArea* stair_;  ///< in a low window it scrolls
    QVBoxLayout* treads_;
    std::vector<NeedsStep*> steps_;
};

}  // namespace extremal
