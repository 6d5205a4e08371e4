// SPDX-License-Identifier: GPL-3.0-or-later
/// The kinds of input that are fuzzed. A case is a text: it is made from two numbers, or read from
/// tests/fuzz/cases.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/random.hpp"

namespace extremal::fuzz {

struct Kind {
    std::string_view name;
    std::string (*make)(Random&);
    /// What is wrong with how the program took the text; empty: nothing. Whatever the text is, it is read or
    /// refused with findings that have a place and a message; a scene that is valid reads the same after it
    /// was written, runs, and stops when it is asked to.
    std::string (*judge)(const std::string& text);
};

/// scene (a preset with changes in its structure), bytes (a preset with changes in its text), set (overrides
/// of a preset), expression (a formula, alone and as a Lagrangian), reference (a CSV file).
const std::vector<Kind>& kinds();

/// The same text for the same numbers.
std::string makeCase(const Kind& kind, std::uint64_t seed, std::uint64_t number);

/// judge, with every exception that comes out as something wrong.
std::string judgeCase(const Kind& kind, const std::string& text);

}  // namespace extremal::fuzz
