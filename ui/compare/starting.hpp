// SPDX-License-Identifier: GPL-3.0-or-later
/// Where motions start, chosen in the plots: a click in a phase portrait or a section adds a start there, and
/// the start of the scene is dragged in every plot of its columns.
#pragma once

#include <QPointF>
#include <QString>

#include <functional>
#include <optional>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/run/comparison.hpp"
#include "engine/scene/scene.hpp"
#include "ui/workspace/document.hpp"

class QMenu;

namespace extremal {

class PlotWidget;
class Workspace;

/// Whether clicks in a plot of this view can add starts.
bool takesStarts(const View& view, const System& system);

/// The start of the scene in the plane of a view; none where it is not in it. `system`: that of the scene.
std::optional<QPointF> startInView(const Scene& scene, const View& view, const System& system);

/// A place with no more digits than a plot can show.
QPointF roundedPlace(QPointF place, const PlotWidget& plot);

/// One more start of a view, or the start of the scene moved within its plane: the edits, or why not.
struct StartEdits {
    std::vector<Edit> edits;
    QString problem;
};
StartEdits editsForStart(const Scene& scene, const View& view, const System& system, QPointF place);
StartEdits editsForMove(const Scene& scene, const View& view, const System& system, QPointF place);

/// Those of the selected scheme, or of the first one. The results have one at least.
const SchemeResult& resultToStartFrom(const Workspace& workspace, const Comparison& results);

/// The sample of a field that is nearest in time; null where the result has no finite one.
const std::vector<double>* sampleAt(const System& system, const SchemeResult& result, double t);
/// That a result has no state at the time that was chosen.
StartEdits withoutState(const SchemeResult& result);

/// The start of the scene moved to where a scheme is at a time: at its nearest row, where the state consists
/// of coordinates and momenta, or with the nearest sample of a field.
StartEdits editsForStartAt(const System& system, const SchemeResult& result, double t);

/// Spread starts over the plot, and remove them: shown for views that take starts.
void addStartActions(QMenu& menu, Workspace& workspace, const std::function<View()>& view);

}  // namespace extremal
