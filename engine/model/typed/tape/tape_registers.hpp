// SPDX-License-Identifier: GPL-3.0-or-later
/// Room for one evaluation of a tape: on the stack, or, for long formulas, one array per thread. Of two that
/// are long, only the one that ran last may be read.
#pragma once

#include <cstddef>
#include <iterator>
#include <vector>

#include "engine/core/algebra/lanes.hpp"
#include "engine/model/typed/tape/tape.hpp"

namespace extremal::typed {

class TapeRegisters {
public:
    /// Runs the tape on the inputs that `fill(double*)` puts in front.
    template <class Fill>
    TapeRegisters(const Tape& tape, const Fill& fill)
        : tape_(tape), at_(tape.registers() <= std::size(small_) ? small_ : large(tape.registers())) {
        fill(at_);
        tape.run(at_);
    }
    TapeRegisters(const TapeRegisters&) = delete;
    TapeRegisters& operator=(const TapeRegisters&) = delete;

    double operator[](std::size_t output) const { return tape_.output(output, at_); }
    /// Outputs first, first + 1, ...
    void copy(std::size_t first, std::size_t count, double* to) const {
        tape_.copyOutputs(first, count, at_, to);
    }

private:
    static double* large(std::size_t size) {
        thread_local std::vector<Lanes> registers;  // they begin at a line of the cache
        const std::size_t lines = (size + Lanes::size - 1) / Lanes::size;
        if (registers.size() < lines) registers.resize(lines);
        return registers.data()->lane.data();
    }
    const Tape& tape_;
    alignas(Lanes) double small_[192];
    double* at_;
};

}  // namespace extremal::typed
