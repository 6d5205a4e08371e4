// SPDX-License-Identifier: GPL-3.0-or-later
/// Spaces that contain a fast oscillation, or know it in closed form: steps of many of its periods (Leok
/// 2004, sec. 7).
#include <algorithm>
#include <numbers>
#include <string>
#include <utility>

#include "engine/core/text/text.hpp"
#include "engine/family/family.hpp"
#include "engine/family/multiscale/basis.hpp"
#include "engine/family/multiscale/fewer_harmonics.hpp"
#include "engine/family/multiscale/oscillatory.hpp"
#include "engine/family/multiscale/product.hpp"
#include "engine/family/multiscale/resonance.hpp"
#include "engine/family/multiscale/slow.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/parts/model_in_place.hpp"
#include "engine/family/parts/references.hpp"
#include "engine/family/parts/scheme_identity.hpp"
#include "engine/family/parts/solver_methods.hpp"
#include "engine/family/parts/starts.hpp"
#include "engine/family/parts/variant.hpp"
#include "engine/family/rule_choices.hpp"
#include "engine/family/scheme.hpp"
#include "engine/integrator/condensed.hpp"
#include "engine/quadrature/catalog.hpp"

namespace extremal::family {
namespace {

FieldInfo json(const char* key, const char* title, const char* symbol, Value fallback,
               const char* description) {
    FieldInfo f = jsonField(key, title, symbol, std::move(fallback), description);
    f.isOptional = f.fallback.isNull();
    return f;
}

FieldInfo slowDegree() {
    FieldInfo f =
        integerField("degree", "n", 1, OscillatoryBasis::mostDegree, 4.0, "Degree of the slow part.");
    f.whyLimits =
        "a slow part of degree 0 stands still; above 24 more steps are cheaper than a higher degree";
    return f;
}

/// A slow polynomial and harmonics of a fast frequency with polynomial amplitudes; each coordinate its own.
SpaceEntry oscillatory() {
    FieldInfo omega =
        json("omega", "frequency", "ω", "model",
             "Frequency of the fast motion: a number or expression, two of them in an array, \"model\" (what "
             "the model says), or \"estimate\" (from a short resolved run).");
    omega.choices = {"model", "estimate"};
    SpaceEntry e;
    e.item = {
        "oscillatory",
        "oscillatory",
        "A slow polynomial and harmonics of a fast frequency with polynomial amplitudes: steps of many "
        "fast periods.",
        {omega, slowDegree(),
         json("harmonics", "harmonics", "m", Value::Array{1.0},
              "Degree of the amplitudes of the first harmonic, of the second, ... of each frequency; with "
              "two frequencies { of, degree } is a combination, such as [1, -1]."),
         json("fast", "fast coordinates", "", {},
              "degree and harmonics of the coordinates the model calls fast."),
         json("variables", "variables", "", {}, "degree and harmonics of single coordinates, by name.")},
        {},
        ""};
    return e;
}

/// The printed space: a slow polynomial times one oscillation. For teaching: it fails.
SpaceEntry productForm() {
    FieldInfo omega =
        jsonField("omega", "frequency", "ω", "model",
                  "Frequency of the fast motion, or where it starts from: a number or expression, or "
                  "\"model\".");
    omega.choices = {"model"};
    SpaceEntry e;
    e.item = {
        "oscillatory-product",
        "product form",
        "A slow polynomial times 1 + alpha sin wt + beta cos wt, as printed. Experimental: steps soon "
        "have no solution.",
        {omega, integerField("degree", "n", 1, OscillatoryBasis::mostDegree, 4.0, "Degree of the slow part."),
         choiceField("frequency", "frequency is", {"fixed", "free"},
                     "Whether each coordinate has its frequency as an unknown."),
         json("fast", "fast coordinates", "", {}, "degree of the coordinates the model calls fast."),
         json("variables", "variables", "", {}, "degree of single coordinates, by name.")},
        {},
        ""};
    return e;
}

std::string mismatchOf(const Discretization& d, const System& system) {
    if (isSlow(d.space)) return slowMismatch(d.space, system);
    if (d.space.text("omega") != "model" || system.fast.frequency > 0) return {};
    return system.id + " does not say how fast it oscillates";
}

Discretization estimate(const Discretization& d, const System& system, const State& start) {
    Discretization known = d;
    if (isOscillatory(d.space) && d.space.text("omega") == "estimate")
        for (auto& [key, value] : known.space.keys)
            if (key == "omega") value = estimateFrequency(system, start);
    return known;
}

/// A step near one at which it is singular, or a model that does not fit.
void checkMultiscale(const SchemeCase& scheme, Findings& findings) {
    if (isSlow(scheme.discretization.space)) return checkSlow(scheme, findings);
    const double h = scheme.step;
    const auto found =
        resonanceOf(scheme.system, estimate(scheme.discretization, scheme.system, scheme.initial), h);
    if (!found) return;
    findings.warning("/step",
                     formatNumber(h) + " is near a resonance of the space: at the step " +
                         formatNumber(found->at, 4) +
                         " the state at its start does not determine the curve, and errors grow nearby",
                     found->near > 0 ? "the step " + formatNumber(found->near) : "another step",
                     found->near > 0 ? Value(found->near) : Value(), "resonance");
}

/// Where a run has so many fast periods that to resolve them is dear: steps of many periods, which cost the
/// same however fast the motion is.
ReferencePlan overFastMotion(const System& system, const State&, double duration) {
    constexpr double manyPeriods = 800, firstParts = 20;
    const double w = system.fast.frequency;
    if (w * duration < 2 * std::numbers::pi * manyPeriods) return {};
    ReferencePlan plan = referenceBy("multiscale R3", system, *namedScheme("multiscale-r3"));
    plan.firstStep = duration / firstParts;
    return plan;
}

WrittenAction written(const Discretization& d) {
    if (isSlow(d.space)) return writtenSlow(d.space);
    return {
        "q is a slow polynomial plus harmonics of a fast phase θ with polynomial amplitudes; the amplitudes "
        "are unknowns. The rule is a grid of slow nodes c_i and phases θ_k, with Filon weights b_ik.",
        {{"S(q_0, q_1) = h Σ_i Σ_k b_ik L(t_0 + c_i h, Q(c_i, θ_k), V(c_i, θ_k))",
          "S(q_0, q_1) = h \\sum_i \\sum_k b_{ik}\\, L\\bigl(t_0 + c_i h, Q(c_i, \\theta_k), V(c_i, "
          "\\theta_k)\\bigr)"},
         {"Q(τ, θ) = Σ_j C_j P_j(τ) + Σ_k Σ_j P_j(τ) (C_kj cos kθ + S_kj sin kθ)",
          "Q(\\tau, \\theta) = \\sum_j C_j P_j(\\tau) + \\sum_k \\sum_j P_j(\\tau) \\bigl( C_{kj} \\cos "
          "k\\theta + S_{kj} \\sin k\\theta \\bigr)"}},
        {{"∂S/∂Y_a = 0 of every interior unknown,  p_0 = −∂S/∂q_0,  p_1 = ∂S/∂q_1",
          "\\frac{\\partial S}{\\partial Y_a} = 0, \\qquad p_0 = -\\frac{\\partial S}{\\partial q_0}, "
          "\\qquad p_1 = \\frac{\\partial S}{\\partial q_1}"}}};
}

/// The spaces that have names, under the rules that an oscillatory space can have.
ChoiceGrid choices(const System& system) {
    ChoiceGrid grid;
    if (!(system.fast.frequency > 0)) return grid;
    grid.subtitle = "oscillatory space × rule";
    static constexpr std::pair<const char*, const char*> columns[] = {{"auto", "auto"},
                                                                      {"F–Lob", "filon-lobatto"},
                                                                      {"F–G", "filon-gauss"},
                                                                      {"Gauss", "gauss"},
                                                                      {"Lob", "lobatto"}};
    for (const auto& [heading, rule] : columns) grid.columns.push_back({heading, findRule(rule)->item.title});
    for (const auto& [text, name] : {std::pair{"R1", "multiscale-r1"},
                                     {"R2", "multiscale-r2"},
                                     {"R3", "multiscale-r3"},
                                     {"product", "product-form"}}) {
        const auto named = namedScheme(name);
        const auto entry = std::find_if(schemeCatalog().begin(), schemeCatalog().end(),
                                        [id = name](const SchemeEntry& e) { return e.item.id == id; });
        for (const auto& [heading, rule] : columns) {
            ChoiceGrid::Cell cell;
            cell.discretization = {named->space, completeQuadrature(named->space, {rule, {}, {}}), {}};
            const Properties known = describe(cell.discretization);
            const Settings& q = cell.discretization.quadrature;
            cell.id = std::string(name) + "." + rule;
            cell.text = q.type == "auto" ? "auto" : std::to_string(q.integer("nodes"));
            if (q.find("phases")) cell.text += "×" + std::to_string(q.integer("phases"));
            cell.title = entry->item.title + " × " + findRule(rule)->item.title;
            grid.cells.push_back(std::move(cell));
        }
        grid.rows.push_back({text, entry->item.description});
    }
    return grid;
}

/// Keys that one of them leaves out do not matter.
bool areEqual(const Settings& a, const Settings& b) {
    const auto isIn = [](const Settings& all, const Settings& other) {
        return std::all_of(all.keys.begin(), all.keys.end(), [&](const auto& key) {
            const Value* there = other.find(key.first);
            return key.second.isNull() ? !there || there->isNull() : there && *there == key.second;
        });
    };
    return a.type == b.type && isIn(a, b) && isIn(b, a);
}

}  // namespace

Family multiscale() {
    Family f;
    f.item = {"multiscale", "multiscale", "Spaces that contain a fast oscillation.", {}, {}, "coordinates"};
    f.source = "Leok 2004, sec. 7";
    f.spaces = {oscillatory(), productForm(), slowSpace()};
    f.completeRule = [](const Settings& space, const Settings& quadrature) {
        if (isSlow(space)) return completeSlowRule(space, quadrature);
        return isProduct(space) ? completeProductRule(space, quadrature)
                                : completeOscillatoryRule(space, quadrature);
    };
    f.parts.set(SmallerSpaces{"harmonics", fewerHarmonics, textOfHarmonics, false});
    f.describe = [](const Discretization& d) {
        if (isSlow(d.space)) return describeSlow(d.space, d.quadrature);
        return isProduct(d.space) ? describeProduct(d.space, d.quadrature)
                                  : describeOscillatory(d.space, d.quadrature);
    };
    f.check = checkMultiscale;
    f.choices = choices;
    f.rules = [](const Settings& space) {
        if (isSlow(space)) return plainRules();
        return std::vector<std::string>{"auto", "filon-lobatto", "filon-gauss", "gauss", "lobatto"};
    };
    f.written = written;
    f.make = [](const System& system, const Discretization& d, double first) {
        const SolverPolicy policy = solverPolicy(d.solver, system);
        if (isSlow(d.space)) return makeSlowStep(system, d, first, policy);
        if (isProduct(d.space)) return makeProductIntegrator(system, d, {0, first}, policy);
        auto tables = [system, d, first, made = oscillatoryTables(system, d, first)](double step) {
            return step == first ? made : oscillatoryTables(system, d, step);
        };
        return makeCondensed(system.mechanics(), std::move(tables), first, policy);
    };
    f.parts.set(SolverMethods{{"newton"}});  // fixed-point iteration diverges on fast oscillations
    f.parts.set(SchemeCondition{mismatchOf});
    f.parts.set(StartEstimate{estimate});
    f.parts.set(ModelInPlace{[](const Discretization& d, const System& system) {
        return isSlow(d.space) ? slowTitle(d.space, system) : std::string();
    }});
    f.parts.set(TrustedScheme{overFastMotion});
    f.parts.set(Variant{});
    f.parts.set(SchemeIdentity{[](const Discretization& a, double, const Discretization& b) {
        return areEqual(a.space, b.space) && areEqual(a.quadrature, b.quadrature);
    }});
    return f;
}

}  // namespace extremal::family
