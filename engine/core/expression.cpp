#include "engine/core/expression.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "engine/core/stumpff.hpp"
#include "engine/core/text.hpp"

namespace extremal {
namespace {

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

constexpr std::string_view velocityCall = "dot";

struct Function {
    const char* name;
    double (*one)(double);
    double (*two)(double, double);
};
constexpr Function functions[] = {
    {"sin", [](double x) { return std::sin(x); }, nullptr},
    {"cos", [](double x) { return std::cos(x); }, nullptr},
    {"tan", [](double x) { return std::tan(x); }, nullptr},
    {"asin", [](double x) { return std::asin(x); }, nullptr},
    {"acos", [](double x) { return std::acos(x); }, nullptr},
    {"atan", [](double x) { return std::atan(x); }, nullptr},
    {"atan2", nullptr, [](double y, double x) { return std::atan2(y, x); }},
    {"sinh", [](double x) { return std::sinh(x); }, nullptr},
    {"cosh", [](double x) { return std::cosh(x); }, nullptr},
    {"tanh", [](double x) { return std::tanh(x); }, nullptr},
    {"exp", [](double x) { return std::exp(x); }, nullptr},
    {"log", [](double x) { return std::log(x); }, nullptr},
    {"sqrt", [](double x) { return std::sqrt(x); }, nullptr},
    {"abs", [](double x) { return std::fabs(x); }, nullptr},
    {"sign", [](double x) { return static_cast<double>((x > 0) - (x < 0)); }, nullptr},
    {"stumpff", nullptr, [](double k, double x) { return stumpff(k, x); }},
};

const Function* findFunction(std::string_view name) {
    for (const Function& f : functions)
        if (name == f.name) return &f;
    return nullptr;
}

/// Recursive descent over the grammar of the header; each rule returns the place of its node.
class Parser {
public:
    explicit Parser(std::string_view text) : text_(text) {}

    Expression parse() {
        skipBlanks();
        if (at_ == text_.size()) throw ExpressionError("is empty", 0);
        sum();
        if (at_ < text_.size()) throw unexpected("an operator");
        result_.text = std::string(text_);
        return std::move(result_);
    }

private:
    /// Counts what is open, so that no text exhausts the stack.
    struct Nesting {
        explicit Nesting(Parser& p) : parser(p) {
            if (++parser.depth_ > maxExpressionDepth)
                throw ExpressionError("is nested deeper than " + std::to_string(maxExpressionDepth),
                                      parser.at_);
        }
        ~Nesting() { --parser.depth_; }
        Parser& parser;
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
        return {"has \"" + std::string(text_.substr(at_, length)) + "\" where " + wanted + " should be", at_};
    }
    int add(Expression::Node node) {
        result_.nodes.push_back(std::move(node));
        return static_cast<int>(result_.nodes.size()) - 1;
    }
    int binary(Operator kind, int left, int right, std::size_t position) {
        return add({kind, 0, {}, left, right, position});
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
            const int inner = sum();
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
        if (findFunction(name))
            throw ExpressionError("needs brackets after the function " + name, position,
                                  "write " + name + "(...)");
        if (name == "pi") return add({Operator::number, std::numbers::pi, name, -1, -1, position});
        return add({Operator::name, 0, name, -1, -1, position});
    }
    int call(const std::string& name, std::size_t position) {
        const Function* function = findFunction(name);
        const bool isVelocity = name == velocityCall;
        if (!function && !isVelocity)
            throw ExpressionError("has no function \"" + name + "\"", position,
                                  suggestName(name, expressionFunctions()));
        const Nesting nesting(*this);
        const std::size_t bracket = at_;
        take('(');
        const int first = sum();
        int second = -1;
        if (function && function->two) {
            if (!take(',')) throw ExpressionError("needs two arguments for " + name, at_);
            second = sum();
        } else if (peek() == ',') {
            throw ExpressionError("needs one argument for " + name, at_);
        }
        closeBracket(bracket);
        return add({Operator::call, 0, name, first, second, position});
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int depth_ = 0;
    Expression result_;
};

double applyNode(const Expression::Node& node, double a, double b) {
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
            return applyFunction(node.name, a, b);
        case Operator::number:
        case Operator::name:
            break;
    }
    return node.number;
}

}  // namespace

double applyFunction(std::string_view name, double a, double b) {
    const Function* function = findFunction(name);
    return function->two ? function->two(a, b) : function->one(a);
}

std::string nameProblem(std::string_view name) {
    const auto isPart = [](char c) { return isLetter(c) || isDigit(c) || c == '_'; };
    if (name.empty() || !isLetter(name.front()) || !std::all_of(name.begin(), name.end(), isPart))
        return "must be letters, digits and _, with a letter first";
    if (name.size() > 40) return "must have at most 40 characters";
    if (name.ends_with("_t")) return "must not end in _t, which makes the name of a velocity";
    if (name == "t") return "must not be t, which is time";
    if (name == "pi") return "must not be pi, which is a constant";
    if (findFunction(name)) return "must not be the name of a function";
    return {};
}

std::vector<std::string> Expression::names() const {
    std::vector<std::string> found;
    for (const Node& node : nodes)
        if (node.kind == Operator::name && std::find(found.begin(), found.end(), node.name) == found.end())
            found.push_back(node.name);
    return found;
}

Expression parseExpression(std::string_view text) {
    if (text.size() > maxExpressionLength)
        throw ExpressionError("is " + std::to_string(text.size()) + " characters long, the limit is " +
                                  std::to_string(maxExpressionLength),
                              0);
    return Parser(text).parse();
}

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
            if (!value) throw ExpressionError("has an unknown name \"" + node.name + "\"", node.position);
            values.push_back(*value);
        } else {
            values.push_back(applyNode(node, operand(node.left), operand(node.right)));
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
        result += word == from ? to : word;
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

const std::vector<std::string>& expressionFunctions() {
    static const std::vector<std::string> all = [] {
        std::vector<std::string> names;
        for (const Function& f : functions) names.emplace_back(f.name);
        return names;
    }();
    return all;
}

}  // namespace extremal
