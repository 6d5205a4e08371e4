// SPDX-License-Identifier: GPL-3.0-or-later
/// P12 of the table of peers: the four vortices of presets/vortices.json, all places at t = 60.
///
///     x_i' = -(1/2 pi) sum_j g_j (y_i - y_j)/r_ij^2,   y_i' = (1/2 pi) sum_j g_j (x_i - x_j)/r_ij^2
/// (Kirchhoff 1876). Schemes take them as a one-form on phase space, as the preset does, and as a Hamiltonian
/// in x and g y, which is the same motion; the vortices of the model `vortices` are on a sphere.
#pragma once

#include <boost/numeric/odeint.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/text/text.hpp"
#include "engine/integrator/composition.hpp"
#include "tests/bench/adaptive_peers.hpp"
#include "tests/bench/first_order_peers.hpp"
#include "tests/bench/peer_table.hpp"
#include "tests/bench/preset_scene.hpp"
#include "tests/bench/scheme_makers.hpp"

namespace extremal::bench {

namespace odeint = boost::numeric::odeint;

struct FourVortices {
    static constexpr std::size_t count = 4, d = 2 * count;
    static constexpr std::array<double, count> strength{1, 1, 1, 0.8};
    static constexpr double scale = 0.5 / std::numbers::pi;
    using Array = std::array<double, d>;

    /// x1, y1, x2, y2, ..; of numbers and of lanes.
    template <class T>
    static void rates(const T* x, T* dx) {
        for (std::size_t k = 0; k < d; ++k) dx[k] = T(0.0);
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const T a = x[2 * i] - x[2 * j], b = x[2 * i + 1] - x[2 * j + 1],
                        w = T(scale) / (a * a + b * b), aw = a * w, bw = b * w;
                dx[2 * i] -= T(strength[j]) * bw;
                dx[2 * i + 1] += T(strength[j]) * aw;
                dx[2 * j] += T(strength[i]) * bw;
                dx[2 * j + 1] -= T(strength[i]) * aw;
            }
    }

    /// x_i' - i y_i' = (1/2 pi i) sum_j g_j u_ij with u_ij = 1/(z_i - z_j), z = x + i y: the coefficients of
    /// the six u, a pair in each lane.
    struct Series {
        std::array<Lanes, 32> re, im, uRe, uIm;
        template <class X>
        void operator()(const X& x, std::size_t n, Array& dx) {
            std::size_t pair = 0;
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t j = 0; j < i; ++j, ++pair) {
                    re[n].lane[pair] = x[n][2 * i] - x[n][2 * j];
                    im[n].lane[pair] = x[n][2 * i + 1] - x[n][2 * j + 1];
                }
            for (; pair < 8; ++pair) re[n].lane[pair] = n == 0, im[n].lane[pair] = 0;
            if (n == 0) {
                const Lanes square = re[0] * re[0] + im[0] * im[0];
                uRe[0] = re[0] / square;
                uIm[0] = -im[0] / square;
            } else {
                Lanes sumRe(0.0), sumIm(0.0);
                for (std::size_t k = 1; k <= n; ++k) {
                    sumRe += re[k] * uRe[n - k] - im[k] * uIm[n - k];
                    sumIm += re[k] * uIm[n - k] + im[k] * uRe[n - k];
                }
                uRe[n] = sumIm * uIm[0] - sumRe * uRe[0];
                uIm[n] = -(sumRe * uIm[0] + sumIm * uRe[0]);
            }
            dx = {};
            pair = 0;
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t j = 0; j < i; ++j, ++pair) {
                    const double a = scale * uRe[n].lane[pair], b = scale * uIm[n].lane[pair];
                    dx[2 * i] += strength[j] * b;
                    dx[2 * i + 1] += strength[j] * a;
                    dx[2 * j] -= strength[i] * b;
                    dx[2 * j + 1] -= strength[i] * a;
                }
        }
    };
};

// For the vector instructions of this machine, as an expert compiles them.
inline void vorticesByTaylor(FourVortices::Array* y, double end, double tolerance) {
    FourVortices::Series series;
    integrateByTaylorRates(*y, end, tolerance, series);
}
template <std::size_t stages>
void vorticesByGauss(FourVortices::Array* y, double end, double n, double tolerance) {
    integrateByGauss<FourVortices::d, stages>(*y, end, n, tolerance,
                                              [](const auto* x, auto* dx) { FourVortices::rates(x, dx); });
}
/// The flow of the energy of two vortices over h: they turn about their centre, the only motion that is known
/// here. Angles of a step are small, and the series are those of the sine and the cosine.
inline void turnPair(double* x, std::size_t i, std::size_t j, double h) {
    const double gi = FourVortices::strength[i], gj = FourVortices::strength[j], both = gi + gj;
    const double a = x[2 * i] - x[2 * j], b = x[2 * i + 1] - x[2 * j + 1];
    const double angle = h * both * FourVortices::scale / (a * a + b * b), z = angle * angle;
    double s = angle *
               (1 - z / 6 * (1 - z / 20 * (1 - z / 42 * (1 - z / 72 * (1 - z / 110 * (1 - z / 156)))))),
           c = -z / 2 * (1 - z / 12 * (1 - z / 30 * (1 - z / 56 * (1 - z / 90 * (1 - z / 132)))));
    if (z > 0.25) {
        s = std::sin(angle);
        c = std::cos(angle) - 1;
    }
    const double u = (c * a - s * b) / both, v = (s * a + c * b) / both;
    x[2 * i] += gj * u;
    x[2 * i + 1] += gj * v;
    x[2 * j] -= gi * u;
    x[2 * j + 1] -= gi * v;
}
/// Known motions of the six pairs in turn, there and back in each part of a composition.
inline void vorticesByPairs(FourVortices::Array* y, double end, int n, const std::vector<double>* parts) {
    constexpr std::array<std::array<std::size_t, 2>, 6> pairs{
        {{0, 1}, {2, 3}, {0, 2}, {1, 3}, {0, 3}, {1, 2}}};
    double* const x = y->data();
    for (int step = 0; step < n; ++step)
        for (const double part : *parts) {
            const double h = part * end / n;
            for (std::size_t k = 0; k < 5; ++k) turnPair(x, pairs[k][0], pairs[k][1], h / 2);
            turnPair(x, pairs[5][0], pairs[5][1], h);
            for (std::size_t k = 5; k-- > 0;) turnPair(x, pairs[k][0], pairs[k][1], h / 2);
        }
}
/// The code for x'' = f(x) has the places in front of the velocities, and here takes the rates of all.
inline void vorticesByDop853(FourVortices::Array* y, double end, double tolerance) {
    integrateByDop853<FourVortices::d / 2>(*y, end, tolerance, [](const double* x, double* a) {
        FourVortices::rates(x, a - FourVortices::d / 2);
    });
}

/// The same vortices with q = x and p = g y.
inline System vorticesAsHamiltonian() {
    Value::Array coordinates;
    std::string H;
    for (int i = 1; i <= 4; ++i) {
        const std::string at = std::to_string(i);
        coordinates.push_back("x" + at);
        for (int j = 1; j < i; ++j) {
            const std::string of = std::to_string(j);
            H += (H.empty() ? "-c*(g" : " + g") + at + "*g" + of + "*log((x" + at + "-x" + of + ")^2+(p_x" +
                 at + "/g" + at + "-p_x" + of + "/g" + of + ")^2)";
        }
    }
    Settings settings{"hamiltonian", {}, {}};
    for (const FieldInfo& f : findModel("hamiltonian")->item.parameters)
        settings.keys.emplace_back(f.key, f.firstValue());
    for (auto& [key, value] : settings.keys) {
        if (key == "coordinates") value = coordinates;
        if (key == "hamiltonian") value = H + ")";
        if (key == "parameters")
            value = Value::Object{
                {"g1", 1.0}, {"g2", 1.0}, {"g3", 1.0}, {"g4", 0.8}, {"c", 0.25 / std::numbers::pi}};
    }
    return findModel("hamiltonian")->make(settings);
}

/// A form of the problem that schemes take: its name, its start, and x1, y1, x2, .. of a state.
struct VortexForm {
    std::string name;
    System system;
    State start;
    bool isCanonical;
    FourVortices::Array seen(const State& state) const {
        FourVortices::Array x;
        for (std::size_t i = 0; i < FourVortices::count; ++i) {
            x[2 * i] = state.x[isCanonical ? i : 2 * i];
            x[2 * i + 1] = isCanonical ? state.x[4 + i] / FourVortices::strength[i] : state.x[2 * i + 1];
        }
        return x;
    }
};

inline std::array<VortexForm, 2> vortexForms(const PresetProblem& preset) {
    std::array<VortexForm, 2> forms{VortexForm{"", preset.system, preset.start, false},
                                    VortexForm{"Hamiltonian, ", vorticesAsHamiltonian(), {}, true}};
    forms[1].start.x.resize(FourVortices::d);
    for (std::size_t i = 0; i < FourVortices::count; ++i) {
        forms[1].start.x[i] = preset.start.x[2 * i];
        forms[1].start.x[4 + i] = FourVortices::strength[i] * preset.start.x[2 * i + 1];
    }
    return forms;
}

/// The reference is Gauss 24 in 600 steps. Gauss 12 to 24 in 200 to 4000 steps, in both forms, Gauss 16 by
/// hand and the Taylor series agree with it to 8e-14.
struct KnownVortices {
    PresetProblem preset = presetProblem("vortices");
    std::array<VortexForm, 2> forms = vortexForms(preset);
    FourVortices::Array start, exact;

    KnownVortices() {
        std::copy_n(preset.start.x.begin(), FourVortices::d, start.begin());
        exact = *by(forms[0], schemeOf(*namedScheme("galerkin-gauss-12")), 600);
    }
    std::optional<FourVortices::Array> by(const VortexForm& form, const Make& make, double n) const {
        const auto integrator = make(form.system, form.start, preset.end / n);
        State state = form.start;
        for (double i = 0; i < n; ++i)
            if (advance(*integrator, state).outcome != Outcome::converged) return {};
        return form.seen(state);
    }
    std::vector<double> error(const FourVortices::Array& x) const {
        double sum = 0;
        for (std::size_t k = 0; k < x.size(); ++k) sum += (x[k] - exact[k]) * (x[k] - exact[k]);
        return {std::isfinite(sum) ? std::sqrt(sum) : HUGE_VAL};
    }
    std::vector<double> errorBy(const VortexForm& form, const Make& make, double n) const {
        const auto x = by(form, make, n);
        return x ? error(*x) : failed;
    }
};

inline void addVortexSchemes(std::vector<Curve>& curves, const KnownVortices& known, double longest) {
    for (const VortexForm& form : known.forms) {
        const std::vector<double> steps = counts(10, 6000, form.isCanonical ? 1.12 : 1.25);
        for (const int s : {2, 3, 4, 6, 8, 10, 12})
            for (const double tolerance : {0.0, 1e-9, 1e-6}) {
                Discretization g = *namedScheme("galerkin-gauss-" + std::to_string(s));
                if (tolerance > 0) g.solver.keys.emplace_back("tolerance", tolerance);
                curves.push_back(measure(form.name + "Gauss " + std::to_string(2 * s) +
                                             (tolerance > 0 ? " to " + formatNumber(tolerance) : ""),
                                         false, steps, longest,
                                         [&](double n) { return known.errorBy(form, schemeOf(g), n); }));
            }
        const Make midpoint = schemeOf(*namedScheme("midpoint"));
        const std::vector<double> parts = compositionParts({"kahan-li", {{"order", 8.0}}, {}}, 2);
        curves.push_back(measure(form.name + "midpoint, Kahan-Li 8", false, steps, longest, [&](double n) {
            return known.errorBy(
                form,
                [&](const System& system, const State& start, double h) {
                    return composed(parts, *midpoint(system, start, h));
                },
                n);
        }));
    }
}

inline void addVortexPeers(std::vector<Curve>& curves, const KnownVortices& known, double longest) {
    using Array = FourVortices::Array;
    const double end = known.preset.end;
    const std::vector<double> steps = counts(10, 6000, 1.12), tolerances = ratios(1e-2, 1e-16, 0.4);
    const auto add = [&](const std::string& name, const std::vector<double>& settings, const auto& run) {
        curves.push_back(measure(name, true, settings, longest, [&](double setting) {
            Array y = known.start;
            run(y, setting);
            return known.error(y);
        }));
    };
    const auto byOdeint = [&](const auto& stepper, Array& y) {
        odeint::integrate_adaptive(
            stepper, [](const Array& x, Array& dx, double) { FourVortices::rates(x.data(), dx.data()); }, y,
            0.0, end, 0.1);
    };
    add("odeint dopri5", tolerances, [&](Array& y, double e) {
        byOdeint(odeint::make_controlled(e, e, odeint::runge_kutta_dopri5<Array>()), y);
    });
    add("odeint rkf78", tolerances, [&](Array& y, double e) {
        byOdeint(odeint::make_controlled(e, e, odeint::runge_kutta_fehlberg78<Array>()), y);
    });
    add("odeint bulirsch-stoer", tolerances,
        [&](Array& y, double e) { byOdeint(odeint::bulirsch_stoer<Array>(e, e), y); });
    for (const double order : {4.0, 6.0, 8.0}) {
        const std::vector<double> parts =
            compositionParts({order == 4 ? "suzuki" : "kahan-li", {{"order", order}}, {}}, 2);
        add("pairs that turn by hand, order " + formatNumber(order), counts(15, 3000, 1.12),
            [&](Array& y, double n) {
                ForThisMachine<&vorticesByPairs>::call()(&y, end, static_cast<int>(n), &parts);
            });
    }
    add("DOP853 by hand", tolerances,
        [&](Array& y, double e) { ForThisMachine<&vorticesByDop853>::call()(&y, end, e); });
    add("Taylor by hand", tolerances,
        [&](Array& y, double e) { ForThisMachine<&vorticesByTaylor>::call()(&y, end, e); });
    for (const double tolerance : {1e-16, 1e-12, 1e-9, 1e-6}) {
        const std::string to = tolerance > 1e-16 ? " to " + formatNumber(tolerance) : "";
        add("Gauss 8 by hand" + to, steps,
            [&](Array& y, double n) { ForThisMachine<&vorticesByGauss<4>>::call()(&y, end, n, tolerance); });
        add("Gauss 16 by hand" + to, steps,
            [&](Array& y, double n) { ForThisMachine<&vorticesByGauss<8>>::call()(&y, end, n, tolerance); });
    }
    for (const double stages : {4.0, 8.0})
        curves.push_back(
            measure("Gauss collocation " + formatNumber(2 * stages), true, steps, longest, [&](double n) {
                return known.errorBy(known.forms[1], baselineOf("gauss-collocation", {{"stages", stages}}),
                                     n);
            }));
}

inline void vortices(PeerTable& table) {
    const KnownVortices known;
    std::vector<Curve> curves;
    constexpr double longest = 0.015;
    addVortexSchemes(curves, known, longest);
    addVortexPeers(curves, known, longest);
    table.add("P12 four vortices", curves, 0);
    std::erase_if(curves, [](const Curve& c) { return !c.isPeer && c.name.starts_with("Hamiltonian"); });
    table.add("P12 as a one-form", curves, 0);
}

}  // namespace extremal::bench
