// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/tape/tape_order.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>

namespace extremal::typed {
namespace {

using Operand = TapeGroup::Operand;

/// What instructions have in common that can be next to each other: which operands are the same in all of
/// them, and which; of the others, how far they are from the first of these.
struct OperandPattern {
    unsigned fixed = 0;  ///< bit k: operand k
    std::array<std::uint32_t, 3> of{};
    auto operator<=>(const OperandPattern&) const = default;
};

std::array<std::uint32_t, 3> operandsOf(const Instruction& code) { return {code.a, code.b, code.c}; }

/// The place of an instruction among those of its pattern.
std::uint32_t movingOperand(unsigned fixed, const Instruction& code) {
    return operandsOf(code)[(fixed & 1) == 0 ? 0 : (fixed & 2) == 0 ? 1 : 2];
}

OperandPattern patternOf(unsigned fixed, int operands, const Instruction& code) {
    OperandPattern pattern{fixed, {}};
    const std::uint32_t moving = movingOperand(fixed, code);
    for (unsigned k = 0; k < static_cast<unsigned>(operands); ++k) {
        const std::uint32_t own = operandsOf(code)[k];
        pattern.of[k] = (fixed >> k & 1) != 0 ? own : own - moving;
    }
    return pattern;
}

/// Shorter stretches cost as much as loops over registers anywhere.
constexpr std::size_t leastStretch = 12;

/// Of an instruction in a long stretch: which one that is, and the place in it.
struct Position {
    std::size_t length = 0, stretch = 0;  ///< length: of the stretch; 0: in none
    std::uint32_t moving = 0;
};

/// Each instruction in the longest stretch that it can be in.
std::vector<Position> positionsIn(std::span<const Line::Step> block) {
    struct Candidate {
        OperandPattern pattern;
        std::uint32_t moving;
        std::size_t index;
        auto operator<=>(const Candidate&) const = default;
    };
    const int operands = operandCount(block.front().code.op);
    std::vector<Candidate> all;
    for (std::size_t k = 0; k < block.size(); ++k)
        for (unsigned fixed = 0; fixed + 1 < 1U << operands; ++fixed)
            all.push_back(
                {patternOf(fixed, operands, block[k].code), movingOperand(fixed, block[k].code), k});
    std::sort(all.begin(), all.end());
    std::vector<Position> positions(block.size());
    for (std::size_t from = 0, to = 0; from < all.size(); from = to) {
        to = from + 1;
        while (to < all.size() && all[to].pattern == all[from].pattern &&
               all[to].moving == all[to - 1].moving + 1)
            ++to;
        if (to - from < leastStretch) continue;
        for (std::size_t k = from; k < to; ++k) {
            Position& own = positions[all[k].index];
            if (to - from > own.length) own = {to - from, from, all[k].moving};
        }
    }
    return positions;
}

/// Whether an operand of two instructions is the same register, or two side by side; which of them.
bool isNext(std::uint32_t one, std::uint32_t other, Operand& kind) {
    kind = one == other ? Operand::single : Operand::sideBySide;
    return other - one <= 1;
}

/// One past the last instruction whose operands go on as those of the first two do.
std::size_t endOfStretch(std::span<const Instruction> code, std::size_t first) {
    std::size_t end = first + 1;
    std::array<Operand, 3> kinds{}, next{};
    for (; end < code.size(); ++end) {
        const auto before = operandsOf(code[end - 1]), here = operandsOf(code[end]);
        bool goesOn = true;
        for (std::size_t k = 0; k < 3; ++k) goesOn = isNext(before[k], here[k], next[k]) && goesOn;
        if (end == first + 1) kinds = next;
        if (!goesOn || next != kinds) break;
    }
    return end;
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

Operand kindOf(std::span<const Instruction> group, std::uint32_t Instruction::*operand) {
    Operand kind = Operand::single, next = kind;
    for (std::size_t k = 1; k < group.size(); ++k) {
        if (!isNext(group[k - 1].*operand, group[k].*operand, next)) return Operand::scattered;
        if (k == 1) kind = next;
        if (next != kind) return Operand::scattered;
    }
    return kind;
}

}  // namespace

void sortByOperands(std::span<Line::Step> block) {
    if (block.size() < 2) return;
    const Op op = block.front().code.op;
    if (op == Op::add || op == Op::multiply)
        for (Line::Step& step : block)
            if (step.code.a > step.code.b) std::swap(step.code.a, step.code.b);
    const std::vector<Line::Step> before(block.begin(), block.end());
    const std::vector<Position> positions = positionsIn(before);
    std::vector<std::size_t> order(block.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const auto keyOf = [&](std::size_t k) {
            const auto& [length, stretch, moving] = positions[k];
            return std::tuple(length > 0, stretch, moving, operandsOf(before[k].code));
        };
        return keyOf(a) < keyOf(b);
    });
    for (std::size_t k = 0; k < block.size(); ++k) block[k] = before[order[k]];
}

void addGroups(std::span<const Instruction> code, std::size_t first, std::vector<TapeGroup>& groups) {
    const auto add = [&](std::size_t from, std::size_t to) {
        if (from == to) return;
        TapeGroup g{static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to - from)};
        const auto all = code.subspan(from, to - from);
        g.isLoop = g.count > 1 && isArithmetic(all.front().op);
        // Operands that an operation does not have are 0 in all of them.
        g.a = kindOf(all, &Instruction::a);
        g.b = kindOf(all, &Instruction::b);
        g.c = kindOf(all, &Instruction::c);
        groups.push_back(g);
    };
    std::size_t waiting = first;
    for (std::size_t at = first, end = 0; at < code.size(); at = end) {
        end = endOfStretch(code, at);
        if (end - at >= leastStretch) {
            add(waiting, at);
            add(waiting = at, end);
            waiting = end;
        } else if (end - at > 1 && end < code.size()) {
            --end;  // a stretch may begin with the last one
        }
    }
    add(waiting, code.size());
}

}  // namespace extremal::typed
