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

/// The registers of one evaluation.
class TapeRoom {
public:
    explicit TapeRoom(std::size_t size) : at_(size <= std::size(small_) ? small_ : large(size)) {}
    TapeRoom(const TapeRoom&) = delete;
    TapeRoom& operator=(const TapeRoom&) = delete;

    double* data() { return at_; }
    const double* data() const { return at_; }

private:
    static double* large(std::size_t size) {
        thread_local std::vector<Lanes> registers;  // they begin at a line of the cache
        const std::size_t lines = (size + Lanes::size - 1) / Lanes::size;
        if (registers.size() < lines) registers.resize(lines);
        return registers.data()->lane.data();
    }
    alignas(Lanes) double small_[192];
    double* at_;
};

/// What a tape computes at some inputs.
class TapeRegisters {
public:
    /// Runs the tape on the inputs that `fill(double*)` puts in front.
    template <class Fill>
    TapeRegisters(const Tape& tape, const Fill& fill) : tape_(tape), room_(tape.registers()) {
        fill(room_.data());
        tape.run(room_.data());
    }

    double operator[](std::size_t output) const { return tape_.output(output, room_.data()); }
    /// Outputs first, first + 1, ...
    void copy(std::size_t first, std::size_t count, double* to) const {
        tape_.copyOutputs(first, count, room_.data(), to);
    }

private:
    const Tape& tape_;
    TapeRoom room_;
};

}  // namespace extremal::typed
