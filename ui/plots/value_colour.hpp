// SPDX-License-Identifier: GPL-3.0-or-later
/// The colours of a scale of values (engine/figure/image/palette.hpp) for painters.
#pragma once

#include <QColor>

#include "engine/figure/image/palette.hpp"

namespace extremal {

/// `part` from 0 to 1.
inline QColor valueColour(double part) {
    const auto shown = valueColours(part);
    return QColor::fromRgbF(static_cast<float>(shown[0]), static_cast<float>(shown[1]),
                            static_cast<float>(shown[2]));
}

}  // namespace extremal
