// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the ticks of an axis stand and what they say: as many as there is room for and at least three,
/// powers of ten with real superscripts, real minus signs.
#pragma once

#include <QFont>
#include <QSharedPointer>
#include <QString>

#include <string>
#include <utility>
#include <vector>

class QCPAxisTicker;

namespace extremal {

/// How long a horizontal axis is [pixels], 0: as long as its labels need, and how they are written.
struct LabelRoom {
    double length = 0;
    QFont font;
};

/// `room`: number of labels that fit on the axis, of usual length; of longer ones some are left out.
QSharedPointer<QCPAxisTicker> linearTicker(int room, const LabelRoom& labels = {});
QSharedPointer<QCPAxisTicker> logTicker(int room);

/// Words at their places, in place of numbers; one that is nearer than `least` to the last one shown is left
/// out.
QSharedPointer<QCPAxisTicker> namedTicker(const std::vector<std::pair<double, std::string>>& names,
                                          double least);

/// "10⁻²".
QString powerOfTen(int exponent);

/// A tick's value when the ticks are `step` apart: no more decimals than the step needs, "2.5×10⁻⁷" where
/// plain digits would be long.
QString tickText(double value, double step);

}  // namespace extremal
