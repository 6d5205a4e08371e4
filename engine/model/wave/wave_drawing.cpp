// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/model/plane_picture.hpp"
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
    const auto density = [values, n](std::size_t j) {
        return values[j] * values[j] + values[n + j] * values[n + j];
    };
    double largest = 0;
    for (std::size_t j = 0; j < n; ++j) largest = std::max(largest, density(j));
    const double unit = largest > 0 ? 1 / largest : 0;
    drawing.shapes.push_back(rasterOf(grid, [&](Raster& r, std::size_t j) {
        r.strengths.push_back(std::sqrt(unit * density(j)));
        // a hue needs no more than single precision
        const float angle = std::atan2(static_cast<float>(values[n + j]), static_cast<float>(values[j]));
        r.hues.push_back(static_cast<double>(angle) / (2 * std::numbers::pi));
    }));
    addFrame(grid, drawing);
}

}  // namespace

void drawWave(const Hamiltonian& h, const double* values, Drawing& drawing) {
    if (h.dimension() == 2)
        drawOnRectangle(h, values, drawing);
    else
        drawOnInterval(h, values, drawing);
}

}  // namespace extremal
