// SPDX-License-Identifier: GPL-3.0-or-later
/// How colours look to others: on a printer without colours, and to people who lack one kind of cones. Of the
/// models of Machado, Oliveira and Fernandes (IEEE Transactions on Visualization and Computer Graphics 15,
/// 2009, table 1), those of full severity, which act on linear red, green and blue.
#pragma once

#include <QColor>
#include <QImage>

namespace extremal {

enum class Sight {
    all,           ///< as it is
    grey,          ///< by relative luminance
    withoutRed,    ///< protanopia
    withoutGreen,  ///< deuteranopia, the most frequent one
    withoutBlue,   ///< tritanopia
};

QColor seenBy(Sight sight, const QColor& colour);
QImage seenBy(Sight sight, const QImage& picture);

}  // namespace extremal
