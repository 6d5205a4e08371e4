// SPDX-License-Identifier: GPL-3.0-or-later
/// What the wanted error costs with each cell of the discretizer: the search of the study `cheapest` over all
/// of them, in the background, while the shading is switched on. Another problem or another wanted error is
/// measured anew, after a pause.
#pragma once

#include <QObject>
#include <QTimer>

#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "engine/scene/resolve.hpp"
#include "engine/study/search/point.hpp"

namespace extremal {

class Discretizer;
class Wanted;
class Workspace;

/// One cell after the search.
struct MeasuredCell {
    double seconds = 0;  ///< 0: the error is not reached
    QString reason;      ///< then why
};

/// The cells, by their discretizations, with the cheapest step of each for this error; empty entries: the
/// scene does not take it, or there was no time for it. `seconds`: of CPU.
std::vector<std::optional<MeasuredCell>> costsOfCells(const ResolvedScene& scene,
                                                      const std::vector<Discretization>& cells, double error,
                                                      double seconds, const std::stop_token& stop);

class CellCosts : public QObject {
    Q_OBJECT
public:
    CellCosts(Workspace& workspace, Wanted& wanted, Discretizer& discretizer, QObject* parent = nullptr);
    ~CellCosts() override;
    void toggle();
    /// False if there is nothing to stop.
    bool stop();
    bool isOn() const;
    bool isRunning() const { return isRunning_; }
    /// Whether the cells show the costs of the present scene and wanted error.
    bool isCurrent() const;

signals:
    void changed();

private:
    void refresh();
    void measure();
    void clear();
    void take(const std::vector<std::optional<MeasuredCell>>& costs);

    Workspace& workspace_;
    Wanted& wanted_;
    Discretizer& discretizer_;
    QTimer pause_;
    std::optional<Scene> scene_;  ///< what was measured, or is
    double error_ = 0;
    bool isRunning_ = false;
    std::stop_source stop_{std::nostopstate};
};

}  // namespace extremal
