// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/galerkin/phase.hpp"

#include <utility>

#include "engine/family/galerkin/split.hpp"
#include "engine/family/table_of.hpp"
#include "engine/integrator/condensed.hpp"
#include "engine/model/first_order/poisson.hpp"
#include "engine/model/spins/spins.hpp"
#include "engine/phase/field_step.hpp"
#include "engine/phase/flow_step.hpp"
#include "engine/phase/one_form_step.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/space/typed.hpp"

namespace extremal::galerkin {

bool isPhase(const System& system) { return system.parts.find<PhaseMechanics>() || isFirstOrder(system); }

std::string phaseProblem(const Discretization& d, const System& system) {
    if (!isPhase(system)) return {};
    if (isTermRule(d.quadrature) || isSplit(d))
        return "one space and one rule are needed in phase space: rules for terms and spaces for "
               "coordinates are for a Lagrangian";
    const bool isGauss =
        d.quadrature.type == "gauss" && d.quadrature.integer("nodes") == d.space.integer("degree");
    const bool isMidpoint = d.quadrature.type == "midpoint" && d.space.integer("degree") == 1;
    if (system.parts.find<Spins>() && (d.space.type != "polynomial" || !(isGauss || isMidpoint)))
        return "q and p of spins must be treated alike, or they do not stay of length 1: degree s with "
               "Gauss(s) "
               "does";
    if (dependsOnStep(d.space)) return "functions that change with the step are for a Lagrangian";
    return {};
}

Properties describePhase(const Discretization& d, const System& system,
                         Properties (*describe)(const Discretization&)) {
    Properties p = describe(d);
    // Kicks and drifts in turn are explicit for kinetic and potential energies alone.
    const auto* const mechanics = system.parts.find<PhaseMechanics>();
    p.isExplicit = p.isExplicit && mechanics && mechanics->isSeparable();
    spins::claimLengths(system, p.claims);
    if (isFirstOrder(system)) {
        const OneForm* const form = system.parts.find<OneForm>();
        p.claims.conserves.clear();
        p.claims.isSymplectic = form && form->hasPlane();
    }
    return p;
}

std::unique_ptr<Integrator> phaseStep(const System& system, const Discretization& d, double step) {
    const SharedCell cell = cellOf(d.space, d.quadrature);
    const SolverPolicy policy = solverPolicy(d.solver, system);
    if (const OneForm* const form = system.parts.find<OneForm>(); form && form->hasPlane())
        return makeOneFormStep(*form, cell, step, policy);
    if (isFirstOrder(system)) return makeFieldStep(firstOrderOf(system), cell, step, policy);
    return makeFlowStep(system.part<PhaseMechanics>(), cell, step, policy);
}

WrittenAction writtenPhase(const System& system) {
    WrittenAction w;
    w.meaning =
        "φ_1, …, φ_m are the functions of the space with φ_a(0) = 0: all but the last vanish at 1 as well, "
        "and "
        "φ_m(1) = 1. α_1, …, α_m and β_1, …, β_m are the unknowns of a step, the rule has the weights b_i "
        "and "
        "the nodes c_i. q is continuous; p jumps at the ends of the step, where p_0 and p_1 are the "
        "multipliers.";
    w.action = {
        {"S(q_0, q_1) = h Σ_i b_i [P_i·V_i − H(t_0 + c_i h, Q_i, P_i)], stationary over α and β",
         "S(q_0, q_1) = \\operatorname*{ext}_{\\alpha, \\beta}\\; h \\sum_i b_i \\bigl[ P_i \\cdot V_i - "
         "H(t_0 + c_i h, Q_i, P_i) \\bigr]"},
        {"Q_i = q_0 + Σ_a φ_a(c_i) α_a,  h V_i = Σ_a φ_a′(c_i) α_a,  P_i = Σ_a φ_a′(c_i) β_a,  q_1 = q_0 + "
         "α_m",
         "Q_i = q_0 + \\sum_a \\varphi_a(c_i)\\, \\alpha_a, \\qquad h V_i = \\sum_a \\varphi_a'(c_i)\\, "
         "\\alpha_a, \\qquad P_i = \\sum_a \\varphi_a'(c_i)\\, \\beta_a, \\qquad q_1 = q_0 + \\alpha_m"}};
    w.stationarity = {
        {"Σ_i b_i φ_a′(c_i) (V_i − ∂H/∂p(i)) = 0,  a = 1, …, m",
         "\\sum_i b_i\\, \\varphi_a'(c_i) \\Bigl( V_i - \\frac{\\partial H}{\\partial p}\\Big|_i \\Bigr) = "
         "0, "
         "\\qquad a = 1, \\dots, m"},
        {"Σ_i b_i (φ_a′(c_i) P_i − h φ_a(c_i) ∂H/∂q(i)) = φ_a(1) p_1,  p_1 = p_0 − h Σ_i b_i ∂H/∂q(i)",
         "\\sum_i b_i \\Bigl( \\varphi_a'(c_i) P_i - h\\, \\varphi_a(c_i) \\frac{\\partial H}{\\partial "
         "q}\\Big|_i \\Bigr) = \\varphi_a(1)\\, p_1, \\qquad p_1 = p_0 - h \\sum_i b_i \\frac{\\partial "
         "H}{\\partial q}\\Big|_i"}};
    if (const OneForm* const form = system.parts.find<OneForm>(); form && form->hasPlane())
        w.meaning +=
            std::string(form->gauged
                            ? " With a differential taken off the form half of the variables, y, has "
                              "no velocity."
                            : "") +
            " P_i = P(Q_i, Y_i), and Y_i, which has no velocity, is free at each node; H(q, p) is that of "
            "(q, Y(q, p)).";
    else if (form)
        w.meaning += " The equations Om(x) x' = grad H are those of H(x, p) = p·f(x) with p = 0.";
    else if (system.parts.find<PoissonStructure>())
        w.meaning += " The equations x' = J(x) grad H are those of H(x, p) = p·f(x) with p = 0.";
    return w;
}

void checkPhase(const SchemeCase& scheme, Findings& findings) {
    const auto& [space, rule, solver, impact] = scheme.discretization;
    if (const OneForm* const form = scheme.system.parts.find<OneForm>(); form && !form->hasPlane())
        findings.warning(
            "/space",
            "is not symplectic here: no half of the variables is free of the form, nor in another "
            "gauge that is found, so that it is collocation on the equations of motion, of the "
            "same order",
            "the form as P(q, y) dq, with as many y as q; symplecticity shows the defect");
    if (const auto* const bracket = scheme.system.parts.find<PoissonStructure>();
        bracket && !bracket->isConstant)
        findings.warning(
            "/space",
            "does not keep the bracket here: it is collocation on the equations of motion, which "
            "keeps linear and quadratic invariants, and the bracket only where it is constant",
            "variables in which the bracket is constant; poisson-defect shows what is lost");
    const int degree = space.integer("degree");
    if (space.type != "polynomial" || degree < 2 || rule.type != "lobatto" || rule.integer("panels") > 1 ||
        rule.integer("nodes") != degree)
        return;
    findings.warning("/quadrature",
                     std::to_string(degree) + " Lobatto nodes make of degree " + std::to_string(degree) +
                         " the same steps as of degree " + std::to_string(degree - 1) + ": order " +
                         std::to_string(2 * degree - 2),
                     "degree " + std::to_string(degree - 1) + ", or " + std::to_string(degree + 1) +
                         " nodes for order " + std::to_string(2 * degree));
}

}  // namespace extremal::galerkin
