// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/galerkin/kept.hpp"

#include <limits>
#include <string>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/family/rule_choices.hpp"
#include "engine/family/table_of.hpp"
#include "engine/integrator/condensed.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/phase/kept_step.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal::galerkin {
namespace {

/// The rule of the scheme where it has more nodes than the degree. With as many there are no more conditions
/// than Gauss collocation has, which keeps no energy: then so many that it is kept to round-off.
Rule<double> keptRule(const Discretization& d) {
    constexpr int more = 6;
    const int degree = d.space.integer("degree");
    Rule<double> rule = makeRule<double>(d.quadrature);
    return rule.size() > degree ? rule : gauss<double>(degree + more);
}

Properties describeKept(const Discretization& d, const std::vector<KeptQuantity>& kept) {
    Properties p;
    p.stabilityLimit = std::numeric_limits<double>::infinity();
    const int s = d.space.integer("degree");
    if (d.space.type != "polynomial") {
        p.refusal = "invariants are kept by polynomials of one degree for all coordinates, not by \"" +
                    d.space.type + "\"";
        p.hint = "the space polynomial, or no \"keep\"";
        return p;
    }
    if (!isPlainRule(d.quadrature)) {
        p.refusal = "invariants are kept by one rule for the whole of the motion";
        p.hint = "gauss, or no \"keep\"";
        return p;
    }
    p.claims.order = 2 * s;
    p.claims.isSymmetric = keptRule(d).isSymmetric;
    for (const KeptQuantity& each : kept) p.claims.conserves.push_back(each.text);
    p.curveOrder = s + 1;
    p.space = "polynomials of degree " + std::to_string(s) + " for x = (q, p), tested by those of degree " +
              std::to_string(s - 1);
    if (s == 1 && isEnergyAlone(kept)) p.knownAs = "average vector field";
    p.shortName = "E" + std::to_string(2 * s);
    return p;
}

WrittenAction writtenKept(const Discretization& d, const std::vector<KeptQuantity>& kept) {
    const int s = d.space.integer("degree"), nodes = keptRule(d).size();
    WrittenAction w;
    w.meaning = "No action is stationary here. The curve x = (q, p) has degree s = " + std::to_string(s) +
                ", its test functions degree s - 1, and Pi is the projection to these with " +
                std::to_string(nodes) + " nodes. Lost is the symplectic form, to C h^" +
                std::to_string(2 * s + 1) +
                " in each step, and with it momenta and quadratic invariants that are not asked for.";
    w.action = {{"x' = Π J ∇H(x),    x(0) = x₀", "x' = \\Pi\\, J\\, \\nabla H(x), \\qquad x(0) = x_0"}};
    w.stationarity = {
        {"∫ ∇H · x' dt = ∫ (Π ∇H) · J (Π ∇H) dt = 0",
         "\\int \\nabla H \\cdot x'\\, dt = \\int (\\Pi \\nabla H) \\cdot J (\\Pi \\nabla H)\\, "
         "dt = 0"}};
    if (isEnergyAlone(kept)) return w;
    w.action = {
        {"x' = Π [ f − G (GᵀG)⁻¹ Gᵀ f ],    f = J ∇H,  G = (Π ∇I₁, Π ∇I₂, …)",
         "x' = \\Pi \\bigl[ f - G (G^T G)^{-1} G^T f \\bigr], \\qquad f = J \\nabla H, \\quad G = (\\Pi "
         "\\nabla I_1, \\Pi \\nabla I_2, \\dots)"}};
    w.stationarity = {{"∫ ∇I_a · x' dt = ∫ (Π ∇I_a) · x' dt = 0",
                       "\\int \\nabla I_a \\cdot x'\\, dt = \\int (\\Pi \\nabla I_a) \\cdot x'\\, dt = 0"}};
    return w;
}

std::unique_ptr<Integrator> makeKept(const System& system, const Discretization& d, double step,
                                     std::vector<Invariant> invariants) {
    return makeKeptStep(flowOf(system), std::move(invariants), d.space.integer("degree"), keptRule(d), step,
                        solverPolicy(d.solver, system));
}

}  // namespace

TestSpace keptTest() { return {describeKept, writtenKept, makeKept}; }

}  // namespace extremal::galerkin
