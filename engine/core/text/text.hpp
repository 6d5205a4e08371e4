// SPDX-License-Identifier: GPL-3.0-or-later
/// Small text helpers: numbers in files, suggestions for misspelt names, and file names made from labels.
///
/// Numbers go through std::to_chars and std::from_chars alone, so that no locale changes a file.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace extremal {

/// The shortest text that reads back as the same double: "0.1", "1e-12", "10000"; "nan", "inf" if not finite.
std::string formatNumber(double value);

/// The same, but whole numbers below 1e15 in full: 100000 and not 1e+05. For counts, and for JSON.
std::string formatCount(double value);

/// At most `digits` significant digits, for people: "3.14", "1.2e-07".
std::string formatNumber(double value, int digits);

/// The double a whole text stands for ("1e-3"); empty if there is anything else in it. May be infinite or
/// NaN.
std::optional<double> parseNumber(std::string_view text);

/// Number of single-character insertions, deletions, replacements and swaps of neighbours between two words,
/// upper and lower case alike.
std::size_t editDistance(std::string_view a, std::string_view b);

/// The candidate that the user most likely meant; empty if none is similar.
std::string nearestName(std::string_view name, const std::vector<std::string>& candidates);

/// A hint for an unknown name: "did you mean \"gauss\"?", or the candidates where none is near.
std::string suggestName(std::string_view name, const std::vector<std::string>& candidates);

/// "a, b and c".
std::string joinNames(const std::vector<std::string>& names);

/// A label in ASCII lower case, letters with accents and Greek ones spelt out, every run of other characters
/// one '-', trimmed: "Galerkin 4" -> "galerkin-4", "Störmer-Verlet" -> "stoermer-verlet".
std::string slug(std::string_view label);

/// One slug per label, equal ones told apart by "-2", "-3"; none is one of `taken`, and none is empty.
std::vector<std::string> uniqueSlugs(const std::vector<std::string>& labels,
                                     const std::vector<std::string>& taken = {});

/// Position of the first byte that is not UTF-8 (no overlong forms, no surrogates), or npos.
std::size_t firstInvalidUtf8(std::string_view text);

/// Number of code points of a UTF-8 text: its width in a terminal, as far as we need it.
std::size_t codePoints(std::string_view text);

}  // namespace extremal
