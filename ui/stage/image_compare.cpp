#include "ui/stage/image_compare.hpp"

#include <QPainter>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "ui/shell/theme.hpp"

namespace extremal {
namespace {

std::vector<double> luminance(const QImage& image) {
    std::vector<double> y;
    y.reserve(static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()));
    for (int row = 0; row < image.height(); ++row) {
        const auto* line = reinterpret_cast<const QRgb*>(image.constScanLine(row));
        for (int x = 0; x < image.width(); ++x)
            y.push_back(0.299 * qRed(line[x]) + 0.587 * qGreen(line[x]) + 0.114 * qBlue(line[x]));
    }
    return y;
}

double windowSsim(const std::vector<double>& a, const std::vector<double>& b, int stride, int x0, int y0,
                  int w, int h) {
    double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
    for (int y = y0; y < y0 + h; ++y)
        for (int x = x0; x < x0 + w; ++x) {
            const auto i =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(stride) + static_cast<std::size_t>(x);
            sa += a[i];
            sb += b[i];
            saa += a[i] * a[i];
            sbb += b[i] * b[i];
            sab += a[i] * b[i];
        }
    const double n = w * h, c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
    const double ma = sa / n, mb = sb / n;
    const double va = saa / n - ma * ma, vb = sbb / n - mb * mb, cov = sab / n - ma * mb;
    return (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
}

double meanSsim(const QImage& actual, const QImage& expected) {
    const auto a = luminance(actual), b = luminance(expected);
    const int width = actual.width(), height = actual.height();
    const int w = std::min(8, width), h = std::min(8, height);
    double sum = 0;
    long long count = 0;
    for (int y = 0; y + h <= height; y += 4)
        for (int x = 0; x + w <= width; x += 4, ++count) sum += windowSsim(a, b, width, x, y, w, h);
    return count > 0 ? sum / static_cast<double>(count) : 1;
}

int channelDifference(QRgb a, QRgb b) {
    return std::max({std::abs(qRed(a) - qRed(b)), std::abs(qGreen(a) - qGreen(b)),
                     std::abs(qBlue(a) - qBlue(b)), std::abs(qAlpha(a) - qAlpha(b))});
}

}  // namespace

ImageDifference compareImages(const QImage& actual, const QImage& expected, int threshold) {
    ImageDifference result;
    result.hasSameSize = !actual.isNull() && actual.size() == expected.size();
    if (!result.hasSameSize) return result;
    const QImage a = actual.convertToFormat(QImage::Format_ARGB32);
    const QImage b = expected.convertToFormat(QImage::Format_ARGB32);
    result.picture = QImage(a.size(), QImage::Format_RGB32);
    result.largest = 0;
    long long differing = 0;
    for (int y = 0; y < a.height(); ++y) {
        const auto* la = reinterpret_cast<const QRgb*>(a.constScanLine(y));
        const auto* lb = reinterpret_cast<const QRgb*>(b.constScanLine(y));
        auto* out = reinterpret_cast<QRgb*>(result.picture.scanLine(y));
        for (int x = 0; x < a.width(); ++x) {
            const int difference = channelDifference(la[x], lb[x]);
            result.largest = std::max(result.largest, difference);
            const int faint = 200 + qGray(la[x]) * 55 / 255;
            out[x] = difference > threshold ? qRgb(220, 20, 40) : qRgb(faint, faint, faint);
            if (difference > threshold) ++differing;
        }
    }
    result.differingPercent =
        100.0 * static_cast<double>(differing) / (static_cast<double>(a.width()) * a.height());
    result.ssim = meanSsim(a, b);
    return result;
}

QImage sideBySide(const QImage& actual, const QImage& expected, const ImageDifference& difference) {
    const Theme theme = Theme::light();
    const int caption = 28, gap = 12;
    const QImage pictures[] = {actual, expected, difference.picture};
    const QString words[] = {QStringLiteral("actual"), QStringLiteral("expected"),
                             difference.hasSameSize
                                 ? QStringLiteral("difference: %1 % of the pixels, largest %2, SSIM %3")
                                       .arg(difference.differingPercent, 0, 'f', 3)
                                       .arg(difference.largest)
                                       .arg(difference.ssim, 0, 'f', 4)
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
