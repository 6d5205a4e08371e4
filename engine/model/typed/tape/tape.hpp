// SPDX-License-Identifier: GPL-3.0-or-later
/// A formula as a straight line of instructions over a small array of registers.
///
/// Registers: the inputs (q, v, t), then the constants, then intermediate values, reused when they are no
/// longer needed. Tapes that are carried out again become code of the processor (machine_code.hpp). Every
/// common part is computed once; integer powers are products, x^(n/2) products of one square root, and sin
/// and cos of one angle a single call. Of long formulas with many parts alike, such as the sums over a chain,
/// instructions are in groups that are carried out as loops (tape_groups.hpp), and registers are given out so
/// that what a loop reads and writes stands side by side where it can. But for that code, evaluation
/// allocates nothing and changes nothing but the caller's registers, so any number of threads may share a
/// tape.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/model/typed/graph.hpp"
#include "engine/model/typed/tape/machine_code.hpp"

namespace extremal::typed {

class Code;

enum class Op : std::uint8_t {
    add,               ///< a + b
    subtract,          ///< a - b
    multiply,          ///< a b
    multiplyAdd,       ///< a b + c
    multiplySubtract,  ///< a b - c
    subtractProduct,   ///< c - a b
    negate,            ///< -a
    reciprocal,        ///< 1 / a
    sqrt,              ///< a^(1/2)
    sinCos,            ///< sin a, and cos a in register c
    call,              ///< the function number c of a
    call2,             ///< the function number c of a and b
    choose,            ///< b where a is not 0, else c
    lookUp             ///< the table number c at a
};

struct Instruction {
    Op op;
    std::uint32_t to, a, b, c;
};

/// Instructions of one operation that do not read each other's results; the registers that they write are
/// side by side, and a group of several never writes to a register that it reads.
struct TapeGroup {
    /// Of all instructions together: one register, registers side by side, or neither.
    enum class Operand : std::uint8_t { single, sideBySide, scattered };
    std::uint32_t first = 0, count = 1;
    bool isLoop = false;  ///< several instructions of arithmetic
    Operand a = Operand::single, b = Operand::single, c = Operand::single;

    bool isSideBySide() const {
        return isLoop && a != Operand::scattered && b != Operand::scattered && c != Operand::scattered;
    }
};

/// A derivative of a table.
struct LookUp {
    std::shared_ptr<const Interpolant> table;
    int order = 0;
};

class Tape {
public:
    /// What computes the roots. Symbols below `inputs` are inputs; there must be no others.
    static Tape of(const Graph& graph, std::span<const int> roots, int inputs);
    /// What computes values of a code.
    static Tape of(const Code& code, std::vector<std::uint32_t> values, std::size_t inputs);
    /// What computes values that are made by instructions, one for each of the first inputs: there it leaves
    /// them, and the next run goes on from them. The other inputs are fresh in each run.
    static Tape goingOn(const Code& code, std::vector<std::uint32_t> values, std::size_t inputs);

    std::size_t registers() const { return registers_; }
    std::size_t outputs() const { return outputs_.size(); }
    std::size_t length() const { return code_.size(); }

    std::size_t inputs() const { return inputs_; }
    std::span<const double> constants() const { return constants_; }
    std::span<const Instruction> code() const { return code_; }
    std::span<const LookUp> tables() const { return tables_; }
    /// Empty where instructions are carried out one by one.
    std::span<const TapeGroup> groups() const { return groups_; }

    /// The register of each output.
    std::span<const std::uint32_t> outputPlaces() const { return outputs_; }
    /// The code that carries it out, of each number one or eight side by side; null where it has none, or not
    /// yet.
    MachineCode::Call forOne() const { return codeOf<MachineCode::Call>(one_); }
    MachineCode::Call forEight() const { return codeOf<MachineCode::Call>(eight_); }
    /// A copy that will have no code.
    Tape withoutCode() const {
        Tape made = *this;
        made.one_ = made.eight_ = nullptr;
        return made;
    }

    bool goesOn() const { return goesOn_; }
    /// Of one that goes on: a run for each inputs() - outputs() numbers from `fresh` to `end`.
    void goOn(double* r, const double* fresh, const double* end) const;
    /// `r` has registers() entries and the inputs in front; afterwards output(i, r) is root i.
    void run(double* r) const;
    template <class T>
    const T& output(std::size_t i, const T* r) const {
        return r[outputs_[i]];
    }
    /// Outputs first, first + 1, ... of those that were computed last.
    void copyOutputs(std::size_t first, std::size_t count, const double* r, double* to) const;

private:
    void findStretches();
    void runOne(double* r) const;  ///< without code
    template <class Call>
    Call codeOf(const std::shared_ptr<MachineCode>& code) const {
        return code ? reinterpret_cast<Call>(code->of(*this)) : nullptr;
    }
    /// Outputs whose registers are side by side, up to the output `end`.
    struct Stretch {
        std::uint32_t end, afterRegister;  ///< afterRegister: one past that of the last
    };

    std::size_t inputs_ = 0, registers_ = 0;
    std::vector<double> constants_;
    std::vector<Instruction> code_;
    std::vector<TapeGroup> groups_;
    std::vector<LookUp> tables_;
    std::vector<std::uint32_t> outputs_;
    std::shared_ptr<MachineCode> one_, eight_;  ///< of all copies
    std::vector<Stretch> stretches_;            ///< empty where most of them are short
    bool goesOn_ = false;
};

}  // namespace extremal::typed
