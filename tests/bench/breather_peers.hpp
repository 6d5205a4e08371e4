// SPDX-License-Identifier: GPL-3.0-or-later
/// P6 of the table of peers: a breather of the sine-Gordon equation, w = 0.9, to t = 100.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "engine/core/text/text.hpp"
#include "engine/integrator/skips_nodes.hpp"
#include "engine/model/wave/basis/wisdom.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/sweep.hpp"
#include "tests/bench/breather_by_hand.hpp"
#include "tests/bench/peer_table.hpp"
#include "tests/bench/scheme_makers.hpp"

namespace extremal::bench {

/// Fourier modes with Gauss in time, over numbers of steps: whole runs, tables and all.
inline void spectralBreather(std::vector<Curve>& curves, int modes) {
    constexpr double end = 100;
    const System system = findModel("field")->make({"field",
                                                    {{"wave_speed", 1.0},
                                                     {"potential", "sine-gordon"},
                                                     {"mass", 1.0},
                                                     {"domain", Value::Array{-80.0, 80.0}},
                                                     {"boundary", "periodic"},
                                                     {"cells", static_cast<double>(modes)},
                                                     {"trigonometric", true}},
                                                    {}});
    const Settings initial{"", {{"profile", "breather"}, {"omega", 0.9}}, {}};
    State start;
    start.x = system.start(initial, 0);
    std::vector<double> exact(start.x.size());
    system.exactFrom(initial, start)(end, exact);
    const auto add = [&](const std::string& label, const Make& make) {
        curves.push_back(measure("Fourier " + std::to_string(modes) + ", " + label, false,
                                 counts(20, 600, 1.12), 0.05, [&](double steps) {
                                     const auto integrator = make(system, start, end / steps);
                                     State state = start;
                                     if (advanceOver(*integrator, state, static_cast<long long>(steps),
                                                     Clock{0, end / steps})
                                             .outcome != Outcome::converged)
                                         return failed;
                                     double error = 0;
                                     system.error.evaluate(state.x.data(), exact.data(), &error);
                                     return std::vector<double>{error};
                                 }));
    };
    for (const int degree : {4, 5, 6, 8})
        for (const double tolerance : {1e-4, 1e-6, 1e-9, 1e-11, 0.0})
            add("Gauss " + std::to_string(2 * degree) + ", tolerance " + formatNumber(tolerance),
                schemeOf({{"fourier-field", {{"degree", static_cast<double>(degree)}, {"nodes", "same"}}, {}},
                          {"gauss", {{"nodes", static_cast<double>(degree)}, {"panels", 1.0}}, {}},
                          {"auto", {{"tolerance", tolerance}}, {}}}));
    for (const char* knots : {"srkn-6b", "srkn-11b", "srkn-14a", "srkn-19a", "srkn-19b"}) {
        add(knots, freeMotion(knots));
        for (const double mass : {0.0, 1.0})
            add(std::string(knots) + ", mass " + formatNumber(mass),
                schemeOf({{"free-motion", {{"knots", knots}, {"mass", mass}}, {}}, {"auto", {}, {}}, {}}));
    }
}

/// Every scheme on meshes and steps that are refined together; the error is the L2 norm at the nodes.
inline void breather(PeerTable& table) {
    struct Code {
        const char* label;
        const char* scheme;  ///< "CELLS" stands for the number of cells
        double ratio;        ///< of the step to the width of a cell
        std::vector<int> cells;
    };
    const std::vector<Code> codes{
        {"leapfrog",
         R"("space": "tent", "quadrature": {"space": "trapezoid", "time": "trapezoid"})",
         0.95,
         {320, 640, 1280, 2560, 5120}},
        {"tents, Gauss 2",
         R"("space": "tent", "quadrature": {"space": {"type": "gauss", "nodes": 2}, "time": {"type": "gauss", "nodes": 2}})",
         0.9,
         {320, 640, 1280, 2560}},
        {"tents of degree 2",
         R"("space": {"type": "tent", "degree": 2, "cells": CELLS})",
         0.5,
         {80, 160, 240, 320, 480}},
        {"tents of degree 3",
         R"("space": {"type": "tent", "degree": 3, "cells": CELLS})",
         0.5,
         {80, 120, 160, 240, 320}},
    };
    std::vector<Curve> curves;
    for (const int cells : {192, 224, 256, 320, 384}) {
        (void)measureTransform({cells});  // as with EXTREMAL_WISDOM: plans of both sides are measured before
        spectralBreather(curves, cells);
    }
    for (const Code& code : codes) {
        Curve curve{code.label, false, {{}}};
        for (const int cells : code.cells) {
            std::string scheme = code.scheme;
            if (const auto at = scheme.find("CELLS"); at != std::string::npos)
                scheme.replace(at, 5, std::to_string(cells));
            const double h = 100 / std::ceil(100 / (code.ratio * 160 / cells));
            const ReadScene read = readScene(std::string_view(
                R"json({"extremal": 1, "model": {"type": "field", "potential": "sine-gordon", "domain": [-80, 80],
                "boundary": "periodic", "cells": )json" +
                std::to_string(cells) +
                R"json(}, "initial": {"profile": "breather", "omega": 0.9}, "time": {"end": 100},
                "schemes": [{"label": "code", "step": )json" +
                std::to_string(h) + ", " + scheme + "}]}"));
            if (!read.resolved) {
                std::fprintf(stderr, "%s, %d cells: %s\n", code.label, cells,
                             read.errors.front().message.c_str());
                continue;
            }
            SweepOptions options;
            options.isAtEnd = true;
            options.threads = 1;
            options.repeat = 1;
            options.ladder.steps = {h};
            Sweep sweep(*read.resolved, options);
            sweep.run([](const ReferenceInfo&) {},
                      [&](std::size_t i, const PointResult& r) { sweep.take(i, r); }, {});
            for (const SweepRow& row : sweep.rows())
                if (row.result.isDone()) curve.errors[0].push_back({row.result.error, row.result.cpuSeconds});
        }
        curves.push_back(curve);
    }
    addBreathersByHand(curves);
    table.add("P6 breather", curves, 0);
}

}  // namespace extremal::bench
