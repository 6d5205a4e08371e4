// SPDX-License-Identifier: GPL-3.0-or-later
/// A field over space at the last time of each scheme; of wave functions the modulus, or the real and
/// imaginary parts. Over a rectangle that of one scheme, as colours.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/figure/build.hpp"
#include "engine/model/parts/potential_levels.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/premise.hpp"

namespace extremal::recipes {
namespace {

enum class Part { modulus, real, imaginary };

struct Shown {
    Part part;
    std::string symbol;
    std::size_t component = 0;  ///< the real part's
};

/// The curves of each scheme, the first in its own colour, a second one pale.
std::vector<Shown> shownParts(const View& view, const FieldSampling& field) {
    const std::vector<std::string>& names = field.components;
    const auto chosen = std::find(names.begin(), names.end(), view.keys.text("component"));
    const auto component = static_cast<std::size_t>(chosen - names.begin());
    if (chosen != names.end() && field.isComplex && component == 1) return {{Part::imaginary, *chosen}};
    if (chosen != names.end()) return {{Part::real, *chosen, component}};
    if (!field.isComplex) return {{Part::real, names.front()}};
    const bool isWave = names.front() == "re";
    const Shown real{Part::real, isWave ? "Re ψ" : names[0]},
        imaginary{Part::imaginary, isWave ? "Im ψ" : names[1]};
    const std::string part = view.keys.text("part");
    if (part == "real") return {real};
    if (part == "imaginary") return {imaginary};
    if (part == "both") return {real, imaginary};
    return {{Part::modulus, isWave ? "|ψ|" : "|" + names[0] + " + i " + names[1] + "|"}};
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

/// Both components at equally spaced points and the ends, where they vanish.
struct EvenSamples {
    std::vector<double> x, first, second;
};

EvenSamples evenSamplesOf(const FieldSampling& field, const std::vector<double>& values) {
    constexpr int rows = 400;
    const std::vector<double> all = field.resampling(rows)(values);
    EvenSamples even{{field.along.left}, {0}, {0}};
    for (int row = 0; row < rows; ++row) {
        even.x.push_back(field.along.left + field.along.length * (row + 0.5) / rows);
        even.first.push_back(all[static_cast<std::size_t>(row)]);
        even.second.push_back(all[static_cast<std::size_t>(rows + row)]);
    }
    even.x.push_back(field.along.left + field.along.length);
    even.first.push_back(0);
    even.second.push_back(0);
    return even;
}

/// V, scaled to the height of the picture, as a guide for the eye.
void addPotential(Figure& figure, const PotentialLevels& levels, double height) {
    const std::vector<double>& V = *levels.V;
    const auto [low, high] = std::minmax_element(V.begin(), V.end());
    if (!(*high > *low)) return;
    Series s;
    s.label = "V (scaled)";
    s.style = 7;
    s.x = *levels.x;
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
HeatMap heatOver(const FieldSampling& field, const std::vector<double>& all, const Shown& shown) {
    const std::size_t n = field.places();
    const double* const values = all.data() + shown.component * n;
    const Part part = shown.part;
    HeatMap heat;
    heat.columns = static_cast<int>(field.x.size());
    heat.rows = static_cast<int>(field.y.size());
    // A node is in the middle of its cell.
    heat.left = field.along.left - field.along.length / heat.columns / 2;
    heat.right = heat.left + field.along.length;
    heat.bottom = field.across.left - field.across.length / heat.rows / 2;
    heat.top = heat.bottom + field.across.length;
    for (int column = 0; column < heat.columns; ++column)
        for (int row = 0; row < heat.rows; ++row) {
            const auto j = static_cast<std::size_t>(column + row * heat.columns);
            heat.values.push_back(part == Part::real ? values[j] : valueOf(part, values[j], values[n + j]));
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
    const FieldSampling& field = context.system->field;
    const Shown shown = shownParts(context.view, field).front();
    if (const SchemeResult* scheme =
            schemeOf(context, [](const SchemeResult& s) { return framesOf(s) != nullptr; })) {
        const Frame& last = framesOf(*scheme)->back();
        figure.title = "Profile of " + scheme->spec.label;
        figure.add(heatOver(field, *last.values, shown));
        figure.x.range = {figure.heat()->left, figure.heat()->right};
        figure.y.range = {figure.heat()->bottom, figure.heat()->top};
        figure.subtitle = shown.symbol + (shown.part == Part::modulus ? ", the colour is its phase" : "") +
                          " · at most " + shortNumber(figure.heat()->high) +
                          " · at t = " + shortNumber(last.t, 4);
    }
    finishFigure(figure, context, "Profile over the plane");
    return figure;
}

Figure makeProfile(const FigureContext& context) {
    if (context.system && !context.system->field.y.empty()) return makePlaneProfile(context);
    Figure figure = startFigure(context, "Profile");
    figure.x.title = "x";
    const bool isField = context.system && context.system->field;
    const std::vector<Shown> parts =
        isField ? shownParts(context.view, context.system->field) : std::vector<Shown>(1);
    const bool isComplex = isField && context.system->field.isComplex;
    const bool isWave = isComplex && context.system->field.components.front() == "re";
    figure.y.title = parts.size() == 1 ? parts.front().symbol
                     : isWave          ? "ψ"
                                       : parts[0].symbol + ", " + parts[1].symbol;
    double height = 0;
    for (const auto& scheme : context.comparison.schemes) {
        if (!context.system || !context.system->field || !framesOf(*scheme)) continue;
        const FieldSampling& field = systemOf(context, *scheme).field;
        const auto& values = *framesOf(*scheme)->back().values;
        const std::size_t n = field.x.size();
        const EvenSamples even = field.resampling ? evenSamplesOf(field, values) : EvenSamples{};
        const double* const re = field.resampling ? even.first.data() : values.data();
        const double* const im = field.resampling ? even.second.data() : values.data() + n;
        for (const Shown& shown : parts) {
            Series s = startOf(*scheme, field, values);
            if (field.resampling) s.x = even.x;
            if (parts.size() > 1) s.part = shown.symbol;
            if (&shown != &parts.front()) s.tone = Tone::pale;
            for (std::size_t j = 0; j < s.x.size(); ++j)
                s.y.push_back(shown.part == Part::real ? re[shown.component * n + j]
                                                       : valueOf(shown.part, re[j], im[j]));
            height = std::max(height, maxMagnitude(s.y));
            figure.add(std::move(s));
        }
        if (!isComplex || figure.series().size() > parts.size()) continue;
        figure.subtitle = "at t = " + shortNumber(framesOf(*scheme)->back().t, 4);
        if (parts.size() > 1) figure.subtitle += ", " + parts[1].symbol + " is pale";
    }
    if (context.system && !context.system->field) figure.message = "The model is not a field";
    if (context.system && context.system->field.isGraph && !figure.series().empty()) {
        double t = 0;
        for (const auto& scheme : context.comparison.schemes)
            if (framesOf(*scheme)) t = framesOf(*scheme)->back().t;
        figure.subtitle = "at t = " + shortNumber(t, 4);
        addExact(figure, context, t);
    }
    const auto* const levels = context.system ? context.system->parts.find<PotentialLevels>() : nullptr;
    if (levels && height > 0 && !context.system->field.x.empty()) addPotential(figure, *levels, height);
    finishFigure(figure, context, "Profile over space");
    return figure;
}

}  // namespace

RecipeEntry profile() { return {"profile", makeProfile}; }

}  // namespace extremal::recipes
