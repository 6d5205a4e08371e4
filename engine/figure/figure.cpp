#include "engine/figure/figure.hpp"

#include <algorithm>
#include <stdexcept>

#include "engine/figure/against.hpp"
#include "engine/figure/view.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/map_grid.hpp"
#include "engine/scene/view_axes.hpp"

namespace extremal {

const ViewEntry* findView(std::string_view id) {
    const auto& all = viewEntries();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const ViewEntry& e) { return e.item.id == id; });
    return found == all.end() ? nullptr : &*found;
}

const std::vector<CatalogItem>& viewCatalog() {
    static const std::vector<CatalogItem> items = [] {
        std::vector<CatalogItem> result;
        for (const ViewEntry& e : viewEntries()) result.push_back(e.item);
        return result;
    }();
    return items;
}

ViewAxes axesOf(const View& view, const System& system) {
    const ViewEntry* entry = findView(view.id);
    if (!entry) return {};
    const Scales& scales = entry->scales;
    ViewAxes axes{scales.exist, scales.isXLog, scales.isYLog, ""};
    const bool isTime = scales.across == Across::time || (scales.across == Across::column && entry->xColumn &&
                                                          entry->xColumn(view, system) == "t");
    if (isTime) axes.variable = system.independent;
    if (scales.across == Across::place) axes.variable = "x";
    if (isAgainstSteps(view)) {
        axes.isXLog = true;
        axes.variable = "n";
    }
    return axes;
}

Figure makeFigure(const Comparison& comparison, const View& view) {
    const ModelEntry* model = findModel(comparison.scene.model.type);
    if (!model) return makeFigure(comparison, view, nullptr);
    const System system = model->make(comparison.scene.model);
    return makeFigure(comparison, view, &system);
}

Figure makeFigure(const Comparison& comparison, const View& view, const System* system) {
    const ViewEntry* entry = findView(view.id);
    if (!entry || !entry->make) throw std::invalid_argument("no plot is called \"" + view.id + "\"");
    return entry->make(FigureContext{comparison, view, system});
}

namespace {

bool isObserved(const Scene& scene, const std::string& observable) {
    return observable.empty() ||
           std::find(scene.observe.begin(), scene.observe.end(), observable) != scene.observe.end();
}

std::vector<View> defaultViews(const Scene& scene) {
    std::vector<View> result;
    for (const char* id : {"work-precision", "energy", "error", "momentum", "norm", "trajectory", "phase"}) {
        const ViewEntry* entry = findView(id);
        if (entry && isObserved(scene, entry->observable)) result.push_back({id, "", ""});
    }
    return result;
}

/// The first pairs that run, by label: pictures of one scheme each.
std::vector<std::string> pairLabels(const Scene& scene, const System& system) {
    constexpr std::size_t most = 4;
    std::vector<std::string> labels;
    for (const SchemeSpec& s : scene.schemes)
        if (const auto pair = pairOf(s);
            s.isEnabled && pair && isPairFor(*pair, system) && labels.size() < most)
            labels.push_back(s.label);
    return labels;
}

}  // namespace

std::vector<View> plotViews(const Scene& scene) {
    const ModelEntry* model = findModel(scene.model.type);
    const System system = model ? model->make(scene.model) : System{};
    std::vector<View> result;
    for (const View& view : scene.views.empty() ? defaultViews(scene) : scene.views) {
        const ViewEntry* entry = findView(view.id);
        if (!entry || !entry->make) continue;
        if (view.id == "sparsity" && view.scheme.empty()) {
            const std::vector<std::string> pairs = pairLabels(scene, system);
            for (const std::string& label : pairs) {
                result.push_back(view);
                result.back().scheme = label;
            }
            if (pairs.empty()) result.push_back(view);
            continue;
        }
        if (view.id == mapView && view.scheme.empty()) {
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
