// SPDX-License-Identifier: GPL-3.0-or-later
/// Generalized Galerkin variational integrators of systems with coordinates: a space that is a table and a
/// plain rule (Leok 2004, sec. 2).
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "engine/action/table.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/family.hpp"
#include "engine/family/frequency.hpp"
#include "engine/family/galerkin/fitted_order.hpp"
#include "engine/family/galerkin/kept.hpp"
#include "engine/family/galerkin/mechanism.hpp"
#include "engine/family/galerkin/phase.hpp"
#include "engine/family/galerkin/split.hpp"
#include "engine/family/galerkin/tables.hpp"
#include "engine/family/galerkin/written.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/parts/described_on_system.hpp"
#include "engine/family/parts/references.hpp"
#include "engine/family/parts/solver_methods.hpp"
#include "engine/family/parts/step_tableau.hpp"
#include "engine/family/parts/tables.hpp"
#include "engine/family/parts/written_on_system.hpp"
#include "engine/family/rule_choices.hpp"
#include "engine/family/scheme.hpp"
#include "engine/family/stability_check.hpp"
#include "engine/family/table_of.hpp"
#include "engine/family/table_properties.hpp"
#include "engine/integrator/condensed.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/model/spins/spins.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/space/typed.hpp"

namespace extremal::family {
namespace {

std::string ordinal(const char* prefix, int order) { return prefix + std::to_string(order); }

/// Name by which the field knows the discretization; degree s, rule with n nodes.
void nameOf(const Settings& space, const Settings& rule, int n, Properties& p) {
    const int s = space.integer("degree");
    if (space.type != "polynomial") {
        p.shortName = ordinal(space.type == "spline" ? "S" : "VI", p.claims.order);
        return;
    }
    if (rule.integer("panels") > 1) {
        p.shortName = ordinal("VI", p.claims.order);
        return;
    }
    const bool isTrapezoid = (rule.type == "trapezoid" && n == 2) || (rule.type == "lobatto" && n == 2) ||
                             (rule.type == "clenshaw-curtis" && n == 2);
    const bool isMidpoint = n == 1 && rule.type != "radau";
    p.isExplicit = s == 1 && (isTrapezoid || (rule.type == "radau" && n == 1));
    if (s == 1 && isMidpoint) {
        p.knownAs = "implicit midpoint";
        p.shortName = "mid";
    } else if (s == 1 && isTrapezoid) {
        p.knownAs = "Störmer-Verlet";
        p.shortName = "SV";
    } else if (s == 1 && rule.type == "radau" && n == 1) {
        p.knownAs = "symplectic Euler";
        p.shortName = "SE";
    } else if (rule.type == "gauss" && n == s) {
        p.knownAs = "Gauss collocation";
        p.shortName = ordinal("G", p.claims.order);
    } else if (rule.type == "lobatto" && n == s + 1) {
        p.knownAs = "Lobatto IIIA-IIIB";
        p.shortName = ordinal("L", p.claims.order);
    } else if (rule.type == "clenshaw-curtis") {
        p.knownAs = "spectral variational";
        p.shortName = ordinal("CC", p.claims.order);
    } else {
        p.shortName = ordinal(rule.type == "radau" ? "R" : "VI", p.claims.order);
    }
}

std::string spaceText(const Settings& space) {
    if (const Value* functions = space.find("functions"); functions && functions->isArray())
        return std::to_string(functions->asArray().size()) + " typed functions";
    const std::string degree = std::to_string(space.integer("degree"));
    if (space.find("cells"))
        return "splines of degree " + degree + " with " + std::to_string(galerkin::cellsIn(space)) + " cells";
    return space.find("degree") ? "polynomials of degree " + degree : space.type;
}

/// A space whose functions change with the step: what holds at small steps.
Properties describeFitted(const Settings& space, const Settings& quadrature) {
    Properties p;
    p.claims.isSymplectic = true;
    p.claims.conserves = {"momentum"};
    p.stabilityLimit = std::numeric_limits<double>::infinity();  // no one number: checked at the step
    try {
        const galerkin::FittedOrder found = galerkin::fittedOrder(space, quadrature);
        p.claims.order = found.bounds.order();
        p.claims.isSymmetric = found.isSymmetric;
        p.curveOrder = std::min(p.claims.order, found.bounds.ofSpace / 2 + 1);
        p.shortfall = found.bounds.shortfall();
        p.caution = cautionOf(tableOf(withStep(space, found.step), quadrature));
        if (p.claims.order < 1) {
            p.refusal =
                "it would have order 0: curves of constant speed are not in the space, nor approached by "
                "it at short steps";
            p.hint = "add \"tau\"";
        }
    } catch (const InvalidScene& e) {
        refuse(e, p);
    }
    return p;
}

Properties describeGalerkin(const Discretization& discretization) {
    if (galerkin::isSplit(discretization)) return galerkin::describeSplit(discretization);
    const auto& [space, quadrature, solver, impact] = discretization;
    Properties p;
    const bool isTyped = space.find("functions") != nullptr;
    if (!isPlainRule(quadrature) && !(isTyped && quadrature.type == "auto")) {
        refuseRule(quadrature, p);
    } else if (isTyped && dependsOnStep(space)) {
        p = describeFitted(space, quadrature);
    } else {
        p = describeTable([&d = discretization] { return tableOf(d.space, d.quadrature); },
                          [&] { return firstEdge(tableStability(discretization)->intervals); });
        if (isTyped && p.refusal.empty() && p.claims.order < 1) {
            p.refusal = "it would have order 0: curves of constant speed are not in the space";
            p.hint = "add \"tau\"";
        }
    }
    if (isTyped) {
        p.shortName = ordinal("VI", p.claims.order);
    } else if (isPlainRule(quadrature) && p.place.empty()) {
        nameOf(space, quadrature, makeRule<double>(quadrature).size(), p);
        if (p.knownAs == "Gauss collocation" || p.knownAs == "implicit midpoint")
            p.claims.conserves.push_back("quadratic invariants");
    }
    p.space = spaceText(space);
    return p;
}

std::shared_ptr<const Tableau> tableauAt(const Discretization& d, double step) {
    if (galerkin::isSplit(d))
        throw InvalidScene(
            "", "has a rule for each term or a space for each coordinate, which no one tableau has",
            "one space and one rule");
    return galerkin::tableauOf(withStep(d.space, step), d.quadrature);
}

/// At the step itself: functions that depend on it, and their stability.
void checkGalerkin(const SchemeCase& scheme, Findings& findings) {
    if (Mechanism::isOne(scheme.system.parts)) return galerkin::checkMechanism(scheme, findings);
    if (galerkin::isPhase(scheme.system)) return galerkin::checkPhase(scheme, findings);
    if (galerkin::isSplit(scheme.discretization)) return galerkin::checkSplit(scheme, findings);
    const auto& [space, quadrature, solver, impact] = scheme.discretization;
    if (!dependsOnStep(space)) return;
    const Table<double> table = tableOf(withStep(space, scheme.step), quadrature);
    const LinearStabilityFacts stability = factsOf(OscillatorStep(oscillatorAction(table)));
    const auto steps = std::abs(scheme.end - scheme.initial.t) / scheme.step;
    for (const double w : linearFrequencies(scheme.system, scheme.initial)) {
        const double growth = stability.growth(w * scheme.step);
        if (!(growth * steps > 1)) continue;
        const std::string size = std::isfinite(growth)
                                     ? "each step magnifies it by e^" + formatNumber(growth, 2) +
                                           ", this run by e^" + formatNumber(growth * steps, 2)
                                     : "it grows without bound";
        findings.warning("/step",
                         "makes the space and the rule unstable at the frequency " + formatNumber(w, 6) +
                             " of the motion near the start: " + size,
                         "another step", {}, "stability-limit");
        return;
    }
}

ReferencePlan trusted(const System& system, const State&, double) {
    if (Mechanism::isOne(system.parts))
        return referenceBy("Galerkin of degree 6 with 6 Gauss nodes", system,
                           *namedScheme("galerkin-gauss-6"));
    return referenceBy("Gauss collocation of degree 12", system, *namedScheme("gauss-collocation-12"));
}

ChoiceGrid choices(const System&) {
    std::vector<SpaceRow> rows;
    for (const int degree : {1, 2, 3, 4, 6, 8})
        rows.push_back({"poly " + std::to_string(degree),
                        "",
                        {"polynomial", {{"degree", static_cast<double>(degree)}, {"basis", "lobatto"}}, {}}});
    for (const int degree : {2, 3})
        rows.push_back({"spline " + std::to_string(degree),
                        "spline",
                        {"spline", {{"degree", static_cast<double>(degree)}, {"cells", 2.0}}, {}}});
    // Functions to begin with: a click adds them, and their formulas are then changed in the form of the
    // scheme.
    rows.push_back({"own",
                    "own",
                    {"typed",
                     {{"functions", Value::Array{"1", "tau", "tau^2", "tau^3"}},
                      {"let", Value::Object{}},
                      {"knots", Value::Array{}}},
                     {}}});
    return ruleChoices(rows);
}

}  // namespace

Family galerkin() {
    Family f;
    f.item = {"galerkin", "Galerkin", "Space x quadrature as one table.", {}, {}, "coordinates"};
    f.source = "Leok 2004, sec. 2";
    f.spaces = tableSpaces();
    f.completeRule = galerkin::completedRule;
    f.describe = describeGalerkin;
    f.check = checkGalerkin;
    f.choices = choices;
    f.rules = [](const Settings& space) {
        std::vector<std::string> rules = plainRules();
        if (space.find("functions")) rules.insert(rules.begin(), "auto");
        return rules;
    };
    f.written = galerkin::written;
    f.takes = mechanisms().with<PhaseMechanics, OneForm, PoissonStructure, Spins>();
    f.parts.set(SchemeCondition{[](const Discretization& d, const System& system) {
        if (const auto refused = galerkin::impactProblem(d, system)) return refused->refusal;
        const std::string problem = galerkin::phaseProblem(d, system);
        return problem.empty() ? galerkin::mechanismProblem(d, system) : problem;
    }});
    f.make = [](const System& system, const Discretization& d, double step) {
        if (Mechanism::isOne(system.parts)) return galerkin::mechanismStep(system, d, step);
        if (galerkin::isPhase(system)) return galerkin::phaseStep(system, d, step);
        if (galerkin::isSplit(d)) {
            const galerkin::Split split = galerkin::splitOf(system, d);
            std::vector<LagrangianTerm<double>> parts =
                split.parts.size() > 1 ? split.parts : decltype(split.parts){};
            return makeCondensed(
                system.mechanics(), [split](double h) { return galerkin::tablesOf(split, h); }, step,
                solverPolicy(d.solver, system), std::move(parts));
        }
        const auto tables = [space = d.space, quadrature = d.quadrature](double h) {
            return std::vector{tableOf(withStep(space, h), quadrature)};
        };
        return makeCondensed(system.mechanics(), tables, step, solverPolicy(d.solver, system), {},
                             system.parts.find<LagrangianEntries>());
    };
    f.parts.set(galerkin::keptTest());
    f.parts.set(SolverMethods{{"newton", "fixed-point"}});
    f.parts.set(TrustedScheme{trusted});
    f.parts.set(
        DescribedOnSystem{[](const Discretization& d, const System& system) -> std::optional<Properties> {
            if (auto refused = galerkin::impactProblem(d, system)) return refused;
            if (Mechanism::isOne(system.parts)) {
                const std::string problem = galerkin::mechanismProblem(d, system);
                if (problem.empty()) return galerkin::describeMechanism(d, system, describeGalerkin);
                if (!galerkin::isSplit(d)) return {};
                Properties refused;
                refused.refusal = problem;
                refused.place = "/quadrature";
                refused.hint = "leave the rule out: the one that keeps the order is taken";
                return refused;
            }
            if (galerkin::isPhase(system)) {
                const std::string problem = galerkin::phaseProblem(d, system);
                if (problem.empty()) return galerkin::describePhase(d, system, describeGalerkin);
                Properties refused = describeGalerkin(d);
                refused.refusal = problem;
                return refused;
            }
            if (!galerkin::isSplit(d)) return {};
            return galerkin::describeSplit(d, system);
        }});
    f.parts.set(
        WrittenOnSystem{[](const Discretization&, const System& system) -> std::optional<WrittenAction> {
            if (!galerkin::isPhase(system)) return {};
            return galerkin::writtenPhase(system);
        }});
    f.parts.set(
        Tables{[](const Discretization& d) { return !galerkin::isSplit(d) && !dependsOnStep(d.space); },
               galerkin::makeTable, galerkin::oscillatorOf});
    f.parts.set(StepTableau{tableauAt});
    return f;
}

}  // namespace extremal::family
