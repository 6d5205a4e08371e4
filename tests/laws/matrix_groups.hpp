// SPDX-License-Identifier: GPL-3.0-or-later
/// Problems on groups given as data for the laws, with references by another route: the Runge-Kutta-Fehlberg
/// method of order 8 on (g, mu), which knows no chart.
#pragma once

#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <cmath>
#include <list>
#include <string>
#include <vector>

#include "engine/model/group/group_mechanics.hpp"
#include "engine/model/group/lie_group.hpp"
#include "tests/laws/bodies.hpp"

namespace extremal::laws {

struct GroupCase {
    const char* name;
    Value group;
    const char* lagrangian;
    Value::Object let;
    std::vector<double> xi;
    double duration;
    int coarsest;  ///< steps
    bool isMu = false;

    System system() const {
        return systemNamed("group", {{"group", group},
                                     {"lagrangian", lagrangian},
                                     {"parameters", Value::Object{}},
                                     {"let", let.empty() ? Value() : Value(let)}});
    }
    State start(const System& system) const {
        Value::Array list;
        for (const double v : xi) list.emplace_back(v);
        return {0, 0, system.start(Settings{"", {{isMu ? "mu" : "xi", list}}, {}}, 0)};
    }
};

inline Value twoOf(const char* first, const char* second, const char* a, const char* b) {
    return Value::Object{{"product", Value::Object{{a, first}, {b, second}}}};
}

/// The free body and the top of math's tables, as data.
inline GroupCase freeBodyAsData() {
    return {
        "SO(3), free", "so3", "(xi1^2 + 2*xi2^2 + 3*xi3^2)/2", {}, {std::cos(1.1), 0, std::sin(1.1)}, 10, 20,
        true};
}
inline GroupCase heavyTopAsData() {
    return {"SO(3), heavy top",
            "so3",
            "(xi1^2 + xi2^2 + xi3^2/2)/2 - 0.3*g31 - g33",
            {},
            {0.1, 0.2, 2},
            10,
            40,
            true};
}

inline std::vector<GroupCase> groupCases() {
    return {
        freeBodyAsData(),
        heavyTopAsData(),
        {"SU(2), free",
         "su2",
         "(xi1^2 + 2*xi2^2 + 3*xi3^2)/2",
         {},
         {std::cos(1.1), 0, std::sin(1.1)},
         10,
         20,
         true},
        {"SO(4), free",
         "so4",
         "(xi1^2 + 2*xi2^2 + 3*xi3^2 + 1.5*xi4^2 + 2.5*xi5^2 + 4*xi6^2)/2",
         {},
         {0.5, 0.3, -0.2, 0.4, 0.1, 0.3},
         5,
         10},
        {"SO(4) in a potential",
         "so4",
         "(xi1^2 + 2*xi2^2 + 3*xi3^2 + 1.5*xi4^2 + 2.5*xi5^2 + 4*xi6^2)/2 - g11 - g11*g22/2",
         {},
         {0.5, 0.3, -0.2, 0.4, 0.1, 0.3},
         5,
         10},
        {"SL(2) in a potential",
         "sl2",
         "(2*xi1^2 + xi2^2 + xi3^2)/2 - (g11^2 + g12^2 + g21^2 + g22^2)/2",
         {},
         {0.3, 0.5, -0.2},
         5,
         20},
        {"SL(2), area-preserving ellipse",
         "sl2",
         "(a11^2 + a12^2 + a21^2 + a22^2)/2 - (g11^2 + g12^2 + g21^2 + g22^2)/2",
         {{"a11", "g11*xi1 + g12*xi3"},
          {"a12", "g11*xi2 - g12*xi1"},
          {"a21", "g21*xi1 + g22*xi3"},
          {"a22", "g21*xi2 - g22*xi1"}},
         {0.4, 0.6, -0.3},
         5,
         20},
        {"SE(2), body in a fluid", "se2", "(xi1^2 + xi2^2 + 3*xi3^2)/2", {}, {0.5, 1, 0.3}, 5, 20},
        {"Heisenberg", "heisenberg", "(xi1^2 + xi2^2 + xi3^2)/2", {}, {1, 1, 1}, 5, 10},
        {"SO(3) x SO(3), two bodies in a chain",
         twoOf("so3", "so3", "up", "low"),
         "(up_xi1^2 + 1.2*up_xi2^2 + 0.5*up_xi3^2)/2 + (0.4*low_xi1^2 + 0.5*low_xi2^2 + 0.3*low_xi3^2)/2 + "
         "(up_xi1^2 + up_xi2^2)/2 + ux*wx + uy*wy + uz*wz - 2*zup - 0.5*zlow",
         {{"ux", "up_g12*up_xi1 - up_g11*up_xi2"},
          {"uy", "up_g22*up_xi1 - up_g21*up_xi2"},
          {"uz", "up_g32*up_xi1 - up_g31*up_xi2"},
          {"wx", "(low_g12*low_xi1 - low_g11*low_xi2)/2"},
          {"wy", "(low_g22*low_xi1 - low_g21*low_xi2)/2"},
          {"wz", "(low_g32*low_xi1 - low_g31*low_xi2)/2"},
          {"zup", "-up_g33"},
          {"zlow", "-low_g33"}},
         {0.6, 0.3, 0.4, -0.5, 0.2, 0.7},
         4,
         10},
        {"U(1) x SU(2), gyrostat",
         twoOf("u1", "su2", "rotor", "hull"),
         "(hull_xi1^2 + 2*hull_xi2^2 + 3*hull_xi3^2)/2 + 0.2*hull_xi1*hull_xi2 + 0.3*(rotor_xi1 + "
         "hull_xi3)^2",
         {},
         {1.5, 0.6, 0.1, 0.4},
         5,
         20}};
}

/// Bodies whose third axes attract those of their neighbours; with `hinges`, the kinetic energy couples them
/// as well, by the product of velocities about those axes in space.
inline GroupCase chainOfBodies(int count, bool hasHinges, const std::string& more = "") {
    static std::list<std::string> texts;  // where the cases point
    const std::string n = std::to_string(count), b = std::to_string(count - 1);
    std::string L = "sum(i, 1.." + n +
                    ", (b[i]_xi1^2 + 1.5*b[i]_xi2^2 + 2*b[i]_xi3^2)/2 - 0.3*b[i]_g33) + "
                    "sum(i, 1.." +
                    b +
                    ", 0.5*(b[i]_g13*b[i+1]_g13 + b[i]_g23*b[i+1]_g23 + "
                    "b[i]_g33*b[i+1]_g33))";
    if (hasHinges)
        L += " + sum(i, 1.." + b + ", 0.2*(b[i]_g11*b[i+1]_g11 + b[i]_g21*b[i+1]_g21)*b[i]_xi3*b[i+1]_xi2)";
    texts.push_back(L + more);
    GroupCase made{"chain",
                   Value::Object{{"product", Value::Object{{"b[1.." + n + "]", "so3"}}}},
                   texts.back().c_str(),
                   {},
                   {},
                   2,
                   10};
    for (int k = 0; k < count; ++k)
        for (const double rate : {0.4, 0.1 + 0.4 * std::sin(k), 0.3 * std::cos(k)}) made.xi.push_back(rate);
    return made;
}

/// The state after `duration` by another route.
inline std::vector<double> referenceOf(const System& system, const State& start, double duration) {
    const auto rate = [&](const std::vector<double>& x, std::vector<double>& dx, double t) {
        system.rate(t, x.data(), dx.data());
    };
    boost::numeric::odeint::runge_kutta_fehlberg78<std::vector<double>> stepper;
    std::vector<double> x = start.x;
    constexpr int steps = 2000;
    for (int k = 0; k < steps; ++k) stepper.do_step(rate, x, k * duration / steps, duration / steps);
    return x;
}

/// Errors of g and of mu after n steps (Frobenius).
struct GroupErrors {
    double g = 1e300, mu = 1e300;
};
inline GroupErrors errorsOf(const System& system, const State& start, const std::vector<double>& reference,
                            const Discretization& discretization, double duration, long long n) {
    const GroupMechanics& on = *system.part<LieGroup>().mechanics;
    const auto integrator = makeIntegrator(system, discretization, {0, duration / static_cast<double>(n)});
    const auto end = after(*integrator, start, n);
    if (!end) return {};
    const auto entries = static_cast<std::size_t>(on.group->entries()),
               d = static_cast<std::size_t>(on.dimension());
    return {distance(end->x, reference, 0, entries), distance(end->x, reference, entries, entries + d)};
}

}  // namespace extremal::laws
