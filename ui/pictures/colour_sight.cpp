// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/pictures/colour_sight.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace extremal {
namespace {

using Rgb3 = std::array<double, 3>;
using Matrix3 = std::array<Rgb3, 3>;

constexpr Matrix3 luminance{{{0.2126, 0.7152, 0.0722}, {0.2126, 0.7152, 0.0722}, {0.2126, 0.7152, 0.0722}}};
constexpr Matrix3 protanopia{
    {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}};
constexpr Matrix3 deuteranopia{
    {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}};
constexpr Matrix3 tritanopia{
    {{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}};

const Matrix3& matrixOf(Sight sight) {
    switch (sight) {
        case Sight::withoutRed:
            return protanopia;
        case Sight::withoutGreen:
            return deuteranopia;
        case Sight::withoutBlue:
            return tritanopia;
        default:
            return luminance;
    }
}

double linearOf(double shown) {
    return shown <= 0.04045 ? shown / 12.92 : std::pow((shown + 0.055) / 1.055, 2.4);
}

int byteOf(double linear) {
    const double x = std::clamp(linear, 0.0, 1.0);
    return static_cast<int>(
        std::lround(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055)));
}

QRgb seen(const Matrix3& m, QRgb pixel) {
    static const std::array<double, 256> linear = [] {
        std::array<double, 256> all{};
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = linearOf(static_cast<double>(i) / 255);
        return all;
    }();
    const auto at = [](int byte) { return linear[static_cast<std::size_t>(byte)]; };
    const Rgb3 c{at(qRed(pixel)), at(qGreen(pixel)), at(qBlue(pixel))};
    const auto channel = [&](const Rgb3& row) {
        return byteOf(row[0] * c[0] + row[1] * c[1] + row[2] * c[2]);
    };
    return qRgba(channel(m[0]), channel(m[1]), channel(m[2]), qAlpha(pixel));
}

}  // namespace

QColor seenBy(Sight sight, const QColor& colour) {
    return sight == Sight::all ? colour : QColor(seen(matrixOf(sight), colour.rgb()));
}

QImage seenBy(Sight sight, const QImage& picture) {
    if (sight == Sight::all) return picture;
    const Matrix3& m = matrixOf(sight);
    QImage image = picture.convertToFormat(QImage::Format_RGB32);
    QRgb last = 0, lastSeen = seen(m, 0);  // neighbours are mostly alike
    for (int y = 0; y < image.height(); ++y) {
        auto* const line = reinterpret_cast<QRgb*>(image.scanLine(y));
        for (int x = 0; x < image.width(); ++x) {
            if (line[x] != last) {
                last = line[x];
                lastSeen = seen(m, last);
            }
            line[x] = lastSeen;
        }
    }
    return image;
}

}  // namespace extremal
