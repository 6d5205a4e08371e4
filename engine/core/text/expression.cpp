// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/text/expression.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/core/text/expression_signatures.hpp"
#include "engine/core/text/indexed.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

constexpr std::string_view velocityCall = "dot";

/// Recursive descent over the grammar of the header; each rule returns the place of its node.
class Parser {
public:
    explicit Parser(std::string_view text) : text_(text) {}

    Expression parse() {
        skipBlanks();
        if (at_ == text_.size()) throw ExpressionError("is empty", 0);
        whole();
        if (at_ < text_.size()) throw unexpected("an operator");
        result_.text = std::string(text_);
        return std::move(result_);
    }

private:
    /// Counts what is open, so that no text exhausts the stack.
    struct Nesting {
        explicit Nesting(Parser& p) : parser(p), outside(p.depth_) { deepen(); }
        ~Nesting() { parser.depth_ = outside; }
        void deepen() const {
            if (++parser.depth_ > maxExpressionDepth)
                throw ExpressionError("is nested deeper than " + std::to_string(maxExpressionDepth),
                                      parser.at_);
        }
        Parser& parser;
        int outside;
    };

    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    void skipBlanks() {
        while (at_ < text_.size() && isBlank(text_[at_])) ++at_;
    }
    bool take(char c) {
        if (peek() != c || at_ == text_.size()) return false;
        ++at_;
        skipBlanks();
        return true;
    }
    ExpressionError unexpected(const std::string& wanted) const {
        if (at_ == text_.size()) return {"ends where " + wanted + " is missing", at_};
        std::size_t length = 1;  // a whole code point
        while (at_ + length < text_.size() &&
               (static_cast<unsigned char>(text_[at_ + length]) & 0xC0) == 0x80)
            ++length;
        return {"has \"" + std::string(text_.substr(at_, length)) + "\" where " + wanted + " should be", at_,
                peek() == '=' ? "equality is written ==" : ""};
    }
    int add(Expression::Node node) {
        result_.nodes.push_back(std::move(node));
        return static_cast<int>(result_.nodes.size()) - 1;
    }
    int binary(Operator kind, int left, int right, std::size_t position) {
        return add({kind, 0, {}, left, right, position});
    }

    bool takeWord(std::string_view word) {
        if (!text_.substr(at_).starts_with(word)) return false;
        at_ += word.size();
        skipBlanks();
        return true;
    }
    int called(std::string_view function, std::size_t position, int left, int right = -1, int third = -1) {
        const ExpressionFunction* const f = findFunction(function);
        return add({Operator::call, 0, std::string(function), left, right, position, third, f, nullptr});
    }
    int whole() {
        std::vector<int> parts{both()};
        const std::size_t position = at_;
        while (takeWord("||")) parts.push_back(both());
        return folded("or", position, std::move(parts));
    }
    int both() {
        std::vector<int> parts{comparison()};
        const std::size_t position = at_;
        while (takeWord("&&")) parts.push_back(comparison());
        return folded("and", position, std::move(parts));
    }
    std::string_view takeComparison() {
        for (const std::string_view each : {"<=", ">=", "==", "!=", "<", ">"})
            if (takeWord(each)) return each;
        return {};
    }
    int comparison() {
        const int left = sum();
        const std::size_t position = at_;
        const std::string_view sign = takeComparison();
        if (sign.empty()) return left;
        const int right = sum();
        if (const std::size_t second = at_; !takeComparison().empty())
            throw ExpressionError("has a chain of comparisons", second, "write a < b && b < c");
        if (sign.front() == '>') return called(sign == ">" ? "<" : "<=", position, right, left);
        return called(sign, position, left, right);
    }
    int sum() {
        int left = product();
        while (true) {
            const std::size_t position = at_;
            if (take('+'))
                left = binary(Operator::add, left, product(), position);
            else if (take('-'))
                left = binary(Operator::subtract, left, product(), position);
            else
                return left;
        }
    }
    int product() {
        int left = signedFactor();
        while (true) {
            const std::size_t position = at_;
            if (take('*'))
                left = binary(Operator::multiply, left, signedFactor(), position);
            else if (take('/'))
                left = binary(Operator::divide, left, signedFactor(), position);
            else
                return left;
        }
    }
    int signedFactor() {
        const std::size_t position = at_;
        if (peek() != '+' && peek() != '-') return power();
        const Nesting nesting(*this);
        if (take('+')) return signedFactor();
        take('-');
        return add({Operator::negate, 0, {}, signedFactor(), -1, position});
    }
    int power() {
        const int base = atom();
        const std::size_t position = at_;
        if (!take('^')) return base;
        const Nesting nesting(*this);
        return binary(Operator::power, base, signedFactor(), position);
    }
    int atom() {
        const std::size_t position = at_;
        if (take('(')) {
            const Nesting nesting(*this);
            const int inner = whole();
            closeBracket(position);
            return inner;
        }
        if (isDigit(peek()) || peek() == '.') return number();
        if (isLetter(peek())) return nameOrCall();
        throw unexpected("a number, a name or \"(\"");
    }
    void closeBracket(std::size_t opened) {
        if (take(')')) return;
        if (at_ == text_.size()) throw ExpressionError("has a bracket that is not closed", opened);
        throw unexpected("an operator or \")\"");
    }
    int number() {
        const std::size_t position = at_;
        double value = 0;
        const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
        if (error == std::errc::result_out_of_range)
            throw ExpressionError("has a number that does not fit a double", position);
        if (error != std::errc()) throw unexpected("a number");
        at_ = static_cast<std::size_t>(end - text_.data());
        if (isLetter(peek()) || peek() == '_' || peek() == '.') throw unexpected("an operator");
        const std::string_view written = text_.substr(position, at_ - position);
        skipBlanks();
        return add({Operator::number, value, std::string(written), -1, -1, position});
    }
    int nameOrCall() {
        const std::size_t position = at_;
        while (isLetter(peek()) || isDigit(peek()) || peek() == '_') ++at_;
        const std::string name(text_.substr(position, at_ - position));
        skipBlanks();
        if (peek() == '(') return call(name, position);
        if (isFunctionName(name) && !nameProblem(name).empty())
            throw ExpressionError("needs brackets after the function " + name, position,
                                  "write " + name + "(...)");
        if (name == "pi") return add({Operator::number, std::numbers::pi, name, -1, -1, position});
        return add({Operator::name, 0, name, -1, -1, position});
    }
    int call(const std::string& name, std::size_t position) {
        const Signature* const signature = findSignature(name);
        const bool isVelocity = name == velocityCall;
        if (!signature && !isVelocity)
            throw ExpressionError("has no function \"" + name + "\"", position,
                                  suggestName(name, expressionFunctions()));
        const Nesting nesting(*this);
        const std::size_t bracket = at_;
        take('(');
        if (signature && signature->isTable) return table(name, position, bracket);
        std::vector<int> arguments{whole()};
        while (peek() == ',') {
            if (isVelocity || static_cast<int>(arguments.size()) == signature->most) break;
            if (signature && signature->isChain) nesting.deepen();
            take(',');
            arguments.push_back(whole());
        }
        if (isVelocity) {
            if (peek() == ',') throw ExpressionError("needs one argument for " + name, at_);
            closeBracket(bracket);
            return add({Operator::call, 0, name, arguments[0], -1, position, -1, nullptr, nullptr});
        }
        const int count = static_cast<int>(arguments.size());
        const bool isTooFew = count < signature->least && (peek() == ')' || at_ == text_.size());
        if (isTooFew || peek() == ',')
            throw ExpressionError("needs " + signature->counted() + " for " + name, at_);
        closeBracket(bracket);
        if (signature->isChain) return chain(name, position, arguments);
        if (signature->isFolded) return folded(signature->meaning, position, arguments);
        if (signature->meaning == "^") return binary(Operator::power, arguments[0], arguments[1], position);
        arguments.resize(3, -1);
        return called(signature->meaning, position, arguments[0], arguments[1], arguments[2]);
    }
    /// piecewise(c1, a1, c2, a2, ..., b) = if(c1, a1, if(c2, a2, ... b)).
    int chain(const std::string& name, std::size_t position, const std::vector<int>& arguments) {
        if (arguments.size() % 2 == 0)
            throw ExpressionError(
                "has no last value for " + name, position,
                "write " + name + "(condition, value, ..., value where none of them holds)");
        int rest = arguments.back();
        for (std::size_t k = arguments.size() - 1; k >= 2; k -= 2)
            rest = called("if", position, arguments[k - 2], arguments[k - 1], rest);
        return rest;
    }
    /// A function of two, of any number: the halves first, so that no tree gets deep.
    int folded(std::string_view function, std::size_t position, std::vector<int> arguments) {
        while (arguments.size() > 1) {
            std::size_t kept = 0;
            for (std::size_t k = 0; k + 1 < arguments.size(); k += 2)
                arguments[kept++] = called(function, position, arguments[k], arguments[k + 1]);
            if (arguments.size() % 2 == 1) arguments[kept++] = arguments.back();
            arguments.resize(kept);
        }
        return arguments[0];
    }
    int table(const std::string& name, std::size_t position, std::size_t bracket) {
        const int argument = whole();
        std::vector<double> x, y;
        while (peek() == ';') {
            take(';');
            if (peek() == ')') break;
            const std::size_t place = at_;
            x.push_back(entry(name));
            if (x.size() > 1 && !(x.back() > x[x.size() - 2]))
                throw ExpressionError("has points of " + name + " that are not in ascending order", place,
                                      "each x greater than the one before it");
            if (!take(',')) throw unexpected("the value of a point: \",\"");
            y.push_back(entry(name));
        }
        if (x.size() < 2 && (peek() == ')' || peek() == ',' || at_ == text_.size()))
            throw ExpressionError("needs at least two points for " + name, at_,
                                  "write " + name + "(x; 0, 0; 1, 2), points x, y after semicolons");
        closeBracket(bracket);
        using Kind = Interpolant::Kind;
        const Kind kind = name == Interpolant::functionName(Kind::cubic) ? Kind::cubic : Kind::linear;
        return add({Operator::call, 0, name, argument, -1, position, -1, nullptr,
                    std::make_shared<const Interpolant>(kind, std::move(x), y)});
    }
    /// A number in a table: an expression without names, of which no node is kept.
    double entry(const std::string& name) {
        const std::size_t before = result_.nodes.size(), place = at_;
        sum();
        std::vector<double> values;
        for (std::size_t n = before; n < result_.nodes.size(); ++n) {
            const Expression::Node& node = result_.nodes[n];
            if (node.kind == Operator::name || node.name == velocityCall)
                throw ExpressionError(
                    "has the name \"" + node.name + "\" in a point of " + name + ", which are numbers",
                    node.position, "scale the whole: F*" + name + "(x/X; 0, 0; 1, 1)");
            const auto operand = [&](int at) {
                return at < 0 ? 0 : values[static_cast<std::size_t>(at) - before];
            };
            values.push_back(applyNode(node, operand(node.left), operand(node.right), operand(node.third)));
        }
        if (!std::isfinite(values.back()))
            throw ExpressionError("has a point of " + name + " that is not finite", place);
        result_.nodes.resize(before);
        return values.back();
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int depth_ = 0;
    Expression result_;
};

}  // namespace

double applyNode(const Expression::Node& node, double a, double b, double c) {
    switch (node.kind) {
        case Operator::negate:
            return -a;
        case Operator::add:
            return a + b;
        case Operator::subtract:
            return a - b;
        case Operator::multiply:
            return a * b;
        case Operator::divide:
            return a / b;
        case Operator::power:
            return std::pow(a, b);
        case Operator::call:
            if (node.table) return node.table->at(a);
            // dot(x) has no value of its own.
            return node.function ? node.function->value(a, b, c) : std::numeric_limits<double>::quiet_NaN();
        case Operator::number:
        case Operator::name:
            break;
    }
    return node.number;
}

std::string nameProblem(std::string_view name) {
    const auto isPart = [](char c) { return isLetter(c) || isDigit(c) || c == '_'; };
    if (name.empty() || !isLetter(name.front()) || !std::all_of(name.begin(), name.end(), isPart))
        return "must be letters, digits and _, with a letter first";
    if (name.size() > 40) return "must have at most 40 characters";
    if (name.ends_with("_t")) return "must not end in _t, which makes the name of a velocity";
    if (name == "t") return "must not be t, which is time";
    if (name == "pi") return "must not be pi, which is a constant";
    const Signature* const signature = findSignature(name);
    if (signature && signature->isReserved) return "must not be the name of a function";
    return {};
}

std::vector<std::string> Expression::names() const {
    std::vector<std::string> found;
    for (const Node& node : nodes)
        if (node.kind == Operator::name && std::find(found.begin(), found.end(), node.name) == found.end())
            found.push_back(node.name);
    return found;
}

namespace {

Expression parse(std::string_view text, std::size_t most) {
    if (text.size() > most)
        throw ExpressionError(
            "is " + std::to_string(text.size()) + " characters long, the limit is " + std::to_string(most),
            0);
    return Parser(text).parse();
}

}  // namespace

Expression parseExpression(std::string_view text) { return parse(text, maxExpressionLength); }

Expression parseWrittenOut(std::string_view text) { return parse(text, maxExpandedLength); }

double evaluate(const Expression& expression,
                const std::function<std::optional<double>(std::string_view)>& valueOf) {
    for (const Expression::Node& node : expression.nodes)
        if (node.kind == Operator::call && node.name == velocityCall)
            throw ExpressionError("has dot(...), which stands for a velocity", node.position,
                                  "only a Lagrangian has velocities");
    std::vector<double> values;
    values.reserve(expression.nodes.size());
    const auto operand = [&](int place) { return place < 0 ? 0.0 : values[static_cast<std::size_t>(place)]; };
    for (const Expression::Node& node : expression.nodes) {
        if (node.kind == Operator::name) {
            const std::optional<double> value = valueOf(node.name);
            if (!value)
                throw ExpressionError("has an unknown name \"" + node.name + "\"", node.position,
                                      isFunctionName(node.name)
                                          ? "as a function it needs brackets: " + node.name + "(...)"
                                          : "");
            values.push_back(*value);
        } else {
            values.push_back(applyNode(node, operand(node.left), operand(node.right), operand(node.third)));
        }
    }
    return values.back();
}

std::string withNameReplaced(std::string_view text, std::string_view from, std::string_view to) {
    const auto isPart = [](char c) { return isLetter(c) || isDigit(c) || c == '_'; };
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i;
        while (end < text.size() && isPart(text[end])) ++end;
        if (end == i) {
            result += text[i++];
            continue;
        }
        const std::string_view word = text.substr(i, end - i);
        std::size_t next = end;
        while (next < text.size() && isBlank(text[next])) ++next;
        const bool isCalled =
            next < text.size() && text[next] == '(' && (isFunctionName(word) || word == velocityCall);
        result += word == from && !isCalled ? to : word;
        i = end;
    }
    return result;
}

std::string caretLines(std::string_view text, std::size_t position, std::size_t reach,
                       std::string_view indent) {
    std::size_t from = position > reach ? position - reach : 0;
    std::size_t to = std::min(text.size(), position + reach);
    const auto isInside = [&](std::size_t i) {
        return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0) == 0x80;
    };
    while (from > 0 && isInside(from)) --from;
    while (isInside(to)) ++to;
    std::string shown =
        (from > 0 ? "..." : "") + std::string(text.substr(from, to - from)) + (to < text.size() ? "..." : "");
    std::replace_if(
        shown.begin(), shown.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
    const std::size_t column = codePoints(text.substr(from, position - from)) + (from > 0 ? 3 : 0);
    return std::string(indent) + shown + "\n" + std::string(indent) + std::string(column, ' ') + '^';
}

}  // namespace extremal
