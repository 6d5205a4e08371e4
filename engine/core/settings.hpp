// SPDX-License-Identifier: GPL-3.0-or-later
/// A named choice and its keys, as it stands in a scene: {"type": "gauss", "nodes": 2}.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/value.hpp"

namespace extremal {

/// After reading, every key of the descriptor is present with its default, and numbers written as expressions
/// have been evaluated in `keys` (their text is kept in `expressions` for writing the scene back).
struct Settings {
    std::string type;           ///< empty: not given
    Value::Object keys;         ///< without "type"
    Value::Object expressions;  ///< key -> the text the user wrote, for the keys given as expressions

    const Value* find(std::string_view key) const {
        for (const auto& m : keys)
            if (m.first == key) return &m.second;
        return nullptr;
    }
    double number(std::string_view key) const {
        const Value* v = find(key);
        return v && v->isNumber() ? v->asNumber() : 0;
    }
    /// The numbers of an array; empty if the key is not there.
    std::vector<double> numbers(std::string_view key) const {
        std::vector<double> all;
        if (const Value* v = find(key); v && v->isArray())
            for (const Value& entry : v->asArray())
                if (entry.isNumber()) all.push_back(entry.asNumber());
        return all;
    }
    int integer(std::string_view key) const { return static_cast<int>(number(key)); }
    std::string text(std::string_view key) const {
        const Value* v = find(key);
        return v && v->isString() ? v->asString() : std::string();
    }
    bool flag(std::string_view key) const {
        const Value* v = find(key);
        return v && v->isBool() && v->asBool();
    }
    bool operator==(const Settings&) const = default;
};

/// The settings of an object {"type": ..., key: ...} inside other settings.
inline Settings settingsOf(const Value& object) {
    Settings settings;
    for (const auto& [key, value] : object.asObject())
        if (key == "type" && value.isString())
            settings.type = value.asString();
        else
            settings.keys.emplace_back(key, value);
    return settings;
}

}  // namespace extremal
