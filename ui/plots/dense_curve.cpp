// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/dense_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace extremal {
namespace {

constexpr int fine = 2;  // places per device pixel along each axis

/// What a round pen has covered, on a grid finer than the pixels.
class Covered {
public:
    Covered(int width, int height, double penWidth)
        : width_(width),
          height_(height),
          places_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
        const double reach = std::max(0.5, penWidth / 2);
        const int most = static_cast<int>(std::ceil(reach));
        for (int row = -most; row <= most; ++row) {
            const double half = reach * reach - row * row;
            if (half >= 0) pen_.push_back({row, static_cast<int>(std::lround(std::sqrt(half)))});
        }
    }
    void line(QPointF a, QPointF b) {
        const QPointF d = b - a;
        const int steps =
            std::max(1, static_cast<int>(std::ceil(std::max(std::abs(d.x()), std::abs(d.y())))));
        const QPointF step = d / steps;
        for (int k = 0; k <= steps; ++k) {
            const QPointF p = a + step * k;
            dot(static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())));
        }
    }
    unsigned char at(int column, int row) const {
        return places_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                       static_cast<std::size_t>(column)];
    }

private:
    enum Place : unsigned char { empty = 0, covered = 1, centre = 2 };
    struct Span {
        int row, half;
    };
    void dot(int column, int row) {
        const bool isInside = column >= 0 && row >= 0 && column < width_ && row < height_;
        unsigned char* const here =
            isInside ? &places_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                                static_cast<std::size_t>(column)]
                     : nullptr;
        if (here && *here == centre) return;  // the pen has been here
        for (const Span& span : pen_) {
            const int at = row + span.row;
            if (at < 0 || at >= height_) continue;
            const int from = std::max(0, column - span.half), to = std::min(width_ - 1, column + span.half);
            unsigned char* const line =
                places_.data() + static_cast<std::size_t>(at) * static_cast<std::size_t>(width_);
            for (int c = from; c <= to; ++c) line[c] = std::max<unsigned char>(line[c], covered);
        }
        if (here) *here = centre;
    }

    int width_, height_;
    std::vector<unsigned char> places_;
    std::vector<Span> pen_;
};

}  // namespace

QImage denseImage(const std::vector<QPolygonF>& lines, const PixelMap& map, const QColor& color, double width,
                  double density) {
    const int columns = static_cast<int>(std::ceil((map.rect.width() + 1) * density)),
              rows = static_cast<int>(std::ceil((map.rect.height() + 1) * density));
    const double scale = fine * density;
    Covered covered(fine * columns, fine * rows, width * scale);
    const QPointF origin = map.rect.topLeft();
    for (const QPolygonF& line : lines)
        for (qsizetype i = 1; i < line.size(); ++i)
            covered.line((line[i - 1] - origin) * scale, (line[i] - origin) * scale);
    // The colour by how many places of a pixel are covered, alpha premultiplied.
    std::array<QRgb, fine * fine + 1> shades{};
    for (std::size_t n = 0; n < shades.size(); ++n) {
        QColor shade = color;
        shade.setAlphaF(static_cast<float>(color.alphaF() * static_cast<double>(n) / (fine * fine)));
        shades[n] = qPremultiply(shade.rgba());
    }
    QImage image(columns, rows, QImage::Format_ARGB32_Premultiplied);
    for (int row = 0; row < rows; ++row) {
        auto* out = reinterpret_cast<QRgb*>(image.scanLine(row));
        for (int column = 0; column < columns; ++column) {
            std::size_t n = 0;
            for (int r = 0; r < fine; ++r)
                for (int c = 0; c < fine; ++c)
                    n += covered.at(fine * column + c, fine * row + r) != 0 ? 1 : 0;
            out[column] = shades[n];
        }
    }
    image.setDevicePixelRatio(density);
    return image;
}

}  // namespace extremal
