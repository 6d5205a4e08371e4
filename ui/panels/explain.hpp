// SPDX-License-Identifier: GPL-3.0-or-later
/// What the numbers of a scheme's row and of the table at the cursor are: how they are measured, in which
/// unit, against what, and how far they can be trusted. Plain text of some lines.
#pragma once

#include <QString>

#include "engine/figure/figure.hpp"
#include "engine/run/comparison.hpp"

class QTableWidget;

namespace extremal {

QString explainCost(const Summary& summary);
/// `unit`: of the error; empty: it has none.
QString explainError(const Summary& summary, const ReferenceInfo& reference, const std::string& unit);
QString explainOrder(const Summary& summary);
/// `areElements`: of a boundary problem, which is solved at once.
QString explainSteps(const Summary& summary, bool areElements);
/// A value of a plot at time t.
QString explainValue(const Figure& figure, const QString& scheme, double t);

/// A click on a cell shows its tip at once, and for long enough to be read.
void explainCellsOf(QTableWidget& table);

}  // namespace extremal
