// SPDX-License-Identifier: GPL-3.0-or-later
/// The cells of a line in the log of a study, and the lists in its head. Internal to engine/study.
#pragma once

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/core/text/text.hpp"
#include "engine/core/value.hpp"
#include "engine/study/wish.hpp"

namespace extremal {

/// Empty where it is not finite; else what reads back the same.
inline std::string cellOf(double value) { return std::isfinite(value) ? formatNumber(value) : ""; }
inline double cellNumber(const std::string& text) {
    return parseNumber(text).value_or(std::numeric_limits<double>::quiet_NaN());
}

/// The index of a point; no point has that of a text that is not a number.
inline std::size_t cellIndex(const std::string& text) {
    return static_cast<std::size_t>(parseNumber(text).value_or(1e18));
}
/// ",<value>" for each.
inline std::string cellsText(std::initializer_list<double> values) {
    std::string text;
    for (const double value : values) text += ',' + cellOf(value);
    return text;
}

inline std::vector<std::string> cellsOf(std::string_view line) {
    std::vector<std::string> cells(1);
    for (const char c : line)
        if (c == ',')
            cells.emplace_back();
        else
            cells.back() += c;
    return cells;
}

/// A text as one cell: without commas.
inline std::string withoutCommas(std::string text) {
    for (std::size_t at = 0; (at = text.find_first_of("%,\n", at)) != std::string::npos; at += 3)
        text.replace(at, 1, text[at] == '%' ? "%25" : text[at] == ',' ? "%2C" : "%0A");
    return text;
}
inline std::string withCommas(std::string text) {
    for (std::size_t at = 0; (at = text.find('%', at)) != std::string::npos; ++at) {
        const std::string code = text.substr(at, 3);
        text.replace(at, 3, code == "%2C" ? "," : code == "%0A" ? "\n" : "%");
    }
    return text;
}

/// By its name; converged for anything else.
inline Outcome outcomeOf(std::string_view text) {
    for (int k = 0; k <= static_cast<int>(Outcome::stopped); ++k)
        if (name(static_cast<Outcome>(k)) == text) return static_cast<Outcome>(k);
    return Outcome::converged;
}

/// Texts or numbers as an array, and back.
template <class Item>
Value arrayOf(const std::vector<Item>& items) {
    Value::Array all;
    for (const Item& item : items) all.emplace_back(item);
    return all;
}
inline std::vector<std::string> textsOf(const Value& array) {
    std::vector<std::string> all;
    for (const Value& text : array.asArray()) all.push_back(text.asString());
    return all;
}
inline Value valueOf(const std::vector<Wish>& wishes) {
    Value::Array all;
    for (const Wish& wish : wishes) all.push_back(Value::Array{wish.metric, wish.value});
    return all;
}
inline std::vector<Wish> wishesOf(const Value& array) {
    std::vector<Wish> all;
    for (const Value& wish : array.asArray())
        all.push_back({wish.asArray()[0].asString(), wish.asArray()[1].asNumber()});
    return all;
}
inline std::vector<double> numbersOf(const Value& array) {
    std::vector<double> all;
    for (const Value& number : array.asArray()) all.push_back(number.asNumber());
    return all;
}

}  // namespace extremal
