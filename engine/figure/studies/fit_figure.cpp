// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/studies/fit_figure.hpp"

#include <cmath>
#include <utility>

#include "engine/figure/build.hpp"
#include "engine/figure/fit_axes.hpp"

namespace extremal {
namespace {

Figure figureOf(const char* view, std::string title, const std::string& file, const std::string& remark) {
    Figure figure;
    figure.view = view;
    figure.title = std::move(title);
    figure.subtitle = file.substr(file.find_last_of('/') + 1);
    if (!remark.empty()) figure.subtitle += ": " + remark;
    figure.x.title = "t";
    return figure;
}

Series seriesOf(const std::string& label, int style, SeriesKind kind) {
    Series series;
    series.label = label;
    series.style = style;
    series.kind = kind;
    return series;
}

}  // namespace

Figure measuredFigure(const MeasuredData& data, std::size_t column, const std::vector<double>& computed) {
    const std::string& name = data.columns.at(column).name;
    Figure figure = figureOf("measured", "Measured and computed", data.name, data.remark);
    figure.y.title = name;
    Series line = seriesOf("computed", 0, SeriesKind::line);
    Series dots = seriesOf("measured", exactStyle, SeriesKind::marks);
    for (std::size_t i = 0; i < data.all.size(); ++i) {
        const Measurement& each = data.all[i];
        if (each.column != column) continue;
        dots.x.push_back(each.t);
        dots.y.push_back(each.value);
        if (i < computed.size()) {
            line.x.push_back(each.t);
            line.y.push_back(computed[i]);
        }
    }
    figure.summary = std::to_string(dots.x.size()) + " measurements of " + name + " against time.";
    figure.add(std::move(dots));
    if (!line.x.empty()) figure.add(std::move(line));
    fitAxes(figure, View{}, "t");
    return figure;
}

Figure residualsFigure(const FitAnswer& answer) {
    Figure figure = figureOf("residuals", "Residuals", answer.data, answer.remark);
    figure.y.title =
        answer.hasDeviations ? "(computed − measured) / deviation" : "(computed − measured) / their scatter";
    std::vector<std::string> names;
    std::vector<Series> all;
    for (const Value::Array& row : answer.residuals.rows) {
        const std::string& name = row[1].asString();
        std::size_t place = 0;
        while (place < names.size() && names[place] != name) ++place;
        if (place == names.size()) {
            names.push_back(name);
            all.push_back(seriesOf(name, static_cast<int>(place), SeriesKind::marks));
        }
        const double over = answer.hasDeviations ? row[5].asNumber() : row[4].asNumber() / answer.scatter;
        all[place].x.push_back(row[0].asNumber());
        all[place].y.push_back(std::isfinite(over) ? over : 0);
    }
    if (!answer.residuals.rows.empty()) {
        const double first = answer.residuals.rows.front()[0].asNumber(),
                     last = answer.residuals.rows.back()[0].asNumber();
        for (const double at : {-1.0, 0.0, 1.0}) figure.add(Guide{{first, last}, {at, at}, at == 0});
    }
    figure.summary = std::to_string(answer.residuals.rows.size()) + " residuals against time.";
    for (Series& series : all) figure.add(std::move(series));
    fitAxes(figure, View{}, "t");
    return figure;
}

}  // namespace extremal
