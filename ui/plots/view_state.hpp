// SPDX-License-Identifier: GPL-3.0-or-later
/// What part of a plot is visible: ranges fitted to the data, ranges the user chose, and the way back and
/// forward.
///
/// Once the user has zoomed or panned an axis, new data do not move it; fit() gives it back. All changes work
/// in axis space, the logarithm on logarithmic axes. Ranges stay finite, increasing and wide enough to be
/// drawn.
#pragma once

#include <array>
#include <vector>

namespace extremal {

struct PlotRange {
    double low = 0, high = 1;
    bool operator==(const PlotRange&) const = default;
};

enum class PlotAxis { x, y };

class ViewState {
public:
    void setLog(bool isXLog, bool isYLog) { isLog_ = {isXLog, isYLog}; }
    /// The range that fits the data; visible unless the user has chosen one.
    void setFitted(PlotAxis axis, PlotRange range);

    PlotRange range(PlotAxis axis) const;
    bool isLog(PlotAxis axis) const { return isLog_[index(axis)]; }
    bool isUserChosen(PlotAxis axis) const { return current_.isChosen[index(axis)]; }
    bool isUserChosen() const { return current_.isChosen[0] || current_.isChosen[1]; }

    /// Remembers the present view for back(). Call once before a gesture (a drag, a turn of the wheel).
    void remember();
    void zoom(PlotAxis axis, double factor,
              double anchor);  ///< factor < 1 goes closer; the anchor stays in its place
    void pan(PlotAxis axis, double fromValue, double toValue);  ///< what was at `from` is now at `to`
    void choose(PlotAxis axis, PlotRange range);
    void fit(PlotAxis axis) { current_.isChosen[index(axis)] = false; }
    void fit() { current_.isChosen = {false, false}; }
    bool back();     ///< false if there is no earlier view
    bool forward();  ///< undoes back(); false if the view was changed since
    void forget() {
        history_.clear();
        left_.clear();
    }

private:
    struct View {
        std::array<PlotRange, 2> chosen;
        std::array<bool, 2> isChosen = {false, false};
        bool operator==(const View&) const = default;
    };
    static std::size_t index(PlotAxis axis) { return axis == PlotAxis::x ? 0 : 1; }
    double toAxis(PlotAxis axis, double value) const;
    void chooseInAxisSpace(PlotAxis axis, double low, double high);

    std::array<bool, 2> isLog_ = {false, false};
    std::array<PlotRange, 2> fitted_;
    View current_;
    std::vector<View> history_;
    struct Left {
        View view, to;
    };
    std::vector<Left> left_;  ///< by back()
};

}  // namespace extremal
