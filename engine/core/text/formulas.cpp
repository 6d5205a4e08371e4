// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/text/formulas.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/asinh.hpp>
#include <boost/math/special_functions/erf.hpp>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "engine/core/algebra/long_numbers.hpp"
#include "engine/core/algebra/stumpff.hpp"
#include "engine/core/work.hpp"

namespace extremal {
namespace {

/// In the order of EvaluatedFormulas::call, then of laterCall.
const char* const calls[] = {
    "sin", "cos",  "tan",   "asin", "acos",  "atan",      "sinh",  "cosh",  "tanh",  "exp",
    "log", "sqrt", "abs",   "sign", "atan2", "stumpff",   "asinh", "acosh", "atanh", "log10",
    "erf", "erfc", "floor", "ceil", "round", "heaviside", "hypot", "mod",   "max",   "min",
    "<",   "<=",   "==",    "!=",   "and",   "or",        "if"};
constexpr int firstLater = 16;

int numberOf(const std::string& name) {
    return static_cast<int>(std::find(std::begin(calls), std::end(calls), name) - std::begin(calls));
}

bool uses(const Expression& expression, std::string_view name) {
    const auto names = expression.names();
    return std::find(names.begin(), names.end(), name) != names.end();
}

template <class T>
T numberFrom(const Expression::Node& node) {
    using std::atan;
    if (node.name == "pi") return 4 * atan(T(1));
    return node.name.empty() ? T(node.number) : T(node.name.c_str());
}

/// Which names the functions need, directly or through later names: others may name h where no step is known.
std::vector<bool> usedNames(const Formulas& formulas) {
    std::vector<bool> isUsed(formulas.names.size(), false);
    for (std::size_t j = isUsed.size(); j-- > 0;) {
        const std::string& name = formulas.names[j].first;
        isUsed[j] = std::any_of(formulas.functions.begin(), formulas.functions.end(),
                                [&](const Expression& e) { return uses(e, name); });
        for (std::size_t later = j + 1; later < isUsed.size() && !isUsed[j]; ++later)
            isUsed[j] = isUsed[later] && uses(formulas.names[later].second, name);
    }
    return isUsed;
}

}  // namespace

bool Formulas::dependOnStep() const {
    std::vector<std::string> dependent{"h"};
    const auto depends = [&](const Expression& e) {
        return std::any_of(dependent.begin(), dependent.end(),
                           [&](const std::string& name) { return uses(e, name); });
    };
    for (const auto& [name, expression] : names)
        if (depends(expression)) dependent.push_back(name);
    return std::any_of(functions.begin(), functions.end(), depends);
}

template <class T>
EvaluatedFormulas<T>::EvaluatedFormulas(const Formulas& formulas) {
    std::vector<std::pair<std::string, int>> known;
    const std::vector<bool> isUsed = usedNames(formulas);
    for (std::size_t j = 0; j < isUsed.size(); ++j) {
        const auto& [name, expression] = formulas.names[j];
        if (isUsed[j]) known.emplace_back(name, append(expression, known, formulas.step));
    }
    for (const Expression& function : formulas.functions)
        results_.push_back(append(function, known, formulas.step));
}

template <class T>
int EvaluatedFormulas<T>::append(const Expression& expression,
                                 const std::vector<std::pair<std::string, int>>& known,
                                 const std::optional<double>& step) {
    std::vector<int> place;
    const auto operand = [&](int node) { return node < 0 ? -1 : place[static_cast<std::size_t>(node)]; };
    for (const Expression::Node& node : expression.nodes) {
        Instruction made{node.kind, operand(node.left), operand(node.right), operand(node.third), 0,
                         T(0),      node.table};
        if (node.kind == Operator::number) made.number = numberFrom<T>(node);
        if (node.kind == Operator::call) made.function = numberOf(node.name);
        if (node.kind == Operator::name && node.name != "tau") {
            const auto found = std::find_if(known.begin(), known.end(),
                                            [&](const auto& entry) { return entry.first == node.name; });
            if (found != known.end()) {
                place.push_back(found->second);
                continue;
            }
            if (node.name != "h" || !step)
                throw ExpressionError("has an unknown name \"" + node.name + "\"", node.position);
            made.kind = Operator::number;
            made.number = T(*step);
        }
        code_.push_back(std::move(made));
        place.push_back(static_cast<int>(code_.size()) - 1);
    }
    return place.back();
}

template <class T>
typename EvaluatedFormulas<T>::Dual EvaluatedFormulas<T>::power(const Dual& a, const Dual& b) {
    using std::log;
    using std::pow;
    const auto exponent = static_cast<double>(b.value);
    if (b.slope == 0 && exponent == std::floor(exponent) && std::fabs(exponent) <= 1000) {
        const int n = static_cast<int>(exponent);
        if (n == 0) return {T(1), T(0)};
        T lower(1), base = n > 0 ? a.value : T(1 / a.value);  // base^(|n| - 1)
        T factor = base;
        for (int k = std::abs(n) - 1; k > 0; k /= 2, factor *= factor)
            if (k % 2 == 1) lower *= factor;
        const T value = lower * base;
        return {value, n > 0 ? T(T(n) * lower * a.slope) : T(T(n) * value * base * a.slope)};
    }
    const T value = pow(a.value, b.value);
    T slope = b.value * pow(a.value, T(b.value - 1)) * a.slope;
    if (b.slope != 0) slope += value * log(a.value) * b.slope;
    return {value, slope};
}

template <class T>
typename EvaluatedFormulas<T>::Dual EvaluatedFormulas<T>::call(int function, const Dual& a, const Dual& b,
                                                               const Dual& c) {
    using std::abs;
    using std::acos;
    using std::asin;
    using std::atan;
    using std::atan2;
    using std::cos;
    using std::cosh;
    using std::exp;
    using std::log;
    using std::sin;
    using std::sinh;
    using std::sqrt;
    using std::tan;
    using std::tanh;
    const T& x = a.value;
    const T sign = T((x > 0) - (x < 0));
    switch (function) {
        case 0:
            return {sin(x), T(cos(x) * a.slope)};
        case 1:
            return {cos(x), T(-sin(x) * a.slope)};
        case 2: {
            const T y = tan(x);
            return {y, T((1 + y * y) * a.slope)};
        }
        case 3:
            return {asin(x), T(a.slope / sqrt(T(1 - x * x)))};
        case 4:
            return {acos(x), T(-a.slope / sqrt(T(1 - x * x)))};
        case 5:
            return {atan(x), T(a.slope / (1 + x * x))};
        case 6:
            return {sinh(x), T(cosh(x) * a.slope)};
        case 7:
            return {cosh(x), T(sinh(x) * a.slope)};
        case 8: {
            const T y = tanh(x);
            return {y, T((1 - y * y) * a.slope)};
        }
        case 9: {
            const T y = exp(x);
            return {y, T(y * a.slope)};
        }
        case 10:
            return {log(x), T(a.slope / x)};
        case 11: {
            const T y = sqrt(x);
            return {y, a.slope == 0 ? T(0) : T(a.slope / (2 * y))};
        }
        case 12:
            return {abs(x), T(sign * a.slope)};
        case 13:
            return {sign, T(0)};
        case 14:
            return {atan2(x, b.value), T((b.value * a.slope - x * b.slope) / (x * x + b.value * b.value))};
        case 15: {
            // c_k(x) of b at the order a, which is a number.
            const T slope = (x * stumpff(T(x + 2), b.value) - stumpff(T(x + 1), b.value)) / 2;
            return {stumpff(x, b.value), T(slope * b.slope)};
        }
        default:
            return laterCall(function - firstLater, a, b, c);
    }
}

template <class T>
typename EvaluatedFormulas<T>::Dual EvaluatedFormulas<T>::laterCall(int function, const Dual& a,
                                                                    const Dual& b, const Dual& c) {
    const T &x = a.value, &y = b.value;
    const auto truth = [&](bool isTrue) { return Dual{x != x ? x : y != y ? y : T(isTrue), T(0)}; };
    const auto bell = [&] { return T(2 / sqrt(boost::math::constants::pi<T>()) * exp(T(-x * x)) * a.slope); };
    switch (function) {
        case 0:
            return {boost::math::asinh(x), T(a.slope / sqrt(T(x * x + 1)))};
        case 1:
            return {log(T(x + sqrt(T(x - 1)) * sqrt(T(x + 1)))), T(a.slope / sqrt(T(x * x - 1)))};
        case 2:
            return {T(log(T((1 + x) / (1 - x))) / 2), T(a.slope / (1 - x * x))};
        case 3:
            return {T(log(x) / log(T(10))), T(a.slope / (x * log(T(10))))};
        case 4:
            return {boost::math::erf(x), bell()};
        case 5:
            return {boost::math::erfc(x), T(-bell())};
        case 6:
            return {floor(x), T(0)};
        case 7:
            return {ceil(x), T(0)};
        case 8:
            return {x < 0 ? T(-floor(T(-x + T(0.5)))) : T(floor(T(x + T(0.5)))), T(0)};
        case 9:
            return {x != x ? x : x > 0 ? T(1) : x < 0 ? T(0) : T(0.5), T(0)};
        case 10: {
            const T r = sqrt(T(x * x + y * y));
            return {r, T((x * a.slope + y * b.slope) / r)};
        }
        case 11: {
            const T whole = floor(T(x / y));
            return {T(x - y * whole), T(a.slope - whole * b.slope)};
        }
        case 12:
            return x < y || y != y ? b : a;
        case 13:
            return y < x || y != y ? b : a;
        case 14:
            return truth(x < y);
        case 15:
            return truth(x <= y);
        case 16:
            return truth(x == y);
        case 17:
            return truth(x != y);
        case 18:
            return truth(x != 0 && y != 0);
        case 19:
            return truth(x != 0 || y != 0);
        default:
            return x != x ? a : x != 0 ? b : c;
    }
}

template <class T>
void EvaluatedFormulas<T>::operator()(const T& tau, std::span<T> value, std::span<T> derivative) const {
    // Functions such as sin take longer than products, and numbers less.
    work::spend(4 * static_cast<double>(code_.size()) *
                (std::is_same_v<T, Quad> ? work::quadruple : work::hundredDigits));
    std::vector<Dual> at;
    at.reserve(code_.size());
    const Dual none;
    const auto operand = [&](int place) -> const Dual& {
        return place < 0 ? none : at[static_cast<std::size_t>(place)];
    };
    for (const Instruction& code : code_) {
        const Dual &a = operand(code.left), &b = operand(code.right);
        switch (code.kind) {
            case Operator::number:
                at.push_back({code.number, T(0)});
                break;
            case Operator::name:
                at.push_back({tau, T(1)});
                break;
            case Operator::negate:
                at.push_back({T(-a.value), T(-a.slope)});
                break;
            case Operator::add:
                at.push_back({T(a.value + b.value), T(a.slope + b.slope)});
                break;
            case Operator::subtract:
                at.push_back({T(a.value - b.value), T(a.slope - b.slope)});
                break;
            case Operator::multiply:
                at.push_back({T(a.value * b.value), T(a.slope * b.value + a.value * b.slope)});
                break;
            case Operator::divide: {
                const T quotient = a.value / b.value;
                at.push_back({quotient, T((a.slope - quotient * b.slope) / b.value)});
                break;
            }
            case Operator::power:
                at.push_back(power(a, b));
                break;
            case Operator::call:
                if (code.table)
                    at.push_back({code.table->at(a.value), T(code.table->at(a.value, 1) * a.slope)});
                else
                    at.push_back(call(code.function, a, b, operand(code.third)));
                break;
        }
    }
    for (std::size_t a = 0; a < results_.size(); ++a) {
        value[a] = operand(results_[a]).value;
        derivative[a] = operand(results_[a]).slope;
    }
}

template class EvaluatedFormulas<Quad>;
template class EvaluatedFormulas<Hundred>;

}  // namespace extremal
