// SPDX-License-Identifier: GPL-3.0-or-later
/// Tapes whose instructions are in groups that are alike, such as those of the springs of a chain: loops in
/// place of one decision after the other, over vectors of the machine where operands stand side by side. The
/// bits are those of the instructions one by one.
#pragma once

#include "engine/model/typed/tape/tape.hpp"

namespace extremal::typed {

/// Carries out a tape that has groups, in the instruction set of this machine.
void runGroups(const Tape& tape, double* r);

}  // namespace extremal::typed
