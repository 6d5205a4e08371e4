// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/passport/formula_parts.hpp"

#include <algorithm>
#include <cctype>

namespace extremal {
namespace {

bool isAlphanumeric(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }
bool isLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// Of the index or exponent that begins there; 0: none does.
std::size_t scriptLength(std::string_view text) {
    constexpr std::size_t most = 6;
    if (text.starts_with('{')) {
        const std::size_t end = text.find('}');
        return end == std::string_view::npos ? 0 : end + 1;
    }
    if (text.starts_with('(')) {
        const std::size_t end = text.find(')');
        return end <= most ? end + 1 : 0;
    }
    const auto end = std::find_if_not(text.begin(), text.end(), isAlphanumeric);
    return end - text.begin() <= 2 ? static_cast<std::size_t>(end - text.begin()) : 0;
}

/// Appends text without indices, its variables apart from the rest.
void addText(std::vector<FormulaPart>& parts, std::string_view plain, std::size_t from, std::size_t end,
             bool isFormula) {
    std::size_t begin = from;
    const auto addUpTo = [&](std::size_t at) {
        if (at > begin)
            parts.push_back(
                {std::string(plain.substr(begin, at - begin)), Script::none, false, begin, at - begin});
    };
    for (std::size_t i = from; isFormula && i < end; ++i) {
        const bool isAlone = isLetter(plain[i]) && (i == 0 || !isAlphanumeric(plain[i - 1])) &&
                             (i + 1 >= plain.size() || !isAlphanumeric(plain[i + 1]));
        if (!isAlone) continue;
        addUpTo(i);
        parts.push_back({std::string(1, plain[i]), Script::none, true, i, 1});
        begin = i + 1;
    }
    addUpTo(end);
}

}  // namespace

std::vector<FormulaPart> formulaParts(std::string_view plain, bool isFormula) {
    std::vector<FormulaPart> parts;
    std::size_t from = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        const bool isMark = plain[i] == '_' || plain[i] == '^';
        const std::size_t length = isMark ? scriptLength(plain.substr(i + 1)) : 0;
        if (length == 0) continue;
        addText(parts, plain, from, i, isFormula);
        std::string_view inside = plain.substr(i + 1, length);
        if (inside.starts_with('{')) inside = inside.substr(1, length - 2);
        const bool isVariable = isFormula && inside.size() == 1 && isLetter(inside[0]);
        parts.push_back({std::string(inside), plain[i] == '_' ? Script::lowered : Script::raised, isVariable,
                         i, length + 1});
        i += length;
        from = i + 1;
    }
    addText(parts, plain, from, plain.size(), isFormula);
    return parts;
}

}  // namespace extremal
