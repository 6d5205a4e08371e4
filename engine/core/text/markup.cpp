// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/text/markup.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>

#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

struct CodePoint {
    std::uint32_t number = 0;
    std::size_t length = 1;  ///< bytes
    bool isValid = false;
};

/// The first character of a text that is not empty; a byte that does not begin one is not valid.
CodePoint firstOf(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text[0]);
    if (lead < 0x80) return {lead, 1, true};
    const std::size_t length = lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    if (length > text.size() || firstInvalidUtf8(text.substr(0, length)) != std::string_view::npos)
        return {lead, 1, false};
    std::uint32_t number = lead & (0xffu >> (length + 1));
    for (std::size_t k = 1; k < length; ++k)
        number = number << 6 | (static_cast<unsigned char>(text[k]) & 0x3fu);
    return {number, length, true};
}

bool isLineEnd(std::uint32_t c) {
    return (c >= 0x0a && c <= 0x0d) || c == 0x85 || c == 0x2028 || c == 0x2029;
}

/// Control characters, marks of direction, the mark of byte order and noncharacters.
bool isInvisible(std::uint32_t c) {
    return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x061c || c == 0x200e || c == 0x200f ||
           (c >= 0x202a && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069) || c == 0xfeff ||
           (c >= 0xfdd0 && c <= 0xfdef) || (c & 0xfffe) == 0xfffe;
}

std::string numberOf(std::uint32_t c) {
    char text[16];
    std::snprintf(text, sizeof text, "U+%04X", static_cast<unsigned>(c));
    return text;
}

std::string visible(std::string_view text, bool keepsLines) {
    std::string out;
    while (!text.empty()) {
        const CodePoint c = firstOf(text);
        const bool isBreak = c.isValid && (c.number == '\t' || isLineEnd(c.number));
        if (isBreak && !(keepsLines && (c.number == '\t' || c.number == '\n' || c.number == '\r')))
            out += ' ';
        else if (!isBreak && (!c.isValid || isInvisible(c.number)))
            out += c.isValid ? numberOf(c.number) : numberOf(0xfffd);
        else
            out += text.substr(0, c.length);
        text.remove_prefix(c.length);
    }
    return out;
}

}  // namespace

std::string replaced(std::string_view text, std::span<const Replacement> by) {
    std::string out;
    while (!text.empty()) {
        const auto found = std::find_if(by.begin(), by.end(),
                                        [&](const Replacement& r) { return text.starts_with(r.first); });
        out += found == by.end() ? text.substr(0, 1) : found->second;
        text.remove_prefix(found == by.end() ? 1 : found->first.size());
    }
    return out;
}

std::string visibleLine(std::string_view text) { return visible(text, false); }
std::string visibleText(std::string_view text) { return visible(text, true); }

std::string markupText(std::string_view text) {
    static constexpr std::array<Replacement, 4> special = {
        {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}}};
    return replaced(visibleText(text), special);
}

std::string markdownText(std::string_view text) {
    // A link or a picture needs "](" or "][", and a target "]:"; an entity begins with "&".
    static constexpr std::array<Replacement, 10> special = {{{"\\", "\\\\"},
                                                             {"*", "\\*"},
                                                             {"_", "\\_"},
                                                             {"|", "\\|"},
                                                             {"<", "\\<"},
                                                             {"`", "\\`"},
                                                             {"](", "\\]("},
                                                             {"][", "\\]["},
                                                             {"]:", "\\]:"},
                                                             {"&", "&amp;"}}};
    return replaced(visibleLine(text), special);
}

std::string markdownListing(const std::vector<std::string>& lines) {
    std::string text, fence = "```";
    for (const std::string& line : lines) {
        while (line.find(fence) != std::string::npos) fence += '`';
        text += visibleLine(line) + "\n";
    }
    return fence + "\n" + text + fence + "\n";
}

std::string commentText(std::string_view text) {
    std::string line = visibleLine(text);
    line.erase(line.find_last_not_of(' ') + 1);
    if (line.ends_with('\\') || line.ends_with("?\?/")) line += '.';
    return line;
}

std::string cppString(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\' || c == '?') {  // "?" could begin a trigraph
            out += '\\';
            out += c;
        } else if (byte < 0x20 || byte >= 0x7f) {
            char octal[8];
            std::snprintf(octal, sizeof octal, "\\%03o", static_cast<unsigned>(byte));
            out += octal;
        } else {
            out += c;
        }
    }
    return out + '"';
}

std::string pythonString(std::string_view text) {
    std::string out = "'";
    while (!text.empty()) {
        const CodePoint c = firstOf(text);
        const std::uint32_t number = c.isValid ? c.number : 0xfffd;
        if (number == '\'' || number == '\\') {
            out += '\\';
            out += static_cast<char>(number);
        } else if (!c.isValid || isLineEnd(number) || isInvisible(number)) {
            char escape[16];
            std::snprintf(escape, sizeof escape, "\\U%08x", static_cast<unsigned>(number));
            out += escape;
        } else {
            out += text.substr(0, c.length);
        }
        text.remove_prefix(c.length);
    }
    return out + '\'';
}

}  // namespace extremal
