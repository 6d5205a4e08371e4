// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/algebra/line_fit.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {

double RunningLine::scatter() const {
    return n_ > 2 && xx_ > 0 ? std::sqrt(std::max(0.0, yy_ - slope() * xy_) / (n_ - 2)) : LineFit::unknown;
}

LineFit lineThrough(std::span<const double> x, std::span<const double> y) {
    double n = 0, mx = 0, my = 0, xx = 0, xy = 0, yy = 0;
    const auto forAll = [&](const auto& work) {
        for (std::size_t i = 0; i < x.size(); ++i)
            if (std::isfinite(y[i])) work(x[i], y[i]);
    };
    forAll([&](double a, double b) { n += 1, mx += a, my += b; });
    if (n < 2) return {};
    mx /= n;
    my /= n;
    forAll([&](double a, double b) {
        xx += (a - mx) * (a - mx);
        xy += (a - mx) * (b - my);
        yy += (b - my) * (b - my);
    });
    if (!(xx > 0)) return {};
    LineFit line;
    line.slope = xy / xx;
    line.constant = my - line.slope * mx;
    line.r2 = yy > 0 ? xy * xy / (xx * yy) : 0;
    line.worst = 0;
    forAll([&](double a, double b) {
        line.worst = std::max(line.worst, std::abs(b - line.constant - line.slope * a));
    });
    return line;
}

}  // namespace extremal
