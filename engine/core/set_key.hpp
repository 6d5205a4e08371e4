// SPDX-License-Identifier: GPL-3.0-or-later
/// Settings with another value of a key.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/settings.hpp"

namespace extremal {

/// Also where the key was not given, or was given as an expression, which then no longer says its value.
inline void setKey(Settings& settings, const char* key, Value value) {
    std::erase_if(settings.expressions, [&](const Value::Member& m) { return m.first == key; });
    for (auto& [name, present] : settings.keys)
        if (name == std::string_view(key)) {
            present = std::move(value);
            return;
        }
    settings.keys.emplace_back(key, std::move(value));
}

}  // namespace extremal
