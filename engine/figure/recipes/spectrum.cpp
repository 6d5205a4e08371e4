// SPDX-License-Identifier: GPL-3.0-or-later
/// The size of each Fourier coefficient of the wave function at the end, with a Dirichlet boundary of each
/// Chebyshev coefficient, on a logarithmic axis: is N enough? Over a rectangle the largest with each wave
/// number along x, and with each along y.
#include <algorithm>
#include <cmath>

#include "engine/figure/build.hpp"
#include "engine/model/wave/spectrum.hpp"

namespace extremal::recipes {
namespace {

/// Those of the last picture.
std::vector<Complex> coefficientsOf(const SchemeResult& scheme, const Hamiltonian& h) {
    const auto n = static_cast<std::size_t>(h.size());
    const auto& values = *framesOf(scheme)->back().values;
    std::vector<Complex> psi(n), c(n);
    for (std::size_t j = 0; j < n; ++j) psi[j] = {values[j], values[n + j]};
    h.toCoefficients(psi.data(), c.data());
    return c;
}

/// The largest coefficient with each wave number along x, or along y.
Series largestAlong(const SchemeResult& scheme, const Hamiltonian& h, const std::vector<Complex>& c,
                    bool isAlongY) {
    const int modes = isAlongY ? h.grid().ny : h.grid().nx;
    Series s;
    s.label = scheme.spec.label;
    s.style = scheme.style;
    s.part = isAlongY ? "along y" : "along x";
    if (isAlongY) s.tone = Tone::pale;
    s.y.assign(static_cast<std::size_t>(modes), 0);
    for (int a = -modes / 2; a < modes / 2; ++a) s.x.push_back(a);
    for (int i = 0; i < h.size(); ++i) {
        const int number = isAlongY ? h.fourier().numberY(i) : h.fourier().number(i);
        double& most = s.y[static_cast<std::size_t>(number + modes / 2)];
        most = std::max(most, std::abs(c[static_cast<std::size_t>(i)]));
    }
    return s;
}

Series spectrumOf(const SchemeResult& scheme, const Hamiltonian& h) {
    const std::vector<Complex> c = coefficientsOf(scheme, h);
    const std::size_t n = c.size();
    Series s;
    s.label = scheme.spec.label;
    s.style = scheme.style;
    for (int k = 0; !h.isPeriodic() && k <= h.size() + 1; ++k) {
        s.x.push_back(k);
        s.y.push_back(std::abs(chebyshevCoefficient(h, c.data(), k)));
    }
    for (std::size_t a = 0; h.isPeriodic() && a < n; ++a) {
        const auto i = static_cast<int>((a + n / 2) % n);
        s.x.push_back(h.fourier().number(i));
        s.y.push_back(std::abs(c[static_cast<std::size_t>(i)]));
    }
    return s;
}

Figure makeSpectrum(const FigureContext& context) {
    Figure figure = startFigure(context, "Spectrum");
    figure.x.title = "wave number";
    figure.y = logAxis("|c|");
    for (const auto& scheme : context.comparison.schemes)
        if (context.system && isWave(*context.system) && framesOf(*scheme)) {
            const Hamiltonian& h = *context.system->hamiltonian();
            if (h.dimension() == 1) {
                figure.add(spectrumOf(*scheme, h));
                continue;
            }
            const std::vector<Complex> c = coefficientsOf(*scheme, h);
            for (const bool isAlongY : {false, true}) figure.add(largestAlong(*scheme, h, c, isAlongY));
            figure.subtitle = "the largest along x; along y pale";
        }
    figure.put(RoundOffFloor{0x1p-52});
    if (context.system && isWave(*context.system)) {
        const wave::Grid& grid = context.system->hamiltonian()->grid();
        const double half =
            (context.system->hamiltonian()->dimension() == 2 ? std::max(grid.nx, grid.ny) : grid.nx) / 2.0;
        figure.x.range = {-half, half};
        if (!context.system->hamiltonian()->isPeriodic()) {
            figure.x.title = "degree";
            figure.x.range = {0, 2 * half + 1};
        }
    } else if (context.system) {
        figure.message = "The model is not a wave function";
    }
    finishFigure(figure, context, "Size of the coefficients at the end");
    return figure;
}

}  // namespace

RecipeEntry spectrum() { return {"spectrum", makeSpectrum}; }

}  // namespace extremal::recipes
