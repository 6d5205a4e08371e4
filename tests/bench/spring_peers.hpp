// SPDX-License-Identifier: GPL-3.0-or-later
/// P1 of the table of peers: the spring pendulum to t = 10, in polar coordinates (extension and angle) and in
/// Cartesian ones, where its Lagrangian is separable. Errors at the rows t = 0.1 n: of the angle, of the
/// extension over its amplitude, of both.
#pragma once

#include <boost/numeric/odeint.hpp>

#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "engine/core/text/text.hpp"
#include "engine/family/multiscale/multiscale.hpp"
#include "tests/bench/peer_table.hpp"
#include "tests/bench/scheme_makers.hpp"
#include "tests/engine/model/typed/typed.hpp"

#if __has_include(<gsl/gsl_odeiv2.h>)
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#define EXTREMAL_BENCH_GSL 1
#endif

namespace extremal::bench {

namespace odeint = boost::numeric::odeint;

constexpr double springGravity = 9.81;

/// Right-hand sides by hand for m = l = 1.
struct PolarRates {
    double k;
    template <class X, class D>
    void operator()(const X& y, D& d, double) const {
        const double r = 1 + y[0], w = y[3] / (r * r), c = std::cos(y[1]), s = std::sin(y[1]);
        d[0] = y[2];
        d[1] = w;
        d[2] = r * w * w + springGravity * c - k * y[0];
        d[3] = -springGravity * r * s;
    }
};
struct CartesianRates {
    double k;
    template <class X, class D>
    void operator()(const X& y, D& d, double) const {
        const double pull = k * (1 / std::sqrt(y[0] * y[0] + y[1] * y[1]) - 1);
        d[0] = y[2];
        d[1] = y[3];
        d[2] = pull * y[0];
        d[3] = pull * y[1] - springGravity;
    }
};

/// The pendulum in one kind of coordinates.
struct SpringForm {
    bool isCartesian;
    System system;
    State start;

    std::string suffix() const { return isCartesian ? " (x, y)" : ""; }

    /// (a, theta) of a state.
    template <class X>
    std::array<double, 2> seen(const X& x) const {
        if (!isCartesian) return {x[0], x[1]};
        return {std::sqrt(x[0] * x[0] + x[1] * x[1]) - 1, std::atan2(x[0], -x[1])};
    }
};

struct Spring {
    double k;
    std::vector<std::array<double, 2>> rows;  ///< (a, theta) at 0.1 n
    double amplitude() const { return 0.05 * std::sqrt(1e4 / k); }

    SpringForm polar() const {
        Settings keys{"spring-pendulum", {{"m", 1.0}, {"g", springGravity}, {"l", 1.0}, {"k", k}}, {}};
        return {false, findModel("spring-pendulum")->make(keys), {0, 0, {amplitude(), 1, 0, 0}}};
    }
    SpringForm cartesian() const {
        const double r = 1 + amplitude();
        return {true,
                laws::typedSystem({"x", "y"}, {{"g", springGravity}, {"k", k}},
                                  "(x_t^2 + y_t^2)/2 - g*y - k/2*(sqrt(x^2 + y^2) - 1)^2"),
                {0, 0, {r * std::sin(1.0), -r * std::cos(1.0), 0, 0}}};
    }

    struct Errors {
        double theta = 0, a = 0;
        void see(const Spring& p, double t, const std::array<double, 2>& seen) {
            const double place = 10 * t;
            if (std::abs(place - std::round(place)) > 1e-6) return;
            const auto& known = p.rows[static_cast<std::size_t>(std::llround(place))];
            theta = std::max(theta, std::abs(seen[1] - known[1]));
            a = std::max(a, std::abs(seen[0] - known[0]) / p.amplitude());
        }
        std::vector<double> all() const { return {theta, a, std::max(theta, a)}; }
    };
};
inline const std::vector<double> lostSpring{HUGE_VAL, HUGE_VAL, HUGE_VAL};

inline Spring springOf(double k) {
    Spring p{k, {}};
    if (k < 1e9) {
        const std::string name = k == 1e4 ? "1e4" : k == 1e6 ? "1e6" : "1e8";
        std::ifstream in(EXTREMAL_SOURCE_DIR "/tests/laws/data/spring_pendulum_k" + name + ".txt");
        for (std::string line; std::getline(in, line);) {
            std::istringstream cells(line);
            double t = 0, a = 0, theta = 0;
            if (cells >> t >> a >> theta) p.rows.push_back({a, theta});
        }
        return p;
    }
    // R3 at a quarter of the largest step that is measured, which agrees with that at half of it to 1e-8.
    const SpringForm form = p.polar();
    const auto integrator = makeIntegrator(form.system, *namedScheme("multiscale-r3"), {0, 0.05});
    State state = form.start;
    p.rows.push_back({state.x[0], state.x[1]});
    while (state.t < 10 - 0.01 && advance(*integrator, state).outcome == Outcome::converged)
        if (state.node % 2 == 0) p.rows.push_back({state.x[0], state.x[1]});
    return p;
}

/// Of n steps; nodes at the rows, or every m-th row where steps are longer.
inline std::vector<double> runSpring(const Spring& p, const SpringForm& form, const Make& make, double n) {
    const auto integrator = make(form.system, form.start, 10 / n);
    State state = form.start;
    Spring::Errors errors;
    while (state.t < 10 - 5 / n) {
        if (advance(*integrator, state).outcome != Outcome::converged) return lostSpring;
        errors.see(p, state.t, form.seen(state.x));
    }
    return errors.all();
}

/// Under error control, from row to row.
inline std::vector<double> runSpringTo(const Spring& p, const SpringForm& form, const Make& make,
                                       double tolerance) {
    const auto integrator = make(form.system, form.start, tolerance);
    State state = form.start;
    Spring::Errors errors;
    for (int row = 1; row <= 100; ++row) {
        while (state.t < 0.1 * row)
            if (integrator->advance(state, 0.1 * row).outcome != Outcome::converged) return lostSpring;
        errors.see(p, 0.1 * row, form.seen(state.x));
    }
    return errors.all();
}

using SpringArray = std::array<double, 4>;
inline SpringArray springStart(const SpringForm& form) {
    return {form.start.x[0], form.start.x[1], form.start.x[2], form.start.x[3]};
}

template <class Stepper, class Rates>
std::vector<double> springByOdeint(const Spring& p, const SpringForm& form, const Stepper& stepper,
                                   const Rates& rates) {
    SpringArray x = springStart(form);
    Spring::Errors errors;
    std::vector<double> times;
    for (int row = 0; row <= 100; ++row) times.push_back(0.1 * row);
    odeint::integrate_times(stepper, rates, x, times.begin(), times.end(), 0.1 / std::sqrt(p.k),
                            [&](const SpringArray& y, double t) { errors.see(p, t, form.seen(y)); });
    return errors.all();
}

#if EXTREMAL_BENCH_GSL
/// GSL's own driver around the right-hand side by hand.
template <class Rates>
std::vector<double> springByGsl(const Spring& p, const SpringForm& form, double tolerance, Rates rates) {
    gsl_odeiv2_system system{[](double t, const double y[], double d[], void* given) {
                                 (*static_cast<const Rates*>(given))(y, d, t);
                                 return int(GSL_SUCCESS);
                             },
                             nullptr, 4, &rates};
    gsl_odeiv2_driver* const driver = gsl_odeiv2_driver_alloc_y_new(
        &system, gsl_odeiv2_step_rk8pd, 0.1 / std::sqrt(p.k), tolerance, tolerance);
    SpringArray x = springStart(form);
    double t = 0;
    Spring::Errors errors;
    int status = GSL_SUCCESS;
    for (int row = 1; row <= 100 && status == GSL_SUCCESS; ++row) {
        status = gsl_odeiv2_driver_apply(driver, &t, 0.1 * row, x.data());
        errors.see(p, t, form.seen(x));
    }
    gsl_odeiv2_driver_free(driver);
    return status == GSL_SUCCESS ? errors.all() : lostSpring;
}
#endif

/// The libraries on a right-hand side by hand.
template <class Rates>
void addLibraries(std::vector<Curve>& curves, const Spring& p, const SpringForm& form, const Rates& rates,
                  const std::vector<double>& tolerances, double longest) {
    const auto add = [&](const std::string& name, auto&& run) {
        curves.push_back(measure(name + form.suffix(), true, tolerances, longest, run));
    };
    add("odeint rkf78", [&](double tolerance) {
        return springByOdeint(
            p, form,
            odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_fehlberg78<SpringArray>()),
            rates);
    });
    add("odeint bulirsch-stoer", [&](double tolerance) {
        return springByOdeint(p, form, odeint::bulirsch_stoer<SpringArray>(tolerance, tolerance), rates);
    });
#if EXTREMAL_BENCH_GSL
    add("GSL rk8pd by hand", [&](double tolerance) { return springByGsl(p, form, tolerance, rates); });
#endif
}

/// A slow model under Gauss's rule, with polynomials of this degree.
inline Discretization namedSlow(const char* model, int degree) {
    const auto n = static_cast<double>(degree);
    return {
        {"slow", {{"model", model}, {"degree", n}}, {}}, {"gauss", {{"nodes", n}, {"panels", 1.0}}, {}}, {}};
}

inline void springs(PeerTable& table) {
    for (const double k : {1e4, 1e6, 1e8, 1e12}) {
        const Spring p = springOf(k);
        const SpringForm polar = p.polar();
        const double longest = k > 1e9 ? 3 : k > 1e7 ? 0.5 : 0.1;
        std::vector<Curve> curves;
        const auto steps = [&](const std::string& name, bool isPeer, const SpringForm& form, const Make& make,
                               const std::vector<double>& settings) {
            curves.push_back(measure(name + form.suffix(), isPeer, settings, longest,
                                     [&](double n) { return runSpring(p, form, make, n); }));
        };
        const std::vector<double> few{10, 20, 25, 40, 50, 100, 200, 300, 400, 500};
        steps("6/4 [3,0]", false, polar, schemeOf(multiscalePair(6, 4, {3, 0})), few);
        for (const std::string r : {"1", "2", "3"})
            steps("R" + r, false, polar, schemeOf(*namedScheme("multiscale-r" + r)), few);
        // Slow models: nodes at the rows, or at some of them.
        for (const char* model : {"rod", "averaged", "normal-form-1", "normal-form-2", "normal-form-3"})
            for (const int degree : {3, 4, 6, 8})
                for (const double tolerance : {0.0, 1e-10, 1e-7, 1e-4}) {
                    Discretization d = namedSlow(model, degree);
                    if (tolerance > 0) d.solver = {"auto", {{"tolerance", tolerance}}, {}};
                    steps(std::string(model) + " Gauss " + std::to_string(2 * degree) + " to " +
                              formatNumber(tolerance),
                          false, polar, schemeOf(d), {5, 10, 20, 25, 50, 100});
                }
        std::vector<double> many;
        for (const double n : ratios(100, 2e7, 1.3))
            if (const double whole = 100 * std::ceil(n / 100); many.empty() || whole > many.back())
                many.push_back(whole);
        // At k = 1e12 impulse alone comes near.
        for (const double order : {4.0, 6.0, 8.0})
            steps("impulse " + std::to_string(static_cast<int>(order)), true, polar,
                  baselineOf("impulse", {{"order", order}}), many);
        if (k < 1e9) {
            steps("Gauss collocation 16", true, polar, baselineOf("gauss-collocation", {{"stages", 8.0}}),
                  many);
            const std::vector<double> tolerances = ratios(1e-3, 1e-14, 0.3);
            for (const char* id : {"rk8pd", "stiff"})
                curves.push_back(measure(id, true, tolerances, longest, [&](double tolerance) {
                    return runSpringTo(p, polar, baselineOf(id), tolerance);
                }));
            addLibraries(curves, p, polar, PolarRates{k}, tolerances, longest);
            // Resolved methods are cheaper in coordinates in which the Lagrangian is separable.
            if (k < 1e5) {
                const SpringForm cartesian = p.cartesian();
                for (const SpringForm* form : {&polar, &cartesian})
                    for (const int s : {2, 4, 6, 8, 10, 12}) {
                        Discretization gauss = *namedScheme("galerkin-gauss-" + std::to_string(s));
                        const std::string name = "Gauss " + std::to_string(2 * s);
                        steps(name, false, *form, schemeOf(gauss), many);
                        gauss.solver.keys.emplace_back("tolerance", 1e-12);
                        steps(name + " to 1e-12", false, *form, schemeOf(gauss), many);
                    }
                for (const char* id : {"srkn-11b", "srkn-14a", "srkn-19a", "blanes-moan-s10"})
                    steps(id, true, cartesian, baselineOf(id), many);
                steps("Gauss collocation 16", true, cartesian,
                      baselineOf("gauss-collocation", {{"stages", 8.0}}), many);
                addLibraries(curves, p, cartesian, CartesianRates{k}, tolerances, longest);
            }
        }
        char name[32];
        std::snprintf(name, sizeof name, "P1 k=%.0e, ", k);
        const char* const quantities[] = {"theta", "a", "both"};
        for (std::size_t e = 0; e < 3; ++e) table.add(std::string(name) + quantities[e], curves, e);
        if (k < 1e5) table.add("P1 k=1e+04, theta, GSL", curves, 0, "GSL rk8pd");
    }
}

}  // namespace extremal::bench
