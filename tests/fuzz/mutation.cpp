// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/mutation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/text/expression.hpp"

namespace extremal::fuzz {
namespace {

const std::vector<double> numbers = {0,     -0.0, 1,     -1,     2,     0.5,    1e-3,   1e3,
                                     1e-12, 1e12, 1e155, 1e-155, 1e308, 5e-324, -1e308, 9007199254740993.0,
                                     64,    65,   1023,  1024,   24,    25,     100,    3.141592653589793,
                                     -0.1,  1e16};
const std::vector<const char*> texts = {
    "",       "x",       "q",      "t",         "1/0",      "sqrt(-1)",
    "2*pi",   "1e999",   "-",      "auto",      "none",     "exact",
    "a b",    "\t",      "\n",     "../../etc", "\xc3\xa9", "\xe2\x88\x9e",
    "(((((1", "x^x^x^x", "kepler", "gauss",     "*",        "/model/k",
    "=1+1",   "{}",      "null",   "true",      "%s%s%n",   "sin(x)*exp(-x^2)"};

/// All values of the tree, the root first.
void gather(Value& value, std::vector<Value*>& all) {
    all.push_back(&value);
    if (value.isArray())
        for (Value& v : value.asArray()) gather(v, all);
    if (value.isObject())
        for (Value::Member& m : value.asObject()) gather(m.second, all);
}

Value* someOf(Value& document, Random& random, bool (Value::*is)() const) {
    std::vector<Value*> all, fitting;
    gather(document, all);
    std::copy_if(all.begin(), all.end(), std::back_inserter(fitting), [&](Value* v) { return (v->*is)(); });
    return fitting.empty() ? nullptr : fitting[random.below(fitting.size())];
}

Value* someValue(Value& document, Random& random) {
    std::vector<Value*> all;
    gather(document, all);
    return all[random.below(all.size())];
}

void scaleNumber(Value& document, Random& random) {
    Value* const value = someOf(document, random, &Value::isNumber);
    if (!value) return;
    const double v = value->asNumber();
    switch (random.below(6)) {
        case 0:
            *value = v * std::pow(10.0, static_cast<double>(random.below(41)) - 20);
            break;
        case 1:
            *value = v + 1;
            break;
        case 2:
            *value = v - 1;
            break;
        case 3:
            *value = -v;
            break;
        case 4:
            *value = v * 2;
            break;
        default:
            *value = random.of(numbers);
    }
    if (!std::isfinite(value->asNumber())) *value = v;  // JSON has no infinities
}

void changeObject(Value& document, Random& random) {
    Value* const value = someOf(document, random, &Value::isObject);
    if (!value || value->asObject().empty()) return;
    Value::Object& object = value->asObject();
    const std::size_t i = random.below(object.size());
    switch (random.below(4)) {
        case 0:
            object.erase(object.begin() + static_cast<std::ptrdiff_t>(i));
            break;
        case 1:
            object[i].first = mutated(object[i].first, random);
            break;
        case 2:
            std::swap(object[i].second, object[random.below(object.size())].second);
            break;
        default:
            object.emplace_back(random.of(texts), hostileValue(random));
    }
}

void changeArray(Value& document, Random& random) {
    Value* const value = someOf(document, random, &Value::isArray);
    if (!value) return;
    Value::Array& array = value->asArray();
    if (array.empty() || random.oneIn(4)) {
        array.push_back(hostileValue(random));
        return;
    }
    const std::size_t i = random.below(array.size());
    switch (random.below(3)) {
        case 0:
            array.erase(array.begin() + static_cast<std::ptrdiff_t>(i));
            break;
        case 1:
            array.push_back(Value(array[i]));
            break;
        default:
            std::swap(array[i], array[random.below(array.size())]);
    }
}

void nest(Value& document, Random& random) {
    Value* const value = someValue(document, random);
    Value deep = *value;
    for (std::size_t depth = random.below(300); depth > 0; --depth)
        deep = Value(Value::Array{std::move(deep)});
    *value = std::move(deep);
}

}  // namespace

Value hostileValue(Random& random) {
    switch (random.below(6)) {
        case 0:
            return random.of(texts);
        case 1:
            return random.oneIn(2);
        case 2:
            return Value::Array{random.of(numbers), random.of(texts)};
        case 3:
            return random.oneIn(2) ? Value(Value::Object{}) : Value();
        default:
            return random.of(numbers);
    }
}

Value mutated(const Value& document, const Value& donor, Random& random) {
    Value changed = document, other = donor;
    for (std::size_t changes = 1 + random.below(4); changes > 0; --changes) switch (random.below(9)) {
            case 0:
                changeObject(changed, random);
                break;
            case 1:
                changeArray(changed, random);
                break;
            case 2:
                *someValue(changed, random) = hostileValue(random);
                break;
            case 3:
                *someValue(changed, random) = Value(*someValue(other, random));
                break;
            case 4: {
                // A part of the other document in the place of its namesake.
                if (!other.isObject() || other.asObject().empty() || !changed.isObject()) break;
                const Value::Member& member = random.of(other.asObject());
                changed.set(member.first, member.second);
                break;
            }
            case 5:
                if (random.oneIn(10)) nest(changed, random);
                break;
            default:
                scaleNumber(changed, random);
        }
    return changed;
}

std::string mutated(std::string_view text, Random& random) {
    std::string changed(text);
    for (std::size_t changes = 1 + random.below(6); changes > 0; --changes) {
        const std::size_t at = changed.empty() ? 0 : random.below(changed.size());
        const std::size_t length = std::min(changed.size() - at, 1 + random.below(20));
        switch (random.below(6)) {
            case 0:
                changed.erase(at, length);
                break;
            case 1:
                changed.insert(at, changed.substr(at, length));
                break;
            case 2:
                changed.insert(at, 1, static_cast<char>(random.below(256)));
                break;
            case 3:
                changed.insert(at, random.of(texts));
                break;
            case 4:
                changed.resize(at);
                break;
            default:
                if (!changed.empty()) changed[at] = static_cast<char>(random.below(256));
        }
    }
    return changed;
}

/// A function with as many arguments as it takes, most of the time.
template <class Part>
std::string call(Random& random, const Part& part) {
    const std::string& function = random.of(expressionFunctions());
    std::string arguments;
    for (const char c : random.oneIn(10) ? std::string("@") : argumentsOf(function))
        arguments += c == '@' ? part() : std::string(1, c);
    return function + "(" + arguments + ")";
}

std::string formula(Random& random, const std::vector<std::string>& names, int depth) {
    if (depth <= 0 || random.oneIn(5)) {
        if (random.oneIn(3)) return std::to_string(random.below(1000)) + (random.oneIn(2) ? "" : "e-2");
        if (random.oneIn(20)) return random.of(texts);
        return random.of(names);
    }
    const auto part = [&] { return formula(random, names, depth - 1); };
    switch (random.below(9)) {
        case 8: {
            static const std::vector<std::string> signs = {"<", "<=", ">", ">=", "==", "!=", "&&", "||"};
            return "(" + part() + random.of(signs) + part() + ")";
        }
        case 0:
            return "(" + part() + ")";
        case 1:
            return "-" + part();
        case 2:
            return part() + "^" + std::to_string(random.below(12));
        case 3:
            return part() + "/" + part();
        case 4:
            return call(random, part);
        case 5:
            return part() + "^" + part();
        case 6:
            return part() + "*" + part();
        default:
            return part() + (random.oneIn(2) ? " + " : "-") + part();
    }
}

std::string somePointer(const Value& document, Random& random) {
    std::string pointer;
    for (const Value* at = &document; !random.oneIn(5);) {
        if (at->isObject() && !at->asObject().empty()) {
            const Value::Member& member = random.of(at->asObject());
            pointer += "/" + (random.oneIn(20) ? mutated(member.first, random) : member.first);
            at = &member.second;
        } else if (at->isArray() && !at->asArray().empty()) {
            const std::size_t i = random.below(at->asArray().size());
            pointer += random.oneIn(6) ? "/*" : random.oneIn(10) ? "/-" : "/" + std::to_string(i);
            at = &at->asArray()[i];
        } else {
            break;
        }
    }
    return pointer.empty() ? "/" + std::string(random.of(texts)) : pointer;
}

}  // namespace extremal::fuzz
