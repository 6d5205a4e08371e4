// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/pictures/image_compare.hpp"

#include <QPainter>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "ui/base/theme.hpp"

namespace extremal {
namespace {

int channelDifference(QRgb a, QRgb b) {
    return std::max({std::abs(qRed(a) - qRed(b)), std::abs(qGreen(a) - qGreen(b)),
                     std::abs(qBlue(a) - qBlue(b)), std::abs(qAlpha(a) - qAlpha(b))});
}

/// Counts of differing pixels in blocks of 8 x 8 pixels; a tile is 2 x 2 blocks.
class Blocks {
public:
    explicit Blocks(QSize picture)
        : picture_(picture),
          columns_((picture.width() + side - 1) / side),
          rows_((picture.height() + side - 1) / side),
          counts_(static_cast<std::size_t>(columns_ + 1) * static_cast<std::size_t>(rows_ + 1)) {}

    void add(int x, int y) {
        ++counts_[place(x / side, y / side)];
        ++total_;
    }
    void summarise(ImageDifference& result) const {
        int most = 0;
        for (int row = 0; row < rows_; ++row)
            for (int column = 0; column < columns_; ++column) {
                const int count = counts_[place(column, row)] + counts_[place(column + 1, row)] +
                                  counts_[place(column, row + 1)] + counts_[place(column + 1, row + 1)];
                if (count <= most) continue;
                most = count;
                result.worstTile = QRect(column * side, row * side, 2 * side, 2 * side)
                                       .intersected(QRect(QPoint(0, 0), picture_));
            }
        const double all = static_cast<double>(picture_.width()) * picture_.height();
        result.differingPercent = 100.0 * static_cast<double>(total_) / all;
        result.worstTilePercent =
            100.0 * most / (std::min(2 * side, picture_.width()) * std::min(2 * side, picture_.height()));
    }

private:
    static constexpr int side = 8;
    /// One more row and column, which are empty, for the tiles at the edges.
    std::size_t place(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_ + 1) +
               static_cast<std::size_t>(column);
    }
    QSize picture_;
    int columns_, rows_;
    std::vector<int> counts_;
    long long total_ = 0;
};

}  // namespace

ImageDifference compareImages(const QImage& actual, const QImage& expected, int threshold) {
    ImageDifference result;
    result.hasSameSize = !actual.isNull() && actual.size() == expected.size();
    if (!result.hasSameSize) return result;
    const QImage a = actual.convertToFormat(QImage::Format_ARGB32);
    const QImage b = expected.convertToFormat(QImage::Format_ARGB32);
    result.picture = QImage(a.size(), QImage::Format_RGB32);
    result.largest = 0;
    Blocks blocks(a.size());
    for (int y = 0; y < a.height(); ++y) {
        const auto* la = reinterpret_cast<const QRgb*>(a.constScanLine(y));
        const auto* lb = reinterpret_cast<const QRgb*>(b.constScanLine(y));
        auto* out = reinterpret_cast<QRgb*>(result.picture.scanLine(y));
        for (int x = 0; x < a.width(); ++x) {
            const int difference = channelDifference(la[x], lb[x]);
            result.largest = std::max(result.largest, difference);
            const int faint = 200 + qGray(la[x]) * 55 / 255;
            out[x] = difference > threshold ? qRgb(220, 20, 40) : qRgb(faint, faint, faint);
            if (difference > threshold) blocks.add(x, y);
        }
    }
    blocks.summarise(result);
    return result;
}

QImage sideBySide(const QImage& actual, const QImage& expected, const ImageDifference& difference) {
    const Theme theme = Theme::light();
    const int caption = 28, gap = 12;
    const QImage pictures[] = {actual, expected, difference.picture};
    const QString words[] = {
        QStringLiteral("actual"), QStringLiteral("expected"),
        difference.hasSameSize
            ? QStringLiteral("difference: %1 % of the pixels, %2 % of the worst tile, largest %3")
                  .arg(difference.differingPercent, 0, 'f', 3)
                  .arg(difference.worstTilePercent, 0, 'f', 1)
                  .arg(difference.largest)
            : QStringLiteral("the sizes differ: %1x%2 and %3x%4")
                  .arg(actual.width())
                  .arg(actual.height())
                  .arg(expected.width())
                  .arg(expected.height())};
    int width = gap, height = 0;
    for (const QImage& p : pictures) {
        width += std::max(p.width(), 320) + gap;
        height = std::max(height, p.height());
    }
    QImage page(width, height + caption + gap, QImage::Format_RGB32);
    page.fill(theme.window);
    QPainter painter(&page);
    painter.setFont(theme.caption());
    painter.setPen(theme.text);
    int x = gap;
    for (std::size_t i = 0; i < 3; ++i) {
        painter.drawText(QPointF(x, 19), words[i]);
        QImage plain = pictures[i];
        plain.setDevicePixelRatio(1);
        painter.drawImage(x, caption, plain);
        x += std::max(plain.width(), 320) + gap;
    }
    return page;
}

}  // namespace extremal
