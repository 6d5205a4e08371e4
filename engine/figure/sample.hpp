// SPDX-License-Identifier: GPL-3.0-or-later
/// Reading a figure: values at a time, and its data as CSV.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "engine/figure/figure.hpp"

namespace extremal {

/// The point of a series at a time (by its own t, where x is not the time), between the two neighbouring
/// samples by straight line (the nearer one where they are sparse); empty outside the samples, at a gap, or
/// if the series has no time.
std::optional<std::pair<double, double>> pointAt(const Series& series, double t);

/// A cell of a heat map with a scale: its place, what it stands for, and that with its value in words, two
/// lines.
struct HeatCell {
    std::size_t column, row;
    double x, y;
    std::string text;
};
/// The cell at a place of the plot; empty outside, and where there is no such map.
std::optional<HeatCell> cellAt(const Figure& figure, double x, double y);

/// "Gauss 4", or "Gauss 4, Re ψ" where a scheme has several curves.
std::string seriesName(const Series& series);

/// "scheme,X,Y" with the axes' titles as headers, then one row per point, in the order of the series; a gap
/// is an empty cell. Of a heat map with a scale "X,Y,VALUE,outcome", one row per cell. With `isVisibleOnly`
/// only points inside the axes' ranges. Quoting as in RFC 4180, lines end in LF.
std::string figureCsv(const Figure& figure, bool isVisibleOnly);

}  // namespace extremal
