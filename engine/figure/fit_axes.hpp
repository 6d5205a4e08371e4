// SPDX-License-Identifier: GPL-3.0-or-later
/// The ranges of a figure's axes: the part that the view asks for, else what is there.
#pragma once

#include "engine/figure/figure.hpp"

namespace extremal {

/// Gives both axes a range. Where the view asks for a part of x alone, y is fitted to what that part shows.
/// The curve of the view, if it has one, becomes a series of its own. Call it after the failures are marked.
void fitAxes(Figure& figure, const View& view, const std::string& variable);

/// The curve of a view between two places, as a series of style `formulaStyle`. Points are added until the
/// largest distance of a chord from the curve is a hundredth of the curve's height, up to 64000; the label
/// says if that was not enough. The points are equally spaced on the axis, which may be logarithmic.
Series formulaSeries(const ViewCurve& curve, const std::string& variable, double low, double high,
                     bool isLog = false);

}  // namespace extremal
