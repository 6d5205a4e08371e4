// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/scene/read/json.hpp"

namespace extremal {
namespace {

constexpr std::size_t lineWidth = 100;

void appendString(std::string& out, std::string_view s) {
    constexpr std::string_view hex = "0123456789abcdef";
    out += '"';
    for (const char c : s) {
        switch (c) {
            case '"':
                out += "\\\"";
                break;
            case '\\':
                out += "\\\\";
                break;
            case '\n':
                out += "\\n";
                break;
            case '\r':
                out += "\\r";
                break;
            case '\t':
                out += "\\t";
                break;
            default:
                if (const auto u = static_cast<unsigned char>(c); u < 0x20 || u == 0x7f) {
                    out += "\\u00";
                    out += hex[u >> 4];
                    out += hex[u & 15];
                } else {
                    out += c;
                }
        }
    }
    out += '"';
}

std::string numberText(double d) {
    if (!std::isfinite(d)) return "null";
    // "-0" would be read back as the integer 0.
    return d == 0 && std::signbit(d) ? "-0.0" : formatCount(d);
}

void appendScalar(std::string& out, const Value& v) {
    if (v.isNull())
        out += "null";
    else if (v.isBool())
        out += v.asBool() ? "true" : "false";
    else if (v.isNumber())
        out += numberText(v.asNumber());
    else
        appendString(out, v.asString());
}

void appendCompact(std::string& out, const Value& v) {
    if (v.isArray()) {
        out += '[';
        for (std::size_t i = 0; i < v.asArray().size(); ++i) {
            if (i > 0) out += ", ";
            appendCompact(out, v.asArray()[i]);
        }
        out += ']';
    } else if (v.isObject()) {
        out += v.asObject().empty() ? "{" : "{ ";
        for (std::size_t i = 0; i < v.asObject().size(); ++i) {
            if (i > 0) out += ", ";
            appendString(out, v.asObject()[i].first);
            out += ": ";
            appendCompact(out, v.asObject()[i].second);
        }
        out += v.asObject().empty() ? "}" : " }";
    } else {
        appendScalar(out, v);
    }
}

bool isContainer(const Value& v) { return v.isArray() || v.isObject(); }

int depth(const Value& v) {
    int deepest = 0;
    if (v.isArray())
        for (const Value& e : v.asArray()) deepest = std::max(deepest, depth(e));
    if (v.isObject())
        for (const auto& [key, e] : v.asObject()) deepest = std::max(deepest, depth(e));
    return isContainer(v) ? deepest + 1 : 0;
}

/// Small things stay on one line: no list of objects, and nothing nested twice.
bool staysOnOneLine(const Value& v, std::size_t column, std::string& oneLine) {
    if (depth(v) > 2) return false;
    if (v.isArray() &&
        std::any_of(v.asArray().begin(), v.asArray().end(), [](const Value& e) { return e.isObject(); }))
        return false;
    oneLine.clear();
    appendCompact(oneLine, v);
    return column + codePoints(oneLine) <= lineWidth;
}

void appendIndented(std::string& out, const Value& v, std::size_t indent, std::size_t column) {
    std::string oneLine;
    if (!isContainer(v)) return appendScalar(out, v);
    if (indent > 0 && staysOnOneLine(v, column, oneLine)) {
        out += oneLine;
        return;
    }
    const std::string margin(indent + 2, ' ');
    const std::size_t count = v.isArray() ? v.asArray().size() : v.asObject().size();
    out += v.isArray() ? '[' : '{';
    for (std::size_t i = 0; i < count; ++i) {
        out += i > 0 ? ",\n" : "\n";
        const std::size_t lineStart = out.size();
        out += margin;
        if (v.isObject()) {
            appendString(out, v.asObject()[i].first);
            out += ": ";
        }
        appendIndented(out, v.isArray() ? v.asArray()[i] : v.asObject()[i].second, indent + 2,
                       out.size() - lineStart);
    }
    if (count > 0) out += '\n' + std::string(indent, ' ');
    out += v.isArray() ? ']' : '}';
}

}  // namespace

std::string writeJson(const Value& value) {
    std::string out;
    appendIndented(out, value, 0, 0);
    return out + '\n';
}

std::string writeCompactJson(const Value& value) {
    std::string out;
    appendCompact(out, value);
    return out;
}

std::string describeValue(const Value& value) {
    if (value.isArray()) return "an array of " + std::to_string(value.asArray().size());
    if (value.isObject()) return "an object";
    std::string text;
    appendScalar(text, value);
    if (codePoints(text) <= 60) return text;
    std::size_t cut = 56;  // not inside a code point
    while ((static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80) --cut;
    return text.substr(0, cut) + "...\"";
}

}  // namespace extremal
