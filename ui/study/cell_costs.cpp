// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study/cell_costs.hpp"

#include <QPointer>
#include <QPushButton>

#include <algorithm>
#include <string>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/family/parts/steps.hpp"
#include "engine/scene/bind.hpp"
#include "engine/study/sweep.hpp"
#include "ui/base/background.hpp"
#include "ui/base/format.hpp"
#include "ui/panels/discretizer.hpp"
#include "ui/workspace/wanted.hpp"
#include "ui/workspace/workspace.hpp"
#include "ui/study/problem_of.hpp"
#include "engine/study/search/candidates.hpp"

namespace extremal {
namespace {

constexpr int pauseMs = 400;
constexpr double searchSeconds = 2;

/// A scheme of this discretization, with a step to begin with. Throws InvalidScene where the system does not
/// take it.
ResolvedScheme schemeOfCell(const Discretization& cell, const std::string& label,
                            const ResolvedScene& scene) {
    constexpr double steps = 100;
    SchemeSpec spec;
    spec.label = label;
    spec.solver.type = "auto";
    spec.step = {timeSpan(scene.scene).length() / steps, {}};
    spec.space = cell.space;
    spec.quadrature = cell.quadrature;
    return acceptedBy(scene, spec);
}

}  // namespace

std::vector<std::optional<MeasuredCell>> costsOfCells(const ResolvedScene& scene,
                                                      const std::vector<Discretization>& cells, double error,
                                                      double seconds, const std::stop_token& stop) {
    std::vector<std::optional<MeasuredCell>> costs(cells.size());
    ResolvedScene all = scene;
    all.scene.schemes.clear();
    all.schemes.clear();
    std::vector<std::size_t> cellOf;
    for (std::size_t i = 0; i < cells.size(); ++i) try {
            ResolvedScheme scheme = schemeOfCell(cells[i], std::to_string(i), scene);
            all.scene.schemes.push_back(scheme.spec);
            all.schemes.push_back(std::move(scheme));
            cellOf.push_back(i);
        } catch (const InvalidScene&) {  // the cell says so itself
        }
    if (cellOf.empty()) return costs;
    SweepOptions options;
    options.wantedError = error;
    options.searchSeconds = seconds;
    options.repeat = 1;
    options.knobs = {.isDegree = false, .isCells = false, .isSmaller = false};  // the cell as it is
    Sweep sweep(std::move(all), options);
    sweep.run({}, {}, stop);
    for (const SweepRow& row : sweep.rows()) {
        if (row.result.status == RunStatus::waiting) continue;
        const double cost = row.result.isDone() ? row.result.cpuSeconds : 0;
        costs[cellOf[row.point.scheme]] = {cost, QString::fromStdString(row.result.reason)};
    }
    return costs;
}

CellCosts::CellCosts(Workspace& workspace, Wanted& wanted, Discretizer& discretizer, QObject* parent)
    : QObject(parent), workspace_(workspace), wanted_(wanted), discretizer_(discretizer) {
    pause_.setSingleShot(true);
    pause_.setInterval(pauseMs);
    connect(&pause_, &QTimer::timeout, this, &CellCosts::measure);
    connect(&discretizer_.costs(), &QPushButton::toggled, this, &CellCosts::refresh);
    connect(&discretizer_, &Discretizer::filled, this, [this] {
        scene_.reset();
        refresh();
    });
    connect(&wanted_, &Wanted::changed, this, &CellCosts::refresh);
    connect(&workspace_, &Workspace::sceneChanged, this, &CellCosts::refresh);
}

CellCosts::~CellCosts() { stop_.request_stop(); }

bool CellCosts::isOn() const { return discretizer_.costs().isChecked(); }

void CellCosts::toggle() { discretizer_.costs().toggle(); }

bool CellCosts::isCurrent() const {
    return scene_ && !isRunning_ && error_ == wanted_.error() && problemOf(workspace_.scene()) == *scene_;
}

bool CellCosts::stop() {
    if (!isRunning_) return false;
    discretizer_.costs().setChecked(false);
    return true;
}

void CellCosts::clear() {
    stop_.request_stop();
    pause_.stop();
    isRunning_ = false;
    scene_.reset();
    for (DiscretizerCell* cell : discretizer_.cells()) cell->setCost(std::nullopt);
    discretizer_.setStripText({});
}

void CellCosts::refresh() {
    if (!isOn() || !workspace_.hasScene()) {
        clear();
        emit changed();
        return;
    }
    if (scene_ && error_ == wanted_.error() && problemOf(workspace_.scene()) == *scene_) return;
    clear();
    pause_.start();
    discretizer_.setStripText(
        tr("Measuring what an error of %1 costs with each cell.").arg(shortNumber(wanted_.error(), 2)));
    emit changed();
}

void CellCosts::measure() {
    if (!isOn() || !workspace_.hasScene()) return;
    if (!discretizer_.isCurrent()) return pause_.start();  // its cells are on their way
    stop_ = std::stop_source();
    scene_ = problemOf(workspace_.scene());
    error_ = wanted_.error();
    isRunning_ = true;
    std::vector<Discretization> cells;
    for (const DiscretizerCell* cell : discretizer_.cells())
        cells.push_back(cell->isEnabled() && !cell->choice().isOwn ? cell->choice().discretization
                                                                   : Discretization{});
    runInBackground([self = QPointer(this), scene = workspace_.resolved(), cells = std::move(cells),
                     error = error_, stop = stop_.get_token()] {
        std::vector<std::optional<MeasuredCell>> costs;
        QString problem;
        try {
            costs = costsOfCells(*scene, cells, error, searchSeconds, stop);
        } catch (const InvalidScene& e) {
            problem = QString::fromStdString(e.problems().front().message);
        }
        sendToWindow([self, costs, problem, stop] {
            if (!self || stop.stop_requested()) return;
            self->isRunning_ = false;
            if (problem.isEmpty())
                self->take(costs);
            else
                self->discretizer_.setStripText(tr("Costs cannot be measured: %1").arg(problem));
            emit self->changed();
        });
    });
    emit changed();
}

void CellCosts::take(const std::vector<std::optional<MeasuredCell>>& costs) {
    const auto& cells = discretizer_.cells();
    if (costs.size() != cells.size()) return;
    double least = 0;
    for (const auto& cost : costs)
        if (cost && cost->seconds > 0 && (least == 0 || cost->seconds < least)) least = cost->seconds;
    const QString error = shortNumber(error_, 2);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!costs[i]) continue;
        const double times = least > 0 ? costs[i]->seconds / least : 0;
        const QString words =
            !(costs[i]->seconds > 0) ? tr("an error of %1: %2").arg(error, costs[i]->reason)
            : times > 1
                ? tr("an error of %1 costs %2, %3 times the cheapest cell")
                      .arg(error, shortTime(costs[i]->seconds), shortNumber(times))
                : tr("an error of %1 costs %2: the cheapest cell").arg(error, shortTime(costs[i]->seconds));
        cells[i]->setCost(CellCost{costs[i]->seconds, times, words});
    }
    discretizer_.setStripText(
        least > 0
            ? tr("Coloured by what an error of %1 costs: from %2 (strong) to a hundred times that (faint); "
                 "without colour: not reached. Point at a cell for its own.")
                  .arg(error, shortTime(least))
            : tr("No cell reaches an error of %1.").arg(error));
}

}  // namespace extremal
