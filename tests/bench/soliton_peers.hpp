// SPDX-License-Identifier: GPL-3.0-or-later
/// P6n of the table of peers: the nonlinear Schroedinger equation from 2 sech x, over one period.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/core/text/text.hpp"
#include "engine/integrator/skips_nodes.hpp"
#include "engine/model/wave/basis/wisdom.hpp"
#include "tests/bench/peer_table.hpp"
#include "tests/bench/scheme_makers.hpp"
#include "tests/bench/soliton_by_hand.hpp"

namespace extremal::bench {

/// 2 sech x to pi/2 on 1024 modes; peers are splittings and exponential integrators with FFTW and sines in
/// vector registers, of the program and by hand (soliton_by_hand.hpp).
inline void solitons(PeerTable& table) {
    constexpr double end = std::numbers::pi / 2;
    (void)measureTransform({1024});  // as with EXTREMAL_WISDOM: planning is left out on both sides
    const ModelEntry* const model = findModel("schrodinger");
    Settings settings{"schrodinger", {}, {}};
    for (const FieldInfo& f : model->item.parameters) settings.keys.emplace_back(f.key, f.firstValue());
    for (auto& [key, value] : settings.keys) {
        if (key == "domain") value = Value::Array{-24.0, 24.0};
        if (key == "modes") value = 1024.0;
        if (key == "interaction") value = -1.0;
    }
    const System system = model->make(settings);
    const Settings initial{"", {{"psi", Value::Object{{"packet", "two-soliton"}}}}, {}};
    State start;
    start.x = system.start(initial, 0);
    std::vector<double> exact(start.x.size());
    system.exactFrom(initial, start)(end, exact);
    const auto errorWith = [&](std::unique_ptr<Integrator> integrator, int steps) {
        State state = start;
        if (advanceOver(*integrator, state, steps, Clock{0, end / steps}).outcome != Outcome::converged)
            return failed;
        double error = 0;
        system.error.evaluate(state.x.data(), exact.data(), &error);
        return std::vector<double>{error};
    };
    std::vector<Curve> curves;
    for (const int degree : {2, 3, 4, 6, 8})
        for (const double tolerance : {1e-4, 1e-5, 1e-7, 1e-10, 1e-12})
            curves.push_back(
                measure("Gauss " + std::to_string(2 * degree) + ", tolerance " + formatNumber(tolerance),
                        false, counts(10, 1000, 1.2), 0.1, [&](double steps) {
                            Discretization d = *namedScheme("schrodinger-gauss-" + std::to_string(degree));
                            d.solver = {"auto", {{"tolerance", tolerance}}, {}};
                            return errorWith(
                                makeIntegrator(system, withEstimates(d, system, start), {0, end / steps}),
                                static_cast<int>(steps));
                        }));
    for (const char* knots : {"strang", "blanes-moan-s6", "srkn-6b", "srkn-11b", "srkn-14a", "srkn-19a"})
        curves.push_back(measure(
            std::string("free motion ") + knots, false, counts(10, 4000, 1.2), 0.1, [&](double steps) {
                return errorWith(freeMotion(knots)(system, start, end / steps), static_cast<int>(steps));
            }));
    for (const char* id :
         {"strang", "blanes-moan-s6", "srkn-6b", "srkn-11b", "srkn-14a", "srkn-19a", "if-rk4"})
        curves.push_back(measure(id, true, counts(10, 4000, 1.2), 0.1, [&](double steps) {
            return errorWith(findBaseline(id)->make(system, {.step = end / steps, .settings = {id, {}, {}}}),
                             static_cast<int>(steps));
        }));
    const auto byHand = [&](const std::string& name, double most, const auto& run) {
        curves.push_back(measure(name + " by hand", true, counts(10, most, 1.2), 0.1, [&](double steps) {
            SolitonByHand psi(*system.hamiltonian(), start.x, 48);
            const std::vector<double> x = run(psi, static_cast<int>(steps));
            double error = 0;
            system.error.evaluate(x.data(), exact.data(), &error);
            return std::vector<double>{std::isfinite(error) ? error : HUGE_VAL};
        }));
    };
    byHand("ETDRK4", 2e4, [&](auto& psi, int n) { return psi.byEtdRk4(end, n); });
    byHand("SRKN 6b", 4000, [&](auto& psi, int n) { return psi.bySplitting(srkn6b(), end, n); });
    byHand("SRKN 11b", 4000, [&](auto& psi, int n) { return psi.bySplitting(srkn11b(), end, n); });
    byHand("SRKN 14a", 4000, [&](auto& psi, int n) { return psi.bySplitting(srkn14a(), end, n); });
    byHand("SRKN 19a", 4000, [&](auto& psi, int n) { return psi.bySplitting(srkn19a(), end, n); });
    table.add("P6n two solitons", curves, 0);
}

}  // namespace extremal::bench
