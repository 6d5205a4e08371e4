// SPDX-License-Identifier: GPL-3.0-or-later
/// Text on a plot: small, or in a rounded box. Only for the sources of ui/plots: it includes QCustomPlot.
#pragma once

#include <qcustomplot.h>

#include "ui/base/theme.hpp"

namespace extremal {

QFont small(const Theme& theme, QFont::Weight weight = QFont::Normal);

/// A rounded box with lines of text; returns its rectangle.
QRectF drawPill(QCPPainter& painter, QPointF topLeft, const QString& text, const QFont& font,
                const QColor& ground, const QColor& line, const QColor& color);

}  // namespace extremal
