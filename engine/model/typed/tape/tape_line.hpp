// SPDX-License-Identifier: GPL-3.0-or-later
/// The instructions that some outputs need, in an order in which they can be carried out. Internal to
/// engine/model/typed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/model/typed/tape/tape.hpp"
#include "engine/model/typed/tape/tape_code.hpp"

namespace extremal::typed {

/// How many operands of an instruction are values; a comes first, then b, then c.
int operandCount(Op op);

/// f of every operand that is a value.
template <class Code, class F>
void forOperands(Code& code, F&& f) {
    const int n = operandCount(code.op);
    if (n > 0) f(code.a);
    if (n > 1) f(code.b);
    if (n > 2) f(code.c);
}

/// Operands are values until registers are given out.
struct Line {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    struct Step {
        Instruction code;
        std::uint32_t makes, makesToo = none;  ///< makesToo: cos of sinCos
    };
    /// Of steps of one operation that do not read each other's results: one past the last of each block.
    using Blocks = std::vector<std::size_t>;

    std::vector<Step> steps;
    std::vector<std::uint32_t> outputs;
    std::vector<int> uses;  ///< of each value

    Line(const std::vector<Code::Item>& items, std::vector<std::uint32_t> wanted);

    /// Sorts the steps by how many have to be there before them, and then by operations; empty, and nothing
    /// changed, where fewer than half of them are in large blocks.
    Blocks sortIntoBlocks();
    /// Puts steps that do not wait for each other between those that do: a processor that carries out several
    /// together has to wait for what is stored before it is read. The operations are the same.
    void spread();

private:
    void drop(const std::vector<char>& isDropped);
    void joinSinesAndCosines();
    void joinProductsAndSums();
};

}  // namespace extremal::typed
