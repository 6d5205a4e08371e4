// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/text/indexed.hpp"

#include <cmath>
#include <functional>
#include <optional>
#include <tuple>

namespace extremal {
namespace {

bool beginsWord(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isOfWord(char c) { return beginsWord(c) || (c >= '0' && c <= '9') || c == '_'; }
bool isBlankHere(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string_view withoutBlanks(std::string_view text) {
    while (!text.empty() && isBlankHere(text.front())) text.remove_prefix(1);
    while (!text.empty() && isBlankHere(text.back())) text.remove_suffix(1);
    return text;
}

class IndexWriter {
public:
    IndexWriter(std::string_view whole, const NamedNumbers& values) : whole_(whole), values_(values) {}

    std::string write(std::string_view part) {
        std::string out;
        write(part, out);
        return out;
    }

    /// The whole number that an expression is; `position`: of the expression.
    long integer(std::string_view text) const {
        const std::size_t position = placeOf(text);
        double value = 0;
        try {
            value = evaluate(parseExpression(text), [&](std::string_view name) -> std::optional<double> {
                // The last ones are the innermost.
                for (auto v = values_.rbegin(); v != values_.rend(); ++v)
                    if (v->first == name) return v->second;
                return {};
            });
        } catch (const ExpressionError& e) {
            throw ExpressionError(e.what(), position + e.position, e.hint);
        }
        const double nearest = std::round(value);
        if (!(std::abs(value - nearest) < 1e-9) || !(std::abs(value) < 1e9))
            throw ExpressionError("has an index that is not a whole number", position);
        return static_cast<long>(nearest);
    }
    /// "a..b".
    std::pair<long, long> range(std::string_view text) const {
        const std::size_t dots = text.find("..");
        if (dots == std::string_view::npos)
            throw ExpressionError("needs a range of an index", placeOf(text), "for example 1..n");
        const long from = integer(text.substr(0, dots)), to = integer(text.substr(dots + 2));
        if (to - from >= maxIndexRange)
            throw ExpressionError("has a range of " + std::to_string(to - from + 1) +
                                      " numbers, the limit is " + std::to_string(maxIndexRange),
                                  placeOf(text));
        return {from, to};
    }
    /// An index of this value, until it is released.
    void hold(const std::string& index, double value) {
        values_.emplace_back(index, value);
        ++indices_;
    }

private:
    std::size_t placeOf(std::string_view part) const {
        const std::less<const char*> isBefore;
        const bool isInside =
            !isBefore(part.data(), whole_.data()) && !isBefore(whole_.data() + whole_.size(), part.data());
        return isInside ? static_cast<std::size_t>(part.data() - whole_.data()) : 0;
    }

    void write(std::string_view text, std::string& out) {
        for (std::size_t at = 0; at < text.size();) {
            if (!isOfWord(text[at])) {
                out += text[at++];
                continue;
            }
            std::size_t to = at;
            while (to < text.size() && isOfWord(text[to])) ++to;
            const std::string_view word = text.substr(at, to - at);
            if (!beginsWord(word.front())) {
                out += word;
            } else if (to < text.size() && text[to] == '[') {
                const std::size_t close = closing(text, to);
                out += word;
                const long index = integer(text.substr(to + 1, close - to - 1));
                if (index < 0) throw ExpressionError("has an index below 0", placeOf(text.substr(to + 1)));
                out += std::to_string(index);
                to = close + 1;
            } else if (word == "sum" && opens(text, to)) {
                const std::size_t open = text.find('(', to), close = closing(text, open);
                writeSum(text.substr(open + 1, close - open - 1), out);
                to = close + 1;
            } else if (const auto value = indexNamed(word)) {
                out += *value < 0 ? "(" + std::to_string(*value) + ")" : std::to_string(*value);
            } else {
                out += word;
            }
            at = to;
            requireRoom(out);
        }
    }
    void requireRoom(const std::string& out) const {
        if (out.size() > maxExpandedLength)
            throw ExpressionError("is more than " + std::to_string(maxExpandedLength) +
                                      " characters long when its sums are written out",
                                  0, "fewer terms");
    }
    static bool opens(std::string_view text, std::size_t at) {
        while (at < text.size() && isBlankHere(text[at])) ++at;
        return at < text.size() && text[at] == '(';
    }
    std::size_t closing(std::string_view text, std::size_t open) const {
        int depth = 0;
        for (std::size_t i = open; i < text.size(); ++i) {
            if (text[i] == '(' || text[i] == '[') ++depth;
            if ((text[i] == ')' || text[i] == ']') && --depth == 0) return i;
        }
        throw ExpressionError("has a bracket that is not closed", placeOf(text.substr(open)));
    }
    std::optional<long> indexNamed(std::string_view word) const {
        for (std::size_t k = 0; k < indices_; ++k) {
            const auto& v = values_[values_.size() - 1 - k];
            if (v.first == word) return static_cast<long>(v.second);
        }
        return {};
    }

    /// "i, 1..n, e".
    void writeSum(std::string_view arguments, std::string& out) {
        std::size_t commas[2] = {0, 0};
        int depth = 0, found = 0;
        for (std::size_t i = 0; i < arguments.size() && found < 2; ++i) {
            if (arguments[i] == '(' || arguments[i] == '[') ++depth;
            if (arguments[i] == ')' || arguments[i] == ']') --depth;
            if (arguments[i] == ',' && depth == 0) commas[found++] = i;
        }
        const std::string_view index = withoutBlanks(arguments.substr(0, commas[0]));
        if (found < 2 || index.empty() || !beginsWord(index.front()) ||
            index.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789") !=
                std::string_view::npos)
            throw ExpressionError("has a sum without index, range and terms", placeOf(arguments),
                                  "for example sum(i, 1..n, x[i]^2)");
        if (indices_ >= 8) throw ExpressionError("has more than 8 sums in each other", placeOf(arguments));
        const auto [from, to] = range(arguments.substr(commas[0] + 1, commas[1] - commas[0] - 1));
        const std::string_view body = arguments.substr(commas[1] + 1);
        hold(std::string(index), 0);
        out += "(";
        for (long i = from; i <= to; ++i) {
            values_.back().second = static_cast<double>(i);
            out += i > from ? "+(" : "(";
            write(body, out);
            out += ")";
            requireRoom(out);
        }
        if (to < from) out += "0";
        out += ")";
        values_.pop_back();
        --indices_;
    }

    std::string_view whole_;
    NamedNumbers values_;
    std::size_t indices_ = 0;  ///< how many of the last values are indices
};

}  // namespace

bool hasIndices(std::string_view text) {
    if (text.find('[') != std::string_view::npos) return true;
    for (std::size_t at = text.find("sum"); at != std::string_view::npos; at = text.find("sum", at + 1)) {
        if (at > 0 && isOfWord(text[at - 1])) continue;
        std::size_t to = at + 3;
        while (to < text.size() && isBlankHere(text[to])) ++to;
        if (to < text.size() && text[to] == '(') return true;
    }
    return false;
}

std::string writtenOut(std::string_view text, const NamedNumbers& values, const IndexedName& of) {
    if (text.size() > maxExpressionLength)
        throw ExpressionError("is " + std::to_string(text.size()) + " characters long, the limit is " +
                                  std::to_string(maxExpressionLength),
                              0);
    IndexWriter writer(text, values);
    if (!of.index.empty()) writer.hold(of.index, of.value);
    return writer.write(text);
}

std::vector<IndexedName> namesOf(std::string_view name, const NamedNumbers& values) {
    const std::size_t open = name.find('[');
    if (open == std::string_view::npos) return {{std::string(name), "", 0}};
    if (name.back() != ']')
        throw ExpressionError("has a bracket that is not closed", open, "for example x[1..n]");
    const std::string letters(name.substr(0, open));
    std::string_view inside = name.substr(open + 1, name.size() - open - 2);
    std::string index;
    if (const std::size_t equals = inside.find('='); equals != std::string_view::npos) {
        index = std::string(withoutBlanks(inside.substr(0, equals)));
        inside.remove_prefix(equals + 1);
    }
    const IndexWriter writer(name, values);
    long from = 0, to = 0;
    if (inside.find("..") == std::string_view::npos)
        from = to = writer.integer(inside);
    else
        std::tie(from, to) = writer.range(inside);
    if (from < 0) throw ExpressionError("has an index below 0", open + 1);
    std::vector<IndexedName> names;
    for (long i = from; i <= to; ++i)
        names.push_back({letters + std::to_string(i), index, static_cast<double>(i)});
    return names;
}

}  // namespace extremal
