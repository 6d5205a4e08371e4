// SPDX-License-Identifier: GPL-3.0-or-later
/// What the views share: axes with titles and units, series from columns, marks, ranges and the sentence for
/// readers.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/figure/recipe.hpp"

namespace extremal {

/// "H  [J]"; without a unit the symbol alone. ASCII minus signs between spaces become real ones.
std::string axisTitle(std::string_view symbol, std::string_view unit);

/// For people: `digits` significant ones, "3.2e-7", "0.31", "1200".
std::string shortNumber(double value, int digits = 2);

/// Symbol and unit of a state or observable column: from the trajectories, else from the system, else its
/// name alone.
struct ColumnInfo {
    std::string symbol, unit;
};
ColumnInfo columnInfo(const FigureContext& context, std::string_view column);

/// Time from the start to the end of the scene, linked with all other time axes.
Axis timeAxis(const FigureContext& context);
Axis logAxis(std::string title);

/// A figure with the entry's title and the id of the view.
Figure startFigure(const FigureContext& context, std::string title);

/// The scheme of the view; without one, the first that has what is shown. Null if there is none.
template <class Shown>
const SchemeResult* schemeOf(const FigureContext& context, const Shown& hasShown) {
    for (const auto& scheme : context.comparison.schemes)
        if (hasShown(*scheme) && (context.view.scheme.empty() || scheme->spec.label == context.view.scheme))
            return scheme.get();
    return nullptr;
}

/// The samples of a field or wave function; null where there is none.
inline const std::vector<Frame>* framesOf(const SchemeResult& scheme) {
    const FieldFrames* frames = scheme.products.find<FieldFrames>();
    return frames && !frames->all.empty() ? &frames->all : nullptr;
}

/// The system that a scheme integrates: its own where its space has its own mesh. There must be one.
inline const System& systemOf(const FigureContext& context, const SchemeResult& scheme) {
    return scheme.scheme && scheme.scheme->ownSystem ? *scheme.scheme->ownSystem : *context.system;
}

/// One series per scheme: a column, or its magnitude, against time.
enum class Take { value, magnitude };
void addAgainstTime(Figure& figure, const FigureContext& context, std::string_view column, Take take);

/// A whole view of one column of an observable against time, as it is. The subtitle says by how much it
/// changes from its first value, at most, in the scheme where it changes least and in that where it changes
/// most; with `isRelative`, as a share of the first value. Finished.
Figure columnAgainstTime(const FigureContext& context, std::string title, std::string_view column,
                         bool isRelative);

/// One curve per scheme: a column against another; where steps are few, along the dense output inside
/// them.
void addCurves(Figure& figure, const FigureContext& context, std::string_view xColumn,
               std::string_view yColumn);

/// Marks of the schemes that failed, gaps where an axis cannot show a value, ranges, a message if there is
/// nothing, and the summary. Last call of every view. `what` starts the summary: "Energy error of 3 schemes
/// against time".
void finishFigure(Figure& figure, const FigureContext& context, std::string_view what);

/// Largest magnitude among the finite values; 0 if there is none.
double maxMagnitude(std::span<const double> values);

/// Euclidean norm at the first row of all columns whose name starts with the prefix ("q.", "momentum."), of
/// the first scheme that has rows: the scale to which round-off is relative.
double initialNorm(const Comparison& comparison, std::string_view prefix);

}  // namespace extremal
