// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/tape/tape_kicks.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "engine/core/algebra/add_scaled.hpp"
#include "engine/model/typed/tape/tape_code.hpp"
#include "engine/model/typed/tape/tape_line.hpp"
#include "engine/model/typed/tape/tape_registers.hpp"

namespace extremal::typed {
namespace {

using Values = std::vector<std::uint32_t>;

/// How far from the beginning of a line of the cache the inputs of a tape are best, so that most of those
/// that its loops go over begin at one.
std::size_t bestShift(const Tape& tape) {
    constexpr std::size_t line = Lanes::size;
    std::array<std::size_t, line> votes{};
    for (const TapeGroup& g : tape.groups()) {
        if (!g.isSideBySide()) continue;
        const TapeGroup::Operand kinds[] = {g.a, g.b, g.c};
        const TapeGroup::Operand* kind = kinds;
        forOperands(tape.code()[g.first], [&](std::uint32_t k) {
            if (*kind++ == TapeGroup::Operand::sideBySide && k < tape.inputs()) votes[k % line] += g.count;
        });
    }
    const auto most = std::max_element(votes.begin(), votes.end()) - votes.begin();
    return (line - static_cast<std::size_t>(most)) % line;
}

}  // namespace

KickTape::KickTape(const Graph& graph, std::span<const int> forces, const Drifts& drifts)
    : d_(forces.size()) {
    const auto d = static_cast<std::uint32_t>(d_);
    const auto moved = [&](Code& code, const Values& p) {
        const Values moves = drifts(code, code.input(3 * d + 1), p);
        Values q;
        for (std::uint32_t i = 0; i < d; ++i) q.push_back(code.make(Op::add, code.input(i), moves[i]));
        return q;
    };
    Code code(graph), ofDrift(graph);
    Values f, p, same;
    for (const int root : forces) {
        f.push_back(code.value(root));
        // Where it is a coordinate or a number it is made here: a tape that goes on from what it has computed
        // reads none of its inputs as a result.
        if (code.items()[f.back()].kind != Code::Kind::instruction)
            f.back() = code.make(Op::multiply, code.constant(1), f.back());
    }
    const std::uint32_t kick = code.input(3 * d);
    for (std::uint32_t i = 0; i < d; ++i) {
        p.push_back(code.make(Op::add, code.input(d + i), code.make(Op::multiply, kick, f[i])));
        same.push_back(ofDrift.input(d + i));
    }
    Values all = moved(code, p);
    for (const Values& each : {p, f}) all.insert(all.end(), each.begin(), each.end());
    pair_ = Tape::goingOn(code, std::move(all), 3 * d_ + 2);
    drift_ = Tape::of(ofDrift, moved(ofDrift, same), 3 * d_ + 2);
    shift_ = bestShift(pair_);
}

KickTape KickTape::ofSeparable(const Graph& graph, std::span<const int> forces,
                               std::span<const double> masses) {
    return {graph, forces, [&](Code& code, std::uint32_t drift, const Values& p) {
                Values moves;
                for (std::size_t i = 0; i < p.size(); ++i) {
                    const double perMass = 1 / masses[i];
                    const std::uint32_t own =
                        perMass == 1 ? drift : code.make(Op::multiply, drift, code.constant(perMass));
                    moves.push_back(code.make(Op::multiply, own, p[i]));
                }
                return moves;
            }};
}

KickTape KickTape::ofSum(const Graph& graph, std::span<const int> forces, std::span<const int> velocities) {
    return {graph, forces, [&](Code& code, std::uint32_t drift, const Values& p) {
                for (std::size_t i = 0; i < p.size(); ++i) code.define(static_cast<int>(p.size() + i), p[i]);
                Values moves;
                for (const int root : velocities)
                    moves.push_back(code.make(Op::multiply, drift, code.value(root)));
                return moves;
            }};
}

void KickTape::take(const KicksAndDrifts<double>& steps, double* q, double* p, double* force) const {
    static_assert(sizeof(KickAndDrift<double>) == 2 * sizeof(double));
    TapeRoom room(std::max(pair_.registers(), drift_.registers()) + shift_);
    double *const r = room.data() + shift_, *const momenta = r + d_, *const forces = r + 2 * d_;
    const auto drift = [&](double s) {
        r[3 * d_ + 1] = s;
        drift_.run(r);
        drift_.copyOutputs(0, d_, r, r);
    };
    std::copy_n(q, d_, r);
    std::copy_n(p, d_, momenta);
    if (steps.isForceKnown) std::copy_n(force, d_, forces);
    bool isForceKnown = steps.isForceKnown && steps.firstDrift == 0;
    for (long long step = 0; step < steps.steps; ++step) {
        std::span<const KickAndDrift<double>> left = steps.pairs;
        if (steps.firstDrift != 0) drift(steps.firstDrift);
        if (isForceKnown && !left.empty()) {
            addScaled(momenta, left.front().kick, forces, d_);
            drift(left.front().drift);
            left = left.subspan(1);
        }
        if (!left.empty()) pair_.goOn(r, &left.front().kick, &left.front().kick + 2 * left.size());
        isForceKnown = steps.keepsForce();
        if (steps.nodes) std::copy_n(r, 2 * d_, steps.nodes + static_cast<std::size_t>(step) * steps.stride);
    }
    std::copy_n(r, d_, q);
    std::copy_n(momenta, d_, p);
    std::copy_n(forces, d_, force);
}

}  // namespace extremal::typed
