// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/tape/machine_code.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/model/typed/tape/tape.hpp"
#include "engine/model/typed/tape/tape_line.hpp"
#include "engine/model/typed/tape/tape_run.hpp"

#if defined(__x86_64__) && defined(EXTREMAL_HAS_XBYAK)
#include <xbyak/xbyak.h>
#endif

namespace extremal::typed {

#if defined(__x86_64__) && defined(EXTREMAL_HAS_XBYAK)

namespace {

bool isArithmetic(Op op) { return op <= Op::sqrt; }

// What the code calls for the rest.
void carryOutOne(const Tape* tape, const Instruction* instruction, double* r) {
    detail::carryOut(*tape, *instruction, r);
}
void carryOutEight(const Tape* tape, const Instruction* instruction, Lanes* r) {
    detail::carryOut(*tape, *instruction, r);
}

/// Writes the code of a tape. Intermediate values are in registers of the machine as far as these go, those
/// that are used most first; all others, inputs among them, are in memory, where the tape has them. Groups
/// that are loops are carried out for eight instructions at a time, some groups in turn, so that what one of
/// them makes is in a register for the next.
class Writer : Xbyak::CodeGenerator {
public:
    Writer(const Tape& tape, bool isEight)
        : CodeGenerator(Xbyak::DEFAULT_MAX_CODE_SIZE, Xbyak::AutoGrow),
          tape_(tape),
          isEight_(isEight),
          isWide_(isEight),
          code_(tape.code()),
          groups_(isEight ? std::span<const TapeGroup>() : tape.groups()),
          firstMade_(tape.inputs() + tape.constants().size()),
          numbersAt_(tape.constants().begin(), tape.constants().end()) {
        numbersAt_.push_back(1);
        numbersAt_.push_back(-0.0);
        choosePlaces();
        findAlive();
    }

    MachineCode::Call write() {
        const bool hasCalls =
            std::any_of(code_.begin(), code_.end(), [](const Instruction& i) { return !isArithmetic(i.op); });
        if (hasCalls) {
            push(rbx);
            push(r12);
            sub(rsp, 8);
            mov(rbx, rdi);
        }
        r_ = hasCalls ? rbx : rdi;
        numbers_ = hasCalls ? r12 : rsi;
        mov(numbers_, reinterpret_cast<std::size_t>(numbersAt_.data()));
        if (groups_.empty())
            for (const Instruction& i : code_) carryOut(i);
        else
            carryOutGroups();
        for (const std::uint32_t output : tape_.outputPlaces()) keep(output);
        leaveWideRegisters();
        if (hasCalls) {
            add(rsp, 8);
            pop(r12);
            pop(rbx);
        }
        ret();
        readyRE();
        return getCode<MachineCode::Call>();
    }

private:
    using Register = Xbyak::Xmm;
    /// Of the machine: loops use these and what is above; single values of tapes that have loops, the others.
    static constexpr int firstOfLoops = 16;
    static constexpr std::size_t mostInLoop = 12;

    /// An operand: in a register of the machine, or in memory, there perhaps one number for all lanes.
    struct Source {
        int place = -1;
        Xbyak::RegExp at = {};
        bool isSame = false;
    };

    static int machineRegisters() { return instructionSet() == InstructionSet::avx512 ? 32 : 16; }
    static int scratch(int k) { return machineRegisters() - 1 - k; }
    static bool isInLoop(const TapeGroup& g) { return g.isLoop && g.isSideBySide(); }
    bool isConstant(std::uint32_t k) const { return k >= tape_.inputs() && k < firstMade_; }

    void choosePlaces() {
        std::vector<std::size_t> uses(tape_.registers(), 0);
        for (const Instruction& i : code_) {
            forOperands(i, [&](std::uint32_t k) { ++uses[k]; });
            ++uses[i.to];
        }
        // Loops read and write memory.
        for (const TapeGroup& g : groups_)
            for (std::uint32_t n = 0; isInLoop(g) && n < g.count; ++n) {
                forOperands(code_[g.first + n], [&](std::uint32_t k) { uses[k] = 0; });
                uses[code_[g.first + n].to] = 0;
            }
        std::vector<std::uint32_t> order;
        for (auto k = static_cast<std::uint32_t>(firstMade_); k < uses.size(); ++k)
            if (uses[k] > 0) order.push_back(k);
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return uses[a] > uses[b]; });
        place_.assign(uses.size(), -1);
        const int most = groups_.empty() ? machineRegisters() - 2 : firstOfLoops;
        for (std::size_t n = 0; n < order.size() && static_cast<int>(n) < most; ++n)
            place_[order[n]] = static_cast<int>(n);
    }
    /// What is in registers of the machine at each call and read after it.
    void findAlive() {
        std::vector<std::uint32_t> placed;
        for (std::uint32_t k = 0; k < place_.size(); ++k)
            if (place_[k] >= 0) placed.push_back(k);
        std::vector<bool> isAlive(tape_.registers(), false);
        for (const std::uint32_t k : tape_.outputPlaces()) isAlive[k] = true;
        for (std::size_t at = code_.size(); at-- > 0;) {
            const Instruction& i = code_[at];
            isAlive[i.to] = false;
            if (i.op == Op::sinCos) isAlive[i.c] = false;
            if (!isArithmetic(i.op)) {
                std::vector<std::uint32_t>& alive = alive_.emplace_back();
                for (const std::uint32_t k : placed)
                    if (isAlive[k]) alive.push_back(k);
            }
            forOperands(i, [&](std::uint32_t k) { isAlive[k] = true; });
        }
    }

    // Operands.

    Register numbered(int index) const { return isWide_ ? Xbyak::Zmm(index) : Register(index); }
    /// Number k of numbersAt_.
    Source number(std::size_t k) const { return {-1, numbers_ + static_cast<int>(8 * k), true}; }
    Xbyak::RegExp slot(std::uint32_t k) const { return r_ + static_cast<int>(k) * (isEight_ ? 64 : 8); }
    Source sourceOf(std::uint32_t k) const {
        return isConstant(k) ? number(k - tape_.inputs()) : Source{place_[k], slot(k), false};
    }
    Xbyak::Address memory(const Source& s) const {
        return !isWide_ ? qword[s.at] : s.isSame ? zword_b[s.at] : zword[s.at];
    }
    /// A register with the operand: its own, or this one.
    Register loaded(const Source& s, int otherwise) {
        if (s.place >= 0) return numbered(s.place);
        const Register into = numbered(otherwise);
        if (!isWide_)
            vmovsd(into, qword[s.at]);
        else if (s.isSame)
            vbroadcastsd(Xbyak::Zmm(otherwise), qword[s.at]);
        else
            vmovupd(into, zword[s.at]);
        return into;
    }
    template <class Use>
    void with(const Source& s, const Use& use) {
        s.place >= 0 ? use(numbered(s.place)) : use(memory(s));
    }
    void store(const Xbyak::RegExp& at, int from) {
        isWide_ ? vmovupd(zword[at], numbered(from)) : vmovsd(qword[at], numbered(from));
    }
    /// Where other code would wait for the upper parts of registers.
    void leaveWideRegisters() {
        if (isEight_ || !groups_.empty()) vzeroupper();
    }

    // Arithmetic.

    void addTo(const Register& to, const Register& a, const Xbyak::Operand& b) {
        isWide_ ? vaddpd(to, a, b) : vaddsd(to, a, b);
    }
    void subtractTo(const Register& to, const Register& a, const Xbyak::Operand& b) {
        isWide_ ? vsubpd(to, a, b) : vsubsd(to, a, b);
    }
    void multiplyTo(const Register& to, const Register& a, const Xbyak::Operand& b) {
        isWide_ ? vmulpd(to, a, b) : vmulsd(to, a, b);
    }
    /// Not into the first scratch register where the operands need it.
    void compute(Op op, int place, const Source& a, const Source& b, const Source& c) {
        const Register to = numbered(place), first = numbered(scratch(0));
        const auto product = [&] {
            with(b, [&](const auto& y) { multiplyTo(first, loaded(a, scratch(0)), y); });
        };
        switch (op) {
            case Op::add:
                return with(b, [&](const auto& y) { addTo(to, loaded(a, scratch(0)), y); });
            case Op::subtract:
                return with(b, [&](const auto& y) { subtractTo(to, loaded(a, scratch(0)), y); });
            case Op::multiply:
                return with(b, [&](const auto& y) { multiplyTo(to, loaded(a, scratch(0)), y); });
            case Op::multiplyAdd:
                product();
                return with(c, [&](const auto& z) { addTo(to, first, z); });
            case Op::multiplySubtract:
                product();
                return with(c, [&](const auto& z) { subtractTo(to, first, z); });
            case Op::subtractProduct:
                product();
                return subtractTo(to, loaded(c, scratch(1)), first);
            case Op::negate: {
                const Register sign = loaded(number(numbersAt_.size() - 1), scratch(1)),
                               x = loaded(a, scratch(0));
                isWide_ ? vpxorq(to, x, sign) : vxorpd(to, x, sign);
                return;
            }
            case Op::reciprocal: {
                const Register one = loaded(number(numbersAt_.size() - 2), scratch(1));
                return with(a, [&](const auto& x) { isWide_ ? vdivpd(to, one, x) : vdivsd(to, one, x); });
            }
            case Op::sqrt: {
                const Register x = loaded(a, scratch(0));
                isWide_ ? vsqrtpd(Xbyak::Zmm(place), x) : vsqrtsd(to, x, x);
                return;
            }
            default:
                return;
        }
    }
    void carryOut(const Instruction& i) {
        if (!isArithmetic(i.op)) return callFor(i);
        const Source to = sourceOf(i.to);
        const int place = to.place >= 0 ? to.place : scratch(0);
        Source operands[3];
        Source* next = operands;
        forOperands(i, [&](std::uint32_t k) { *next++ = sourceOf(k); });
        compute(i.op, place, operands[0], operands[1], operands[2]);
        if (to.place < 0) store(to.at, place);
    }

    /// A call changes all registers of the machine.
    void callFor(const Instruction& i) {
        forOperands(i, [&](std::uint32_t k) { keep(k); });
        std::vector<std::uint32_t> alive = std::move(alive_.back());
        alive_.pop_back();
        for (const std::uint32_t k : alive) keep(k);
        leaveWideRegisters();
        mov(rdi, reinterpret_cast<std::size_t>(&tape_));
        mov(rsi, reinterpret_cast<std::size_t>(&i));
        mov(rdx, r_);
        mov(rax, isEight_ ? reinterpret_cast<std::size_t>(ForThisMachine<&carryOutEight>::call())
                          : reinterpret_cast<std::size_t>(&carryOutOne));
        call(rax);
        alive.push_back(i.to);
        if (i.op == Op::sinCos) alive.push_back(i.c);
        for (const std::uint32_t k : alive)
            if (place_[k] >= 0) (void)loaded({-1, slot(k), false}, place_[k]);
    }
    /// What register k of the tape holds, to its place in memory as well.
    void keep(std::uint32_t k) {
        if (place_[k] >= 0)
            store(slot(k), place_[k]);
        else if (isConstant(k))
            store(slot(k), loaded(sourceOf(k), scratch(0)).getIdx());
    }

    // Groups.

    /// Constants that stand side by side as operands are read where the tape has them.
    void placeConstants() {
        const Range constants{static_cast<std::uint32_t>(tape_.inputs()),
                              static_cast<std::uint32_t>(tape_.constants().size())};
        bool areRead = false;
        for (const TapeGroup& g : groups_)
            if (isInLoop(g))
                forRanges(g, [&](const Range& read) {
                    areRead = areRead || (read.count > 1 && read.meets(constants));
                });
        for (std::uint32_t k = 0; areRead && k < constants.count; ++k) {
            vmovsd(numbered(scratch(0)), qword[number(k).at]);
            store(slot(constants.first + k), scratch(0));
        }
    }
    void carryOutGroups() {
        placeConstants();
        for (std::size_t g = 0; g < groups_.size();) {
            std::size_t end = g + 1;
            if (!isInLoop(groups_[g])) {
                for (const Instruction& i : code_.subspan(groups_[g].first, groups_[g].count)) carryOut(i);
            } else {
                while (end < groups_.size() && end - g < mostInLoop &&
                       canJoin(groups_.subspan(g, end - g), groups_[end]))
                    ++end;
                isWide_ = true;
                writeLoop(groups_.subspan(g, end - g));
                isWide_ = isEight_;
            }
            g = end;
        }
    }
    /// Registers of the tape.
    struct Range {
        std::uint32_t first, count;
        bool meets(const Range& other) const {
            return first < other.first + other.count && other.first < first + count;
        }
    };
    Range madeBy(const TapeGroup& g) const { return {code_[g.first].to, g.count}; }
    /// What a group reads, operand by operand.
    template <class Use>
    void forRanges(const TapeGroup& g, const Use& use) const {
        const TapeGroup::Operand kinds[] = {g.a, g.b, g.c};
        const TapeGroup::Operand* kind = kinds;
        forOperands(code_[g.first], [&](std::uint32_t k) {
            use(Range{k, *kind++ == TapeGroup::Operand::single ? 1 : g.count});
        });
    }
    /// Whether a group can be carried out for eight places before the ones in front of it are for the next:
    /// it reads of these only what is of the same place, and writes nothing that they still read.
    bool canJoin(std::span<const TapeGroup> before, const TapeGroup& g) const {
        if (!isInLoop(g) || g.count != before.front().count) return false;
        const Range own = madeBy(g);
        bool can = true;
        for (const TapeGroup& e : before) {
            const Range other = madeBy(e);
            const auto isApart = [](const Range& a, const Range& b) {
                return !a.meets(b) || (a.first == b.first && a.count == b.count);
            };
            can = can && !own.meets(other);
            forRanges(g, [&](const Range& read) { can = can && isApart(read, other); });
            forRanges(e, [&](const Range& read) { can = can && isApart(read, own); });
        }
        return can;
    }
    void writeLoop(std::span<const TapeGroup> groups) {
        constexpr std::uint32_t lanes = 8, mostUnrolled = 16;
        const std::uint32_t count = groups.front().count, whole = count / lanes;
        if (whole > mostUnrolled) {
            Xbyak::Label again;
            xor_(eax, eax);
            L(again);
            writeEight(groups, rax);
            add(rax, 8 * lanes);
            cmp(rax, 8 * lanes * whole);
            jl(again, T_NEAR);
        } else {
            for (std::uint32_t k = 0; k < whole; ++k) writeEight(groups, Xbyak::RegExp(8 * lanes * k));
        }
        if (count % lanes == 0) return;
        mov(eax, (1u << count % lanes) - 1);
        kmovw(k1, eax);
        writeEight(groups, Xbyak::RegExp(8 * lanes * whole), true);
    }
    /// Eight places from `offset` on, in bytes; of the last ones those of the mask.
    void writeEight(std::span<const TapeGroup> groups, const Xbyak::RegExp& offset, bool isMasked = false) {
        for (std::size_t n = 0; n < groups.size(); ++n) {
            const TapeGroup& g = groups[n];
            const Instruction& i = code_[g.first];
            const TapeGroup::Operand kinds[] = {g.a, g.b, g.c};
            Source operands[3];
            std::size_t next = 0;
            forOperands(i, [&](std::uint32_t k) {
                Source& operand = operands[next];
                if (kinds[next++] == TapeGroup::Operand::single) {
                    operand = isConstant(k) ? sourceOf(k) : Source{-1, slot(k), true};
                    return;
                }
                operand = {-1, slot(k) + offset, false};
                for (std::size_t e = 0; e < n; ++e)
                    if (madeBy(groups[e]).first == k) operand.place = firstOfLoops + static_cast<int>(e);
            });
            const int place = firstOfLoops + static_cast<int>(n);
            compute(i.op, place, operands[0], operands[1], operands[2]);
            const Xbyak::Address to = zword[slot(i.to) + offset];
            isMasked ? vmovupd(to | k1, Xbyak::Zmm(place)) : vmovupd(to, Xbyak::Zmm(place));
        }
    }

    const Tape& tape_;
    bool isEight_;
    bool isWide_;  ///< eight numbers in each register of the machine, here
    std::span<const Instruction> code_;
    std::span<const TapeGroup> groups_;  ///< of one number
    std::size_t firstMade_;              ///< register of the tape
    std::vector<double> numbersAt_;      ///< constants of the tape, then 1 and -0
    std::vector<int> place_;             ///< of each register of the tape in the machine; negative: in memory
    std::vector<std::vector<std::uint32_t>> alive_;  ///< of the calls to come, the last one first
    Xbyak::Reg64 r_, numbers_;
};

}  // namespace

struct MachineCode::Made {
    Made(const Tape& from, bool isEight) : tape(from.withoutCode()), writer(tape, isEight) {}
    Tape tape;  ///< that the code refers to
    Writer writer;
};

MachineCode::Call MachineCode::make(const Tape& tape) {
    constexpr std::size_t longest = 20000;
    const std::lock_guard lock(making_);
    if (left_.load(std::memory_order_relaxed) < 0) return call_.load(std::memory_order_acquire);
    const bool isWide = isEight_ || !tape.groups().empty();
    const InstructionSet needed = isWide ? InstructionSet::avx512 : InstructionSet::avx2;
    if (instructionSet() >= needed && tape.length() <= longest) {
        try {
            made_ = std::make_unique<Made>(tape, isEight_);
            call_.store(made_->writer.write(), std::memory_order_release);
        } catch (const Xbyak::Error&) {
            made_.reset();  // no executable memory
        }
    }
    left_.store(-1, std::memory_order_relaxed);
    return call_.load(std::memory_order_acquire);
}

#else

struct MachineCode::Made {};

MachineCode::Call MachineCode::make(const Tape&) {
    left_.store(-1, std::memory_order_relaxed);
    return nullptr;
}

#endif

MachineCode::MachineCode(bool isEight) : isEight_(isEight) {}
MachineCode::~MachineCode() = default;

}  // namespace extremal::typed
