// SPDX-License-Identifier: GPL-3.0-or-later
/// JSON text to a Value and back.
///
/// Reading is strict: one document, UTF-8, no duplicate keys, only finite numbers, at most 200 levels
/// (refused as soon as they are met, whatever the length of the text). Writing is byte-stable: reading and
/// writing what was written gives the same bytes.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/value.hpp"

namespace extremal {

/// Deepest nesting of arrays and objects that is read.
inline constexpr int maxJsonDepth = 200;
/// Most values that are read from one text, objects and arrays among them.
inline constexpr int mostJsonValues = 2'000'000;

/// Throws InvalidScene: for bad syntax the message ends in "line L, column C"; for a duplicate key, a number
/// out of range or too many levels the pointer says where.
Value parseJson(std::string_view text);

/// The Value as JSON, indented by two spaces, short arrays and objects on one line, ending in a newline.
/// Numbers that are not finite, which JSON cannot express, become null.
std::string writeJson(const Value& value);

/// The Value as JSON on one line, without a newline.
std::string writeCompactJson(const Value& value);

/// What a value is, for messages: 12, "text" (shortened), an array, an object, true, null.
std::string describeValue(const Value& value);

}  // namespace extremal
