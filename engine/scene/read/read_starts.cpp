// SPDX-License-Identifier: GPL-3.0-or-later
/// The keys `starts` and `spread` of a view: starts in its plane besides that of the scene.
#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/scene/plane_start.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/read/read_parts.hpp"
#include "engine/view/catalog.hpp"

namespace extremal {
namespace {

void readPoints(Reader& reader, const Value& points, const std::string& at, ViewStarts& starts) {
    if (!reader.isArray(points, at, "points [x, y]") || !reader.hasAtMost(points, at, "points", mostEntries))
        return;
    if (points.asArray().size() > ViewStarts::most)
        return reader.error(at, "has " + std::to_string(points.asArray().size()) + " points, the limit is " +
                                    std::to_string(ViewStarts::most));
    for (std::size_t i = 0; i < points.asArray().size(); ++i) {
        const Value& point = points.asArray()[i];
        const std::string place = childPointer(at, i);
        if (!reader.isArray(point, place, "two numbers")) continue;
        if (point.asArray().size() != 2) {
            reader.error(place, "must be a point [x, y] of the plot, got " +
                                    std::to_string(point.asArray().size()) + " numbers");
            continue;
        }
        const auto x = reader.number(point.asArray()[0], place + "/0", {}),
                   y = reader.number(point.asArray()[1], place + "/1", {});
        if (x && y) starts.points.emplace_back(*x, *y);
    }
}

}  // namespace

void readStarts(Reader& reader, const Value& object, const std::string& pointer, const System* system,
                View& view) {
    const Value *points = object.find("starts"), *spread = object.find("spread");
    if (!points && !spread) return;
    const std::string at = childPointer(pointer, points ? "starts" : "spread");
    if (!keysOf(view.id, system).hasStarts)
        return reader.error(at, "is only for phase portraits and sections");
    if (points) readPoints(reader, *points, at, view.starts);
    const std::string ofSpread = childPointer(pointer, "spread");
    if (spread)
        if (const auto count =
                reader.number(*spread, ofSpread,
                              {0, static_cast<double>(ViewStarts::most), false, true, "a number of starts"}))
            view.starts.spread = static_cast<int>(count->value);
    if (!system || view.starts.isEmpty()) return;
    const auto plane = planeOf(view, *system);
    if (!plane) return;
    if (const std::string problem = startProblem(*system, *plane); !problem.empty())
        return reader.error(at, "starts in this plot " + problem, "other columns, or no starts");
    const bool hasRange = view.xRange && view.yRange;
    if (view.starts.spread > 0 && plane->at.empty() && !hasRange)
        reader.error(ofSpread, "needs to know where: the range of both axes",
                     R"("range": {"x": [-3, 3], "y": [-2, 2]})");
}

void checkStarts(Reader& reader, const ResolvedScene& resolved) {
    const System& system = *resolved.system;
    const Scene& scene = resolved.scene;
    for (std::size_t v = 0; v < scene.views.size(); ++v) {
        const View& view = scene.views[v];
        const auto plane = view.starts.isEmpty() ? std::nullopt : planeOf(view, system);
        if (!plane) continue;
        const std::string pointer = childPointer("/views", v);
        const StartPlane starts(system, resolved.initial, *plane);
        for (std::size_t i = 0; i < view.starts.points.size(); ++i) {
            const auto& [x, y] = view.starts.points[i];
            if (const std::string problem = starts.at(x.value, y.value).problem; !problem.empty())
                reader.warning(childPointer(pointer + "/starts", i), "has no motion: " + problem,
                               "a point inside the region that the energy admits");
        }
        if (startsOf(starts, view).size() == view.starts.points.size() && view.starts.spread > 0)
            reader.warning(childPointer(pointer, "spread"),
                           "finds no bounded region around the start of the scene that its energy admits",
                           "give the range of both axes, or another start");
    }
}

}  // namespace extremal
