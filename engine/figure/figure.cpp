// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/figure.hpp"

#include <algorithm>
#include <stdexcept>

#include "engine/figure/recipe.hpp"
#include "engine/scene/view_choices.hpp"
#include "engine/scene/map_grid.hpp"

namespace extremal {

const MovingCurve::Moment& MovingCurve::at(double t) const {
    const double ahead = moments.back().t < moments.front().t ? -1 : 1;
    const auto next = std::partition_point(moments.begin(), moments.end(),
                                           [&](const Moment& m) { return ahead * m.t <= ahead * t; });
    return next == moments.begin() ? *next : *(next - 1);
}

Figure makeFigure(const Comparison& comparison, const View& view) {
    const ModelEntry* model = findModel(comparison.scene.model.type);
    if (!model) return makeFigure(comparison, view, nullptr);
    const System system = model->make(comparison.scene.model);
    return makeFigure(comparison, view, &system);
}

Figure makeFigure(const Comparison& comparison, const View& view, const System* system) {
    const ViewEntry* entry = findView(view.id);
    if (!entry || !entry->isPlot()) throw std::invalid_argument("no plot is called \"" + view.id + "\"");
    return draw(FigureContext{comparison, view, system, *entry});
}

bool isEmpty(const Figure& figure) { return figure.series().empty() && !figure.heat(); }

namespace {

/// The first schemes that run and have the view, by label: pictures of one scheme each.
std::vector<std::string> firstLabels(const Scene& scene, const ViewEntry& entry) {
    constexpr std::size_t most = 4;
    std::vector<std::string> labels;
    for (const SchemeSpec& s : scene.schemes)
        if (s.isEnabled && labels.size() < most && unsuitableFor(entry, resolve(s)).empty())
            labels.push_back(s.label);
    return labels;
}

}  // namespace

std::vector<View> plotViews(const Scene& scene) {
    const ModelEntry* model = findModel(scene.model.type);
    const System system = model ? model->make(scene.model) : System{};
    std::vector<View> result;
    for (const View& view : shownViews(scene)) {
        const ViewEntry* entry = findView(view.id);
        if (!entry || !entry->isPlot()) continue;
        if (entry->pictures == Pictures::perDiscretization && view.scheme.empty()) {
            const std::vector<std::string> pairs = firstLabels(scene, *entry);
            for (const std::string& label : pairs) {
                result.push_back(view);
                result.back().scheme = label;
            }
            if (pairs.empty()) result.push_back(view);
            continue;
        }
        if (entry->pictures == Pictures::perStep && view.scheme.empty()) {
            const std::vector<std::size_t> mapped = mappedSchemes(scene);
            for (const std::size_t i : mapped) {
                result.push_back(view);
                result.back().scheme = scene.schemes[i].label;
            }
            if (mapped.empty()) result.push_back(view);
            continue;
        }
        const std::vector<std::string> columns =
            entry->columns ? entry->columns(system) : std::vector<std::string>{};
        if (!view.x.empty() || !view.y.empty() || columns.empty()) {
            result.push_back(view);
            continue;
        }
        for (const std::string& column : columns) {
            result.push_back(view);
            result.back().x = "t";
            result.back().y = column;
        }
    }
    return result;
}

}  // namespace extremal
