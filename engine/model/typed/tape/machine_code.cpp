// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/tape/machine_code.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/model/typed/tape/tape.hpp"
#include "engine/model/typed/tape/tape_line.hpp"
#include "engine/model/typed/tape/tape_parts.hpp"
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
          does_(tape, isEight ? 0 : mostInLoop),
          kept_(tape.goesOn() ? static_cast<std::uint32_t>(tape.outputs()) : 0),
          firstMade_(tape.inputs() + tape.constants().size()),
          numbersAt_(tape.constants().begin(), tape.constants().end()) {
        numbersAt_.push_back(1);
        numbersAt_.push_back(-0.0);
        choosePlaces();
        findAlive();
    }

    void* write() {
        const bool hasCalls = std::any_of(does_.code.begin(), does_.code.end(),
                                          [](const Instruction& i) { return !isArithmetic(i.op); });
        const Xbyak::Reg64 overCalls[] = {rbx, r12, r13, r14};
        if (hasCalls) {
            for (const Xbyak::Reg64& each : overCalls) push(each);
            sub(rsp, 8);
            mov(rbx, rdi);
            mov(r13, rsi);
            mov(r14, rdx);
        }
        r_ = hasCalls ? rbx : rdi;
        numbers_ = hasCalls ? r12 : rcx;
        mov(numbers_, reinterpret_cast<std::size_t>(numbersAt_.data()));
        if (tape_.goesOn()) {
            writeRuns(hasCalls ? r13 : rsi, hasCalls ? r14 : rdx);
        } else {
            carryOutAll();
            for (const std::uint32_t output : does_.outputs) keep(output);
        }
        leaveWideRegisters();
        if (hasCalls) {
            add(rsp, 8);
            for (std::size_t k = std::size(overCalls); k-- > 0;) pop(overCalls[k]);
        }
        ret();
        readyRE();
        return const_cast<std::uint8_t*>(getCode());
    }

private:
    using Register = Xbyak::Xmm;
    /// Of the machine: loops use these and what is above; single values of tapes that have loops, the others.
    static constexpr int firstOfLoops = 16;
    static constexpr std::size_t mostInLoop = 12;
    static constexpr std::uint32_t lanes = 8;

    /// An operand: in a register of the machine, or in memory, there perhaps one number for all lanes.
    struct Source {
        int place = -1;
        Xbyak::RegExp at = {};
        bool isSame = false;
    };

    static int machineRegisters() { return instructionSet() == InstructionSet::avx512 ? 32 : 16; }
    static int scratch(int k) { return machineRegisters() - 1 - k; }
    bool hasLoops() const { return !does_.parts.empty(); }
    bool isConstant(std::uint32_t k) const { return k >= tape_.inputs() && k < firstMade_; }

    void choosePlaces() {
        std::vector<std::size_t> uses(tape_.registers(), 0);
        for (const Instruction& i : does_.code) {
            forOperands(i, [&](std::uint32_t k) { ++uses[k]; });
            ++uses[i.to];
        }
        // Loops read and write memory.
        for (const TapePart& part : does_.parts)
            for (std::size_t m = 0; part.isLoop && m < part.members.size(); ++m)
                for (std::uint32_t n = 0; n < part.members[m].group.count; ++n) {
                    const Instruction& i = does_.code[part.members[m].group.first + n];
                    forOperands(i, [&](std::uint32_t k) { uses[k] = 0; });
                    uses[i.to] = 0;
                }
        // What a run makes comes before what it leaves to the next one, which may wait for memory.
        const auto isLeft = [&](std::uint32_t k) { return k < tape_.inputs(); };
        std::vector<std::uint32_t> order;
        for (std::uint32_t k = 0; k < uses.size(); ++k)
            if (isLeft(k) ? tape_.goesOn() && uses[k] > 0 : k >= firstMade_ && uses[k] > 0)
                order.push_back(k);
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::tuple(isLeft(a), uses[b]) < std::tuple(isLeft(b), uses[a]);
        });
        place_.assign(uses.size(), -1);
        const int most = hasLoops() ? firstOfLoops : machineRegisters() - 2;
        for (std::size_t n = 0; n < order.size() && static_cast<int>(n) < most; ++n)
            place_[order[n]] = static_cast<int>(n);
    }
    /// What is in registers of the machine at each call and read after it.
    void findAlive() {
        std::vector<std::uint32_t> placed;
        for (std::uint32_t k = 0; k < place_.size(); ++k)
            if (place_[k] >= 0) placed.push_back(k);
        std::vector<bool> isAlive(tape_.registers(), false);
        for (const std::uint32_t k : does_.outputs) isAlive[k] = true;
        for (std::size_t at = does_.code.size(); at-- > 0;) {
            const Instruction& i = does_.code[at];
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
        if (isEight_ || hasLoops()) vzeroupper();
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
    /// What register `from` of the tape holds to register `to`.
    void copy(std::uint32_t from, std::uint32_t to) {
        if (from == to) return;
        const Register value = loaded(sourceOf(from), place_[to] >= 0 ? place_[to] : scratch(0));
        if (place_[to] < 0)
            store(slot(to), value.getIdx());
        else if (value.getIdx() != place_[to])
            vmovapd(numbered(place_[to]), value);
    }

    void carryOutAll() {
        if (!hasLoops())
            for (const Instruction& i : does_.code) carryOut(i);
        else
            carryOutParts();
    }
    /// Of a tape that goes on: one run after the other, each with numbers of its own from `next` on. What is
    /// kept from run to run is in registers of the machine as far as these go.
    void writeRuns(const Xbyak::Reg64& next, const Xbyak::Reg64& end) {
        const auto fresh = static_cast<std::uint32_t>(tape_.inputs()) - kept_;
        for (std::uint32_t k = 0; k < kept_; ++k)
            if (place_[k] >= 0) vmovsd(Register(place_[k]), qword[slot(k)]);
        Xbyak::Label again;
        L(again);
        for (std::uint32_t k = 0; k < fresh; ++k) {
            const int place = place_[kept_ + k];
            vmovsd(Register(place >= 0 ? place : scratch(0)), qword[next + static_cast<int>(8 * k)]);
            if (place < 0) store(slot(kept_ + k), scratch(0));
        }
        add(next, 8 * fresh);
        carryOutAll();
        for (std::uint32_t i = 0; i < kept_; ++i) copy(does_.outputs[i], i);
        cmp(next, end);
        jb(again, T_NEAR);
        for (std::uint32_t k = 0; k < kept_; ++k) keep(k);
    }

    // Loops.

    /// Constants that stand side by side as operands are read where the tape has them.
    void placeConstants() {
        const auto first = static_cast<std::uint32_t>(tape_.inputs()),
                   count = static_cast<std::uint32_t>(tape_.constants().size());
        if (!does_.hasLoopOver(first, count)) return;
        for (std::uint32_t k = 0; k < count; ++k) {
            vmovsd(numbered(scratch(0)), qword[number(k).at]);
            store(slot(first + k), scratch(0));
        }
    }
    void carryOutParts() {
        placeConstants();
        for (const TapePart& part : does_.parts) {
            isWide_ = part.isLoop || isEight_;
            if (part.isLoop) {
                writeLoop(part.members);
                continue;
            }
            for (const auto& [group, isRead] : part.members)
                for (std::size_t k = 0; k < group.count; ++k) carryOut(does_.code[group.first + k]);
        }
        isWide_ = isEight_;
    }
    using Members = std::span<const TapePart::Member>;

    /// The last places, which are less than a register, are computed with some before them; all is read
    /// before anything there is stored. What is stored under a mask would be read late.
    void writeLoop(Members groups) {
        constexpr std::uint32_t mostUnrolled = 16;
        const std::uint32_t count = groups.front().group.count, whole = count / lanes;
        const bool isMasked = count % lanes != 0 && (whole == 0 || 2 * groups.size() > mostInLoop),
                   isOverlapped = count % lanes != 0 && !isMasked;
        const std::uint32_t alone = isOverlapped ? whole - 1 : whole;
        if (alone > mostUnrolled) {
            Xbyak::Label again;
            xor_(eax, eax);
            L(again);
            computeEight(groups, rax, firstOfLoops);
            storeEight(groups, rax, firstOfLoops);
            add(rax, 8 * lanes);
            cmp(rax, 8 * lanes * alone);
            jl(again, T_NEAR);
        } else {
            for (std::uint32_t k = 0; k < alone; ++k) {
                computeEight(groups, placesFrom(lanes * k), firstOfLoops);
                storeEight(groups, placesFrom(lanes * k), firstOfLoops);
            }
        }
        if (isOverlapped) {
            const Xbyak::RegExp lastWhole = placesFrom(lanes * alone), last = placesFrom(count - lanes);
            const int others = firstOfLoops + static_cast<int>(groups.size());
            computeEight(groups, lastWhole, firstOfLoops);
            computeEight(groups, last, others);
            storeEight(groups, lastWhole, firstOfLoops);
            storeEight(groups, last, others);
        }
        if (isMasked) {
            mov(eax, (1u << count % lanes) - 1);
            kmovw(k1, eax);
            computeEight(groups, placesFrom(lanes * whole), firstOfLoops);
            storeEight(groups, placesFrom(lanes * whole), firstOfLoops, true);
        }
    }
    static Xbyak::RegExp placesFrom(std::uint32_t first) { return Xbyak::RegExp(8 * first); }
    /// Eight places from `offset` on, in bytes: what each group makes is in a register, from `firstPlace` on.
    void computeEight(Members groups, const Xbyak::RegExp& offset, int firstPlace) {
        for (std::size_t n = 0; n < groups.size(); ++n) {
            const TapeGroup& g = groups[n].group;
            const Instruction& i = does_.code[g.first];
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
                    if (does_.code[groups[e].group.first].to == k)
                        operand.place = firstPlace + static_cast<int>(e);
            });
            compute(i.op, firstPlace + static_cast<int>(n), operands[0], operands[1], operands[2]);
        }
    }
    void storeEight(Members groups, const Xbyak::RegExp& offset, int firstPlace, bool isMasked = false) {
        for (const auto& [group, isRead] : groups) {
            const Xbyak::Zmm from(firstPlace++);
            if (!isRead) continue;
            const Xbyak::Address to = zword[slot(does_.code[group.first].to) + offset];
            isMasked ? vmovupd(to | k1, from) : vmovupd(to, from);
        }
    }

    const Tape& tape_;
    bool isEight_;
    bool isWide_;  ///< eight numbers in each register of the machine, here
    TapeParts does_;
    std::uint32_t kept_;             ///< inputs that a tape that goes on leaves to its next run
    std::size_t firstMade_;          ///< register of the tape
    std::vector<double> numbersAt_;  ///< constants of the tape, then 1 and -0
    std::vector<int> place_;         ///< of each register of the tape in the machine; negative: in memory
    std::vector<std::vector<std::uint32_t>> alive_;  ///< of the calls to come, the last one first
    Xbyak::Reg64 r_, numbers_;
};

}  // namespace

struct MachineCode::Made {
    Made(const Tape& from, bool isEight) : tape(from.withoutCode()), writer(tape, isEight) {}
    Tape tape;  ///< that the code refers to
    Writer writer;
};

void* MachineCode::make(const Tape& tape) {
    constexpr std::size_t longest = 20000;
    const std::lock_guard lock(making_);
    if (left_.load(std::memory_order_relaxed) < 0) return code_.load(std::memory_order_acquire);
    const bool isWide = isEight_ || !tape.groups().empty();
    const InstructionSet needed = isWide ? InstructionSet::avx512 : InstructionSet::avx2;
    if (instructionSet() >= needed && tape.length() <= longest) {
        try {
            made_ = std::make_unique<Made>(tape, isEight_);
            code_.store(made_->writer.write(), std::memory_order_release);
        } catch (const Xbyak::Error&) {
            made_.reset();  // no executable memory
        }
    }
    left_.store(-1, std::memory_order_relaxed);
    return code_.load(std::memory_order_acquire);
}

#else

struct MachineCode::Made {};

void* MachineCode::make(const Tape&) {
    left_.store(-1, std::memory_order_relaxed);
    return nullptr;
}

#endif

MachineCode::MachineCode(bool isEight) : isEight_(isEight) {}
MachineCode::~MachineCode() = default;

}  // namespace extremal::typed
