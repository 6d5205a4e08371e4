// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/text/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>

namespace extremal {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool isSlugCharacter(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); }

/// Length of the UTF-8 sequence at the start of `s`, or 0 if it is not one.
std::size_t sequenceLength(std::string_view s) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(s[i]); };
    const unsigned char first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || s.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    if (first == 0xE0 && byte(1) < 0xA0) return 0;  // overlong
    if (first == 0xED && byte(1) > 0x9F) return 0;  // surrogates
    if (first == 0xF0 && byte(1) < 0x90) return 0;  // overlong
    if (first == 0xF4 && byte(1) > 0x8F) return 0;  // beyond U+10FFFF
    return length;
}

/// A letter outside ASCII by those of ASCII; empty where it is not known.
std::string_view transliterated(std::string_view letter) {
    struct Row {
        std::string_view letters, plain;  ///< each letter between blanks
    };
    static constexpr Row rows[] = {{" ä Ä æ Æ ", "ae"},
                                   {" ö Ö ø Ø œ Œ ", "oe"},
                                   {" ü Ü ", "ue"},
                                   {" ß ", "ss"},
                                   {" à á â ã å ā ą À Á Â Ã Å Ā Ą ", "a"},
                                   {" ç ć č Ç Ć Č ", "c"},
                                   {" ď đ Ď Đ ", "d"},
                                   {" è é ê ë ē ę ě È É Ê Ë Ē Ę Ě ", "e"},
                                   {" ğ Ğ ", "g"},
                                   {" ì í î ï ī ı Ì Í Î Ï Ī İ ", "i"},
                                   {" ł ľ Ł Ľ ", "l"},
                                   {" ñ ń ň Ñ Ń Ň ", "n"},
                                   {" ò ó ô õ ō ő Ò Ó Ô Õ Ō Ő ", "o"},
                                   {" ř Ř ", "r"},
                                   {" ś š ş Ś Š Ş ", "s"},
                                   {" ť ţ Ť Ţ ", "t"},
                                   {" ù ú û ū ů ű Ù Ú Û Ū Ů Ű ", "u"},
                                   {" ý ÿ Ý ", "y"},
                                   {" ź ż ž Ź Ż Ž ", "z"},
                                   {" α Α ", "alpha"},
                                   {" β Β ", "beta"},
                                   {" γ Γ ", "gamma"},
                                   {" δ Δ ", "delta"},
                                   {" ε ϵ ", "epsilon"},
                                   {" η ", "eta"},
                                   {" θ Θ ϑ ", "theta"},
                                   {" κ ", "kappa"},
                                   {" λ Λ ", "lambda"},
                                   {" μ µ ", "mu"},
                                   {" ν ", "nu"},
                                   {" ξ Ξ ", "xi"},
                                   {" π Π ", "pi"},
                                   {" ρ ", "rho"},
                                   {" σ Σ ", "sigma"},
                                   {" τ ", "tau"},
                                   {" φ Φ ϕ ", "phi"},
                                   {" χ ", "chi"},
                                   {" ψ Ψ ", "psi"},
                                   {" ω Ω ", "omega"},
                                   {" ζ ", "zeta"}};
    if (letter.size() < 2) return {};
    for (const Row& row : rows)
        if (row.letters.find(letter) != std::string_view::npos) return row.plain;
    return {};
}

}  // namespace

std::string formatNumber(double value) {
    std::array<char, 32> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    return {buffer.data(), end};
}

std::string formatCount(double value) {
    if (value != std::trunc(value) || std::fabs(value) >= 1e15) return formatNumber(value);
    return std::to_string(static_cast<long long>(value));
}

std::string formatNumber(double value, int digits) {
    std::array<char, 64> buffer;
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits)
            .ptr;
    return {buffer.data(), end};
}

std::optional<double> parseNumber(std::string_view text) {
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

std::size_t editDistance(std::string_view a, std::string_view b) {
    // Optimal string alignment with three rows: previous(j) is the distance of a[0, i-1) to b[0, j).
    std::vector<std::size_t> older(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        current[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t differs = lower(a[i - 1]) != lower(b[j - 1]);
            current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + differs});
            if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
                current[j] = std::min(current[j], older[j - 2] + 1);
        }
        std::swap(older, previous);
        std::swap(previous, current);
    }
    return previous[b.size()];
}

std::string nearestName(std::string_view name, const std::vector<std::string>& candidates) {
    if (name.size() > 200) return {};
    std::string best;
    std::size_t bestDistance = std::max<std::size_t>(1, std::min<std::size_t>(name.size() / 2, 4)) + 1;
    for (const std::string& candidate : candidates) {
        std::size_t distance = editDistance(name, candidate);
        // What a user began to type, or knows as a part of the name, is near as well.
        const bool isPart = name.size() >= 4 && candidate.find(name) != std::string::npos;
        if (isPart) distance = std::min<std::size_t>(distance, 2);
        if (distance < bestDistance) {
            bestDistance = distance;
            best = candidate;
        }
    }
    return best;
}

std::string joinNames(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
        text += names[i];
    }
    return text;
}

std::string suggestName(std::string_view name, const std::vector<std::string>& candidates) {
    if (const std::string near = nearestName(name, candidates); !near.empty())
        return "did you mean \"" + near + "\"?";
    return candidates.empty() ? std::string() : "known: " + joinNames(candidates);
}

std::string slug(std::string_view label) {
    std::string text;
    bool isGap = false;
    const auto add = [&](std::string_view letters) {
        if (isGap && !text.empty()) text += '-';
        isGap = false;
        text += letters;
    };
    for (std::size_t i = 0; i < label.size();) {
        const std::size_t length = std::max<std::size_t>(1, sequenceLength(label.substr(i)));
        const std::string_view letter = label.substr(i, length);
        i += length;
        const char c = lower(letter.front());
        if (isSlugCharacter(c))
            add({&c, 1});
        else if (const std::string_view plain = transliterated(letter); !plain.empty())
            add(plain);
        else
            isGap = true;
    }
    return text;
}

std::vector<std::string> uniqueSlugs(const std::vector<std::string>& labels,
                                     const std::vector<std::string>& taken) {
    std::set<std::string> used(taken.begin(), taken.end());
    std::vector<std::string> slugs;
    for (const std::string& label : labels) {
        std::string base = slug(label);
        if (base.empty()) base = "scheme";
        std::string candidate = base;
        for (int n = 2; !used.insert(candidate).second; ++n) candidate = base + "-" + std::to_string(n);
        slugs.push_back(candidate);
    }
    return slugs;
}

std::size_t firstInvalidUtf8(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = sequenceLength(text.substr(i));
        if (length == 0) return i;
        i += length;
    }
    return std::string_view::npos;
}

std::size_t codePoints(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace extremal
