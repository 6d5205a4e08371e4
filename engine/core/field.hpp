// SPDX-License-Identifier: GPL-3.0-or-later
/// Descriptors: one table entry describes one parameter of a model, space, rule, scheme or baseline.
/// They are the single source for JSON keys, range checks, forms, `extremal list`, the schema and the
/// handbook.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "engine/core/value.hpp"

namespace extremal {

/// numbers: an array of a fixed length; names: an array of texts; constants: an object of numbers by names of
/// the user's; formulas: an array of expressions, in the variables that `components` names and the parameters
/// of the model, whose values are put in place; definitions: an object of such, whose names formulas beside
/// it use; terms: an expression, or an object of expressions by the names of the terms of a sum.
enum class FieldType {
    number,
    numbers,
    integer,
    boolean,
    text,
    choice,
    names,
    constants,
    formulas,
    definitions,
    terms,
    json
};

/// What is known about one parameter, independent of the type that owns it.
struct FieldInfo {
    std::string key;     ///< JSON key: "k"
    std::string title;   ///< "stiffness"
    std::string symbol;  ///< as in formulas: "k"
    std::string unit;    ///< "N/m"; empty if dimensionless
    FieldType type = FieldType::number;
    Value fallback;  ///< default; null if the key is required
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool isMinExcluded = false;  ///< true: the value must be greater than min
    std::vector<std::string>
        choices;  ///< for FieldType::choice; the values allowed of a FieldType::integer, if any
    std::vector<std::string> components;  ///< for FieldType::numbers: what each number is called; gives their
                                          ///< count. formulas, definitions: the variables in them
    bool isOptional = false;              ///< a key without a default that may be omitted
    std::string description;              ///< one line
    std::string whyLimits;                ///< hint if a value is out of range; may be empty
    Value example;                        ///< the value in a new scene if there is no default

    // Compiled once: hundreds of descriptors are made and handed on.
    FieldInfo();
    FieldInfo(const FieldInfo&);
    FieldInfo(FieldInfo&&) noexcept;
    FieldInfo& operator=(const FieldInfo&);
    FieldInfo& operator=(FieldInfo&&) noexcept;
    ~FieldInfo();

    const Value& firstValue() const { return example.isNull() ? fallback : example; }
};

/// A number field of `Owner`: its descriptor and where it is stored.
template <class Owner>
struct Field {
    double Owner::*member;
    FieldInfo info;
};

// Descriptors of the usual kinds. Further properties (symbol, limits, unit, ...) are set on the result.

/// A number without limits or a symbol.
FieldInfo numberField(std::string key, std::string title, std::string unit, double fallback,
                      std::string description);
/// A positive number; the key is the symbol, too.
FieldInfo positive(std::string key, std::string title, std::string unit, double fallback,
                   std::string description);
/// A number that may be zero but not negative.
FieldInfo notNegative(std::string key, std::string title, std::string unit, double fallback,
                      std::string description);
/// A few numbers in an array, one per component.
FieldInfo numbers(std::string key, std::string title, std::string unit, std::vector<std::string> components,
                  Value fallback, std::string description);
/// An integer from min to max, under the title of its key. Fallback null: required.
FieldInfo integerField(std::string key, std::string symbol, double min, double max, Value fallback,
                       std::string description);
/// One of a few integers, under the title of its key.
FieldInfo integerChoice(std::string key, std::vector<std::string> choices, double fallback,
                        std::string description);
/// One of a few texts; the first one is the default.
FieldInfo choiceField(std::string key, std::string title, std::vector<std::string> choices,
                      std::string description);
/// Yes or no, under the title of its key.
FieldInfo flagField(std::string key, bool fallback, std::string description);
/// A text of the user's. Fallback null: required.
FieldInfo textField(std::string key, std::string symbol, Value fallback, std::string description);
/// Constants by names of the user's: none, if left out.
FieldInfo constantsField(std::string key, std::string description);
/// "parameters": constants that may be expressions in each other.
FieldInfo parametersField(Value::Object example = {});
/// A list of names of the user's, under the title of its key.
FieldInfo namesField(std::string key, Value::Array example, std::string description);
/// A formula, or an object of such terms by name.
FieldInfo termsField(std::string key, std::string title, Value example, std::string description);
/// Expressions in variables and parameters of the model. Fallback null: required, unless isOptional.
FieldInfo formulasField(std::string key, std::vector<std::string> variables, Value fallback,
                        std::string description);
/// Names for such expressions: none, if left out.
FieldInfo definitionsField(std::string key, std::vector<std::string> variables, std::string description);
/// Any value that the field's owner reads itself. Fallback null: it may be required, or optional
/// (isOptional).
FieldInfo jsonField(std::string key, std::string title, std::string symbol, Value fallback,
                    std::string description);
/// The same without a default, which may be omitted; its symbol is the key.
FieldInfo optionalJsonField(std::string key, std::string title, std::string description);

}  // namespace extremal
