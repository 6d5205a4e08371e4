// SPDX-License-Identifier: GPL-3.0-or-later
/// P5 of the table of peers: a wave function in a cosine well, N = 256 and 512, at t = 1.
///
/// Rows of two kinds: codes that take all of the spectrum, and those that an expert tells beforehand which
/// energies the packet has: peers ("cut", wave_by_hand.hpp) as well as schemes, whose spaces may have fewer
/// modes than the model (the key `modes`).
#pragma once

#include <string>
#include <vector>

#include "engine/model/wave/basis/wisdom.hpp"
#include "engine/model/wave/resampling.hpp"
#include "tests/bench/peer_table.hpp"
#include "tests/bench/wave_by_hand.hpp"
#include "tests/bench/wave_costs.hpp"

namespace extremal::bench {

/// By `modes` of its own, from the same packet.
inline Method withModes(int modes, const Method& method) {
    WaveProblem own{"", onCircle("50*(1 - cos(x))", 1, modes), {}, 1, {}, 0};
    own.start = packet(own.system, 20, 5);
    return [=](const WaveProblem& whole, int n) {
        const std::vector<double> few = method(own, n);
        std::vector<double> all(few.empty() ? 0 : whole.exact.size());
        if (!few.empty())
            WaveResampling(*own.system.hamiltonian(), *whole.system.hamiltonian())
                .write(coefficients(few.data()), coefficients(all.data()));
        return all;
    };
}

inline void waves(PeerTable& table) {
    for (const int modes : {256, 512}) {
        (void)measureTransform({modes});  // as with EXTREMAL_WISDOM: planning is left out on both sides
        WaveProblem p{"P5", onCircle("50*(1 - cos(x))", 1, modes), {}, 1, {}, 3e-16};
        p.start = packet(p.system, 20, 5);
        p.exact = knownState(p.system, modes);
        std::vector<Curve> curves;
        const auto add = [&](const std::string& name, bool isPeer, const Method& method) {
            curves.push_back(measure(name, isPeer, counts(2, 3e5, 1.12), 0.05, [&](double n) {
                return std::vector<double>{errorOf(p, method(p, static_cast<int>(n)))};
            }));
        };
        for (const int degree : {4, 8, 12, 16})
            for (const double tolerance : {0.0, 1e-10})
                for (const int own : {0, 64, 80, 96, 128}) {
                    const Method method = pairMethod(degree, "banded", tolerance);
                    add((own > 0 ? "cut to " + std::to_string(own) + " modes, " : "") + "Gauss " +
                            std::to_string(2 * degree) + (tolerance > 0 ? " in fours" : " in pairs"),
                        false, own > 0 ? withModes(own, method) : method);
                }
        for (const char* knots : {"strang", "suzuki-4", "srkn-6b", "srkn-11b", "srkn-14a", "srkn-19a"})
            add(std::string("free motion ") + knots, false,
                schemeMethod({{"free-motion", {{"knots", knots}}, {}}, {"auto", {}, {}}, {}}));
        add("SRKN 14a by hand", true, bareSrkn14a);
        for (const char* id : {"srkn-19a", "srkn-14a", "srkn-11b", "strang", "chebyshev-propagation"})
            add(id, true, baselineMethod(id));
        addWavesByHand(curves, p);
        std::vector<Curve> whole = curves;
        std::erase_if(whole, [](const Curve& c) { return c.name.starts_with("cut"); });
        table.add("P5 wave, N=" + std::to_string(modes), whole, 0);
        table.add("P5 cut spectrum, N=" + std::to_string(modes), curves, 0, "cut");
    }
}

}  // namespace extremal::bench
