// SPDX-License-Identifier: GPL-3.0-or-later
/// P13 of the table of peers: the four-bar with a motor and a damper of presets/four-bar.json, the places of
/// both joints at t = 10.
///
/// Codes for the same equations, four coordinates and three rods, are IDA (ida_four_bar.hpp) and explicit
/// integrators of the accelerations (index 1), whose drift off the rods is part of their error; RATTLE takes
/// no forces beside those of a potential. Our scheme on the rods by hand (four_bar_rods.hpp) shows what it
/// could cost in these coordinates. "minimal" is the same motion in the angle of the crank alone, which
/// an expert derives for this one mechanism: a row of its own. There Gauss collocation of the angle and its
/// momentum by hand, which is our scheme in this angle, shows what no code of the scheme is much below.
#pragma once

#include <boost/numeric/odeint.hpp>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/text/text.hpp"
#include "tests/bench/adaptive_peers.hpp"
#include "tests/bench/first_order_peers.hpp"
#include "tests/bench/four_bar.hpp"
#include "tests/bench/four_bar_rods.hpp"
#include "tests/bench/ida_four_bar.hpp"
#include "tests/bench/peer_table.hpp"
#include "tests/bench/preset_scene.hpp"
#include "tests/bench/scheme_makers.hpp"
#include "tests/laws/laws.hpp"

namespace extremal::bench {

namespace odeint = boost::numeric::odeint;

struct KnownFourBar {
    PresetProblem preset = presetProblem("four-bar");
    FourBar::State start;
    std::array<double, 4> exact;

    KnownFourBar() {
        std::copy_n(preset.start.x.begin(), start.size(), start.begin());
        exact = by(preset.system, preset.start, schemeOf(*namedScheme("galerkin-gauss-6")), 4000).value();
    }
    /// x1, y1, x2, y2 at the end; of one coordinate, the angle.
    std::optional<std::array<double, 4>> by(const System& system, const State& from, const Make& make,
                                            double n) const {
        const auto integrator = make(system, from, preset.end / n);
        State state = from;
        for (double i = 0; i < n; ++i)
            if (advance(*integrator, state).outcome != Outcome::converged) return {};
        if (system.dimension() == 1) return FourBar::places(state.x[0]);
        return std::array{state.x[0], state.x[1], state.x[2], state.x[3]};
    }
    template <class X>
    std::vector<double> error(const X& x) const {
        double sum = 0;
        for (std::size_t i = 0; i < 4; ++i) sum += (x[i] - exact[i]) * (x[i] - exact[i]);
        return {std::isfinite(sum) ? std::sqrt(sum) : HUGE_VAL};
    }
    std::vector<double> errorBy(const System& system, const State& from, const Make& make, double n) const {
        const auto x = by(system, from, make, n);
        return x ? error(*x) : failed;
    }
};

/// The same motion in the angle of the crank, as a scene may have it.
inline System fourBarInOneAngle() {
    const std::string x1 = "cos(a)", y1 = "sin(a)", square = "(2.5-cos(a))^2+sin(a)^2",
                      along = "((4-3.24+" + square + ")/(2*(" + square + ")))",
                      across = "sqrt(4/(" + square + ")-" + along + "^2)",
                      x2 = "(cos(a)+" + along + "*(2.5-cos(a))+" + across + "*sin(a))",
                      y2 = "(sin(a)-" + along + "*sin(a)+" + across + "*(2.5-cos(a)))",
                      // The rocker turns by w for each turn of the crank.
        w = "((" + y2 + "-" + y1 + ")*" + x1 + "-(" + x2 + "-" + x1 + ")*" + y1 + ")/((" + y2 + "-" + y1 +
            ")*(" + x2 + "-2.5)-(" + x2 + "-" + x1 + ")*" + y2 + ")";
    return laws::systemNamed("lagrangian",
                             {{"coordinates", Value::Array{"a"}},
                              {"parameters", Value::Object{}},
                              {"lagrangian", "a_t^2/2*(1+2*3.24*(" + w + ")^2)-9.81*sin(a)-2*9.81*" + y2},
                              {"forces", Value::Object{{"a", "12"}}},
                              {"dissipation", "0.75*3.24*(" + w + ")^2*a_t^2"}});
}

inline void addFourBarSchemes(std::vector<Curve>& curves, const std::string& prefix,
                              const KnownFourBar& known, const System& system, const State& from) {
    const std::vector<double> steps = counts(150, 2e4, 1.25);
    const auto add = [&](const std::string& name, Discretization scheme, double tolerance) {
        if (tolerance > 0) scheme.solver = {"auto", {{"tolerance", tolerance}}, {}};
        curves.push_back(measure(prefix + name + (tolerance > 0 ? " to " + formatNumber(tolerance) : ""),
                                 false, steps, 0.2,
                                 [&](double n) { return known.errorBy(system, from, schemeOf(scheme), n); }));
    };
    for (const double tolerance : {0.0, 1e-14, 1e-13, 1e-11, 1e-9, 1e-8, 1e-6, 1e-5, 1e-4})
        for (const int s : {2, 3, 4, 6, 8})
            add("Gauss " + std::to_string(2 * s), *namedScheme("galerkin-gauss-" + std::to_string(s)),
                tolerance);
    for (const int s : {2, 4})
        add("Lobatto " + std::to_string(2 * s), *namedScheme("galerkin-lobatto-" + std::to_string(s)), 1e-9);
}

inline void addFourBarPeers(std::vector<Curve>& curves, const KnownFourBar& known) {
    const std::vector<double> steps = counts(100, 1e5, 2), tolerances = ratios(1e-2, 1e-16, 0.4);
    const double end = known.preset.end;
    for (const char* id : {"rk4-projected", "baumgarte", "rattle", "ggl-bdf2"}) {
        if (!canIntegrate(*findBaseline(id), known.preset.system)) {
            std::printf("    %s does not take the four-bar\n", id);
            continue;
        }
        curves.push_back(measure(id, true, steps, 0.1, [&](double n) {
            return known.errorBy(known.preset.system, known.preset.start,
                                 baselineOf(id, laws::defaultsOf(findBaseline(id)->item).keys), n);
        }));
    }
#ifdef EXTREMAL_HAS_IDA
    curves.push_back(measure("IDA, index 2", true, ratios(1e-2, 1e-14, 0.2), 1, [&](double e) {
        const auto at = idaFourBar(known.start, end, e);
        return at ? known.error(*at) : failed;
    }));
#endif
    const auto add = [&](const std::string& name, const auto& start, const auto& seen, const auto& run) {
        curves.push_back(measure(name, true, tolerances, 0.1, [&](double e) {
            auto y = start;
            run(y, e);
            return known.error(seen(y));
        }));
    };
    const auto addForm = [&]<std::size_t d>(const std::string& prefix, const std::array<double, 2 * d>& start,
                                            const auto& accelerate, const auto& seen) {
        using Array = std::array<double, 2 * d>;
        const auto byOdeint = [&](const auto& stepper, Array& y) {
            odeint::integrate_adaptive(
                stepper,
                [&](const Array& x, Array& dx, double) {
                    std::copy_n(x.begin() + d, d, dx.begin());
                    accelerate(x.data(), dx.data() + d);
                },
                y, 0.0, end, 0.01);
        };
        add(prefix + "odeint dopri5", start, seen, [&](Array& y, double e) {
            byOdeint(odeint::make_controlled(e, e, odeint::runge_kutta_dopri5<Array>()), y);
        });
        add(prefix + "odeint rkf78", start, seen, [&](Array& y, double e) {
            byOdeint(odeint::make_controlled(e, e, odeint::runge_kutta_fehlberg78<Array>()), y);
        });
        add(prefix + "DOP853 by hand", start, seen,
            [&](Array& y, double e) { integrateByDop853<d>(y, end, e, accelerate); });
    };
    addForm.operator()<4>("index 1, ", known.start, &FourBar::accelerate,
                          [](const FourBar::State& y) { return y; });
    addForm.operator()<1>("minimal, ", std::array{std::atan2(known.start[1], known.start[0]), 0.0},
                          &FourBar::accelerateAngle,
                          [](const std::array<double, 2>& y) { return FourBar::places(y[0]); });
}

// For the vector instructions of this machine, as an expert compiles it.
template <std::size_t stages>
void fourBarByGauss(std::array<double, 2>* y, double end, double n, double tolerance) {
    integrateByGauss<2, stages>(*y, end, n, tolerance,
                                [](const auto* z, auto* dz) { FourBar::ratesOfAngle(z, dz); });
}

/// The steps that our schemes have.
inline void addFourBarByGauss(std::vector<Curve>& curves, const KnownFourBar& known) {
    const auto add = [&]<std::size_t stages> {
        for (const double tolerance : {1e-14, 1e-9, 1e-6, 1e-3})
            curves.push_back(measure(
                "minimal, Gauss " + std::to_string(2 * stages) + " by hand to " + formatNumber(tolerance),
                true, counts(150, 2e4, 1.25), 0.1, [&](double n) {
                    std::array y{std::atan2(known.start[1], known.start[0]), 0.0};
                    ForThisMachine<&fourBarByGauss<stages>>::call()(&y, known.preset.end, std::floor(n),
                                                                    tolerance);
                    return known.error(FourBar::places(y[0]));
                }));
    };
    add.operator()<2>();
    add.operator()<3>();
    add.operator()<4>();
    add.operator()<6>();
    add.operator()<8>();
}

template <std::size_t stages>
void fourBarOnRods(OnRods* state, double end, double n, double tolerance) {
    integrateOnRods<stages>(*state, end, n, tolerance);
}

/// The same steps again.
inline void addFourBarOnRods(std::vector<Curve>& curves, const KnownFourBar& known) {
    const auto add = [&]<std::size_t stages> {
        for (const double tolerance : {1e-14, 1e-11, 1e-8, 1e-6, 1e-4})
            curves.push_back(measure(
                "Gauss " + std::to_string(2 * stages) + " on rods by hand to " + formatNumber(tolerance),
                true, counts(150, 2e4, 1.25), 0.1, [&](double n) {
                    OnRods state{{known.start[0], known.start[1], known.start[2], known.start[3]}, 0};
                    ForThisMachine<&fourBarOnRods<stages>>::call()(&state, known.preset.end, std::floor(n),
                                                                   tolerance);
                    return known.error(state.u);
                }));
    };
    add.operator()<2>();
    add.operator()<3>();
    add.operator()<4>();
    add.operator()<6>();
    add.operator()<8>();
}

inline void fourBar(PeerTable& table) {
    const KnownFourBar known;
    std::vector<Curve> curves;
    addFourBarSchemes(curves, "", known, known.preset.system, known.preset.start);
    addFourBarPeers(curves, known);
    addFourBarByGauss(curves, known);
    addFourBarOnRods(curves, known);
    std::vector<Curve> same = curves;
    std::erase_if(same, [](const Curve& c) { return c.name.starts_with("minimal"); });
    table.add("P13 four-bar", same, 0);
    table.add("P13 four-bar, minimal", curves, 0, "minimal");
    std::erase_if(curves, [](const Curve& c) { return !c.isPeer; });
    const System oneAngle = fourBarInOneAngle();
    const State from{0, 0, {std::atan2(known.start[1], known.start[0]), 0}};
    addFourBarSchemes(curves, "one angle, ", known, oneAngle, from);
    table.add("P13 one angle, minimal", curves, 0, "minimal");
}

}  // namespace extremal::bench
