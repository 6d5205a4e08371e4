// SPDX-License-Identifier: GPL-3.0-or-later
/// JSON pointers (RFC 6901): "/schemes/1/step" names a place in a scene; "~1" stands for "/" and "~0" for
/// "~".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/value.hpp"

namespace extremal {

/// Appends "/token", escaped.
void appendToken(std::string& pointer, std::string_view token);

/// The pointer of a member or an element.
std::string childPointer(std::string_view pointer, std::string_view token);
std::string childPointer(std::string_view pointer, std::size_t index);

/// The unescaped tokens; empty if the text is not a pointer (must be "" or start with '/').
std::optional<std::vector<std::string>> splitPointer(std::string_view pointer);

/// An array index: digits only, no leading zero; empty otherwise.
std::optional<std::size_t> arrayIndex(std::string_view token);

/// The member or element that a token names, or null.
const Value* childOf(const Value& parent, std::string_view token);
/// The value at a place, or null.
const Value* valueAt(const Value& root, std::string_view pointer);

}  // namespace extremal
