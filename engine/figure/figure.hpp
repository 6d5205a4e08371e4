// SPDX-License-Identifier: GPL-3.0-or-later
/// A plot as data: what the window, the snapshots, the exports and the tests share. No Qt here.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/figure/layer_range.hpp"
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

/// The styles of curves that belong to no scheme: a thin dashed neutral line, and a solid one.
inline constexpr int formulaStyle = -1, exactStyle = -2;

/// How the points of a series are drawn.
enum class SeriesKind {
    line,         ///< y over x, which is monotone
    markedLine,   ///< with a dot at every value
    curve,        ///< parametric: x is not monotone (phase portrait)
    markedCurve,  ///< parametric, with a dot at every value
    marks,        ///< dots alone
    cells,        ///< a unit square around every point
    ticks,        ///< a short vertical stroke at every point, x monotone
};
constexpr bool hasLine(SeriesKind kind) {
    return kind != SeriesKind::marks && kind != SeriesKind::cells && kind != SeriesKind::ticks;
}
constexpr bool hasMarks(SeriesKind kind) {
    return kind == SeriesKind::markedLine || kind == SeriesKind::markedCurve || kind == SeriesKind::marks;
}
constexpr bool isParametric(SeriesKind kind) {
    return kind == SeriesKind::curve || kind == SeriesKind::markedCurve;
}

/// Pale: of what has less weight than another layer of the same colour.
enum class Tone { full, pale };

/// A curve at several times.
struct MovingCurve {
    struct Moment {
        double t = 0;
        std::vector<double> x, y;
    };
    std::vector<Moment> moments;  ///< in the order of time
    /// The last one that is not later; the first before all of them.
    const Moment& at(double t) const;
};

/// The data of a scheme, or of a formula.
struct Series {
    std::string label;      ///< the scheme's label
    std::string part = {};  ///< of several curves of one scheme, which: "Re ψ"
    Tone tone = Tone::full;
    int style = 0;  ///< colour and dash of the scheme
    SeriesKind kind = SeriesKind::line;
    std::vector<double> x, y;  ///< NaN is a gap
    std::vector<double>
        t;  ///< of the points, where x is not the time: a cursor in time finds its place; else empty
    /// The samples are too far apart to be joined: between them the curve turns in a way that they do not
    /// tell.
    bool isSparse = false;
    int hidden = 0;                      ///< values a log axis cannot show (<= 0) or that are not finite
    std::vector<std::size_t> rows = {};  ///< of a study: which of its rows each point is; else empty
    /// Its place on the figure's ColourScale, from 0 to 1, which then gives its colour; empty: that of its
    /// style.
    std::optional<double> shade = {};
    /// Of a curve that moves: x and y are its last moment.
    std::shared_ptr<const MovingCurve> moving = {};
};

/// What the shades of series stand for: a linear scale beside the plot.
struct ColourScale {
    std::string title;
    double low = 0, high = 1;
};

/// A faint line behind the series: a contour, an outline.
struct Guide {
    std::vector<double> x, y;  ///< NaN is a gap
    bool isStrong = false;
    bool isBroad = false;  ///< a band of some width: what stands out
};

/// A faint area in the colour of a scheme: what its curve may be as well. A closed polygon.
struct Area {
    std::string label;  ///< the scheme's
    int style = 0;
    std::vector<double> x, y;
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
    /// With a scale: what there is to say of a cell beside its value ("drifting"), or why it has none
    /// ("blow-up"); else empty.
    std::vector<std::string> faults = {};
    std::vector<double> xs, ys;  ///< with a scale: what the columns and rows stand for
};

/// A scheme that ended early: where, and why.
struct FailureMark {
    std::string label;
    int style = 0;
    double x = 0;      ///< time of the failure
    std::string text;  ///< "diverged at t = 0.31"
};

/// Steps of a scheme in which something happened besides: a mark at the node where each ended.
struct EventMarks {
    std::string label;
    int style = 0;
    std::string text;          ///< "energy unsolvable: 18 of 600 steps"
    std::vector<double> x, y;  ///< y not a number: at the lower edge
};

/// A faint horizontal line: what round-off alone would give.
struct RoundOffFloor {
    double y = 0;
};

/// A faint band from below up to `top`: values that the reference does not resolve.
struct DoubtfulBand {
    double top = 0;
};

using Layer = std::variant<Series, HeatMap, FailureMark, EventMarks, Guide, Area, Label, RoundOffFloor,
                           DoubtfulBand, ColourScale>;

enum class Aspect {
    free,
    equal,  ///< one unit is as long on both axes: trajectories in a plane
};
enum class AxisStyle {
    scales,
    none,  ///< the axes are not scales
};

/// One panel: axes, and layers. A view of several panels is several figures, which the window links by their
/// time axes. What is drawn behind what follows from the kind of a layer; among layers of one kind, the later
/// ones are in front.
struct Figure {
    std::string view;      ///< "energy", "phase", ...
    std::string title;     ///< "Energy error"
    std::string subtitle;  ///< muted: "no drift: 3 of 4"
    Axis x, y;
    Aspect aspect = Aspect::free;
    AxisStyle axes = AxisStyle::scales;
    std::vector<Layer> layers;
    std::string message;  ///< why there is nothing to see, in place of the series; else empty
    std::string summary;  ///< one sentence for screen readers

    void add(Layer layer) { layers.push_back(std::move(layer)); }
    /// The layers of one kind, in their order.
    template <class L>
    LayerRange<L, Layer> all() {
        return {layers.data(), layers.data() + layers.size()};
    }
    template <class L>
    LayerRange<const L, const Layer> all() const {
        return {layers.data(), layers.data() + layers.size()};
    }
    /// The first layer of a kind, or null.
    template <class L>
    const L* find() const {
        for (const Layer& layer : layers)
            if (const L* found = std::get_if<L>(&layer)) return found;
        return nullptr;
    }
    template <class L>
    void drop() {
        std::erase_if(layers, [](const Layer& layer) { return std::holds_alternative<L>(layer); });
    }
    /// The only layer of its kind.
    template <class L>
    void put(L layer) {
        drop<L>();
        add(std::move(layer));
    }

    auto series() { return all<Series>(); }
    auto series() const { return all<Series>(); }
    const HeatMap* heat() const { return find<HeatMap>(); }
    HeatMap* heat() { return all<HeatMap>().empty() ? nullptr : &all<HeatMap>().front(); }
};

/// Height of the round-off floor; 0 if there is none.
inline double floorOf(const Figure& figure) {
    const RoundOffFloor* floor = figure.find<RoundOffFloor>();
    return floor ? floor->y : 0;
}

/// The figure of one view of a comparison. The view must be one of viewCatalog() that is a plot (not
/// "stage"); anything else throws std::invalid_argument. All axes come with a range.
Figure makeFigure(const Comparison& comparison, const View& view);
/// The same for a system made before, or null: titles and units then come from the columns alone.
Figure makeFigure(const Comparison& comparison, const View& view, const System* system);

/// Whether its axis y can be logarithmic, or linear: not where y has named places or a map is drawn, and
/// logarithmic only where something is positive.
bool canHaveScale(const Figure& figure, bool isLog);

/// Whether there is no data in it, but a message at most.
bool isEmpty(const Figure& figure);

/// Views that this scene asks for and that are plots, in order; with defaults when the scene names none. A
/// trajectory that is not an orbit in a plane becomes one view per coordinate (up to three), as their units
/// differ.
std::vector<View> plotViews(const Scene& scene);

}  // namespace extremal
