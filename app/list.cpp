// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report.hpp"
#include "app/verbs.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/study/atlas/catalogues.hpp"

namespace extremal::app {
namespace {

/// "degree 1..24, basis lobatto|chebyshev": what can be set, in one line.
std::string parameterText(const CatalogItem& item) {
    std::string text;
    for (const FieldInfo& field : item.parameters) {
        if (!text.empty()) text += ", ";
        text += field.key;
        if (!field.fallback.isNull())
            text.append(" = ").append(field.fallback.isString() ? field.fallback.asString()
                                                                : writeCompactJson(field.fallback));
        if (!field.unit.empty()) text.append(" ").append(field.unit);
    }
    return text.empty() ? text : " {" + text + "}";
}

std::string tableText(const Catalogue& catalogue, const std::string& indent) {
    Table table;
    for (const CatalogItem& item : catalogue.items) {
        std::string words = item.title;
        if (!item.description.empty()) words.append(": ").append(item.description);
        table.rows.push_back({indent + item.id, words + parameterText(item)});
    }
    return table.text();
}

}  // namespace

int listVerb(const std::string& wanted, const CommonOptions& options) {
    if (!wanted.empty()) {
        const Catalogue* const found = findCatalogue(wanted);
        if (!found) {
            std::vector<std::string> names;
            for (const Catalogue& catalogue : catalogues()) names.push_back(catalogue.name);
            printProblem("list", "unknown kind \"" + wanted + "\"", suggestName(wanted, names));
            return unusable;
        }
        return print(options.isJson ? writeJson(catalogueValue(*found)) : tableText(*found, ""), done);
    }
    Value document{Value::Object{}};
    std::string text;
    for (const Catalogue& catalogue : catalogues()) {
        document.set(catalogue.name, catalogueValue(catalogue));
        if (!text.empty()) text += '\n';
        text.append(catalogue.name).append("\n").append(tableText(catalogue, "  "));
    }
    return print(options.isJson ? writeJson(document) : text, done);
}

}  // namespace extremal::app
