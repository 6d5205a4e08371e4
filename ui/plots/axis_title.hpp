// SPDX-License-Identifier: GPL-3.0-or-later
/// Titles of axes with lowered and raised parts and norms: "p_theta" is p with theta below the line, up to
/// the end of the word, "x^(1/2)" is x with 1/2 above it; the bars of a norm are thin lines, as bold ones run
/// together.
#pragma once

#include <QString>

class QCPPainter;
class QCPAxis;
class QFont;
class QPainter;
class QPointF;

namespace extremal {

/// The title without its marks, as wide as it is drawn or wider.
QString plainTitle(const QString& title);
/// Whether parts of it are lowered or raised, or bars of a norm: then it is drawn by the functions below.
bool hasOwnParts(const QString& title);
/// In the painter's colour, from this point of the baseline on.
void drawTitle(QPainter& painter, const QFont& font, QPointF at, const QString& title);
/// Draws a title where the axis would draw its label.
void drawAxisTitle(QCPPainter& painter, const QCPAxis& axis, const QString& title);

}  // namespace extremal
