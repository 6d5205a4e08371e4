// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/galerkin/mechanism.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/galerkin/split.hpp"
#include "engine/family/galerkin/tables.hpp"
#include "engine/family/rule_choices.hpp"
#include "engine/family/table_of.hpp"
#include "engine/integrator/condensed.hpp"
#include "engine/mechanism/impact/impact_step.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/mechanism_curve.hpp"
#include "engine/mechanism/mechanism_step.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/space/typed.hpp"

namespace extremal::galerkin {
namespace {

constexpr std::array<std::string_view, 4> ownRules = {otherTerms, "constraints", "forces", "rolling"};

/// With the rule of the Lagrangian alone.
Discretization ofLagrangian(const Discretization& d) {
    if (!isTermRule(d.quadrature)) return d;
    Discretization plain = d;
    plain.quadrature = termPart(d.quadrature, otherTerms);
    if (plain.quadrature.type.empty()) plain.quadrature = completedRule(d.space, {});
    return plain;
}

/// The rule of the forces; nothing where it is that of the Lagrangian.
std::optional<Settings> ruleOfForces(const Discretization& d) {
    Settings own = termPart(d.quadrature, "forces");
    return own.type.empty() ? std::nullopt : std::optional(std::move(own));
}

bool isRollingAtGauss(const Discretization& d) { return termPart(d.quadrature, "rolling").type == "gauss"; }

/// What is wrong with rules that are hardly a choice.
std::string fixedRuleProblem(const Discretization& d, const System& system) {
    for (const char* key : {"constraints", "rolling"}) {
        const Settings rule = termPart(d.quadrature, key);
        if (rule.type.empty()) continue;
        const bool isRolling = std::string(key) == "rolling", isGauss = rule.type == "gauss";
        const std::string what = isRolling ? "rolling conditions" : "constraints";
        if (isGauss && !isRolling)
            return what +
                   " by gauss: the ends of a step leave them, and the order of p drops; lobatto keeps it";
        if (isGauss && system.parts.find<Constraint>())
            return "rolling conditions by gauss leave p where it is at the end of a step, and the "
                   "constraints "
                   "would move it; lobatto takes both";
        if (!isGauss && rule.type != "lobatto") return what + " lose order but at the nodes of lobatto";
        const int degree = d.space.integer("degree"), needed = isGauss ? degree : degree + 1;
        if (degree > 0 && rule.integer("nodes") > 0 && rule.integer("nodes") != needed)
            return what + " take " + std::to_string(needed) + (isGauss ? " Gauss" : " Lobatto") +
                   " nodes with degree " + std::to_string(degree) + ": with more, or fewer, the order drops";
    }
    return {};
}

bool isRadau(const Settings& rule, std::string_view end) {
    return rule.type == "radau" && rule.text("end") == end;
}

}  // namespace

std::optional<Properties> impactProblem(const Discretization& d, const System& system) {
    if (d.impact == ImpactLaw::energy) return {};
    const Wall* const wall = system.parts.find<Wall>();
    const Constraint* const constraint = system.parts.find<Constraint>();
    Properties refused;
    refused.place = "/impact";
    refused.hint = "\"impact\": \"energy\", or leave it out";
    if (!wall)
        refused.refusal = "is about walls, and the model has none of them";
    else if (!wall->isElastic())
        refused.refusal = "cannot be variational where restitutions are below 1: energy is lost there";
    else if (system.parts.find<Force>() || system.parts.find<Rolling>())
        refused.refusal =
            "cannot be variational with forces or rolling: they are not in the action, whose "
            "derivative by the time of the contact is 0";
    else if (system.mechanics().isTimeDependent || wall->isTimeDependent ||
             (constraint && constraint->isTimeDependent))
        refused.refusal =
            "cannot be variational where the model depends on time: the discrete energies "
            "differ then by what it does in the step";
    else
        return {};
    return refused;
}

std::string mechanismProblem(const Discretization& d, const System& system) {
    if (!Mechanism::isOne(system.parts)) return {};
    const std::string what = untaken(Takes::only<Mechanical>(), system.parts);
    const bool hasOther =
        isTermRule(d.quadrature) &&
        std::any_of(d.quadrature.keys.begin(), d.quadrature.keys.end(), [](const auto& key) {
            return std::find(ownRules.begin(), ownRules.end(), key.first) == ownRules.end();
        });
    const Discretization plain = ofLagrangian(d);
    if (hasOther || isSplit(plain))
        return "one space and one rule are needed for " + what +
               ": rules for terms and spaces for coordinates are for a Lagrangian alone";
    if (std::string problem = fixedRuleProblem(d, system); !problem.empty()) return problem;
    const bool isConstrained = system.parts.find<Constraint>() || system.parts.find<Rolling>();
    if (cellsIn(d.space) > 1 && isConstrained)
        return "splines with cells lose order under a constraint, which holds at the Lobatto nodes of the "
               "whole "
               "step: polynomials keep it";
    if (dependsOnStep(d.space))
        return "functions that change with the step are for a Lagrangian alone, without " + what;
    return {};
}

Properties describeMechanism(const Discretization& d, const System& system,
                             Properties (*describe)(const Discretization&)) {
    Properties p = describe(ofLagrangian(d));
    std::erase(p.claims.conserves, "quadratic invariants");
    // They act in the variation, not in the action: momenta and symmetry stay, the symplectic form does not.
    if (system.parts.find<Force>() || system.parts.find<Rolling>()) p.claims.isSymplectic = false;
    if (const Wall* const wall = system.parts.find<Wall>()) {
        p.claims.isSymplectic = p.claims.isSymplectic && d.impact == ImpactLaw::variational;
        p.claims.isSymmetric = p.claims.isSymmetric && wall->isElastic();
    }
    if (isRollingAtGauss(d) && system.parts.find<Rolling>()) {
        // p is that of q, and v of the curve meets the conditions to this order only at the ends of a step.
        const int m = p.claims.order / 2;
        p.claims.order = m % 2 == 0 ? m : m + 1;
        p.remark = "rolling conditions at Gauss nodes: the energy is kept, the order of q is " +
                   std::to_string(2 * m) + ", that of p " + std::to_string(p.claims.order);
    }
    if (const auto forces = ruleOfForces(d); forces && system.parts.find<Force>()) {
        p.claims.order = std::min(p.claims.order, makeRule<double>(*forces).degree + 1);
        if (forces->type == "radau") p.claims.isSymmetric = false;
    }
    return p;
}

std::unique_ptr<Integrator> mechanismStep(const System& system, const Discretization& d, double step) {
    const Discretization plain = ofLagrangian(d);
    const Table<double> table = tableOf(plain.space, plain.quadrature);
    MechanismRules rules;
    if (const auto rule = ruleOfForces(d)) rules.forces = makeRule<double>(*rule);
    rules.isRollingAtGauss = isRollingAtGauss(d) && system.parts.find<Rolling>();
    const auto make = [table, rules, step, policy = solverPolicy(d.solver, system)](const Parts& parts) {
        return makeMechanismStep(parts, table, rules, step, policy);
    };
    if (!system.parts.find<Wall>()) return make(system.parts);
    return makeImpactStep(system.parts, make, MechanismCurve::partsPerFunction * table.unknowns(), d.impact);
}

void checkMechanism(const SchemeCase& scheme, Findings& findings) {
    constexpr double stiff = 10;
    if (scheme.isComposed && scheme.system.parts.find<Wall>())
        findings.error("/composition", "loses its order at impacts, where the error of its steps jumps",
                       "the scheme alone, or a higher degree");
    const Force* const force = scheme.system.parts.find<Force>();
    if (!force) return;
    const auto own = ruleOfForces(scheme.discretization);
    const Settings rule = own ? *own : ofLagrangian(scheme.discretization).quadrature;
    if (isRadau(rule, "left")) return;
    const Mechanics<double>& L = scheme.system.mechanics();
    const int d = L.dimension;
    const double* const q = scheme.initial.x.data();
    Eigen::VectorXd v = Eigen::VectorXd::Zero(d), F(d), gradient(2 * d);
    Mechanism::Rows byState(d, 2 * d), hessian(2 * d, 2 * d);
    double value = 0;
    if (!L.velocity(L.model.get(), scheme.initial.t, q, q + d, v.data())) return;
    L.jet(L.model.get(), scheme.initial.t, q, v.data(), &value, gradient.data(), hessian.data());
    // At rest as well: friction that is smoothed is stiff where a velocity changes its sign.
    double z = 0;
    for (const Eigen::VectorXd& at : {v, Eigen::VectorXd(Eigen::VectorXd::Zero(d))}) {
        force->first(force->model.get(), scheme.initial.t, q, at.data(), F.data(), byState.data());
        const Eigen::MatrixXd rates = dense::solve<double>(Eigen::MatrixXd(hessian.bottomRightCorner(d, d)),
                                                           Eigen::MatrixXd(byState.rightCols(d)));
        if (rates.allFinite()) z = std::max(z, std::abs(scheme.step) * rates.norm());
    }
    if (!(z > stiff)) return;
    const std::string size =
        "damping is stiff for the step: c h / m = " + formatNumber(z, 2) + " at the places of the start, ";
    const int nodes = std::max(1, scheme.discretization.space.integer("degree"));
    findings.warning("/quadrature",
                     size + (isRadau(rule, "right") ? "and forces by right Radau amplify it"
                                                    : "and the velocity rings instead of dying out"),
                     "\"forces\": {\"type\": \"radau\", \"nodes\": " + std::to_string(nodes) +
                         ", \"end\": \"left\"} damps it",
                     {}, "stiff-damping");
}

}  // namespace extremal::galerkin
