// SPDX-License-Identifier: GPL-3.0-or-later
/// Tapes as instructions of the processor, made while the program runs: intermediate values stay in registers
/// of the machine, and nothing is decided on the way. The bits are those of the instructions one by one:
/// arithmetic is the same in the same order, and for everything else (sin, exp, tables) the code calls what
/// carries out that instruction.
///
/// Code is made when a tape is carried out for the second time, which costs as much as some hundred runs
/// save; not every tape that is made for a model is carried out more than once. It needs an x86-64 with AVX
/// (for eight nodes, and for tapes in groups, with AVX-512) and memory that may be made executable. Without
/// these, and where they are very long, tapes are carried out instruction by instruction.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

namespace extremal::typed {

class Tape;

/// The code of one tape, for one number in each register or for eight. Any number of threads may share it.
class MachineCode {
public:
    explicit MachineCode(bool isEight);
    ~MachineCode();
    MachineCode(const MachineCode&) = delete;
    MachineCode& operator=(const MachineCode&) = delete;

    /// `r`: as in Tape::run(), eight of each side by side where it is of eight; constants need not be there.
    using Call = void (*)(double* r);
    /// What the call of a tape that goes on is: as Tape::goOn(), for one run or more.
    using Runs = void (*)(double* r, const double* fresh, const double* end);
    /// A Call, or Runs; null where the tape is to be carried out otherwise. Always of the same tape.
    void* of(const Tape& tape) {
        if (void* const ready = code_.load(std::memory_order_acquire)) return ready;
        const int left = left_.load(std::memory_order_relaxed);
        if (left < 0) return nullptr;
        if (left > 0) return left_.store(left - 1, std::memory_order_relaxed), nullptr;
        return make(tape);
    }

private:
    struct Made;
    void* make(const Tape& tape);

    bool isEight_;
    std::atomic<void*> code_{nullptr};
    std::atomic<int> left_{1};  ///< runs before it is made; negative: it is not made any more
    std::mutex making_;
    std::unique_ptr<Made> made_;
};

}  // namespace extremal::typed
