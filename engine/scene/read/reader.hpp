// SPDX-License-Identifier: GPL-3.0-or-later
/// What reading a scene shares between its parts: the findings, and the values of the model's parameters by
/// name. Internal to engine/scene. Every function records what is wrong and goes on, so that all errors are
/// found.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/core/settings.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/family/findings.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

/// What a number may be.
struct Limits {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool isMinExcluded = false;
    bool isInteger = false;
    std::string hint = {};  ///< where a value is not admitted

    static Limits positive() { return {0, std::numeric_limits<double>::infinity(), true, false}; }
    static Limits of(const FieldInfo& field);
    bool admit(double value) const;
    std::string describe() const;  ///< "a positive finite number", "an integer from 1 to 24"
};

class Reader : public Findings {
public:
    /// Parameters of the model that expressions may use. A parameter whose own value is wrong, and already
    /// reported, is there without a value: what depends on it is not reported again.
    std::map<std::string, std::optional<double>, std::less<>> parameters;
    Settings model;                       ///< as read; no type: it is wrong
    bool hasUnknownModel = false;         ///< no name can be judged
    std::vector<std::string> stateNames;  ///< of the model, where it has them: what formulas of states are of

    /// Each returns an empty result after recording an error.
    std::optional<Number> number(const Value& value, const std::string& pointer, const Limits& limits);
    std::optional<bool> flag(const Value& value, const std::string& pointer);
    std::optional<std::string> text(const Value& value, const std::string& pointer);
    /// A text of one line: no control characters, at most 200 characters.
    std::optional<std::string> line(const Value& value, const std::string& pointer);
    /// A line that is a cell of CSV files: not empty, and not what a spreadsheet takes for a formula.
    std::optional<std::string> label(const Value& value, const std::string& pointer);
    bool isObject(const Value& value, const std::string& pointer);
    bool isArray(const Value& value, const std::string& pointer, const std::string& what);
    /// Whether an array or an object has no more than so many entries.
    bool hasAtMost(const Value& value, const std::string& pointer, const std::string& what, std::size_t most);

    /// An error for every key of the object that is not known, up to a hundred.
    void checkKeys(const Value& object, const std::string& pointer, const std::vector<std::string>& known);
    /// An error that names the nearest of the known names.
    void unknownName(const std::string& pointer, std::string_view kind, std::string_view name,
                     const std::vector<std::string>& known);

    /// The value of an expression; not finite is an error.
    std::optional<double> evaluateText(const std::string& text, const std::string& pointer);
    /// An expression in one variable and the parameters. Empty after recording an error, or if a parameter in
    /// it is wrong.
    std::optional<ViewCurve> curve(const std::string& text, const std::string& pointer,
                                   const std::string& variable);
    /// The values of the parameters in an expression in several variables and the parameters, which those
    /// hide; empty as above.
    std::optional<std::vector<std::pair<std::string, double>>> function(
        const std::string& text, const std::string& pointer, const std::vector<std::string>& variables);
    /// An expression in variables and the parameters, with the values of these in place. Empty after
    /// recording an error, or if a parameter in it is wrong.
    std::optional<std::string> formula(const std::string& text, const std::string& pointer,
                                       const std::vector<std::string>& variables);
};

/// Defaults of keys whose descriptor has none because they follow from something else (nodes from the
/// degree).
using DerivedDefault = std::optional<Value> (*)(std::string_view type, std::string_view key,
                                                const Settings& context);

/// Reads {"type": NAME, ...} (or just "NAME") against a catalogue's entries; every key of the entry is then
/// present.
std::optional<Settings> readSettings(Reader& reader, const Value& value, const std::string& pointer,
                                     std::string_view kind, const std::vector<const CatalogItem*>& items,
                                     DerivedDefault derived = nullptr, const Settings& context = {});

/// Reads the members of an object by their descriptors alone; `ignored` are keys handled elsewhere.
bool readFields(Reader& reader, const Value& object, const std::string& pointer,
                const std::vector<FieldInfo>& fields, const std::vector<std::string>& ignored,
                Settings& settings, DerivedDefault derived = nullptr, const Settings& context = {});

/// The settings as {"type": NAME, keys...}, with expressions as they were written.
Value settingsValue(const Settings& settings, std::string_view typeKey = "type");
Value numberValue(const Number& number);

}  // namespace extremal
