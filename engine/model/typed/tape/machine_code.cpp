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
/// that are used most first; all others, inputs among them, are in memory, where the tape has them.
class Writer : Xbyak::CodeGenerator {
public:
    Writer(const Tape& tape, bool isEight)
        : CodeGenerator(Xbyak::DEFAULT_MAX_CODE_SIZE, Xbyak::AutoGrow),
          tape_(tape),
          isEight_(isEight),
          code_(tape.code()),
          firstMade_(tape.inputs() + tape.constants().size()) {
        for (const double constant : tape.constants()) constants_.push_back(constant);
        constants_.push_back(1);
        constants_.push_back(-0.0);
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
        mov(numbers_, reinterpret_cast<std::size_t>(constants_.data()));
        for (const Instruction& i : code_) isArithmetic(i.op) ? compute(i) : callFor(i);
        for (const std::uint32_t output : tape_.outputPlaces()) keep(output);
        if (isEight_) vzeroupper();
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
    std::size_t one() const { return constants_.size() - 2; }
    std::size_t sign() const { return constants_.size() - 1; }
    int machineRegisters() const { return instructionSet() == InstructionSet::avx512 ? 32 : 16; }
    Register numbered(int index) const { return isEight_ ? Xbyak::Zmm(index) : Register(index); }
    Register scratch(int k) const { return numbered(machineRegisters() - 1 - k); }

    void choosePlaces() {
        std::vector<std::size_t> uses(tape_.registers(), 0);
        for (const Instruction& i : code_) {
            forOperands(i, [&](std::uint32_t k) { ++uses[k]; });
            ++uses[i.to];
        }
        std::vector<std::uint32_t> order;
        for (auto k = static_cast<std::uint32_t>(firstMade_); k < uses.size(); ++k)
            if (uses[k] > 0) order.push_back(k);
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return uses[a] > uses[b]; });
        place_.assign(uses.size(), -1);
        for (std::size_t n = 0; n < order.size() && static_cast<int>(n) < machineRegisters() - 2; ++n)
            place_[order[n]] = static_cast<int>(n);
    }
    /// What is in registers of the machine at each call and read after it.
    void findAlive() {
        std::vector<bool> isAlive(tape_.registers(), false);
        for (const std::uint32_t k : tape_.outputPlaces()) isAlive[k] = true;
        for (std::size_t at = code_.size(); at-- > 0;) {
            const Instruction& i = code_[at];
            isAlive[i.to] = false;
            if (i.op == Op::sinCos) isAlive[i.c] = false;
            if (!isArithmetic(i.op)) {
                std::vector<std::uint32_t>& alive = alive_.emplace_back();
                for (std::uint32_t k = 0; k < place_.size(); ++k)
                    if (place_[k] >= 0 && isAlive[k]) alive.push_back(k);
            }
            forOperands(i, [&](std::uint32_t k) { isAlive[k] = true; });
        }
    }

    Xbyak::Address slot(std::uint32_t k) const {
        const int at = static_cast<int>(k) * (isEight_ ? 64 : 8);
        return isEight_ ? zword[r_ + at] : qword[r_ + at];
    }
    /// A number of `constants_`, to all places of a register.
    Xbyak::Address number(std::size_t k) const {
        const int at = static_cast<int>(k) * 8;
        return isEight_ ? zword_b[numbers_ + at] : qword[numbers_ + at];
    }
    bool isConstant(std::uint32_t k) const { return k >= tape_.inputs() && k < firstMade_; }

    void load(const Register& to, std::uint32_t k) {
        if (isConstant(k))
            loadNumber(to, k - tape_.inputs());
        else if (isEight_)
            vmovupd(to, slot(k));
        else
            vmovsd(to, slot(k));
    }
    void loadNumber(const Register& to, std::size_t k) {
        const int at = static_cast<int>(k) * 8;
        if (isEight_)
            vbroadcastsd(Xbyak::Zmm(to.getIdx()), qword[numbers_ + at]);
        else
            vmovsd(to, qword[numbers_ + at]);
    }
    void store(std::uint32_t k, const Register& from) {
        if (isEight_)
            vmovupd(slot(k), from);
        else
            vmovsd(slot(k), from);
    }
    Register inRegister(std::uint32_t k, const Register& otherwise) {
        if (place_[k] >= 0) return numbered(place_[k]);
        load(otherwise, k);
        return otherwise;
    }
    /// op(to, a, b) where b may be in memory.
    template <class Operation>
    void withSecond(std::uint32_t b, const Operation& operation) {
        if (place_[b] >= 0)
            operation(numbered(place_[b]));
        else if (isConstant(b))
            operation(number(b - tape_.inputs()));
        else
            operation(slot(b));
    }
    void addTo(const Register& to, const Register& a, const Xbyak::Operand& b) {
        isEight_ ? vaddpd(to, a, b) : vaddsd(to, a, b);
    }
    void subtractTo(const Register& to, const Register& a, const Xbyak::Operand& b) {
        isEight_ ? vsubpd(to, a, b) : vsubsd(to, a, b);
    }
    void multiplyTo(const Register& to, const Register& a, const Xbyak::Operand& b) {
        isEight_ ? vmulpd(to, a, b) : vmulsd(to, a, b);
    }

    void compute(const Instruction& i) {
        const Register to = place_[i.to] >= 0 ? numbered(place_[i.to]) : scratch(0);
        switch (i.op) {
            case Op::add:
                withSecond(i.b, [&](const auto& b) { addTo(to, inRegister(i.a, scratch(0)), b); });
                break;
            case Op::subtract:
                withSecond(i.b, [&](const auto& b) { subtractTo(to, inRegister(i.a, scratch(0)), b); });
                break;
            case Op::multiply:
                withSecond(i.b, [&](const auto& b) { multiplyTo(to, inRegister(i.a, scratch(0)), b); });
                break;
            case Op::multiplyAdd:
                product(i);
                withSecond(i.c, [&](const auto& c) { addTo(to, scratch(0), c); });
                break;
            case Op::multiplySubtract:
                product(i);
                withSecond(i.c, [&](const auto& c) { subtractTo(to, scratch(0), c); });
                break;
            case Op::subtractProduct:
                product(i);
                subtractTo(to, inRegister(i.c, scratch(1)), scratch(0));
                break;
            case Op::negate:
                loadNumber(scratch(1), sign());
                flipSign(to, inRegister(i.a, scratch(0)));
                break;
            case Op::reciprocal:
                loadNumber(scratch(1), one());
                withSecond(i.a, [&](const auto& a) {
                    isEight_ ? vdivpd(to, scratch(1), a) : vdivsd(to, scratch(1), a);
                });
                break;
            case Op::sqrt: {
                const Register a = inRegister(i.a, scratch(0));
                isEight_ ? vsqrtpd(Xbyak::Zmm(to.getIdx()), a) : vsqrtsd(to, a, a);
                break;
            }
            default:
                break;
        }
        if (place_[i.to] < 0) store(i.to, to);
    }
    /// a b in a register that nothing else is in.
    void product(const Instruction& i) {
        withSecond(i.b, [&](const auto& b) { multiplyTo(scratch(0), inRegister(i.a, scratch(0)), b); });
    }
    void flipSign(const Register& to, const Register& a) {
        // The bits of integers need no more than AVX-512F; of one number AVX.
        isEight_ ? vpxorq(to, a, scratch(1)) : vxorpd(to, a, scratch(1));
    }

    /// A call changes all registers of the machine.
    void callFor(const Instruction& i) {
        forOperands(i, [&](std::uint32_t k) { keep(k); });
        std::vector<std::uint32_t> alive = std::move(alive_.back());
        alive_.pop_back();
        for (const std::uint32_t k : alive) keep(k);
        if (isEight_) vzeroupper();
        mov(rdi, reinterpret_cast<std::size_t>(&tape_));
        mov(rsi, reinterpret_cast<std::size_t>(&i));
        mov(rdx, r_);
        mov(rax, isEight_ ? reinterpret_cast<std::size_t>(ForThisMachine<&carryOutEight>::call())
                          : reinterpret_cast<std::size_t>(&carryOutOne));
        call(rax);
        alive.push_back(i.to);
        if (i.op == Op::sinCos) alive.push_back(i.c);
        for (const std::uint32_t k : alive)
            if (place_[k] >= 0) load(numbered(place_[k]), k);
    }
    /// What register k of the tape holds, to its place in memory as well.
    void keep(std::uint32_t k) {
        if (place_[k] >= 0)
            store(k, numbered(place_[k]));
        else if (isConstant(k))
            store(k, inRegister(k, scratch(0)));
    }

    const Tape& tape_;
    bool isEight_;
    std::span<const Instruction> code_;
    std::size_t firstMade_;  ///< register of the tape
    std::vector<double> constants_;
    std::vector<int> place_;  ///< of each register of the tape in the machine; negative: in memory
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
    const InstructionSet needed = isEight_ ? InstructionSet::avx512 : InstructionSet::avx2;
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
