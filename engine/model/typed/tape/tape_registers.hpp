// SPDX-License-Identifier: GPL-3.0-or-later
/// Room for one evaluation of a tape: on the stack, or, for long formulas, one array per thread. Of two that
/// are long, only the one that ran last may be read.
#pragma once

#include <iterator>
#include <vector>

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

private:
    static double* large(std::size_t size) {
        thread_local std::vector<double> registers;
        if (registers.size() < size) registers.resize(size);
        return registers.data();
    }
    const Tape& tape_;
    double small_[192];
    double* at_;
};

}  // namespace extremal::typed
