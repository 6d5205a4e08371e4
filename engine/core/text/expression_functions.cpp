// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <limits>

#include "engine/core/algebra/stumpff.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/core/text/expression_signatures.hpp"

namespace extremal {
namespace {

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr int any = std::numeric_limits<int>::max();

double signOf(double x) { return x > 0 ? 1 : x < 0 ? -1 : x; }
/// A comparison with what is not a number is neither true nor false.
double truth(bool isTrue, double a, double b) { return std::isnan(a) || std::isnan(b) ? notANumber : isTrue; }

/// What a tree may call, in one place. Comparisons and && and || are functions, too. Of max and min the first
/// argument counts where both are equal.
constexpr ExpressionFunction functions[] = {
    {"sin", 1, [](double x, double, double) { return std::sin(x); }},
    {"cos", 1, [](double x, double, double) { return std::cos(x); }},
    {"tan", 1, [](double x, double, double) { return std::tan(x); }},
    {"asin", 1, [](double x, double, double) { return std::asin(x); }},
    {"acos", 1, [](double x, double, double) { return std::acos(x); }},
    {"atan", 1, [](double x, double, double) { return std::atan(x); }},
    {"atan2", 2, [](double y, double x, double) { return std::atan2(y, x); }},
    {"sinh", 1, [](double x, double, double) { return std::sinh(x); }},
    {"cosh", 1, [](double x, double, double) { return std::cosh(x); }},
    {"tanh", 1, [](double x, double, double) { return std::tanh(x); }},
    {"asinh", 1, [](double x, double, double) { return std::asinh(x); }},
    {"acosh", 1, [](double x, double, double) { return std::acosh(x); }},
    {"atanh", 1, [](double x, double, double) { return std::atanh(x); }},
    {"exp", 1, [](double x, double, double) { return std::exp(x); }},
    {"log", 1, [](double x, double, double) { return std::log(x); }},
    {"log10", 1, [](double x, double, double) { return std::log10(x); }},
    {"sqrt", 1, [](double x, double, double) { return std::sqrt(x); }},
    {"abs", 1, [](double x, double, double) { return std::fabs(x); }},
    {"sign", 1, [](double x, double, double) { return signOf(x); }},
    {"stumpff", 2, [](double k, double x, double) { return stumpff(k, x); }},
    {"erf", 1, [](double x, double, double) { return std::erf(x); }},
    {"erfc", 1, [](double x, double, double) { return std::erfc(x); }},
    {"floor", 1, [](double x, double, double) { return std::floor(x); }},
    {"ceil", 1, [](double x, double, double) { return std::ceil(x); }},
    {"round", 1, [](double x, double, double) { return std::round(x); }},
    {"heaviside", 1, [](double x, double, double) { return (1 + signOf(x)) / 2; }},
    {"hypot", 2, [](double a, double b, double) { return std::hypot(a, b); }},
    {"mod", 2, [](double a, double b, double) { return a - b * std::floor(a / b); }},
    {"max", 2, [](double a, double b, double) { return a < b || std::isnan(b) ? b : a; }},
    {"min", 2, [](double a, double b, double) { return b < a || std::isnan(b) ? b : a; }},
    {"<", 2, [](double a, double b, double) { return truth(a < b, a, b); }},
    {"<=", 2, [](double a, double b, double) { return truth(a <= b, a, b); }},
    {"==", 2, [](double a, double b, double) { return truth(a == b, a, b); }},
    {"!=", 2, [](double a, double b, double) { return truth(a != b, a, b); }},
    {"and", 2, [](double a, double b, double) { return truth(a != 0 && b != 0, a, b); }},
    {"or", 2, [](double a, double b, double) { return truth(a != 0 || b != 0, a, b); }},
    {"if", 3, [](double c, double a, double b) { return std::isnan(c) ? c
                                                        : c != 0      ? a
                                                                      : b; }},
};

constexpr Signature reserved(std::string_view name, int arguments = 1) {
    return {name, name, arguments, arguments, true};
}
constexpr Signature later(std::string_view name, std::string_view meaning, int arguments = 1) {
    return {name, meaning, arguments, arguments};
}
constexpr Signature folding(std::string_view name) { return {name, name, 2, any, false, true}; }
constexpr Signature lookUp(Interpolant::Kind kind) {
    return {
        Interpolant::functionName(kind), Interpolant::functionName(kind), 1, 1, false, false, false, true};
}

/// As users write them. The first sixteen never were names; the others may be.
constexpr Signature signatures[] = {
    reserved("sin"),
    reserved("cos"),
    reserved("tan"),
    reserved("asin"),
    reserved("acos"),
    reserved("atan"),
    reserved("atan2", 2),
    reserved("sinh"),
    reserved("cosh"),
    reserved("tanh"),
    reserved("exp"),
    reserved("log"),
    reserved("sqrt"),
    reserved("abs"),
    reserved("sign"),
    reserved("stumpff", 2),
    later("ln", "log"),
    later("log10", "log10"),
    later("asinh", "asinh"),
    later("acosh", "acosh"),
    later("atanh", "atanh"),
    later("erf", "erf"),
    later("erfc", "erfc"),
    later("pow", "^", 2),
    folding("hypot"),
    folding("max"),
    folding("min"),
    later("mod", "mod", 2),
    later("floor", "floor"),
    later("ceil", "ceil"),
    later("round", "round"),
    later("heaviside", "heaviside"),
    later("step", "heaviside"),
    later("if", "if", 3),
    {"piecewise", "if", 3, any, false, false, true},
    lookUp(Interpolant::Kind::linear),
    lookUp(Interpolant::Kind::cubic),
};

}  // namespace

std::string Signature::counted() const {
    static constexpr std::string_view words[] = {"no", "one", "two", "three"};
    const std::string count(words[least]);
    return (least < most ? "at least " : "") + count + (least == 1 ? " argument" : " arguments");
}

const Signature* findSignature(std::string_view name) {
    for (const Signature& each : signatures)
        if (name == each.name) return &each;
    return nullptr;
}

const ExpressionFunction* findFunction(std::string_view name) {
    for (const ExpressionFunction& each : functions)
        if (name == each.name) return &each;
    return nullptr;
}

bool isFunctionName(std::string_view name) { return findSignature(name) != nullptr; }

const std::vector<std::string>& expressionFunctions() {
    static const std::vector<std::string> all = [] {
        std::vector<std::string> names;
        for (const Signature& each : signatures) names.emplace_back(each.name);
        return names;
    }();
    return all;
}

std::string argumentsOf(std::string_view function) {
    const Signature* const signature = findSignature(function);
    if (!signature) return "@";
    if (signature->isTable) return "@; -1, 2; 0, 0.5; 3, 1";
    std::string text = "@";
    for (int k = 1; k < signature->least; ++k) text += ", @";
    return text;
}

}  // namespace extremal
