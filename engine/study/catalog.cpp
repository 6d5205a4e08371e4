// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/catalog.hpp"

#include <algorithm>

#include "engine/core/text/text.hpp"
#include "engine/run/files/export.hpp"

namespace extremal {

const StudyEntry* findStudy(std::string_view id) {
    const auto& all = studyEntries();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const StudyEntry& e) { return e.item.id == id; });
    return found == all.end() ? nullptr : &*found;
}

const std::vector<CatalogItem>& studyCatalog() {
    static const std::vector<CatalogItem> items = [] {
        std::vector<CatalogItem> all;
        for (const StudyEntry& e : studyEntries()) all.push_back(e.item);
        return all;
    }();
    return items;
}

std::vector<StudyTable> tablesOf(const StudyEntry& study, const Sweep& sweep) {
    std::vector<StudyTable> all{{study.item.id, study.columns, study.rows(sweep)}};
    if (!study.further.empty()) {
        auto& [name, columns, rows] = all.front();
        const bool isKnown = std::any_of(rows.begin(), rows.end(),
                                         [](const Value::Array& row) { return !row.back().isNull(); });
        if (isKnown) columns.push_back(study.further);
        for (Value::Array& row : rows) row.resize(columns.size());
    }
    if (study.besides)
        for (StudyTable& table : study.besides(sweep)) all.push_back(std::move(table));
    return all;
}

StudyTable summaryOf(const StudyEntry& study, const Sweep& sweep) {
    return {"", study.summaryColumns, study.summary(sweep)};
}

std::string csvText(const StudyTable& table) {
    std::string text;
    for (const std::string& column : table.columns) text += (text.empty() ? "" : ",") + column;
    text += '\n';
    for (const Value::Array& row : table.rows) {
        for (std::size_t c = 0; c < row.size(); ++c) {
            if (c > 0) text += ',';
            if (row[c].isNumber()) text += formatNumber(row[c].asNumber());
            if (row[c].isBool()) text += row[c].asBool() ? "true" : "false";
            if (row[c].isString()) text += csvCell(row[c].asString());
        }
        text += '\n';
    }
    return text;
}

Value rowsValue(const StudyTable& table) {
    Value::Array all;
    for (const Value::Array& row : table.rows) {
        Value object{Value::Object{}};
        for (std::size_t c = 0; c < row.size(); ++c) object.set(table.columns[c], row[c]);
        all.push_back(std::move(object));
    }
    return all;
}

}  // namespace extremal
