// SPDX-License-Identifier: GPL-3.0-or-later
/// What the scene keeps of a plot, as edits of the document: the part it shows, and a curve to compare with.
#pragma once

#include <functional>
#include <vector>

#include "engine/scene/scene.hpp"
#include "ui/plots/view_state.hpp"
#include "ui/workspace/document.hpp"

class QMenu;
class QWidget;

namespace extremal {

struct ViewEntry;
class PlotWidget;
class Workspace;

/// The plots that this scene can have: its system and at least one of its schemes have what they show.
/// Without speed against accuracy, which is always there.
std::vector<const ViewEntry*> offeredPlots(const Scene& scene);

/// The scene's views with one of the plots shown changed. A view that stands for several plots is split into
/// them.
std::vector<View> viewsForPlot(const Scene& scene, const View& before, const View& after);
std::vector<Edit> editsForPlot(const Scene& scene, const View& before, const View& after);
std::vector<Edit> editsForViews(const Scene& scene, std::vector<View> views);
/// The views of a scene and how it is shown, as edits of one that differs in these.
std::vector<Edit> editsForSeen(const Scene& scene);

/// The scene's views without one of the plots shown, or with it moved so many places among them. Empty where
/// nothing changes. A view that stands for several plots is split into them.
std::vector<Edit> editsWithoutPlot(const Scene& scene, const View& view);
std::vector<Edit> editsForMovedPlot(const Scene& scene, const View& view, int by);

/// A range with no more digits than a plot can show: a ten-thousandth of its width, or four digits on a
/// logarithmic axis.
ViewRange roundedRange(PlotRange range, bool isLog);

/// The view with the part that its plot shows now, along the axes that the user zoomed.
View withPart(const View& view, const PlotWidget& plot);
/// Submenus for what a view lets one choose ("against": time or steps). `view` gives it as it is when chosen.
/// A part that was kept goes, and a curve whose variable the choice changes.
void addChoices(QMenu& menu, Workspace& workspace, const std::string& id, const std::function<View()>& view);
/// Submenus for what a view names: its columns, its scheme, its node. `view` as above; they are made when the
/// menu is about to open, since other schemes and observables give other names.
void addNames(QMenu& menu, Workspace& workspace, const std::string& id, const std::function<View()>& view);
/// Asks for an expression and draws it in the plot; an empty one removes it.
void askForCurve(Workspace& workspace, const View& view, QWidget* parent);

}  // namespace extremal
