// SPDX-License-Identifier: GPL-3.0-or-later
/// The order of instructions that do not depend on each other, such that loops over them read registers side
/// by side. Internal to engine/model/typed.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/core/algebra/lanes.hpp"
#include "engine/model/typed/tape/tape.hpp"
#include "engine/model/typed/tape/tape_line.hpp"

namespace extremal::typed {

/// How many registers a loop may write past its end, where it goes over whole ones of the machine.
constexpr std::uint32_t loopOverrun = Lanes::size - 1;

/// Sorts steps of one operation whose operands are registers: those whose operands are side by side, or the
/// same, come after each other.
void sortByOperands(std::span<Line::Step> block);

/// Adds the groups of instructions of one operation, from `first` on to the end of the code: long stretches
/// with operands that are side by side or the same, and what is between them.
void addGroups(std::span<const Instruction> code, std::size_t first, std::vector<TapeGroup>& groups);

}  // namespace extremal::typed
