// SPDX-License-Identifier: GPL-3.0-or-later
/// Symplectic-energy-momentum integrators: the times of nodes are unknowns, chosen so that the discrete
/// energy is kept (Leok 2004, sec. 5).
#include "engine/family/family.hpp"
#include "engine/family/parts/advice.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/parts/nodes.hpp"
#include "engine/family/parts/solver_methods.hpp"
#include "engine/family/parts/variant.hpp"

#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/energy_momentum/density.hpp"
#include "engine/family/energy_momentum/moving_time.hpp"
#include "engine/family/rule_choices.hpp"
#include "engine/family/table_properties.hpp"
#include "engine/integrator/condensed.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal {
namespace {

constexpr int mostDegree = 4;
constexpr std::array<const char*, 4> policies = {"reset", "minimise", "keep", "stop"};

}  // namespace

MovingTimeOptions movingTimeOptions(const Settings& space, int order, double firstStep) {
    MovingTimeOptions options;
    options.first = firstStep;
    options.order = order;
    const std::string policy = space.text("policy");
    for (std::size_t i = 0; i < policies.size(); ++i)
        if (policy == policies[i]) options.policy = static_cast<UnsolvablePolicy>(i);
    if (const std::vector<double> window = space.numbers("window"); window.size() == 2) {
        options.shrink = window[0];
        options.grow = window[1];
    }
    const double h = std::abs(firstStep), least = space.number("hmin"), most = space.number("hmax");
    options.least = least > 0 ? least : usualLeast * h;
    options.most = most > 0 ? most : usualMost * h;
    if (!(options.shrink < 1 && options.grow > 1))
        throw InvalidScene("/space/window", "must contain 1: a step as long as the one before", "[0.5, 2]");
    if (options.least > h)
        throw InvalidScene("/space/hmin",
                           "is " + formatNumber(options.least) + ", and the first step is " +
                               formatNumber(h) + ": it must not be shorter",
                           "at most " + formatNumber(h));
    if (options.most < h)
        throw InvalidScene("/space/hmax",
                           "is " + formatNumber(options.most) + ", and the first step is " + formatNumber(h) +
                               ": it must not be longer",
                           "at least " + formatNumber(h));
    return options;
}

namespace family {
namespace {

FieldInfo stepLimit(const char* key, const char* title, double multiple, const char* description) {
    FieldInfo f = positive(key, title, "", 1, description);
    f.fallback = {};
    f.isOptional = true;
    f.description += " Left out: " + formatNumber(multiple) + " times the first.";
    return f;
}

SpaceEntry movingTime() {
    FieldInfo degree =
        integerField("degree", "s", 1, mostDegree, nullptr, "Degree of the polynomials on one step.");
    degree.whyLimits =
        "above degree 4 the discrete energy of usual steps agrees with the energy to round-off, and does "
        "not tell how long a step is";
    FieldInfo window = numbers("window", "window", "", {"shrink", "grow"}, Value::Array{0.5, 2.0},
                               "A step is between these multiples of the one before.");
    window.min = 0;
    window.isMinExcluded = true;
    SpaceEntry e;
    e.item = {
        "moving-time",
        "moving times",
        "Polynomials in time on steps whose ends are unknowns: the discrete energy is kept. The step of "
        "the scheme is the first one.",
        {degree,
         choiceField("policy", "without a root", {policies.begin(), policies.end()},
                     "What a step does where the energy equation has no root: start the energy anew, "
                     "take the least energy error, take the first step again, or end the run."),
         window, stepLimit("hmin", "shortest step", usualLeast, "No step is shorter."),
         stepLimit("hmax", "longest step", usualMost, "No step is longer.")},
        {},
        "a Lagrangian without explicit time"};
    return e;
}

/// That of polynomials of the degree: the times are no part of it.
Table<double> tableOfSpace(const Settings& space, const Settings& quadrature) {
    return makeTable(polynomialSpace<double>(space.integer("degree"), PolynomialBasis::lobatto),
                     makeRule<double>(quadrature));
}

Properties describeMovingTime(const Discretization& discretization) {
    const auto& [space, quadrature, solver, impact] = discretization;
    const std::string degree = std::to_string(space.integer("degree"));
    Properties p;
    if (isPlainRule(quadrature))
        p = describeTable([&d = discretization] { return tableOfSpace(d.space, d.quadrature); });
    else
        refuseRule(quadrature, p);
    p.claims.conserves.push_back("discrete energy");
    p.claims.isOneStep = false;
    p.space = "polynomials of degree " + degree + " with moving times";
    p.prefix = "SEM ";
    p.shortName = p.refusal.empty() ? "SEM" + std::to_string(p.claims.order) : "-";
    return p;
}

std::string mismatchOf(const Discretization&, const System& system) {
    if (!system.mechanics().isTimeDependent) return {};
    return "the Lagrangian of " + system.id +
           " depends on time, so that its energy is not constant and cannot choose the steps";
}

std::string timesText(std::size_t count) {
    return count == 1 ? "once" : count == 2 ? "twice" : std::to_string(count) + " times";
}

/// What the policy does, for a sentence that ends with it.
std::string consequence(std::string_view policy) {
    if (policy == "minimise") return "steps shrink to the shortest allowed";
    if (policy == "keep") return "steps of the first length leave the discrete energy";
    if (policy == "stop") return "the run ends there";
    return "the discrete energy starts anew there";
}

std::optional<SolvabilityForecast> forecast(const SchemeCase& scheme, const Settings& space,
                                            const Settings& quadrature, FollowUntil until) {
    const int order = describe(space, quadrature).claims.order;
    return forecastSolvability(scheme.system.mechanics(), tableOfSpace(space, quadrature), order,
                               scheme.initial, scheme.step, scheme.end, until);
}

/// A degree for which the density keeps its sign, or 0. From degree 3 on that is rare, and hard to tell from
/// round-off.
int solvableDegree(const SchemeCase& scheme) {
    const int own = scheme.discretization.space.integer("degree");
    for (const int degree : {1, 2}) {
        if (degree == own) continue;
        Settings space = scheme.discretization.space;
        for (auto& [key, value] : space.keys)
            if (key == "degree") value = static_cast<double>(degree);
        const auto found =
            forecast(scheme, space, completeQuadrature(space, {"gauss", {}, {}}), FollowUntil::doubt);
        if (found && found->unresolved == 0 && found->signChanges.empty()) return degree;
    }
    return 0;
}

/// Steps that would be shorter than is allowed, as the monitor is the same on all of them: a start where they
/// are long.
void checkShortest(const SchemeCase& scheme, const SolvabilityForecast& found, Findings& findings) {
    const auto& [space, quadrature, solver, impact] = scheme.discretization;
    const int order = describe(space, quadrature).claims.order;
    const double shortest = scheme.step * std::pow(found.first / found.largest, 1.0 / (order + 1)),
                 least = movingTimeOptions(space, order, scheme.step).least;
    if (!(shortest < least)) return;
    findings.warning("/space/hmin",
                     "is " + formatNumber(least, 3) + ", and steps will be about " +
                         formatNumber(shortest, 2) + " near t = " + formatNumber(found.timeOfLargest, 3) +
                         ": shorter ones count as without a root",
                     "the key hmin of the space, " + formatNumber(shortest / 2, 1), {}, "solvability");
}

void checkSolvability(const SchemeCase& scheme, Findings& findings) {
    const auto& [space, quadrature, solver, impact] = scheme.discretization;
    const auto found = forecast(scheme, space, quadrature, FollowUntil::end);
    if (!found) return;
    if (found->vanishes)
        return findings.warning("/space",
                                "leaves the steps undetermined: every step has the same discrete energy, to "
                                "round-off, from t = " +
                                    formatNumber(scheme.initial.t, 3) + " to " +
                                    formatNumber(found->until, 3) + "; the run will refuse",
                                "a fixed step: the space polynomial", {}, "step-density");
    constexpr double most = 0.05;
    if (found->unresolved > most)
        findings.warning("/step",
                         "is short for the degree: on " + formatNumber(100 * found->unresolved, 2) +
                             " % of the motion up to t = " + formatNumber(found->until, 3) +
                             " the density of the local action error is below the round-off of the discrete "
                             "energy, which then hardly tells how long a step is",
                         "a longer first step, or a lower degree", {}, "step-density");
    if (found->signChanges.empty() && found->unresolved <= most)
        return checkShortest(scheme, *found, findings);
    if (found->signChanges.empty()) return;
    const int other = solvableDegree(scheme);
    const std::string policy = space.text("policy");
    findings.warning("/space",
                     "has steps without a root of the energy equation: the density of the local action error "
                     "changes its sign " +
                         timesText(found->signChanges.size()) +
                         " up to t = " + formatNumber(found->until, 3) +
                         ", first at t = " + formatNumber(found->signChanges.front(), 3) + "; policy " +
                         policy + ": " + consequence(policy),
                     other > 0 ? "degree " + std::to_string(other) + ", whose density keeps its sign"
                     : policy == "reset" ? "a fixed step"
                                         : "the policy reset, or a fixed step",
                     {}, "solvability");
}

std::string adviceFor(Outcome outcome) {
    if (outcome == Outcome::energyUnsolvable)
        return "No step has this discrete energy: the density of the local action error changes its sign "
               "here. Try the policy reset, another degree, or a fixed step.";
    if (outcome == Outcome::refused)
        return "Every step has the same discrete energy, to round-off: the steps are undetermined, as they "
               "are for a free particle and at rest. Take a fixed step (the space polynomial), or a longer "
               "first step.";
    if (outcome == Outcome::stepBudget)
        return "The steps became far shorter than the first. Try the policy reset, or a larger hmin.";
    return {};
}

ChoiceGrid choicesOf(const System&) {
    std::vector<SpaceRow> rows;
    for (int degree = 1; degree <= mostDegree; ++degree)
        rows.push_back({"SEM " + std::to_string(degree),
                        "sem",
                        {"moving-time",
                         {{"degree", static_cast<double>(degree)},
                          {"policy", policies.front()},
                          {"window", Value::Array{0.5, 2.0}}},
                         {}}});
    return ruleChoices(rows);
}

std::unique_ptr<Integrator> makeIt(const System& system, const Discretization& d, double step) {
    if (const std::string reason = mismatchOf(d, system); !reason.empty())
        throw InvalidScene("/space/type", reason, "a fixed step: the space polynomial");
    const int order = describe(d).claims.order;
    return makeMovingTime(system.mechanics(), tableOfSpace(d.space, d.quadrature),
                          movingTimeOptions(d.space, order, step), solverPolicy(d.solver, system));
}

WrittenAction written(const Discretization&) {
    return {
        "The end times t_k of the elements are unknowns beside those of the Galerkin step, h_k = t_{k+1} − "
        "t_k.",
        {{"S = Σ_k h_k Σ_i b_i L(t_k + c_i h_k, Q_i, V_i)",
          "S = \\sum_k h_k \\sum_i b_i\\, L(t_k + c_i h_k, Q_i, V_i)"}},
        {{"∂S/∂Y_a = 0,  p_1 = ∂S/∂q_1,  and in the times E_d(h_k) = −∂S/∂h_k = E, the same on every element",
          "\\frac{\\partial S}{\\partial Y_a} = 0, \\qquad p_1 = \\frac{\\partial S}{\\partial q_1}, \\qquad "
          "E_d(h_k) = -\\frac{\\partial S}{\\partial h_k} = E"}}};
}

}  // namespace

Family energy_momentum() {
    Family f;
    f.item = {"energy_momentum",    "symplectic-energy-momentum", "Times of nodes are unknowns.", {}, {},
              "a mechanical system"};
    f.source = "Leok 2004, sec. 5";
    f.spaces = {movingTime()};
    f.completeRule = [](const Settings& space, const Settings& quadrature) {
        return completePlainRule(quadrature, space.integer("degree"), 1);
    };
    f.describe = describeMovingTime;
    f.check = checkSolvability;
    f.choices = choicesOf;
    f.rules = [](const Settings&) { return plainRules(); };
    f.written = written;
    f.make = makeIt;
    f.parts.set(SolverMethods{{"newton"}});
    f.parts.set(OwnTimeGrid{[](const Settings&) { return TimeGrid::free; }});
    f.parts.set(Variant{});
    f.parts.set(SchemeCondition{mismatchOf});
    f.parts.set(Advice{adviceFor});
    return f;
}

}  // namespace family
}  // namespace extremal
