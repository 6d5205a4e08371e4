/// A plot as data: what the window, the snapshots, the exports and the tests share. No Qt here.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/run/comparison.hpp"

namespace extremal {

struct Axis {
    std::string title;  ///< with symbol and unit, ready to draw: "t  [s]", "|H - H(0)|  [J]"
    bool isLog = false;
    bool isTime = false;                                  ///< linked with the other time axes
    std::optional<std::pair<double, double>> range;       ///< fixed range; else fitted to the data
    std::optional<std::pair<double, double>> whole = {};  ///< what fits all data, where the view shows a part
    std::vector<std::pair<double, std::string>> ticks =
        {};  ///< named places in place of numbers, without a grid
};

/// The styles of curves that are no scheme's: a thin dashed neutral line, and a solid one.
inline constexpr int formulaStyle = -1, exactStyle = -2;

struct Series {
    std::string label;        ///< the scheme's label
    std::string part = {};    ///< of several curves of one scheme, which: "Re ψ"
    bool isPale = false;      ///< a further curve of one scheme
    int style = 0;            ///< colour and dash of the scheme
    bool isCurve = false;     ///< x is not monotone (phase portrait): drawn as a parametric curve
    bool hasMarkers = false;  ///< a point at every value
    bool hasLine = true;
    bool isCells = false;      ///< a unit square around every point
    bool isHollow = false;     ///< cells are pale
    std::vector<double> x, y;  ///< NaN is a gap
    std::vector<double>
        t;           ///< of the points, where x is not the time: a cursor in time finds its place; else empty
    int hidden = 0;  ///< values a log axis cannot show (<= 0) or that are not finite
};

/// A faint line behind the series: a contour, an outline.
struct Guide {
    std::vector<double> x, y;  ///< NaN is a gap
    bool isStrong = false;
};

/// A word in the plane of the plot.
struct Label {
    double x = 0, y = 0;
    std::string text;
};

/// A field as colours over a rectangle: columns from left to right, each from the bottom up.
struct HeatMap {
    double left = 0, right = 1, bottom = 0, top = 1;
    int columns = 0, rows = 0;
    double low = 0, high = 1;    ///< of the values; below and above them colours stay
    std::vector<double> values;  ///< value (row, column) at column * rows + row; NaN is a gap
    std::vector<double> hues;  ///< the colour in turns, of values that have a phase; empty: one scale for all
    /// Title of a logarithmic scale beside the plot; low and high are positive, cells sharp, of equal size on
    /// the axes as they are (equal ratios on logarithmic ones). Empty: no scale.
    std::string scale = {};
    std::vector<std::string> faults = {};  ///< with a scale: why a cell has no value ("blow-up"), else empty
    std::vector<double> xs, ys;            ///< with a scale: what the columns and rows stand for
};

/// A scheme that ended early: where, and why.
struct FailureMark {
    std::string label;
    int style = 0;
    double x = 0;      ///< time of the failure
    std::string text;  ///< "diverged at t = 0.31"
};

struct Figure {
    std::string view;      ///< "energy", "phase", ...
    std::string title;     ///< "Energy error"
    std::string subtitle;  ///< muted: "bounded: 3 of 4"
    Axis x, y;
    std::vector<Series> series;
    std::optional<HeatMap> heat;  ///< behind the series
    std::vector<FailureMark> failures;
    std::vector<Guide> guides;
    std::vector<Label> labels;
    bool hasTicks = true;                 ///< false: the axes are no scales
    std::optional<double> floor;          ///< round-off floor: a faint horizontal line
    std::optional<double> doubtfulBelow;  ///< values below are not resolved by the reference: a faint band
    std::string message;                  ///< why there is nothing to see, in place of the series; else empty
    bool hasEqualScales = false;          ///< trajectories in a plane: one unit is as long on both axes
    std::string summary;                  ///< one sentence for screen readers
};

/// The figure of one view of a comparison. The view must be one of viewCatalog() that is a plot (not
/// "stage"); anything else throws std::invalid_argument. All axes come with a range.
Figure makeFigure(const Comparison& comparison, const View& view);
/// The same for a system made before, or null: titles and units then come from the columns alone.
Figure makeFigure(const Comparison& comparison, const View& view, const System* system);

/// Views that this scene asks for and that are plots, in order; with defaults when the scene names none. A
/// trajectory that is not an orbit in a plane becomes one view per coordinate (up to three), as their units
/// differ.
std::vector<View> plotViews(const Scene& scene);

}  // namespace extremal
