/// The size of each Fourier coefficient of the wave function at the end, between walls of each Chebyshev coefficient, on a
/// logarithmic axis: is N enough?
#include <algorithm>
#include <cmath>

#include "engine/figure/build.hpp"
#include "engine/wave/spectrum.hpp"

namespace extremal::views {
namespace {

Series spectrumOf(const SchemeResult& scheme, const Hamiltonian& h) {
    const auto n = static_cast<std::size_t>(h.size());
    const auto& values = *scheme.frames.back().values;
    std::vector<Complex> psi(n), c(n);
    for (std::size_t j = 0; j < n; ++j) psi[j] = {values[j], values[n + j]};
    h.toCoefficients(psi.data(), c.data());
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
        if (context.system && context.system->hasWave() && !scheme->frames.empty())
            figure.series.push_back(spectrumOf(*scheme, *context.system->wave));
    figure.floor = 0x1p-52;
    if (context.system && context.system->hasWave()) {
        const double half = context.system->wave->size() / 2.0;
        figure.x.range = {-half, half};
        if (!context.system->wave->isPeriodic()) {
            figure.x.title = "degree";
            figure.x.range = {0, 2 * half + 1};
        }
    } else if (context.system) {
        figure.message = "The model is no wave function";
    }
    finishFigure(figure, context, "Size of the coefficients at the end");
    return figure;
}

}  // namespace

ViewEntry spectrum() {
    return {{"spectrum", "Spectrum", "size of the Fourier or Chebyshev coefficients of the wave function at the end, logarithmic", {}, {}, {}},
            "", makeSpectrum, nullptr, {true, false, true}};
}

}  // namespace extremal::views
