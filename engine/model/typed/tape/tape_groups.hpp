// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs of a tape whose instructions are alike and do not read each other's results, such as the springs of a
/// chain: loops in place of one decision after the other, over vectors where operands stand side by side.
/// The bits are those of the instructions one by one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/model/typed/tape/tape.hpp"

namespace extremal::typed {

/// Of code whose registers are written once: the groups in it, those of one instruction included. Neighbours
/// of one operation belong together where none reads what another makes.
std::vector<TapeGroup> groupsOf(std::span<const Instruction> code);

/// Carries out a group that is a loop.
void runLoop(const TapeGroup& group, const Instruction* code, double* r);

}  // namespace extremal::typed
