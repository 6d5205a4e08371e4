// SPDX-License-Identifier: GPL-3.0-or-later
/// `extremal handbook`: a page of the handbook, or a section of it, as Markdown.
#include "app/report.hpp"
#include "app/verbs.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/read/json.hpp"
#include "ui/text/handbook_pages.hpp"

namespace extremal::app {
namespace {

/// The headings of a page, as places.
std::vector<std::string> placesOf(const QString& page) {
    std::vector<std::string> all;
    for (const QString& line : handbookPage(page).split('\n'))
        if (line.startsWith(QLatin1String("##")))
            all.push_back((page + '#' + handbookAnchor(QString(line).remove('#').trimmed())).toStdString());
    return all;
}

}  // namespace

int handbookVerb(const std::string& place, const CommonOptions& options) {
    if (place.empty()) {
        Table table;
        Value::Array all;
        for (const QString& page : handbookPages()) {
            const std::string name = page.toStdString(), title = handbookTitle(page).toStdString();
            table.rows.push_back({name, title});
            all.push_back(Value::Object{{"page", name}, {"title", title}});
        }
        return print(options.isJson ? writeJson(all) : table.text(), done);
    }
    const QString text = handbookSection(QString::fromStdString(place));
    if (!text.isEmpty()) {
        if (!options.isJson) return print(text.toStdString(), done);
        return print(writeJson(Value::Object{{"place", place}, {"markdown", text.toStdString()}}), done);
    }
    std::vector<std::string> known;
    for (const QString& page : handbookPages()) {
        known.push_back(page.toStdString());
        if (place.starts_with(page.toStdString() + '#')) {
            known = placesOf(page);
            break;
        }
    }
    printProblem("handbook", "there is no page \"" + place + "\"", suggestName(place, known));
    return unusable;
}

}  // namespace extremal::app
