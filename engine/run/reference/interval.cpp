// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/interval.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/model/typed/tape/tape_run.hpp"

namespace extremal {
namespace {

using typed::Function;
using typed::Instruction;
using typed::Op;

/// What is not a number, as infinity minus infinity, may be anything.
RealInterval ordered(double a, double b) {
    if (std::isnan(a) || std::isnan(b)) return RealInterval::all();
    return {std::min(a, b), std::max(a, b)};
}

RealInterval sum(const RealInterval& a, const RealInterval& b) {
    return ordered(a.low + b.low, a.high + b.high);
}
RealInterval negative(const RealInterval& a) { return {-a.high, -a.low}; }

/// 0 times infinity is 0: what is bounded by infinity is not infinite.
double productOf(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }

RealInterval product(const RealInterval& a, const RealInterval& b) {
    const double all[] = {productOf(a.low, b.low), productOf(a.low, b.high), productOf(a.high, b.low),
                          productOf(a.high, b.high)};
    return {*std::min_element(std::begin(all), std::end(all)),
            *std::max_element(std::begin(all), std::end(all))};
}

RealInterval square(const RealInterval& a) {
    const double low = a.low * a.low, high = a.high * a.high;
    const bool hasZero = a.low <= 0 && a.high >= 0;
    return {hasZero ? 0 : std::min(low, high), std::max(low, high)};
}

RealInterval reciprocal(const RealInterval& a) {
    if (a.low <= 0 && a.high >= 0) return RealInterval::all();
    return ordered(1 / a.high, 1 / a.low);
}

/// cos: its largest value at whole turns, its smallest between.
RealInterval cosine(const RealInterval& a) {
    constexpr double turn = 2 * std::numbers::pi;
    if (!(a.width() < turn)) return {-1, 1};
    RealInterval c = ordered(std::cos(a.low), std::cos(a.high));
    if (std::floor(a.high / turn) > std::floor(a.low / turn) || std::fmod(a.low, turn) == 0) c.high = 1;
    if (std::floor(a.high / turn - 0.5) > std::floor(a.low / turn - 0.5)) c.low = -1;
    return c;
}
RealInterval sine(const RealInterval& a) {
    constexpr double quarter = std::numbers::pi / 2;
    return cosine({a.low - quarter, a.high - quarter});
}

RealInterval callOneOver(Function function, const RealInterval& a) {
    const auto rising = [&] {
        return ordered(typed::detail::callOne(function, a.low), typed::detail::callOne(function, a.high));
    };
    switch (function) {
        case Function::sin:
            return sine(a);
        case Function::cos:
            return cosine(a);
        case Function::abs:
            return a.low <= 0 && a.high >= 0 ? RealInterval{0, std::max(-a.low, a.high)}
                                             : ordered(std::fabs(a.low), std::fabs(a.high));
        case Function::cosh: {
            RealInterval c = rising();
            if (a.low <= 0 && a.high >= 0) c.low = 1;
            return c;
        }
        case Function::log:
            return a.low > 0 ? rising() : RealInterval::all();
        case Function::exp:
        case Function::atan:
        case Function::sinh:
        case Function::tanh:
        case Function::asinh:
        case Function::erf:
        case Function::erfc:
        case Function::sign:
        case Function::floor:
        case Function::ceil:
        case Function::round:
        case Function::heaviside:
            return rising();
        case Function::asin:
        case Function::acos:
            return a.low >= -1 && a.high <= 1 ? rising() : RealInterval::all();
        default:
            return RealInterval::all();
    }
}

RealInterval callTwoOver(Function function, const RealInterval& a, const RealInterval& b) {
    const auto truth = [](bool isSure, bool isPossible) {
        return RealInterval{isSure ? 1.0 : 0.0, isPossible ? 1.0 : 0.0};
    };
    switch (function) {
        case Function::max:
            return {std::max(a.low, b.low), std::max(a.high, b.high)};
        case Function::min:
            return {std::min(a.low, b.low), std::min(a.high, b.high)};
        case Function::less:
            return truth(a.high < b.low, a.low < b.high);
        case Function::lessOrEqual:
            return truth(a.high <= b.low, a.low <= b.high);
        case Function::power:
            // Of a positive base it is monotone in each: its extremes are at corners.
            if (!(a.low > 0)) return RealInterval::all();
            return {std::min({std::pow(a.low, b.low), std::pow(a.low, b.high), std::pow(a.high, b.low),
                              std::pow(a.high, b.high)}),
                    std::max({std::pow(a.low, b.low), std::pow(a.low, b.high), std::pow(a.high, b.low),
                              std::pow(a.high, b.high)})};
        default:
            return RealInterval::all();
    }
}

}  // namespace

void enclose(const typed::Tape& tape, RealInterval* r) {
    RealInterval* constant = r + tape.inputs();
    for (const double value : tape.constants()) *constant++ = {value, value};
    for (const Instruction& i : tape.code()) {
        const RealInterval a = r[i.a];
        // Of some instructions b and c are numbers of functions, and not of registers.
        const auto b = [&] { return r[i.b]; };
        const auto c = [&] { return r[i.c]; };
        const auto ab = [&] { return i.a == i.b ? square(a) : product(a, b()); };
        switch (i.op) {
            case Op::add:
                r[i.to] = sum(a, b());
                break;
            case Op::subtract:
                r[i.to] = sum(a, negative(b()));
                break;
            case Op::multiply:
                r[i.to] = ab();
                break;
            case Op::multiplyAdd:
                r[i.to] = sum(ab(), c());
                break;
            case Op::multiplySubtract:
                r[i.to] = sum(ab(), negative(c()));
                break;
            case Op::subtractProduct:
                r[i.to] = sum(c(), negative(ab()));
                break;
            case Op::negate:
                r[i.to] = negative(a);
                break;
            case Op::reciprocal:
                r[i.to] = reciprocal(a);
                break;
            case Op::sqrt:
                r[i.to] = a.high >= 0 ? RealInterval{std::sqrt(std::max(a.low, 0.0)), std::sqrt(a.high)}
                                      : RealInterval::all();
                break;
            case Op::sinCos:
                r[i.to] = sine(a);
                r[i.c] = cosine(a);  // a is a copy: it may be one of the two
                break;
            case Op::call:
                r[i.to] = callOneOver(static_cast<Function>(i.c), a);
                break;
            case Op::call2:
                r[i.to] = callTwoOver(static_cast<Function>(i.c), a, b());
                break;
            case Op::choose:
                if (a.low > 0 || a.high < 0)
                    r[i.to] = b();
                else if (a.low == 0 && a.high == 0)
                    r[i.to] = c();
                else
                    r[i.to] = {std::min(b().low, c().low), std::max(b().high, c().high)};
                break;
            case Op::lookUp:
                r[i.to] = RealInterval::all();
                break;
        }
    }
}

}  // namespace extremal
