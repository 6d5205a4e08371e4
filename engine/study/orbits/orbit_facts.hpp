// SPDX-License-Identifier: GPL-3.0-or-later
/// What is known of a periodic orbit, and of a family of them, as plain numbers.
#pragma once

#include <complex>
#include <string>
#include <string_view>
#include <vector>

namespace extremal {

enum class OrbitKind {
    conservative,  ///< no explicit time, an energy that is kept: two multipliers are 1
    dissipative,   ///< no explicit time, no energy that is kept: a limit cycle; one multiplier is 1
    forced         ///< explicit time, whose period is the orbit's
};

/// What picks one orbit of a family. nothing: it is isolated.
enum class OrbitHold { nothing, energy, period };

/// How the motions next to an orbit behave, by its multipliers without those that are 1 by themselves.
enum class OrbitStability { elliptic, attracting, unstable };

constexpr std::string_view name(OrbitStability stability) {
    return stability == OrbitStability::elliptic     ? "elliptic"
           : stability == OrbitStability::attracting ? "attracting"
                                                     : "unstable";
}

struct PeriodicOrbit {
    std::vector<double> x;  ///< its start
    double period = 0;
    double energy = 0;                              ///< of the start; NaN where there is none
    double gap = 0;                                 ///< largest |Phi(x) - x - w| over the size of the entry
    std::vector<double> closes;                     ///< the same of every iterate, the guess first
    std::vector<std::complex<double>> multipliers;  ///< the largest first
    double trace = 0;                               ///< their sum
};

struct OrbitRow {
    double value = 0;  ///< of the number along which the family goes
    PeriodicOrbit orbit;
    OrbitStability stability = OrbitStability::elliptic;
    /// What happened since the row before: "turns", "period doubling", "multiplier at 1", "pair leaves the
    /// circle"; empty: nothing.
    std::string mark;
};

struct OrbitFamily {
    std::vector<OrbitRow> rows;  ///< the first orbit is the first
    std::string end;             ///< why it does not reach the value; empty: it does
    bool isStopped = false;
};

}  // namespace extremal
