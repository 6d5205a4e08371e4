// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/written_out.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/indexed.hpp"
#include "engine/core/text/invalid_text.hpp"
#include "engine/model/typed/formula.hpp"

namespace extremal::typed {
namespace {

constexpr const char* keysWithFormulas[] = {"lagrangian", "constraints", "forces", "rolling",
                                            "walls",      "dissipation", "let",    "group"};

bool hasIndex(const Value& value) {
    if (value.isString()) return extremal::hasIndices(value.asString());
    if (value.isArray()) return std::any_of(value.asArray().begin(), value.asArray().end(), hasIndex);
    return value.isObject() &&
           std::any_of(value.asObject().begin(), value.asObject().end(), [](const Value::Member& m) {
               return extremal::hasIndices(m.first) || hasIndex(m.second);
           });
}

bool isOneOf(const std::string& key, std::span<const char* const> keys) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

class Expansion {
public:
    explicit Expansion(NamedNumbers parameters) : parameters_(std::move(parameters)) {}

    Value names(const Value& list, const std::string& pointer) {
        Value::Array all;
        for (std::size_t i = 0; i < list.asArray().size(); ++i) {
            const Value& entry = list.asArray()[i];
            if (!entry.isString()) return list;
            for (const IndexedName& n : namesAt(entry.asString(), pointer + "/" + std::to_string(i)))
                all.emplace_back(n.name);
        }
        return all;
    }
    /// A text, texts by name, or lists of them.
    Value texts(const Value& value, const std::string& pointer, const IndexedName& of = {}) {
        if (value.isString()) return text(value.asString(), pointer, of);
        if (value.isArray()) {
            Value::Array all;
            for (const Value& each : value.asArray())
                all.push_back(texts(each, pointer + "/" + std::to_string(all.size()), of));
            return all;
        }
        if (!value.isObject()) return value;
        Value::Object all;
        for (const auto& [name, own] : value.asObject())
            for (const IndexedName& n : namesAt(name, pointer + "/" + name))
                all.emplace_back(n.name, texts(own, pointer + "/" + n.name, n.index.empty() ? of : n));
        return all;
    }

private:
    std::vector<IndexedName> namesAt(const std::string& name, const std::string& pointer) {
        const auto made = atPlace(pointer, name, [&] { return namesOf(name, parameters_); });
        names_ += made.size();
        if (names_ > 4 * maxCoordinates)
            throw InvalidScene(pointer, "makes more than " + std::to_string(4 * maxCoordinates) + " names");
        return made;
    }
    std::string text(const std::string& typed, const std::string& pointer, const IndexedName& of) {
        std::string made =
            atPlace(pointer, typed, [&] { return extremal::writtenOut(typed, parameters_, of); });
        length_ += made.size();
        if (length_ > maxExpandedLength)
            throw InvalidScene(pointer, "is too long when all sums are written out: the limit is " +
                                            std::to_string(maxExpandedLength) + " characters");
        return made;
    }

    NamedNumbers parameters_;
    std::size_t names_ = 0, length_ = 0;
};

}  // namespace

bool hasIndices(const Settings& settings) {
    const auto has = [&](const char* key) {
        const Value* const value = settings.find(key);
        return value && hasIndex(*value);
    };
    return has("coordinates") || std::any_of(std::begin(keysWithFormulas), std::end(keysWithFormulas), has);
}

Settings writtenOut(const Settings& settings) {
    if (!hasIndices(settings)) return settings;
    NamedNumbers parameters;
    if (const Value* const given = settings.find("parameters"); given && given->isObject())
        for (const auto& [name, value] : given->asObject())
            if (value.isNumber()) parameters.emplace_back(name, value.asNumber());
    Expansion expansion(std::move(parameters));
    Settings made = settings;
    for (auto& [key, value] : made.keys) {
        const std::string pointer = "/" + key;
        if (key == "coordinates" && value.isArray()) value = expansion.names(value, pointer);
        if (isOneOf(key, keysWithFormulas)) value = expansion.texts(value, pointer);
    }
    return made;
}

Settings startWrittenOut(const Settings& initial, const NamedNumbers& parameters) {
    Settings made = initial;
    Expansion expansion(parameters);
    for (auto& [key, value] : made.keys)
        if (hasIndex(value)) value = expansion.texts(value, "/" + key);
    return made;
}

}  // namespace extremal::typed
