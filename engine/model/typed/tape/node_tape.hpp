// SPDX-License-Identifier: GPL-3.0-or-later
/// Tapes at many nodes together, eight at a time.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "engine/core/algebra/lanes.hpp"
#include "engine/model/typed/tape/tape.hpp"
#include "engine/model/typed/tape/tape_run.hpp"

namespace extremal::typed {

/// In line with its caller, which is compiled for several instruction sets
/// (core/algebra/instruction_set.hpp). `fill(registers)` loads the inputs; `write(k, value)` takes output k
/// of the eight nodes.
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
    if (const auto code = tape.forEight())
        code(r->lane.data());
    else
        detail::runInGroups(tape, r);
    for (std::size_t k = 0; k < tape.outputs(); ++k) write(k, tape.output(k, r));
}
/// Eight numbers as one, which loops over them are not always compiled to.
inline void storeEight(const Lanes& from, double* to) { std::memcpy(to, &from, sizeof from); }

/// Formulas in (q, p) alone.
class NodeTape {
public:
    NodeTape() = default;
    /// Symbol k is q_k, symbol d + k is p_k.
    NodeTape(const Graph& graph, std::span<const int> roots, int dimension);
    /// Root k at node i to k * nodes + i, likewise q and p; `nodes` is a multiple of 8.
    void evaluate(int nodes, const double* q, const double* p, double* values) const;

private:
    int dimension_ = 0;
    Tape tape_;
};

}  // namespace extremal::typed
