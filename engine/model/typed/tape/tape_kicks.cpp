// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/tape/tape_kicks.hpp"

#include <algorithm>
#include <cstddef>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/model/typed/tape/tape_loops.hpp"
#include "engine/model/typed/tape/tape_registers.hpp"

namespace extremal::typed {
namespace {

/// p_i += kick f_i, q_i += drift p_i / m_i, of coordinates side by side.
template <class Pack>
struct Motion {
    KickAndDrift<double> by;
    const double* perMass;
    double *q, *p;

    /// What moves in the lanes of one register of the machine.
    struct Moved {
        Pack q, p;
    };
    [[gnu::always_inline]] void move(Moved& to, const double* f, std::size_t i) const {
        Pack force, inverse;
        registers::load(force, f);
        registers::load(inverse, perMass + i);
        registers::load(to.q, q + i);
        registers::load(to.p, p + i);
        to.p += by.kick * force;
        to.q += (by.drift * inverse) * to.p;
    }
    [[gnu::always_inline]] void keep(const Moved& moved, std::size_t i) const {
        registers::store(p + i, moved.p);
        if (by.drift != 0) registers::store(q + i, moved.q);
    }
    [[gnu::always_inline]] void takeOne(double f, std::size_t i) const {
        p[i] += by.kick * f;
        if (by.drift != 0) q[i] += (by.drift * perMass[i]) * p[i];
    }
    /// Those from `first` on. The last ones, which are less than a register, are moved with some before them,
    /// from where all of these are.
    [[gnu::always_inline]] void take(const double* f, std::size_t first, std::size_t count) const {
        constexpr std::size_t lanes = registers::lanesOf<Pack>;
        if (count < lanes) {
            for (std::size_t i = 0; i < count; ++i) takeOne(f[i], first + i);
            return;
        }
        Moved last;
        move(last, f + count - lanes, first + count - lanes);
        for (std::size_t i = 0; i + lanes <= count; i += lanes) {
            Moved moved;
            move(moved, f + i, first + i);
            keep(moved, first + i);
        }
        if (count % lanes != 0) keep(last, first + count - lanes);
    }
    /// All, by the forces in the registers of a tape.
    [[gnu::always_inline]] void take(const Tape& tape, const double* r) const {
        std::size_t first = 0;
        for (const auto& [end, afterRegister] : tape.stretches()) {
            take(r + afterRegister - (end - first), first, end - first);
            first = end;
        }
        for (; first < tape.outputs(); ++first) takeOne(tape.output(first, r), first);
    }
};

template <class Pack>
void kicksAndDriftsBy(const Tape* tape, std::span<const KickAndDrift<double>> pairs, const double* perMass,
                      bool isForceKnown, double* q, double* p, double* force) {
    const std::size_t d = tape->outputs();
    TapeRoom room(tape->registers());
    double* const r = room.data();
    std::copy_n(q, d, r);
    const MachineCode::Call code = tape->forOne();
    if (!code) detail::fillConstants(*tape, r);
    // A force that is a coordinate itself is read before that moves.
    const bool isCoordinate = tape->hasInputAsOutput();
    for (const KickAndDrift<double>& pair : pairs) {
        const Motion<Pack> motion{pair, perMass, r, p};
        if (!isForceKnown && code)
            code(r);
        else if (!isForceKnown)
            detail::carryOutAll<Pack>(*tape, r);
        const bool isCopied = !isForceKnown && (isCoordinate || &pair == &pairs.back());
        if (isCopied) tape->copyOutputs(0, d, r, force);
        if (isForceKnown || isCoordinate)
            motion.take(force, 0, d);
        else
            motion.take(*tape, r);
        isForceKnown = false;
    }
    std::copy_n(r, d, q);
}

}  // namespace

void kicksAndDrifts(const Tape& forces, std::span<const KickAndDrift<double>> pairs, const double* perMass,
                    bool isForceKnown, double* q, double* p, double* force) {
    using namespace registers;
    static const auto call =
        ForThisMachine<&kicksAndDriftsBy<Eight>, &kicksAndDriftsBy<Four>, &kicksAndDriftsBy<Two>>::call();
    call(&forces, pairs, perMass, isForceKnown, q, p, force);
}

}  // namespace extremal::typed
