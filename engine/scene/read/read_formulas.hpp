// SPDX-License-Identifier: GPL-3.0-or-later
/// Arrays of expressions, and names for expressions, as functions of a space and nodes of a rule are typed.
/// Internal to engine/scene.
#pragma once

#include <string>

#include "engine/scene/read/reader.hpp"

namespace extremal {

/// `object` is what the field is a member of: its definitions may be used. Stored with parameters in place;
/// what was written is kept where there were any.
bool readFormulas(Reader& reader, const Value& object, const Value& value, const std::string& pointer,
                  const FieldInfo& field, Settings& settings);
bool readDefinitions(Reader& reader, const Value& value, const std::string& pointer, const FieldInfo& field,
                     Settings& settings);

}  // namespace extremal
