// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/changes.hpp"

#include <string>

#include "engine/scene/read/pointer.hpp"

namespace extremal {
namespace {

void addChanges(const Value& before, const Value& after, const std::string& place, std::vector<Edit>& edits) {
    if (before == after) return;
    if (before.isObject() && after.isObject()) {
        for (const auto& [key, value] : before.asObject())
            if (!after.find(key)) edits.push_back({childPointer(place, key), std::nullopt});
        for (const auto& [key, value] : after.asObject()) {
            const Value* const was = before.find(key);
            if (was)
                addChanges(*was, value, childPointer(place, key), edits);
            else
                edits.push_back({childPointer(place, key), value});
        }
        return;
    }
    const bool areLists =
        before.isArray() && after.isArray() && before.asArray().size() == after.asArray().size();
    if (!areLists) return edits.push_back({place, after});
    for (std::size_t i = 0; i < after.asArray().size(); ++i)
        addChanges(before.asArray()[i], after.asArray()[i], place + "/" + std::to_string(i), edits);
}

}  // namespace

std::vector<Edit> changesBetween(const Value& before, const Value& after) {
    std::vector<Edit> edits;
    addChanges(before, after, "", edits);
    return edits;
}

}  // namespace extremal
