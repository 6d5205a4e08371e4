// SPDX-License-Identifier: GPL-3.0-or-later
/// Degree s with Gauss(s) whose end times are unknowns: Gauss collocation with steps that keep the discrete
/// energy.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry sem() {
    SchemeEntry e;
    e.item = {"sem-<s>",
              "symplectic-energy-momentum",
              "Degree s with Gauss(s) and moving times: order 2s, keeps the discrete energy where it can.",
              {},
              {},
              "a Lagrangian without explicit time"};
    e.source = "Leok 2004, sec. 5";
    e.minDegree = 1;
    e.maxDegree = 4;
    e.make = [](int degree) {
        const auto s = static_cast<double>(degree);
        Discretization d;
        d.space = {
            "moving-time", {{"degree", s}, {"policy", "reset"}, {"window", Value::Array{0.5, 2.0}}}, {}};
        d.quadrature = {"gauss", {{"nodes", s}}, {}};
        return d;
    };
    return e;
}

}  // namespace extremal::schemes
