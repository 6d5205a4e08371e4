/// Descriptors: one table entry describes one parameter of a model, space, rule, scheme or baseline.
/// They are the single source for JSON keys, range checks, forms, `extremal list`, the schema and the handbook.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "engine/core/value.hpp"

namespace extremal {

/// numbers: an array of a fixed length; names: an array of texts; constants: an object of numbers by names of the user's.
enum class FieldType { number, numbers, integer, boolean, text, choice, names, constants, json };

/// What is known about one parameter, independent of the type that owns it.
struct FieldInfo {
    std::string key;       ///< JSON key: "k"
    std::string title;     ///< "stiffness"
    std::string symbol;    ///< as in formulas: "k"
    std::string unit;      ///< "N/m"; empty if dimensionless
    FieldType type = FieldType::number;
    Value fallback;        ///< default; null if the key is required
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool isMinExcluded = false;        ///< true: the value must be greater than min
    std::vector<std::string> choices;  ///< for FieldType::choice; the values allowed of a FieldType::integer, if any
    std::vector<std::string> components;  ///< for FieldType::numbers: what each number is called; gives their count
    bool isOptional = false;           ///< a key without a default that may be left out
    std::string description;           ///< one line
    std::string whyLimits;             ///< hint where a value is out of range; may be empty
    Value example;                     ///< what a new scene starts from where there is no default

    const Value& firstValue() const { return example.isNull() ? fallback : example; }
};

/// A number field of `Owner`: its descriptor and where it is stored.
template <class Owner>
struct Field {
    double Owner::*member;
    FieldInfo info;
};

/// Descriptor of a positive number: the most frequent case.
inline FieldInfo positive(std::string key, std::string title, std::string unit, double fallback, std::string description) {
    FieldInfo f;
    f.symbol = key;
    f.key = std::move(key);
    f.title = std::move(title);
    f.unit = std::move(unit);
    f.fallback = fallback;
    f.min = 0;
    f.isMinExcluded = true;
    f.description = std::move(description);
    return f;
}

/// Descriptor of a number that may be zero but not negative.
inline FieldInfo notNegative(std::string key, std::string title, std::string unit, double fallback, std::string description) {
    FieldInfo f = positive(std::move(key), std::move(title), std::move(unit), fallback, std::move(description));
    f.isMinExcluded = false;
    return f;
}

/// Descriptor of a few numbers in an array, one per component; every one within min and max.
inline FieldInfo numbers(std::string key, std::string title, std::string unit, std::vector<std::string> components,
                         Value fallback, std::string description) {
    FieldInfo f;
    f.symbol = key;
    f.key = std::move(key);
    f.title = std::move(title);
    f.unit = std::move(unit);
    f.type = FieldType::numbers;
    f.components = std::move(components);
    f.fallback = std::move(fallback);
    f.description = std::move(description);
    return f;
}

}  // namespace extremal
