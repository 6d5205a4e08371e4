// SPDX-License-Identifier: GPL-3.0-or-later
/// A field over space at the last time of each scheme; of wave functions the modulus, or the real and
/// imaginary parts. Over a rectangle that of one scheme, as colours.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/figure/build.hpp"
#include "engine/model/wave/hamiltonian.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/premise.hpp"

namespace extremal::recipes {
namespace {

enum class Part { modulus, real, imaginary };

struct Shown {
    Part part;
    const char* symbol;
};

/// The curves of each scheme, the first in its own colour, a second one pale.
std::vector<Shown> shownParts(const View& view) {
    constexpr Shown real{Part::real, "Re ψ"}, imaginary{Part::imaginary, "Im ψ"};
    const std::string part = view.keys.text("part");
    if (part == "real") return {real};
    if (part == "imaginary") return {imaginary};
    if (part == "both") return {real, imaginary};
    return {{Part::modulus, "|ψ|"}};
}

double valueOf(Part part, double re, double im) {
    return part == Part::real ? re : part == Part::imaginary ? im : std::hypot(re, im);
}

Series startOf(const SchemeResult& scheme, const FieldSampling& field, const std::vector<double>& values) {
    Series s;
    s.label = scheme.spec.label;
    s.style = scheme.style;
    const std::span<const double> nodes = field.nodesOf(values);
    s.x.assign(nodes.begin(), nodes.end());
    if (field.hasMovingNodes) s.kind = SeriesKind::markedLine;
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
    figure.add(std::move(s));
}

/// The exact solution of a field at the time of the frames, as a guide for the eye.
void addExact(Figure& figure, const FigureContext& context, double t) {
    const Scene& scene = context.comparison.scene;
    const State start = initialState(scene, *context.system);
    const ExactSolution exact = exactSolution(scene, *context.system, start);
    if (!exact || premiseOf(scene, *context.system, start).isViolated) return;
    Series s;
    s.label = "exact solution";
    s.style = 7;
    s.tone = Tone::pale;
    s.x = context.system->field.x;
    std::vector<double> x(start.x.size());
    exact(t, x);
    s.y.assign(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(s.x.size()));
    figure.add(std::move(s));
}

/// The modulus with the phase as its colour, or one part.
HeatMap heatOver(const Hamiltonian& h, const std::vector<double>& values, Part part) {
    const wave::Grid& grid = h.grid();
    const std::size_t n = values.size() / 2;
    HeatMap heat;
    heat.columns = grid.nx;
    heat.rows = grid.ny;
    // A node is in the middle of its cell.
    heat.left = grid.x.left - grid.x.length / grid.nx / 2;
    heat.right = heat.left + grid.x.length;
    heat.bottom = grid.y.left - grid.y.length / grid.ny / 2;
    heat.top = heat.bottom + grid.y.length;
    for (int column = 0; column < grid.nx; ++column)
        for (int row = 0; row < grid.ny; ++row) {
            const auto j = static_cast<std::size_t>(column + row * grid.nx);
            heat.values.push_back(valueOf(part, values[j], values[n + j]));
            if (part == Part::modulus)
                heat.hues.push_back(std::atan2(values[n + j], values[j]) / (2 * std::numbers::pi));
        }
    heat.high = maxMagnitude(heat.values);
    heat.low = part == Part::modulus ? 0 : -heat.high;
    return heat;
}

Figure makePlaneProfile(const FigureContext& context) {
    Figure figure = startFigure(context, "Profile");
    figure.x.title = "x";
    figure.y.title = "y";
    figure.aspect = Aspect::equal;
    const Shown shown = shownParts(context.view).front();
    if (const SchemeResult* scheme =
            schemeOf(context, [](const SchemeResult& s) { return framesOf(s) != nullptr; })) {
        const Frame& last = framesOf(*scheme)->back();
        figure.title = "Profile of " + scheme->spec.label;
        figure.add(heatOver(*context.system->hamiltonian(), *last.values, shown.part));
        figure.x.range = {figure.heat()->left, figure.heat()->right};
        figure.y.range = {figure.heat()->bottom, figure.heat()->top};
        figure.subtitle = std::string(shown.symbol) +
                          (shown.part == Part::modulus ? ", the colour is its phase" : "") + " · at most " +
                          shortNumber(figure.heat()->high) + " · at t = " + shortNumber(last.t, 4);
    }
    finishFigure(figure, context, "Profile over the plane");
    return figure;
}

Figure makeProfile(const FigureContext& context) {
    if (context.system && extremal::isWave(*context.system) &&
        context.system->hamiltonian()->dimension() == 2)
        return makePlaneProfile(context);
    Figure figure = startFigure(context, "Profile");
    figure.x.title = "x";
    const bool isWave = context.system && extremal::isWave(*context.system);
    const std::vector<Shown> parts = isWave ? shownParts(context.view) : std::vector<Shown>(1);
    figure.y.title = !isWave ? "u" : parts.size() > 1 ? "ψ" : parts.front().symbol;
    double height = 0;
    for (const auto& scheme : context.comparison.schemes) {
        if (!context.system || !context.system->field || !framesOf(*scheme)) continue;
        const FieldSampling& field = systemOf(context, *scheme).field;
        const auto& values = *framesOf(*scheme)->back().values;
        const std::size_t n = field.x.size();
        const bool isUneven = isWave && !context.system->hamiltonian()->isPeriodic();
        const EvenSamples even =
            isUneven ? evenSamples(*context.system->hamiltonian(), values.data(), 400) : EvenSamples{};
        const double* const re = isUneven ? even.re.data() : values.data();
        const double* const im = isUneven ? even.im.data() : values.data() + n;
        for (const Shown& shown : parts) {
            Series s = startOf(*scheme, field, values);
            if (isUneven) s.x = even.x;
            if (parts.size() > 1) s.part = shown.symbol;
            if (&shown != &parts.front()) s.tone = Tone::pale;
            for (std::size_t j = 0; j < s.x.size(); ++j)
                s.y.push_back(isWave ? valueOf(shown.part, re[j], im[j]) : re[j]);
            height = std::max(height, maxMagnitude(s.y));
            figure.add(std::move(s));
        }
        if (!isWave || figure.series().size() > parts.size()) continue;
        figure.subtitle = "at t = " + shortNumber(framesOf(*scheme)->back().t, 4);
        if (parts.size() > 1) figure.subtitle += ", Im ψ is pale";
    }
    if (context.system && !context.system->field) figure.message = "The model is not a field";
    if (context.system && isField(*context.system) && !figure.series().empty()) {
        double t = 0;
        for (const auto& scheme : context.comparison.schemes)
            if (framesOf(*scheme)) t = framesOf(*scheme)->back().t;
        figure.subtitle = "at t = " + shortNumber(t, 4);
        addExact(figure, context, t);
    }
    if (isWave && height > 0 && !context.system->field.x.empty())
        addPotential(figure, *context.system->hamiltonian(), height);
    finishFigure(figure, context, "Profile over space");
    return figure;
}

}  // namespace

RecipeEntry profile() { return {"profile", makeProfile}; }

}  // namespace extremal::recipes
