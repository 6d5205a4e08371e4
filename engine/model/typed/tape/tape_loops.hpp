// SPDX-License-Identifier: GPL-3.0-or-later
/// The groups of a tape, carried out on numbers in the registers of an instruction set. Included by kernels
/// that are compiled for each of these (core/algebra/instruction_set.hpp).
///
/// A group whose operands are side by side goes over whole registers to its end and past it: a loop over the
/// rest would cost as much as the group. What is written there is of no use, and goes where nothing is kept
/// (tape.cpp); the bits of the group itself are those of its instructions one by one.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/core/algebra/registers.hpp"
#include "engine/model/typed/tape/tape.hpp"
#include "engine/model/typed/tape/tape_run.hpp"

namespace extremal::typed::detail {

/// One value in all lanes.
template <class Pack>
struct SameValue {
    Pack value;
    [[gnu::always_inline]] explicit SameValue(double one) : value(one - Pack{}) {}
    [[gnu::always_inline]] void load(Pack& to, std::size_t) const { to = value; }
};
template <class Pack>
struct SideBySide {
    const double* at;
    [[gnu::always_inline]] void load(Pack& to, std::size_t k) const { registers::load(to, at + k); }
};

/// to[k] = an operation on a[k], b[k], c[k], of which it has some. `to` is apart from them.
template <class Pack>
class GroupLoop {
public:
    GroupLoop(const TapeGroup& g, const Instruction& first, double* r)
        : count_(g.count), to_(r + first.to), a_(r + first.a), b_(r + first.b), c_(r + first.c), group_(g) {}

    [[gnu::always_inline]] void carryOut(Op op) const {
        switch (op) {
            case Op::add:
                return binary([](Pack& to, const Pack& x, const Pack& y) { to = x + y; });
            case Op::subtract:
                return binary([](Pack& to, const Pack& x, const Pack& y) { to = x - y; });
            case Op::multiply:
                return binary([](Pack& to, const Pack& x, const Pack& y) { to = x * y; });
            case Op::multiplyAdd:
                return ternary([](Pack& to, const Pack& x, const Pack& y, const Pack& z) { to = x * y + z; });
            case Op::multiplySubtract:
                return ternary([](Pack& to, const Pack& x, const Pack& y, const Pack& z) { to = x * y - z; });
            case Op::subtractProduct:
                return ternary([](Pack& to, const Pack& x, const Pack& y, const Pack& z) { to = z - x * y; });
            case Op::negate:
                return unary([](Pack& to, const Pack& x) { to = -x; });
            case Op::reciprocal:
                return unary([](Pack& to, const Pack& x) { to = 1 / x; });
            case Op::sqrt:
                return unary([](Pack& to, const Pack& x) {
                    for (int i = 0; i < registers::lanesOf<Pack>; ++i) to[i] = __builtin_sqrt(x[i]);
                });
            default:
                return;
        }
    }

private:
    static constexpr auto lanes = static_cast<std::size_t>(registers::lanesOf<Pack>);

    /// `use` of the values of one operand of all instructions.
    template <class Use>
    [[gnu::always_inline]] static void with(TapeGroup::Operand kind, const double* at, Use&& use) {
        if (kind == TapeGroup::Operand::single)
            use(SameValue<Pack>(*at));
        else
            use(SideBySide<Pack>{at});
    }
    template <class F>
    [[gnu::always_inline]] void unary(F&& f) const {
        with(group_.a, a_, [to = to_, n = count_, f](auto a) {
            for (std::size_t k = 0; k < n; k += lanes) {
                Pack x, y;
                a.load(x, k);
                f(y, x);
                registers::store(to + k, y);
            }
        });
    }
    template <class F>
    [[gnu::always_inline]] void binary(F&& f) const {
        with(group_.a, a_, [&](auto a) {
            with(group_.b, b_, [to = to_, n = count_, a, f](auto b) {
                for (std::size_t k = 0; k < n; k += lanes) {
                    Pack x, y, z;
                    a.load(x, k);
                    b.load(y, k);
                    f(z, x, y);
                    registers::store(to + k, z);
                }
            });
        });
    }
    template <class F>
    [[gnu::always_inline]] void ternary(F&& f) const {
        with(group_.a, a_, [&](auto a) {
            with(group_.b, b_, [&](auto b) {
                with(group_.c, c_, [to = to_, n = count_, a, b, f](auto c) {
                    for (std::size_t k = 0; k < n; k += lanes) {
                        Pack x, y, z, w;
                        a.load(x, k);
                        b.load(y, k);
                        c.load(z, k);
                        f(w, x, y, z);
                        registers::store(to + k, w);
                    }
                });
            });
        });
    }

    std::size_t count_;
    double* to_;
    const double *a_, *b_, *c_;
    const TapeGroup& group_;
};

/// All instructions of a tape whose constants are in place, in groups where there are some.
template <class Pack>
[[gnu::always_inline]] inline void carryOutAll(const Tape& tape, double* r) {
    if (tape.groups().empty()) {
        for (const Instruction& i : tape.code()) carryOut(tape, i, r);
        return;
    }
    for (const TapeGroup& g : tape.groups()) {
        const Instruction* const code = &tape.code()[g.first];
        if (!g.isLoop)
            for (std::uint32_t k = 0; k < g.count; ++k) carryOut(tape, code[k], r);
        else if (g.isSideBySide())
            GroupLoop<Pack>(g, *code, r).carryOut(code->op);
        else
            carryOutLoop(g, code, r);
    }
}

}  // namespace extremal::typed::detail
