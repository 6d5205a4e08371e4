// SPDX-License-Identifier: GPL-3.0-or-later
/// Inputs that are wrong in a few places: what users mistype, what files lose, and what is random.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/value.hpp"
#include "tests/fuzz/random.hpp"

namespace extremal::fuzz {

/// A text of a scalar that is likely to hurt: extreme numbers, formulas, names, control characters.
Value hostileValue(Random& random);

/// The document with one to four changes: members removed, renamed, repeated, exchanged, values replaced,
/// numbers scaled, parts of another document in their place.
Value mutated(const Value& document, const Value& donor, Random& random);

/// The text with a few bytes changed, removed, repeated or inserted.
std::string mutated(std::string_view text, Random& random);

/// A formula in these names: well-formed for the most part.
std::string formula(Random& random, const std::vector<std::string>& names, int depth);

/// A JSON pointer to a place of the document, now and then with "*", "-" or a wrong key.
std::string somePointer(const Value& document, Random& random);

}  // namespace extremal::fuzz
