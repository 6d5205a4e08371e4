// SPDX-License-Identifier: GPL-3.0-or-later
#include "extremal/figure.hpp"

#include "engine/core/text/text.hpp"
#include "engine/figure/image/svg.hpp"
#include "engine/figure/sample.hpp"
#include "engine/view/catalog.hpp"
#include "library/data.hpp"

namespace extremal::api {

Figure::Figure(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

const std::string& Figure::view() const { return data_->figure.view; }
const std::string& Figure::title() const { return data_->figure.title; }
const std::string& Figure::xTitle() const { return data_->figure.x.title; }
const std::string& Figure::yTitle() const { return data_->figure.y.title; }
const std::string& Figure::summary() const { return data_->figure.summary; }
std::vector<Curve> Figure::curves() const {
    std::vector<Curve> all;
    for (const Series& series : data_->figure.series())
        all.push_back({seriesName(series), series.x, series.y});
    return all;
}
std::string Figure::svg(int width, int height, bool isDark) const {
    return svgOf(data_->figure, {width, height, isDark});
}
std::string Figure::csv() const { return figureCsv(data_->figure, false); }

std::vector<Figure> figures(const Comparison& comparison) {
    const extremal::Comparison& all = *comparison.data().comparison;
    std::vector<Figure> result;
    for (const View& view : plotViews(all.scene))
        result.push_back(handleOf(makeFigure(all, view, all.system.get())));
    return result;
}

Figure figure(const Comparison& comparison, const std::string& view) {
    const extremal::Comparison& all = *comparison.data().comparison;
    for (const View& each : plotViews(all.scene))
        if (each.id == view) return handleOf(makeFigure(all, each, all.system.get()));
    const ViewEntry* const entry = findView(view);
    std::vector<std::string> plots;
    for (const ViewEntry& each : viewEntries())
        if (each.isPlot()) plots.push_back(each.item.id);
    if (!entry || !entry->isPlot())
        throw InvalidScene("/views", "no plot is called \"" + view + "\"", suggestName(view, plots));
    if (const std::string missing = missingFor(View{view, "", ""}, *all.system); !missing.empty())
        throw InvalidScene("/views", "the view " + view + " needs " + missing);
    extremal::Figure drawn = makeFigure(all, View{view, "", ""}, all.system.get());
    if (isEmpty(drawn))
        throw InvalidScene("/views", "the run has not computed what the view " + view + " shows",
                           "name it in \"views\" of the scene");
    return handleOf(std::move(drawn));
}

}  // namespace extremal::api
