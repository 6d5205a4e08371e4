// SPDX-License-Identifier: GPL-3.0-or-later
/// How the window shows a scene: the cursors, the layout of the page and the sizes of cards.
#include <algorithm>

#include "engine/core/text/text.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/read/read_parts.hpp"
#include "engine/scene/write/format.hpp"

namespace extremal {
namespace {

/// A time of a cursor. Whoever shortens the interval keeps the scene.
std::optional<Number> cursorOf(Reader& reader, const Value& show, const char* key, const Scene& scene) {
    const Value* const given = show.find(key);
    if (!given) return {};
    const std::string at = childPointer("/show", key);
    const auto time = reader.number(*given, at, {});
    if (!time) return {};
    const auto [first, last] = std::minmax(scene.start.value, scene.end.value);
    if (time->value < first || time->value > last)
        reader.warning(at,
                       formatNumber(time->value) + " is not between " + formatNumber(first) + " and " +
                           formatNumber(last) + ", the times of the scene: the cursor stands at the nearest",
                       "set /time/end or this time");
    return time;
}

}  // namespace

void readShown(Reader& reader, const Value& document, Scene& scene) {
    const Value* const show = document.find("show");
    if (!show || !reader.isObject(*show, "/show")) return;
    reader.checkKeys(*show, "/show", format::show);
    scene.shown.time = cursorOf(reader, *show, "time", scene);
    scene.shown.pinned = cursorOf(reader, *show, "pinned", scene);
    const Value* const layout = show->find("layout");
    if (!layout) return;
    const auto name = reader.text(*layout, "/show/layout");
    if (!name) return;
    const auto found = std::find(format::layouts.begin(), format::layouts.end(), *name);
    if (found == format::layouts.end())
        return reader.unknownName("/show/layout", "layout", *name, format::layouts);
    scene.shown.layout = static_cast<PageLayout>(found - format::layouts.begin());
}

CardSize readCardSize(Reader& reader, const Value& object, const std::string& pointer) {
    CardSize size;
    const Value* const given = object.find("size");
    const std::string at = childPointer(pointer, "size");
    if (!given || !reader.isObject(*given, at)) return size;
    reader.checkKeys(*given, at, format::cardSize);
    const Limits limits{CardSize::least, CardSize::most, false, true, "pixels of the card in the window"};
    for (const auto& [key, target] : {std::pair{"width", &size.width}, std::pair{"height", &size.height}})
        if (const Value* const side = given->find(key))
            if (const auto pixels = reader.number(*side, childPointer(at, key), limits))
                *target = static_cast<int>(pixels->value);
    return size;
}

}  // namespace extremal
