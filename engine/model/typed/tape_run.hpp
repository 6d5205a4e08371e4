/// The instructions of a tape, carried out on numbers or on eight numbers together (Lanes).
#pragma once

#include <cmath>
#include <cstddef>

#include "engine/core/lanes.hpp"
#include "engine/core/lanes_trigonometry.hpp"
#include "engine/model/typed/graph.hpp"
#include "engine/model/typed/tape.hpp"

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
            return static_cast<double>((a > 0) - (a < 0));
        case Function::atan2:
        case Function::power:
            break;
    }
    return a;
}
inline Lanes callOne(Function function, const Lanes& a) {
    if (function == Function::sin) return sin(a);
    if (function == Function::cos) return cos(a);
    return a.map([function](double v) { return callOne(function, v); });
}

inline double callTwo(Function function, double a, double b) {
    return function == Function::atan2 ? std::atan2(a, b) : std::pow(a, b);
}
inline Lanes callTwo(Function function, const Lanes& a, const Lanes& b) {
    Lanes r;
    for (std::size_t i = 0; i < Lanes::size; ++i) r.lane[i] = callTwo(function, a.lane[i], b.lane[i]);
    return r;
}

template <class T>
void run(const Tape& tape, T* r) {
    using std::cos;
    using std::sin;
    using std::sqrt;
    T* constant = r + tape.inputs();
    for (const double value : tape.constants()) *constant++ = T(value);
    for (const Instruction& i : tape.code()) {
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
        }
    }
}

}  // namespace extremal::typed::detail
