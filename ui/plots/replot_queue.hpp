// SPDX-License-Identifier: GPL-3.0-or-later
/// Draws plots one per turn of the event loop: those of a window together would take longer than a user waits
/// for an answer.
#pragma once

class QCustomPlot;

namespace extremal {

/// Draws the plot soon, and once however often it is asked for until then. Plots are drawn in the order in
/// which they asked.
void queueReplot(QCustomPlot& plot);

}  // namespace extremal
