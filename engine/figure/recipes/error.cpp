// SPDX-License-Identifier: GPL-3.0-or-later
/// Distance to the reference on a logarithmic axis, with the floor below which the reference itself is no
/// better.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/figure/against.hpp"

namespace extremal::recipes {
namespace {

std::string symbolOf(const FigureContext& context) {
    if (context.system && context.system->error.evaluate) return context.system->error.columns.front().symbol;
    const bool isSingle = context.system && context.system->dimension() == 1;
    const std::string q = isSingle ? context.system->coordinates.front().symbol : "q";
    return isSingle ? "|" + q + " − " + q + "_ref|" : "‖q − q_ref‖";
}

std::string referenceText(const ReferenceInfo& reference) {
    if (reference.type == "none") return "no reference";
    if (reference.type == "exact") return "reference: exact";
    std::string text =
        "reference: " + (reference.description.empty() ? reference.type : reference.description);
    if (std::isfinite(reference.horizon))
        text += ", good to t = " + shortNumber(reference.horizon, 3);
    else if (std::isfinite(reference.estimatedError))
        text += ", good to " + shortNumber(reference.estimatedError, 1);
    return text;
}

/// Where errors cannot be judged all along: the bound of the reference up to each time, and the last time up
/// to which it is small.
void addBound(Figure& figure, const FigureContext& context) {
    const ReferenceInfo& reference = context.comparison.reference;
    if (reference.boundAlong.empty() || isAgainstSteps(context.view)) return;
    Guide bound;
    bound.isStrong = true;
    for (const ReferenceInfo::At& each : reference.boundAlong) {
        bound.x.push_back(each.t);
        bound.y.push_back(each.value > 0 ? each.value : std::numeric_limits<double>::quiet_NaN());
    }
    figure.add(std::move(bound));
    if (!std::isfinite(reference.horizon)) return;
    figure.add(Guide{{reference.horizon, reference.horizon}, {0x1p-52, reference.boundAlong.back().value}});
    figure.add(Label{reference.horizon, 2 * reference.boundAlong.back().value, "judged to here"});
}

/// When the force has a pulse, which schemes may step over.
void addPulses(Figure& figure, const FigureContext& context, double scale) {
    constexpr std::size_t most = 12;  // more would be a grey plot
    const std::vector<ReferenceInfo::At>& pulses = context.comparison.reference.pulses;
    if (isAgainstSteps(context.view) || pulses.size() > most || !(scale > 0)) return;
    for (const ReferenceInfo::At& pulse : pulses) {
        figure.add(Guide{{pulse.t, pulse.t}, {0x1p-52 * scale, scale}});
        figure.add(Label{pulse.t, 2 * 0x1p-52 * scale, "pulse, " + shortNumber(pulse.value, 1) + " wide"});
    }
}

Figure makeError(const FigureContext& context) {
    Figure figure = startFigure(context, "Error");
    figure.y = logAxis(axisTitle(symbolOf(context), columnInfo(context, "error").unit));
    addErrors(figure, context, "error");

    const ReferenceInfo& reference = context.comparison.reference;
    figure.subtitle = referenceText(reference);
    const bool hasOwnMeasure = context.system && context.system->error.evaluate;
    const double scale = hasOwnMeasure ? context.system->error.scale : initialNorm(context.comparison, "q.");
    if (scale > 0) figure.put(RoundOffFloor{0x1p-52 * scale});
    if (reference.estimatedError > 0 && std::isfinite(reference.estimatedError)) {
        if (reference.boundAlong.empty())
            figure.put(RoundOffFloor{std::max(floorOf(figure), reference.estimatedError)});
        if (reference.boundAlong.empty()) figure.put(DoubtfulBand{10 * reference.estimatedError});
    }
    addBound(figure, context);
    addPulses(figure, context, scale);
    for (const auto& scheme : context.comparison.schemes) {
        const double opensAt = scheme->summary.opensAt;
        if (!std::isfinite(opensAt) || isAgainstSteps(context.view)) continue;
        const std::span<const double> t = scheme->trajectory["t"], error = scheme->trajectory["error"];
        const auto row = std::lower_bound(t.begin(), t.end(), opensAt) - t.begin();
        figure.add(EventMarks{scheme->spec.label,
                              scheme->style,
                              "open from t = " + shortNumber(opensAt) + " on",
                              {opensAt},
                              {error[static_cast<std::size_t>(row)]}});
    }
    if (reference.type == "none") figure.message = "Without a reference there is no error to show";
    finishFigure(figure, context,
                 "Distance to the reference " + againstText(context.view) + " (" + figure.subtitle + ")");
    return figure;
}

}  // namespace

RecipeEntry error() { return {"error", makeError}; }

}  // namespace extremal::recipes
