// SPDX-License-Identifier: GPL-3.0-or-later
/// Figures made ready to stand beside each other: parts of a figure by scheme and by time, and portraits in
/// which no scheme hides another.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/figure/figure.hpp"

namespace extremal {

/// Whether curves or dots in a plane are shown, which can lie on top of each other for many turns: a phase
/// portrait, an orbit, a section. Not where x is the time, and not where both axes are logarithmic, as in
/// studies.
bool isPortrait(const Figure& figure);

/// The labels of the schemes that have curves, in the order in which they are drawn.
std::vector<std::string> schemesIn(const Figure& figure);

/// The layers of these schemes, and those that belong to none; without labels, all.
Figure withSchemes(const Figure& figure, std::span<const std::string> labels);

/// What happens from one time to another: on an axis of times its range, elsewhere the points of the curves
/// between these times, with both ends by straight lines between samples. The other axis keeps its range, so
/// that portraits of several windows of time can be compared. Curves that carry no times stay whole.
Figure withinTimes(const Figure& figure, double from, double to);

/// One panel per scheme of a portrait, each with the name of its scheme as title and "Phase portrait of NAME"
/// as summary, all with the ranges of the whole; the figure itself where there are fewer than two schemes.
std::vector<Figure> besideEachOther(const Figure& figure);

/// Where the curves of a portrait stay, in place of the curves: a map of the share of the time that they
/// spend in each of `cells` x `cells` equal cells of the plot, its scale in powers of ten. Between samples a
/// curve is straight and goes at an even pace; dots count alike. Not a number where no curve comes.
Figure densityOf(const Figure& figure, int cells = 80);

}  // namespace extremal
