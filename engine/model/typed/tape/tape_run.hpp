// SPDX-License-Identifier: GPL-3.0-or-later
/// The instructions of a tape, carried out on numbers or on eight numbers together (Lanes). Of numbers alone
/// groups are in tape_groups.hpp.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "engine/core/algebra/lanes.hpp"
#include "engine/core/algebra/lanes_trigonometry.hpp"
#include "engine/model/typed/graph.hpp"
#include "engine/model/typed/tape/tape.hpp"

namespace extremal::typed::detail {

inline double callOne(Function function, double a) {
    switch (function) {
        case Function::sin:
            return std::sin(a);
        case Function::cos:
            return std::cos(a);
        case Function::tan:
            return std::tan(a);
        case Function::asin:
            return std::asin(a);
        case Function::acos:
            return std::acos(a);
        case Function::atan:
            return std::atan(a);
        case Function::sinh:
            return std::sinh(a);
        case Function::cosh:
            return std::cosh(a);
        case Function::tanh:
            return std::tanh(a);
        case Function::exp:
            return std::exp(a);
        case Function::log:
            return std::log(a);
        case Function::abs:
            return std::fabs(a);
        case Function::sign:
            return a > 0 ? 1 : a < 0 ? -1 : a;
        case Function::asinh:
            return std::asinh(a);
        case Function::acosh:
            return std::acosh(a);
        case Function::atanh:
            return std::atanh(a);
        case Function::erf:
            return std::erf(a);
        case Function::erfc:
            return std::erfc(a);
        case Function::floor:
            return std::floor(a);
        case Function::ceil:
            return std::ceil(a);
        case Function::round:
            return std::round(a);
        case Function::heaviside:
            return a > 0 ? 1 : a < 0 ? 0 : 0.5 + a;
        default:
            break;
    }
    return a;
}
inline Lanes callOne(Function function, const Lanes& a) {
    if (function == Function::sin) return sin(a);
    if (function == Function::cos) return cos(a);
    return a.map([function](double v) { return callOne(function, v); });
}

/// Not a number where an operand is not: neither true nor false.
inline double truth(bool isTrue, double a, double b) {
    return std::isnan(a) || std::isnan(b) ? std::numeric_limits<double>::quiet_NaN() : isTrue;
}
inline double callTwo(Function function, double a, double b) {
    switch (function) {
        case Function::atan2:
            return std::atan2(a, b);
        case Function::hypot:
            return std::hypot(a, b);
        case Function::max:
            return a < b || std::isnan(b) ? b : a;
        case Function::min:
            return b < a || std::isnan(b) ? b : a;
        case Function::less:
            return truth(a < b, a, b);
        case Function::lessOrEqual:
            return truth(a <= b, a, b);
        case Function::equal:
            return truth(a == b, a, b);
        case Function::notEqual:
            return truth(a != b, a, b);
        default:
            return std::pow(a, b);
    }
}
inline Lanes callTwo(Function function, const Lanes& a, const Lanes& b) {
    Lanes r;
    for (std::size_t i = 0; i < Lanes::size; ++i) r.lane[i] = callTwo(function, a.lane[i], b.lane[i]);
    return r;
}

inline double choose(double a, double b, double c) { return std::isnan(a) ? a : a != 0 ? b : c; }
inline Lanes choose(const Lanes& a, const Lanes& b, const Lanes& c) {
    Lanes r;
    for (std::size_t i = 0; i < Lanes::size; ++i) r.lane[i] = choose(a.lane[i], b.lane[i], c.lane[i]);
    return r;
}
inline double lookUp(const LookUp& table, double a) { return table.table->at(a, table.order); }
inline Lanes lookUp(const LookUp& table, const Lanes& a) {
    return a.map([&](double v) { return lookUp(table, v); });
}

template <class T>
void carryOut(const Tape& tape, const Instruction& i, T* r) {
    using std::cos;
    using std::sin;
    using std::sqrt;
    switch (i.op) {
        case Op::add:
            r[i.to] = r[i.a] + r[i.b];
            break;
        case Op::subtract:
            r[i.to] = r[i.a] - r[i.b];
            break;
        case Op::multiply:
            r[i.to] = r[i.a] * r[i.b];
            break;
        case Op::multiplyAdd:
            r[i.to] = r[i.a] * r[i.b] + r[i.c];
            break;
        case Op::multiplySubtract:
            r[i.to] = r[i.a] * r[i.b] - r[i.c];
            break;
        case Op::subtractProduct:
            r[i.to] = r[i.c] - r[i.a] * r[i.b];
            break;
        case Op::negate:
            r[i.to] = -r[i.a];
            break;
        case Op::reciprocal:
            r[i.to] = T(1) / r[i.a];
            break;
        case Op::sqrt:
            r[i.to] = sqrt(r[i.a]);
            break;
        case Op::sinCos: {
            const T angle = r[i.a];
            r[i.to] = sin(angle);
            r[i.c] = cos(angle);
            break;
        }
        case Op::call:
            r[i.to] = callOne(static_cast<Function>(i.c), r[i.a]);
            break;
        case Op::call2:
            r[i.to] = callTwo(static_cast<Function>(i.c), r[i.a], r[i.b]);
            break;
        case Op::choose:
            r[i.to] = choose(r[i.a], r[i.b], r[i.c]);
            break;
        case Op::lookUp:
            r[i.to] = lookUp(tape.tables()[i.c], r[i.a]);
            break;
    }
}

template <class T>
void fillConstants(const Tape& tape, T* r) {
    T* constant = r + tape.inputs();
    for (const double value : tape.constants()) *constant++ = T(value);
}

/// One after the other, whether there are groups or not.
template <class T>
void run(const Tape& tape, T* r) {
    fillConstants(tape, r);
    for (const Instruction& i : tape.code()) carryOut(tape, i, r);
}

/// A group that is a loop; what it reads may be anywhere.
template <class T, class F>
void loop(const TapeGroup& g, const Instruction* code, T* r, F&& f) {
    T* to = r + code->to;
    for (std::uint32_t k = 0; k < g.count; ++k) *to++ = f(r[code[k].a], r[code[k].b], r[code[k].c]);
}
template <class T>
void carryOutLoop(const TapeGroup& g, const Instruction* code, T* r) {
    using std::sqrt;
    using V = const T&;
    switch (code->op) {
        case Op::add:
            return loop(g, code, r, [](V a, V b, V) { return a + b; });
        case Op::subtract:
            return loop(g, code, r, [](V a, V b, V) { return a - b; });
        case Op::multiply:
            return loop(g, code, r, [](V a, V b, V) { return a * b; });
        case Op::multiplyAdd:
            return loop(g, code, r, [](V a, V b, V c) { return a * b + c; });
        case Op::multiplySubtract:
            return loop(g, code, r, [](V a, V b, V c) { return a * b - c; });
        case Op::subtractProduct:
            return loop(g, code, r, [](V a, V b, V c) { return c - a * b; });
        case Op::negate:
            return loop(g, code, r, [](V a, V, V) { return -a; });
        case Op::reciprocal:
            return loop(g, code, r, [](V a, V, V) { return T(1) / a; });
        case Op::sqrt:
            return loop(g, code, r, [](V a, V, V) { return sqrt(a); });
        default:
            return;
    }
}

/// In groups where there are some.
inline void runInGroups(const Tape& tape, Lanes* r) {
    if (tape.groups().empty()) return run(tape, r);
    fillConstants(tape, r);
    for (const TapeGroup& g : tape.groups()) {
        const Instruction* const code = &tape.code()[g.first];
        if (g.isLoop)
            carryOutLoop(g, code, r);
        else
            for (std::uint32_t k = 0; k < g.count; ++k) carryOut(tape, code[k], r);
    }
}

}  // namespace extremal::typed::detail
