// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/settings.hpp"

namespace extremal {

Settings::Settings(std::string itsType, Value::Object itsKeys, Value::Object itsExpressions)
    : type(std::move(itsType)), keys(std::move(itsKeys)), expressions(std::move(itsExpressions)) {}
Settings::Settings() = default;
Settings::Settings(const Settings&) = default;
Settings::Settings(Settings&&) noexcept = default;
Settings& Settings::operator=(const Settings&) = default;
Settings& Settings::operator=(Settings&&) noexcept = default;
Settings::~Settings() = default;

const Value* Settings::find(std::string_view key) const {
    for (const auto& m : keys)
        if (m.first == key) return &m.second;
    return nullptr;
}

double Settings::number(std::string_view key) const {
    const Value* v = find(key);
    return v && v->isNumber() ? v->asNumber() : 0;
}

std::vector<double> Settings::numbers(std::string_view key) const {
    std::vector<double> all;
    if (const Value* v = find(key); v && v->isArray())
        for (const Value& entry : v->asArray())
            if (entry.isNumber()) all.push_back(entry.asNumber());
    return all;
}

int Settings::integer(std::string_view key) const { return static_cast<int>(number(key)); }

std::string Settings::text(std::string_view key) const {
    const Value* v = find(key);
    return v && v->isString() ? v->asString() : std::string();
}

bool Settings::flag(std::string_view key) const {
    const Value* v = find(key);
    return v && v->isBool() && v->asBool();
}

Settings settingsOf(const Value& object) {
    Settings settings;
    for (const auto& [key, value] : object.asObject())
        if (key == "type" && value.isString())
            settings.type = value.asString();
        else
            settings.keys.emplace_back(key, value);
    return settings;
}

}  // namespace extremal
