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

    // Compiled once.
    Settings(std::string type, Value::Object keys, Value::Object expressions);
    Settings();
    Settings(const Settings&);
    Settings(Settings&&) noexcept;
    Settings& operator=(const Settings&);
    Settings& operator=(Settings&&) noexcept;
    ~Settings();

    const Value* find(std::string_view key) const;
    double number(std::string_view key) const;
    /// The numbers of an array; empty if the key is not there.
    std::vector<double> numbers(std::string_view key) const;
    int integer(std::string_view key) const;
    std::string text(std::string_view key) const;
    bool flag(std::string_view key) const;
    bool operator==(const Settings&) const = default;
};

/// The settings of an object {"type": ..., key: ...} inside other settings.
Settings settingsOf(const Value& object);

}  // namespace extremal
