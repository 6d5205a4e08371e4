/// Titles of axes with lowered parts: "p_theta" is p with theta below the line, up to the end of the word.
#pragma once

#include <QString>

class QCPPainter;
class QCPAxis;

namespace extremal {

/// The title without its marks, as wide as it is drawn or wider.
QString plainTitle(const QString& title);
/// Whether parts of it are lowered.
bool hasLoweredPart(const QString& title);
/// Draws a title where the axis would draw its label.
void drawAxisTitle(QCPPainter& painter, const QCPAxis& axis, const QString& title);

}  // namespace extremal
