// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/model/wave/wave_system.hpp"

namespace extremal {
namespace {

/// |psi| over x as a curtain with the phase as its colour, above the potential. A wave spread over the whole
/// domain stands a tenth of it high.
void drawOnInterval(const Hamiltonian& h, const double* values, Drawing& drawing) {
    const auto n = static_cast<std::size_t>(h.size());
    const double L = h.domain().length, left = h.domain().left, unit = 0.1 * L * std::sqrt(L);
    const auto& V = h.potential();
    const auto [low, high] = std::minmax_element(V.begin(), V.end());
    // A periodic domain is closed by the first node.
    const auto place = [&](std::size_t j) { return j < n ? h.x()[j] : left + L; };
    if (*high > *low) {
        const std::size_t every = std::max<std::size_t>(1, n / 256), last = h.isPeriodic() ? n : n - 1;
        const auto at = [&, from = *low, range = *high - *low](std::size_t j) {
            return Point{place(j), 0.3 * L * (V[j % n] - from) / range, 0};
        };
        for (std::size_t j = 0; j + every <= last; j += every)
            drawing.shapes.push_back(Segment{at(j), at(j + every), 1.2, ShapeRole::scenery});
    }
    drawing.shapes.push_back(Segment{{left, 0, 0}, {left + L, 0, 0}, 1.2, ShapeRole::scenery});
    if (!h.isPeriodic())
        for (const double end : {left, left + L})
            drawing.shapes.push_back(Segment{{end, 0, 0}, {end, 0.3 * L, 0}, 2, ShapeRole::scenery});
    Curtain curtain;
    const auto add = [&](double x, double re, double im) {
        curtain.top.push_back({x, unit * std::hypot(re, im), 0});
        curtain.hues.push_back(std::atan2(im, re) / (2 * std::numbers::pi));
    };
    if (h.isPeriodic()) {
        for (std::size_t j = 0; j <= n; ++j) add(place(j), values[j % n], values[n + j % n]);
    } else {
        const EvenSamples even = evenSamples(h, values, 256);
        for (std::size_t j = 0; j < even.x.size(); ++j) add(even.x[j], even.re[j], even.im[j]);
    }
    drawing.shapes.push_back(std::move(curtain));
}

/// A picture of at most this many points along a side, of all nodes and once more the first, which closes the
/// domain.
constexpr int mostPoints = 129;

template <class At>
Raster rasterOf(const wave::Grid& grid, At&& at) {
    Raster raster;
    raster.corner = {grid.x.left, grid.y.left, 0};
    raster.width = grid.x.length;
    raster.height = grid.y.length;
    const auto pointsOf = [](int n) {
        int points = n;
        while (points + 1 > mostPoints && points % 2 == 0) points /= 2;
        return points + 1;
    };
    raster.columns = pointsOf(grid.nx);
    raster.rows = pointsOf(grid.ny);
    const int everyX = grid.nx / (raster.columns - 1), everyY = grid.ny / (raster.rows - 1);
    for (int j = 0; j < raster.rows; ++j)
        for (int i = 0; i < raster.columns; ++i)
            at(raster, static_cast<std::size_t>(i * everyX % grid.nx + j * everyY % grid.ny * grid.nx));
    return raster;
}

/// |psi| as how strong a colour is, the phase as its hue, over the potential in grey: each as strong as it
/// can be where it is largest.
void drawOnRectangle(const Hamiltonian& h, const double* values, Drawing& drawing) {
    const wave::Grid& grid = h.grid();
    const auto n = static_cast<std::size_t>(h.size());
    drawing.tracer = {grid.x.left + grid.x.length / 2, grid.y.left + grid.y.length / 2, 0};
    if (drawing.isTracerOnly) return;
    const auto& V = h.potential();
    const auto [low, high] = std::minmax_element(V.begin(), V.end());
    if (*high > *low) {
        Raster ground = rasterOf(grid, [&, from = *low, range = *high - *low](Raster& r, std::size_t j) {
            r.strengths.push_back(0.4 * (V[j] - from) / range);
        });
        ground.role = ShapeRole::scenery;
        drawing.shapes.push_back(std::move(ground));
    }
    double largest = 0;
    for (std::size_t j = 0; j < n; ++j) largest = std::max(largest, std::hypot(values[j], values[n + j]));
    const double unit = largest > 0 ? 1 / largest : 0;
    drawing.shapes.push_back(rasterOf(grid, [&](Raster& r, std::size_t j) {
        r.strengths.push_back(unit * std::hypot(values[j], values[n + j]));
        r.hues.push_back(std::atan2(values[n + j], values[j]) / (2 * std::numbers::pi));
    }));
    const Point a = {grid.x.left, grid.y.left, 0}, c = {a[0] + grid.x.length, a[1] + grid.y.length, 0},
                b = {c[0], a[1], 0}, d = {a[0], c[1], 0};
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, d}, std::pair{d, a}})
        drawing.shapes.push_back(Segment{from, to, 1.2, ShapeRole::scenery});
}

}  // namespace

void drawWave(const Hamiltonian& h, const double* values, Drawing& drawing) {
    if (h.dimension() == 2)
        drawOnRectangle(h, values, drawing);
    else
        drawOnInterval(h, values, drawing);
}

}  // namespace extremal
