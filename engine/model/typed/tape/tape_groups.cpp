// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/tape/tape_groups.hpp"

#include <cstddef>
#include <cstdint>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/model/typed/tape/tape_run.hpp"

namespace extremal::typed {
namespace {

using Operand = TapeGroup::Operand;

struct Single {
    double value;
    double operator[](std::size_t) const { return value; }
};

/// An operand of all instructions of a loop: one value, or values side by side.
struct Values {
    bool isSingle;
    const double* at;

    template <class Use>
    [[gnu::always_inline]] void with(Use&& use) const {
        if (isSingle)
            use(Single{*at});
        else
            use(at);
    }
};

/// to[k] = an operation on a[k], b[k], c[k], of which it has some. `to` is apart from them, which the
/// compiler is told.
struct Loop {
    std::size_t count;
    double* to;
    Values a, b, c;

    template <class F>
    [[gnu::always_inline]] void unary(F&& f) const {
        a.with([out = to, n = count, f](auto x) {
#pragma GCC ivdep
            for (std::size_t k = 0; k < n; ++k) out[k] = f(x[k]);
        });
    }
    template <class F>
    [[gnu::always_inline]] void binary(F&& f) const {
        a.with([&](auto x) {
            b.with([out = to, n = count, x, f](auto y) {
#pragma GCC ivdep
                for (std::size_t k = 0; k < n; ++k) out[k] = f(x[k], y[k]);
            });
        });
    }
    template <class F>
    [[gnu::always_inline]] void ternary(F&& f) const {
        a.with([&](auto x) {
            b.with([&](auto y) {
                c.with([out = to, n = count, x, y, f](auto z) {
#pragma GCC ivdep
                    for (std::size_t k = 0; k < n; ++k) out[k] = f(x[k], y[k], z[k]);
                });
            });
        });
    }
    [[gnu::always_inline]] void carryOut(Op op) const {
        switch (op) {
            case Op::add:
                return binary([](double x, double y) { return x + y; });
            case Op::subtract:
                return binary([](double x, double y) { return x - y; });
            case Op::multiply:
                return binary([](double x, double y) { return x * y; });
            case Op::multiplyAdd:
                return ternary([](double x, double y, double z) { return x * y + z; });
            case Op::multiplySubtract:
                return ternary([](double x, double y, double z) { return x * y - z; });
            case Op::subtractProduct:
                return ternary([](double x, double y, double z) { return z - x * y; });
            case Op::negate:
                return unary([](double x) { return -x; });
            case Op::reciprocal:
                return unary([](double x) { return 1 / x; });
            case Op::sqrt:
                return unary([](double x) { return __builtin_sqrt(x); });
            default:
                return;
        }
    }
};

[[gnu::always_inline]] inline void carryOut(const TapeGroup& g, const Instruction* code, double* r) {
    if (g.a == Operand::scattered || g.b == Operand::scattered || g.c == Operand::scattered)
        return detail::carryOutLoop(g, code, r);
    const auto values = [&](Operand kind, std::uint32_t first) {
        return Values{kind == Operand::single, r + first};
    };
    Loop{g.count, r + code->to, values(g.a, code->a), values(g.b, code->b), values(g.c, code->c)}.carryOut(
        code->op);
}

void carryOutGroups(const Tape* tape, double* r) {
    detail::fillConstants(*tape, r);
    for (const TapeGroup& g : tape->groups()) {
        const Instruction* const code = &tape->code()[g.first];
        if (g.isLoop)
            carryOut(g, code, r);
        else
            for (std::uint32_t k = 0; k < g.count; ++k) detail::carryOut(*tape, code[k], r);
    }
}

}  // namespace

void runGroups(const Tape& tape, double* r) {
    static const auto call = ForThisMachine<&carryOutGroups>::call();
    call(&tape, r);
}

}  // namespace extremal::typed
