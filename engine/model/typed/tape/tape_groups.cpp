// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/tape/tape_groups.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/core/algebra/instruction_set.hpp"

namespace extremal::typed {
namespace {

using Operand = TapeGroup::Operand;

struct Single {
    double value;
    double operator[](std::size_t) const { return value; }
};

/// use(values) of an operand that is one value, or values side by side.
template <class Use>
[[gnu::always_inline]] inline void withOperand(Operand kind, const double* r, std::uint32_t first,
                                               Use&& use) {
    if (kind == Operand::single)
        use(Single{r[first]});
    else
        use(r + first);
}

template <class F>
[[gnu::always_inline]] inline void unary(const TapeGroup& g, const Instruction* code, double* r, F&& f) {
    double* __restrict const to = r + code->to;
    if (g.isRegular)
        withOperand(g.a, r, code->a, [&](auto a) {
            for (std::size_t k = 0; k < g.count; ++k) to[k] = f(a[k]);
        });
    else
        for (std::size_t k = 0; k < g.count; ++k) to[k] = f(r[code[k].a]);
}

template <class F>
[[gnu::always_inline]] inline void binary(const TapeGroup& g, const Instruction* code, double* r, F&& f) {
    double* __restrict const to = r + code->to;
    if (g.isRegular)
        withOperand(g.a, r, code->a, [&](auto a) {
            withOperand(g.b, r, code->b, [&](auto b) {
                for (std::size_t k = 0; k < g.count; ++k) to[k] = f(a[k], b[k]);
            });
        });
    else
        for (std::size_t k = 0; k < g.count; ++k) to[k] = f(r[code[k].a], r[code[k].b]);
}

template <class F>
[[gnu::always_inline]] inline void ternary(const TapeGroup& g, const Instruction* code, double* r, F&& f) {
    double* __restrict const to = r + code->to;
    if (g.isRegular)
        withOperand(g.a, r, code->a, [&](auto a) {
            withOperand(g.b, r, code->b, [&](auto b) {
                withOperand(g.c, r, code->c, [&](auto c) {
                    for (std::size_t k = 0; k < g.count; ++k) to[k] = f(a[k], b[k], c[k]);
                });
            });
        });
    else
        for (std::size_t k = 0; k < g.count; ++k) to[k] = f(r[code[k].a], r[code[k].b], r[code[k].c]);
}

bool isArithmetic(Op op) {
    switch (op) {
        case Op::sinCos:
        case Op::call:
        case Op::call2:
        case Op::choose:
        case Op::lookUp:
            return false;
        default:
            return true;
    }
}

void carryOut(const TapeGroup* group, const Instruction* code, double* r) {
    const TapeGroup& g = *group;
    switch (code->op) {
        case Op::add:
            return binary(g, code, r, [](double a, double b) { return a + b; });
        case Op::subtract:
            return binary(g, code, r, [](double a, double b) { return a - b; });
        case Op::multiply:
            return binary(g, code, r, [](double a, double b) { return a * b; });
        case Op::multiplyAdd:
            return ternary(g, code, r, [](double a, double b, double c) { return a * b + c; });
        case Op::multiplySubtract:
            return ternary(g, code, r, [](double a, double b, double c) { return a * b - c; });
        case Op::subtractProduct:
            return ternary(g, code, r, [](double a, double b, double c) { return c - a * b; });
        case Op::negate:
            return unary(g, code, r, [](double a) { return -a; });
        case Op::reciprocal:
            return unary(g, code, r, [](double a) { return 1 / a; });
        case Op::sqrt:
            return unary(g, code, r, [](double a) { return __builtin_sqrt(a); });
        default:
            return;
    }
}

/// Whether an operand of all instructions is one register, or registers side by side.
bool isPattern(std::span<const Instruction> group, std::uint32_t Instruction::*operand, Operand& kind) {
    const std::uint32_t first = group.front().*operand, step = group[1].*operand - first;
    kind = step == 0 ? Operand::single : Operand::sideBySide;
    if (step > 1) return false;
    for (std::size_t k = 0; k < group.size(); ++k)
        if (group[k].*operand != first + step * static_cast<std::uint32_t>(k)) return false;
    return true;
}

}  // namespace

std::vector<TapeGroup> groupsOf(std::span<const Instruction> code) {
    std::vector<TapeGroup> groups;
    for (std::size_t first = 0, end = 0; first < code.size(); first = end) {
        const std::uint32_t to = code[first].to;
        const auto readsOwn = [&](const Instruction& i) {  // registers are written in order
            return std::max({i.a, i.b, i.op == Op::call || i.op == Op::call2 ? 0 : i.c}) >= to;
        };
        end = first + 1;
        while (end < code.size() && code[end].op == code[first].op && code[end].to == to + (end - first) &&
               code[first].op != Op::sinCos && !readsOwn(code[end]))
            ++end;
        TapeGroup g{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end - first)};
        g.isLoop = g.count > 1 && isArithmetic(code[first].op);
        if (g.isLoop) {
            const auto all = code.subspan(first, g.count);
            g.isRegular = isPattern(all, &Instruction::a, g.a);
            // Operands that an operation does not have are 0 in all of them.
            g.isRegular = isPattern(all, &Instruction::b, g.b) && g.isRegular;
            g.isRegular = isPattern(all, &Instruction::c, g.c) && g.isRegular;
        }
        groups.push_back(g);
    }
    return groups;
}

void runLoop(const TapeGroup& group, const Instruction* code, double* r) {
    static const auto call = ForThisMachine<&carryOut>::call();
    call(&group, code, r);
}

}  // namespace extremal::typed
