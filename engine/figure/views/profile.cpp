/// A field over space at the last time of each scheme; of wave functions the modulus, and of the first scheme the parts too.
#include <algorithm>
#include <cmath>

#include "engine/figure/build.hpp"
#include "engine/wave/hamiltonian.hpp"

namespace extremal::views {
namespace {

Series startOf(const SchemeResult& scheme, const FieldSampling& field) {
    Series s;
    s.label = scheme.spec.label;
    s.style = scheme.style;
    s.x = field.x;
    return s;
}

/// V, scaled to the height of the picture, as a guide for the eye.
void addPotential(Figure& figure, const Hamiltonian& h, double height) {
    const auto& V = h.potential();
    const auto [low, high] = std::minmax_element(V.begin(), V.end());
    if (!(*high > *low)) return;
    Series s;
    s.label = "V (scaled)";
    s.style = 7;
    s.x = h.x();
    for (const double v : V) s.y.push_back(height * (v - *low) / (*high - *low));
    figure.series.push_back(std::move(s));
}

Figure makeProfile(const FigureContext& context) {
    Figure figure = startFigure(context, "Profile");
    figure.x.title = "x";
    figure.y.title = context.system && context.system->hasWave() ? "|ψ|" : "u";
    double height = 0;
    for (const auto& scheme : context.comparison.schemes) {
        if (!context.system || !context.system->field || scheme->frames.empty()) continue;
        const FieldSampling& field = context.system->field;
        const auto& values = *scheme->frames.back().values;
        const std::size_t n = field.x.size();
        Series s = startOf(*scheme, field);
        const bool isUneven = context.system->hasWave() && !context.system->wave->isPeriodic();
        if (isUneven) {
            const EvenSamples even = evenSamples(*context.system->wave, values.data(), 400);
            s.x = even.x;
            for (std::size_t j = 0; j < even.x.size(); ++j) s.y.push_back(std::hypot(even.re[j], even.im[j]));
        }
        for (std::size_t j = 0; !isUneven && j < n; ++j)
            s.y.push_back(context.system->hasWave() ? std::hypot(values[j], values[n + j]) : values[j]);
        height = std::max(height, maxMagnitude(s.y));
        figure.series.push_back(std::move(s));
        if (!context.system->hasWave() || figure.series.size() > 1) continue;
        figure.subtitle = "at t = " + shortNumber(scheme->frames.back().t, 4);
    }
    if (context.system && !context.system->field) figure.message = "The model is no field";
    if (context.system && context.system->hasWave() && height > 0 && !context.system->field.x.empty())
        addPotential(figure, *context.system->wave, height);
    finishFigure(figure, context, "Profile over space");
    return figure;
}

}  // namespace

ViewEntry profile() {
    return {{"profile", "Profile", "a field over space at the end; of wave functions the modulus, and the potential", {}, {}, {}},
            "", makeProfile, nullptr, againstPlace};
}

}  // namespace extremal::views
