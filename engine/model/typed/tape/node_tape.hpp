// SPDX-License-Identifier: GPL-3.0-or-later
/// A tape at eight nodes at a time, in line with its caller, which is compiled for several instruction sets
/// (core/algebra/instruction_set.hpp).
#pragma once

#include <cstddef>
#include <vector>

#include "engine/core/algebra/lanes.hpp"
#include "engine/model/typed/tape/tape.hpp"
#include "engine/model/typed/tape/tape_run.hpp"

namespace extremal::typed {

/// `fill(registers)` loads the inputs; `write(k, value)` takes output k of the eight nodes.
template <class Fill, class Write>
void runEight(const Tape& tape, const Fill& fill, const Write& write) {
    constexpr std::size_t few = 64;
    alignas(Lanes) std::byte small[few * sizeof(Lanes)];  // not initialised: a tape writes before it reads
    Lanes* r = reinterpret_cast<Lanes*>(small);
    if (tape.registers() > few) {
        thread_local std::vector<Lanes> many;
        if (many.size() < tape.registers()) many.resize(tape.registers());
        r = many.data();
    }
    fill(r);
    detail::runInGroups(tape, r);
    for (std::size_t k = 0; k < tape.outputs(); ++k) write(k, tape.output(k, r));
}

}  // namespace extremal::typed
