// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/files/event_files.hpp"

#include "engine/core/known_value.hpp"
#include "engine/core/text/text.hpp"
#include "engine/run/files/export.hpp"
#include "engine/scene/write/format.hpp"

namespace extremal {

std::string eventsCsv(const FoundEvents& found) {
    const auto& columns = found.rows.columns;
    const std::size_t width = columns.size() - 2;  // without the event and its direction
    std::string text = "event,direction";
    for (std::size_t c = 0; c < width; ++c)
        text += "," + csvCell(c == 0 ? columns[c].symbol : columns[c].name);
    text += '\n';
    for (std::size_t r = 0; r < found.rows.rows(); ++r) {
        const auto event = static_cast<std::size_t>(columns[width].values[r]);
        text += csvCell(found.all[event].spec.title()) + (columns[width + 1].values[r] > 0 ? ",up" : ",down");
        for (std::size_t c = 0; c < width; ++c) addNumber(text, columns[c].values[r]);
        text += '\n';
    }
    return text;
}

Value eventsValue(const FoundEvents& found) {
    Value::Array all;
    for (const FoundEvents::Event& event : found.all) {
        Value each{Value::Object{}};
        each.set("event", event.spec.title());
        each.set("action", format::actions[static_cast<std::size_t>(event.spec.action)]);
        each.set("count", static_cast<double>(event.count));
        each.set("first", knownNumber(event.first));
        each.set("last", knownNumber(event.last));
        all.push_back(each);
    }
    return all;
}

std::string eventsText(const SchemeResult& result) {
    std::string text;
    if (const FoundImpacts* const impacts = result.products.find<FoundImpacts>())
        text = "impacts: " + std::to_string(impacts->count) +
               (impacts->isCut ? "; the file has the first " + std::to_string(FoundImpacts::mostRows) : "");
    const FoundEvents* const found = result.products.find<FoundEvents>();
    if (!found) return text;
    for (const FoundEvents::Event& event : found->all)
        if (event.spec.action != EventSpec::Action::stop)
            text += (text.empty() ? "" : "; ") + event.spec.title() + ": " + std::to_string(event.count);
    if (found->stoppedBy >= 0) {
        const FoundEvents::Event& event = found->all[static_cast<std::size_t>(found->stoppedBy)];
        text += (text.empty() ? "stopped by " : "; stopped by ") + event.spec.title() +
                " at t = " + formatNumber(event.last, 6);
    }
    if (found->isCut) text += "; the file has the first " + std::to_string(FoundEvents::mostRows);
    return text;
}

}  // namespace extremal
