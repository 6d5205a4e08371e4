// SPDX-License-Identifier: GPL-3.0-or-later
/// Small discs, painted ten thousand times: a fifth of what as many antialiased ellipses cost. Pictures of
/// the disc at four places within a pixel are made once and copied.
#pragma once

#include <QColor>
#include <QPixmap>

#include <array>

class QPainter;

namespace extremal {

class DotStamp {
public:
    /// `ratio`: device pixels per pixel of the painter.
    DotStamp(const QColor& color, double radius, double ratio);
    /// On a painter that is not transformed; the centre is rounded to half a device pixel.
    void draw(QPainter& painter, const QPointF& centre) const;

private:
    static constexpr int places = 2;  // in each direction
    std::array<QPixmap, places * places> pictures_;
    double ratio_;
    int half_;  // device pixels from the pixel of the centre to the edge of the pictures
};

}  // namespace extremal
