// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>
#include <unordered_set>

#include <nlohmann/json.hpp>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/pointer.hpp"

namespace extremal {
namespace {

std::string lineAndColumn(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t lineStart = before.rfind('\n') + 1;  // npos + 1 is 0
    return "line " + std::to_string(line) + ", column " +
           std::to_string(codePoints(before.substr(lineStart)) + 1);
}

/// The library's "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while
/// parsing value - unexpected ..." without what the user cannot use.
std::string plainMessage(std::string message) {
    for (const std::string_view lead : {"] ", ": ", "syntax error while parsing "})
        if (const auto at = message.find(lead); at != std::string::npos && at < 80)
            message.erase(0, at + lead.size());
    if (const auto last = message.find("; last read: '"); last != std::string::npos) {
        const auto expected = message.find("'; expected ", last);
        message.erase(last, expected == std::string::npos ? std::string::npos : expected + 1 - last);
    }
    return message;
}

/// Receives the events of the parser and builds the tree; a false return ends the reading.
class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
public:
    explicit TreeBuilder(std::string_view text) : text_(text) {}

    Value take() { return std::move(root_); }
    const std::optional<Problem>& problem() const { return problem_; }

    bool null() override { return add(Value()); }
    bool boolean(bool b) override { return add(Value(b)); }
    bool number_integer(number_integer_t i) override { return add(Value(static_cast<double>(i))); }
    bool number_unsigned(number_unsigned_t u) override { return add(Value(static_cast<double>(u))); }
    bool number_float(number_float_t d, const string_t&) override {
        if (!std::isfinite(d)) return fail(pointer(), "the number is too large for a double");
        return add(Value(d));
    }
    bool string(string_t& s) override { return add(Value(std::move(s))); }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(Value(Value::Object{})); }
    bool start_array(std::size_t) override { return open(Value(Value::Array{})); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override {
        Level& level = levels_.back();
        level.key = std::move(name);
        if (!level.keys.insert(level.key).second)
            return fail(pointer(), "the key \"" + level.key + "\" appears twice", "keep one of them");
        return true;
    }
    bool parse_error(std::size_t position, const std::string& lastToken,
                     const nlohmann::detail::exception& error) override {
        if (error.id == 406)
            return fail(pointer(), "the number " + lastToken.substr(0, 40) + " is too large for a double");
        const std::size_t offset = position > 0 ? position - 1 : 0;
        return fail("", "is not JSON: " + plainMessage(error.what()) + " at " + lineAndColumn(text_, offset));
    }

private:
    struct Level {
        Value value;
        std::string key;
        std::unordered_set<std::string> keys;
    };

    /// Where the next value stands.
    std::string pointer() const {
        std::string p;
        for (const Level& level : levels_)
            appendToken(p, level.value.isArray() ? std::to_string(level.value.asArray().size()) : level.key);
        return p;
    }
    bool fail(std::string where, std::string message, std::string hint = {}, std::string topic = {}) {
        problem_ = Problem{std::move(where), std::move(message), std::move(hint), {}, {}, std::move(topic)};
        return false;
    }
    bool add(Value value) {
        if (++count_ > mostJsonValues)
            return fail("", "has more than " + formatCount(mostJsonValues) + " values",
                        "a scene has some hundred", "strangers");
        if (levels_.empty()) {
            root_ = std::move(value);
        } else if (Level& level = levels_.back(); level.value.isArray()) {
            level.value.asArray().push_back(std::move(value));
        } else {
            level.value.asObject().emplace_back(level.key, std::move(value));
        }
        return true;
    }
    bool open(Value value) {
        if (levels_.size() >= static_cast<std::size_t>(maxJsonDepth))
            return fail("", "is nested deeper than " + std::to_string(maxJsonDepth) + " levels",
                        "a scene needs fewer than 10");
        levels_.push_back({std::move(value), {}, {}});
        return true;
    }
    bool close() {
        Value value = std::move(levels_.back().value);
        levels_.pop_back();
        return add(std::move(value));
    }

    std::string_view text_;
    std::size_t count_ = 0;
    std::vector<Level> levels_;
    Value root_;
    std::optional<Problem> problem_;
};

}  // namespace

Value parseJson(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
        throw InvalidScene("", "is empty", "a scene is a JSON object; extremal list presets names examples");
    // The parser takes a zero byte for the end of the text, and would hide what follows.
    const std::size_t bad = std::min(firstInvalidUtf8(text), text.find('\0'));
    if (bad != std::string_view::npos)
        throw InvalidScene("", "is not UTF-8 text: bad byte at " + lineAndColumn(text, bad),
                           "save the file as UTF-8");
    TreeBuilder builder(text);
    const bool isRead = nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
    if (builder.problem()) throw InvalidScene({*builder.problem()});
    if (!isRead) throw InvalidScene("", "is not JSON");
    return builder.take();
}

}  // namespace extremal
