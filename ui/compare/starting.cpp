// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/compare/starting.hpp"

#include <QInputDialog>
#include <QMenu>
#include <QPointer>

#include <algorithm>
#include <cmath>

#include "engine/run/products.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/plane_start.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/view/catalog.hpp"
#include "ui/compare/plot_edits.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

std::optional<ViewPlane> startablePlane(const View& view, const System& system) {
    const auto plane = planeOf(view, system);
    return plane && startProblem(system, *plane).empty() ? plane : std::nullopt;
}

/// The numbers of a part of the state, as the scene has them where they stay.
Value numbersOf(const std::vector<double>& x, std::size_t first, std::size_t count,
                const std::vector<Number>& before) {
    Value::Array values;
    for (std::size_t i = 0; i < count; ++i) {
        const bool stays =
            i < before.size() && before[i].value == x[first + i] && !before[i].expression.empty();
        values.push_back(stays ? Value(before[i].expression) : Value(x[first + i]));
    }
    return values;
}

}  // namespace

bool takesStarts(const View& view, const System& system) {
    return keysOf(view.id, &system).hasStarts && startablePlane(view, system);
}

std::optional<QPointF> startInView(const Scene& scene, const View& view, const System& system) {
    constexpr double onSection = 1e-12;
    const auto plane = startablePlane(view, system);
    if (!plane || scene.initial.second == Initial::Second::position) return {};
    const State start = initialState(scene, system);
    const std::vector<Quantity> columns = stateColumns(system);
    QPointF at;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (columns[i].name == plane->x) at.setX(start.x[i]);
        if (columns[i].name == plane->y) at.setY(start.x[i]);
        if (columns[i].name == plane->at && std::abs(start.x[i]) > onSection) return {};
    }
    return at;
}

QPointF roundedPlace(QPointF place, const PlotWidget& plot) {
    const auto rounded = [](double value, PlotRange range) {
        const double unit = std::pow(10, std::floor(std::log10(range.high - range.low)) - 3);
        return unit < 1 ? std::round(value / unit) / std::round(1 / unit) : std::round(value / unit) * unit;
    };
    return {rounded(place.x(), plot.visibleRange(PlotAxis::x)),
            rounded(place.y(), plot.visibleRange(PlotAxis::y))};
}

StartEdits editsForStart(const Scene& scene, const View& view, const System& system, QPointF place) {
    const auto plane = startablePlane(view, system);
    if (!plane) return {};
    const PlaneStart start = StartPlane(system, initialState(scene, system), *plane).at(place.x(), place.y());
    if (!start.problem.empty()) return {{}, QString::fromStdString(start.problem)};
    View after = view;
    after.starts.points.push_back({Number{place.x(), {}}, Number{place.y(), {}}});
    return {editsForPlot(scene, view, after), {}};
}

StartEdits editsForMove(const Scene& scene, const View& view, const System& system, QPointF place) {
    const auto plane = startablePlane(view, system);
    if (!plane) return {};
    const PlaneStart start = StartPlane(system, initialState(scene, system), *plane).at(place.x(), place.y());
    if (!start.problem.empty()) return {{}, QString::fromStdString(start.problem)};
    const auto d = static_cast<std::size_t>(system.dimension());
    Value initial{Value::Object{}};
    initial.set("q", numbersOf(start.x, 0, d, scene.initial.q));
    const bool hasMomenta = scene.initial.second == Initial::Second::momentum;
    initial.set("p", numbersOf(start.x, d, d, hasMomenta ? scene.initial.pOrV : std::vector<Number>{}));
    return {{{"/initial", initial}}, {}};
}

const SchemeResult& resultToStartFrom(const Workspace& workspace, const Comparison& results) {
    const int selected = workspace.selectedScheme();
    for (const auto& result : results.schemes)
        if (selected >= 0 &&
            result->spec.label == workspace.scene().schemes[static_cast<std::size_t>(selected)].label)
            return *result;
    return *results.schemes.front();
}

const std::vector<double>* sampleAt(const System& system, const SchemeResult& result, double t) {
    const FieldFrames* const frames = result.products.find<FieldFrames>();
    if (!frames || frames->all.empty()) return nullptr;
    const auto apart = [t](const Frame& frame) { return std::abs(frame.t - t); };
    const std::vector<double>& values =
        *std::min_element(frames->all.begin(), frames->all.end(), [&](const Frame& a, const Frame& b) {
             return apart(a) < apart(b);
         })->values;
    const bool isWhole = values.size() == system.field.size() &&
                         std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    return isWhole ? &values : nullptr;
}

StartEdits withoutState(const SchemeResult& result) {
    return {{}, QObject::tr("%1 has no state there").arg(QString::fromStdString(result.spec.label))};
}

StartEdits editsForStartAt(const System& system, const SchemeResult& result, double t) {
    if (system.field.initial) {
        const std::vector<double>* const sample = sampleAt(system, result, t);
        return sample ? StartEdits{{{"/initial", system.field.initial(*sample)}}, {}} : withoutState(result);
    }
    if (!system.hasCoordinates())
        return {
            {},
            QObject::tr(
                "the state of this model is more than coordinates and momenta, or the values of a field")};
    const std::vector<Quantity> columns = stateColumns(system);
    const auto times = result.trajectory["t"];
    std::size_t row = 0;
    for (std::size_t i = 0; i < times.size(); ++i)
        if (std::abs(times[i] - t) < std::abs(times[row] - t)) row = i;
    std::vector<double> x;
    for (const Quantity& column : columns) {
        const auto values = result.trajectory[column.name];
        if (row >= values.size() || !std::isfinite(values[row])) return withoutState(result);
        x.push_back(values[row]);
    }
    const auto d = static_cast<std::size_t>(system.dimension());
    Value initial{Value::Object{}};
    initial.set("q", numbersOf(x, 0, d, {}));
    initial.set("p", numbersOf(x, d, d, {}));
    return {{{"/initial", initial}}, {}};
}

void addStartActions(QMenu& menu, Workspace& workspace, const std::function<View()>& view) {
    if (!keysOf(view().id, nullptr).hasStarts) return;
    const auto change = [&workspace, view](const auto& edit, const QString& what) {
        const View before = view();
        View after = before;
        edit(after.starts);
        if (!(after == before)) workspace.edit(editsForPlot(workspace.scene(), before, after), what);
    };
    QAction* spread = menu.addAction(QObject::tr("Spread starts..."), &menu, [&menu, view, change] {
        const QPointer<QMenu> guard(&menu);  // its plot may leave the page meanwhile
        bool isChosen = false;
        const int now = view().starts.spread;
        const int count = QInputDialog::getInt(
            menu.parentWidget(), QObject::tr("Spread starts"),
            QObject::tr("Motions that start evenly spread over the plot, 0 to %1").arg(ViewStarts::most),
            now > 0 ? now : 200, 0, ViewStarts::most, 10, &isChosen);
        if (isChosen && guard)
            change([count](ViewStarts& starts) { starts.spread = count; }, QObject::tr("Spread starts"));
    });
    QAction* undo = menu.addAction(QObject::tr("Remove the last start"), &menu, [change] {
        change([](ViewStarts& starts) { starts.points.pop_back(); }, QObject::tr("Remove a start"));
    });
    QAction* remove = menu.addAction(QObject::tr("Remove all starts"), &menu, [change] {
        change([](ViewStarts& starts) { starts = {}; }, QObject::tr("Remove the starts"));
    });
    QObject::connect(&menu, &QMenu::aboutToShow, &workspace, [&workspace, view, spread, undo, remove] {
        const View now = view();
        const bool takes = takesStarts(now, *workspace.resolved()->system);
        const bool hasRoom = keysOf(now.id, nullptr).hasZeros || (now.xRange && now.yRange);
        spread->setVisible(takes);
        spread->setEnabled(hasRoom);
        spread->setToolTip(hasRoom ? QString()
                                   : QObject::tr("Store the range of both axes in the scene first"));
        undo->setVisible(!now.starts.points.empty());
        remove->setVisible(!now.starts.isEmpty());
    });
}

}  // namespace extremal
