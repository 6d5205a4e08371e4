// SPDX-License-Identifier: GPL-3.0-or-later
/// Indices and exponents of formulas in plain text, as pages set them: "a_t^2", "Y_{m−1}", "f^(4)".
///
/// What follows "_" or "^" is an index or exponent where it is one or two letters or digits, a few characters
/// in round brackets, which stay, or anything in braces, which go. Everything else is text as it stands.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace extremal {

enum class Script { none, lowered, raised };

struct FormulaPart {
    std::string text;
    Script script = Script::none;
    bool isVariable = false;   ///< a letter alone, which is set in italics
    std::size_t from, length;  ///< of the bytes in the plain text that stand for it
};

/// All of the text, from left to right. Variables are told apart where all of it is a formula.
std::vector<FormulaPart> formulaParts(std::string_view plain, bool isFormula);

}  // namespace extremal
