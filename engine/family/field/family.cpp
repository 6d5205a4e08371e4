// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields: hat functions and their higher-order likes on a mesh of space and time (Leok 2004, sec. 2.1,
/// multisymplectic variational integrators).
#include "engine/family/family.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/parts/described_on_system.hpp"
#include "engine/family/parts/dispersion.hpp"
#include "engine/family/parts/meshes.hpp"
#include "engine/family/parts/nodes.hpp"
#include "engine/family/parts/own_measures.hpp"
#include "engine/family/parts/references.hpp"
#include "engine/family/parts/scheme_identity.hpp"
#include "engine/family/parts/solver_methods.hpp"
#include "engine/family/parts/starts.hpp"
#include "engine/family/parts/steps.hpp"
#include "engine/family/parts/tensor_rules.hpp"
#include "engine/family/parts/variant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "engine/action/table.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/field/discretization.hpp"
#include "engine/family/field/dispersion.hpp"
#include "engine/family/field/field_step.hpp"
#include "engine/family/field/mass_matrix.hpp"
#include "engine/family/field/patch_form.hpp"
#include "engine/family/field/plane_tent.hpp"
#include "engine/family/field/slab_stepper.hpp"
#include "engine/family/field/step_limit.hpp"
#include "engine/family/rule_choices.hpp"
#include "engine/family/table_properties.hpp"
#include "engine/model/field/field_system.hpp"
#include "engine/model/plane_field/settings.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/solve/newton_policy.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::family {
namespace {

constexpr int mostTimeDegree = 4;

SpaceEntry tent() {
    SpaceEntry e;
    FieldInfo degree =
        jsonField("degree", "degree", "r, s", Value(1.0),
                  "Degree of the polynomials on a cell: one number, or {\"space\": r, \"time\": "
                  "s}; r up to 3, s up to 4.");
    FieldInfo cells = integerField("cells", "N", 2, 1e6, nullptr,
                                   "Number of elements in space; default: that of the model.");
    cells.isOptional = true;
    FieldInfo parts =
        integerField("parts", "parts", 1, 512, nullptr,
                     "Of an element, in which functions of its own are linear; default: 32 for each period "
                     "of the medium.");
    parts.isOptional = true;
    const FieldInfo functions = choiceField(
        "functions", "functions", {"lagrange", "cell-problem", "snapshots"},
        "lagrange: Lagrange polynomials. In a medium a(x/epsilon), of elements with degree 1 in space: "
        "with a constant flux a u_x (cell-problem), or from snapshots of a short resolved run.");
    e.item = {
        "tent",
        "hat functions",
        "Continuous functions of space and time that are polynomials on each cell of a rectangular mesh.",
        {degree, cells, functions, parts},
        {},
        "a field"};
    return e;
}

std::string text(const char* name, int degree) {
    return degree == 1 ? std::string("linear in ") + name
                       : "of degree " + std::to_string(degree) + " in " + name;
}

/// What a rule in one direction promises for polynomials of a degree there.
Properties inDirection(const Settings& quadrature, const char* direction, int degree) {
    Settings own = ruleSettingsIn(quadrature, direction);
    if (own.type == "exact")
        own = {"gauss", {{"nodes", static_cast<double>(degree + 1)}, {"panels", 1.0}}, {}};
    if (!isPlainRule(own)) {
        Properties p;
        refuseRule(own, p);
        return p;
    }
    return describeTable([&] {
        return makeTable<double>(polynomialSpace<double>(degree, PolynomialBasis::lobatto),
                                 makeRule<double>(own));
    });
}

/// "trapezoid", "gauss 2": a rule for people.
std::string ruleName(const Settings& quadrature, const char* direction) {
    const Settings own = ruleSettingsIn(quadrature, direction);
    return own.type + (own.find("nodes") ? " " + std::to_string(own.integer("nodes")) : "");
}

/// Degrees that cannot be: sets the reason and what to write in their place. False if they can be.
bool refuseDegrees(Properties& p, const Discretization& d, const TentDegrees& degrees) {
    if (degrees.space < 1 || degrees.space > FieldNodes::mostDegree || degrees.time < 1 ||
        degrees.time > mostTimeDegree) {
        p.refusal = "degrees go from 1 to " + std::to_string(FieldNodes::mostDegree) + " in space and to " +
                    std::to_string(mostTimeDegree) + " in time";
        p.hint = "\"degree\": {\"space\": 1, \"time\": 1}";
        return true;
    }
    if (hasOwnFunctions(d.space) && degrees.space != 1) {
        p.refusal = "elements with functions of their own have degree 1 in space";
        p.hint = "\"degree\": {\"space\": 1, \"time\": " + std::to_string(degrees.time) + "}";
        return true;
    }
    return false;
}

/// The same of rules.
bool refuseRules(Properties& p, const Discretization& d, const TentDegrees& degrees) {
    for (const auto& [direction, degree] : {std::pair{tensorParts[0], degrees.space},
                                            {acrossPart, degrees.space},
                                            {tensorParts[1], degrees.time}}) {
        const Properties own = inDirection(d.quadrature, direction, degree);
        if (own.refusal.empty()) continue;
        p.refusal = own.refusal + (direction == acrossPart ? " along y" : std::string(" in ") + direction);
        p.hint = own.hint;
        return true;
    }
    return false;
}

/// What is known of the largest step, from the limit of the rule in time.
void describeStability(Properties& p, const Discretization& d, int degree, const Rule<double>& rule,
                       double limit) {
    p.stabilityLimit = limit;
    const std::string order = "order " + std::to_string(p.claims.order);
    if (std::isinf(limit)) {
        p.remark = order + ", stable at every step";
    } else if (hasOwnFunctions(d.space)) {
        p.remark = order + " down to the period of the medium";
    } else if (leastMass(degree, rule) == 0) {
        p.stabilityLimit = 0;
        p.instability =
            "the rule " + ruleName(d.quadrature, "space") +
            " in space does not see the mass of the wave that alternates from node to node, whose "
            "frequency is infinite, and the rule " +
            ruleName(d.quadrature, "time") + " in time is stable up to a finite one alone";
        p.hint = "midpoint in time, or another rule in space";
        p.remark = "unstable for every step";
    } else {
        p.remark = order + ", stable for c dt/dx up to " +
                   formatNumber(limit / std::sqrt(largestSpatialEigenvalue(degree, rule)), 3);
    }
}

/// "leapfrog", "midpoint × trapezoid": the name of the scheme of this space and rules.
std::string nameOfTent(const Discretization& d, const TentDegrees& degrees, bool isExplicit) {
    const std::string spaceRule = ruleName(d.quadrature, "space"), timeRule = ruleName(d.quadrature, "time");
    if (d.quadrature.find(acrossPart))
        return spaceRule + " × " + ruleName(d.quadrature, acrossPart) + " × " + timeRule;
    if (hasOwnFunctions(d.space))
        return (d.space.text("functions") == "snapshots" ? "snapshots × " : "cell problem × ") + timeRule;
    if (degrees.space == 1 && degrees.time == 1) {
        if (spaceRule == "midpoint" && timeRule == "midpoint") return "Preissman box scheme";
        if (isExplicit) return "leapfrog";
    }
    return spaceRule + " × " + timeRule;
}

Properties describeTent(const Discretization& d) {
    const TentDegrees degrees = tentDegrees(d.space);
    Properties p;
    p.space = text("space", degrees.space) + ", " + text("time", degrees.time);
    if (refuseDegrees(p, d, degrees)) return p;
    if (hasOwnFunctions(d.space))
        p.space = (d.space.text("functions") == "snapshots" ? "functions from snapshots in space, "
                                                            : "functions of a cell problem in space, ") +
                  text("time", degrees.time);
    if (refuseRules(p, d, degrees)) return p;
    const Properties space = inDirection(d.quadrature, "space", degrees.space),
                     across = inDirection(d.quadrature, acrossPart, degrees.space),
                     time = inDirection(d.quadrature, "time", degrees.time);
    const Rule<double> rule = ruleIn(d.quadrature, "space", degrees.space);
    p.orderInSpace = std::min(space.claims.order, across.claims.order);
    p.claims.order = std::min(p.orderInSpace, time.claims.order);
    p.claims.isSymmetric = time.claims.isSymmetric;
    p.claims.isSymplectic = true;
    p.claims.conserves = {"multisymplectic form", "momentum"};
    p.curveOrder = std::min(degrees.space, degrees.time) + 1;
    p.shortName = "T" + std::to_string(p.claims.order);
    p.prefix = "Fields ";
    const TimeTable table = timeTable(d);
    const bool isLumped = !hasOwnFunctions(d.space) && rule.size() == degrees.space + 1 &&
                          rule.c.front() == 0 && rule.c.back() == 1 && !d.quadrature.find(acrossPart);
    p.isExplicit = table.isTrapezoid() && isLumped;
    describeStability(p, d, degrees.space, rule, timeLimit(table));
    p.knownAs = nameOfTent(d, degrees, p.isExplicit);
    return p;
}

/// One rule is that of both directions. By itself, of linear functions the trapezoidal rule in both, which
/// makes the step explicit; of higher degrees Gauss, with one node more in space, where it then is exact.
Settings completeTent(const Settings& space, const Settings& quadrature) {
    const TentDegrees degrees = tentDegrees(space);
    const bool isAutomatic = quadrature.type.empty() || quadrature.type == "auto";
    if (!isAutomatic) return completeRule(quadrature, {std::max(degrees.space, degrees.time), 1});
    const auto part = [](const char* type, double nodes) {
        Value rule{Value::Object{{"type", type}}};
        if (nodes > 0) rule.set("nodes", nodes);
        rule.set("panels", 1.0);
        return rule;
    };
    const bool isExplicit = degrees.time == 1;
    const Value alongX = hasOwnFunctions(space)             ? part("gauss", 2)
                         : degrees.space == 1 && isExplicit ? part("trapezoid", 0)
                         : isExplicit                       ? part("lobatto", degrees.space + 1)
                                                            : part("gauss", degrees.space + 1),
                alongT = isExplicit ? part("trapezoid", 0) : part("gauss", degrees.time);
    return {"product", {{tensorParts[0], alongX}, {tensorParts[1], alongT}}, {}};
}

std::optional<Settings> modelOf(const Settings& space, const Settings& model) {
    const int degree = tentDegrees(space).space, cells = space.integer("cells");
    if (model.type != "field" || componentNames(model) != std::vector<std::string>{"u"}) return {};
    if (degree == 1 && !hasOwnFunctions(space) && (cells == 0 || cells == model.integer("cells"))) return {};
    Settings own = model;
    for (auto& [key, value] : own.keys)
        if (key == "cells" && cells > 0) value = static_cast<double>(cells);
    own.keys.emplace_back(elementDegreeKey, static_cast<double>(degree));
    if (hasOwnFunctions(space)) {
        own.keys.emplace_back(elementFunctionsKey, space.text("functions"));
        own.keys.emplace_back(elementPartsKey, static_cast<double>(space.integer("parts")));
    }
    return own;
}

std::shared_ptr<const FieldProblem> problemFor(const System& system, const Discretization& d) {
    const auto& problem = system.part<ScalarField>().problem;
    if (hasOwnFunctions(d.space) && !problem->functions)
        throw InvalidScene("/space/functions", "functions of their own are for elements of a scalar field",
                           "\"lagrange\"");
    if (problem->nodes.degree != tentDegrees(d.space).space)
        throw InvalidScene("/space/degree",
                           "the field has elements of degree " + std::to_string(problem->nodes.degree));
    return problem;
}

void checkTent(const SchemeCase& scheme, Findings& findings) {
    const Discretization& d = scheme.discretization;
    if (describe(d).stabilityLimit <= 0) return;  // said already
    if (scheme.system.parts.find<PlaneField>()) return checkPlaneTent(scheme, findings);
    const auto problem = problemFor(scheme.system, d);
    // The midpoint rule in time takes the velocity from the velocity, all others from the momentum.
    if (!scheme.allowsUnstable && !timeTable(d).isBalanced() && !problem->functions &&
        hasMasslessWave(*problem, ruleIn(d.quadrature, "space", problem->nodes.degree)))
        findings.error("/quadrature",
                       "with the rule " + ruleName(d.quadrature, "space") + " in space on this mesh of " +
                           std::to_string(problem->mesh.elements()) +
                           " cells the wave that alternates from node to node has no mass, so that its "
                           "velocity does not follow from its momentum",
                       problem->mesh.isPeriodic()
                           ? "an odd number of cells, another rule in space, midpoint in time and degree 1 "
                             "there, or \"allow_unstable\": true"
                           : "another rule in space, midpoint in time and degree 1 there, or "
                             "\"allow_unstable\": true");
    const double steps = std::abs(scheme.end - scheme.initial.t) / scheme.step;
    checkFieldStep(*spatialForm(d, problemFor(scheme.system, d)), timeLimit(timeTable(d), steps), scheme,
                   describe(d).knownAs, findings);
}

/// Degree 3 in space and time. Steps divide those of the schemes, whose nodes are then among its own.
ReferenceMesh referenceMesh(const Settings& model, double step, int refinement) {
    int cells = model.integer("cells");
    // A medium is resolved by 4 elements in each period.
    if (const Value* a = model.find("a"); a && *a != Value("1")) {
        const std::vector<double> ends = model.numbers("domain");
        cells =
            std::max(cells, static_cast<int>(std::ceil(4 * (ends[1] - ends[0]) / model.number("epsilon"))));
    }
    const int factor = 1 << refinement;
    cells *= factor;
    const Settings space{"tent",
                         {{"degree", Value(Value::Object{{"space", 3}, {"time", 3}})},
                          {"cells", static_cast<double>(cells)},
                          {"functions", "lagrange"}},
                         {}};
    return {
        "elements of degree 3 on " + std::to_string(cells) + " cells, h = " + formatNumber(step / factor, 3),
        {space, completeTent(space, {}), {}},
        step / factor,
        static_cast<double>(cells)};
}

double largestStep(const System& system, const Discretization& d, const State& start) {
    if (describe(d).stabilityLimit <= 0) return 0;
    if (const auto* const plane = system.parts.find<PlaneField>())
        return refusalOnPlane(d, *plane->problem) ? 0 : longestPlaneStep(d, *plane->problem, start.x.data());
    const double limit = timeLimit(timeTable(d));
    if (std::isinf(limit)) return limit;
    return limit / std::sqrt(spatialForm(d, problemFor(system, d))->largestEigenvalue(start.x.data()));
}

/// A complete rule of one direction, as an object.
Value completePart(const char* type, int degree, std::optional<int> nodes = {}) {
    const Settings rule = completeRule({type, {}, {}}, {degree, 1, 1, nodes});
    Value value{Value::Object{{"type", rule.type}}};
    for (const auto& [key, v] : rule.keys) value.set(key, v);
    return value;
}

ChoiceGrid choices(const System& system) {
    struct Direction {
        const char* heading;
        const char* description;
        int degree;
        const char* rule;
        int nodes;
        const char* functions = "lagrange";
    };
    static constexpr Direction rows[] = {
        {"trap", "linear in space, trapezoidal rule", 1, "trapezoid", 0},
        {"exact", "linear in space, exact", 1, "exact", 0},
        {"mid", "linear in space, midpoint rule", 1, "midpoint", 0},
        {"G 3", "quadratic in space, Gauss 3", 2, "gauss", 3},
        {"G 4", "cubic in space, Gauss 4", 3, "gauss", 4},
        {"cell", "functions of a cell problem in space", 1, "gauss", 2, "cell-problem"},
        {"POD", "functions from snapshots in space", 1, "gauss", 2, "snapshots"}};
    static constexpr Direction columns[] = {{"trap", "linear in time, trapezoidal rule", 1, "trapezoid", 0},
                                            {"exact", "linear in time, exact", 1, "exact", 0},
                                            {"mid", "linear in time, midpoint rule", 1, "midpoint", 0},
                                            {"G 2", "quadratic in time, Gauss 2", 2, "gauss", 2},
                                            {"G 3", "cubic in time, Gauss 3", 3, "gauss", 3}};
    ChoiceGrid grid;
    grid.subtitle = "space × time";
    for (const Direction& c : columns) grid.columns.push_back({c.heading, c.description});
    for (const Direction& r : rows) {
        const bool isPolynomial = std::string_view(r.functions) == "lagrange";
        const bool isPlane = system.parts.find<PlaneField>() != nullptr;
        if (!isPolynomial && (isPlane || !system.fieldProblem().coefficient))
            continue;  // they would be linear
        std::vector<ChoiceGrid::Cell> row;
        for (const Direction& c : columns) {
            ChoiceGrid::Cell cell;
            const auto partOf = [](const Direction& d) {
                return completePart(d.rule, d.degree,
                                    d.nodes > 0 ? std::optional<int>(d.nodes) : std::nullopt);
            };
            const Value degree = r.degree == 1 && c.degree == 1
                                     ? Value(1.0)
                                     : Value(Value::Object{{"space", r.degree}, {"time", c.degree}});
            cell.discretization = {
                {"tent", {{"degree", degree}, {"functions", r.functions}}, {}},
                {"product", {{tensorParts[0], partOf(r)}, {tensorParts[1], partOf(c)}}, {}},
                {}};
            const Properties known = describe(cell.discretization);
            cell.id = (isPolynomial ? std::to_string(r.degree) + r.rule : std::string(r.functions)) + "." +
                      std::to_string(c.degree) + c.rule;
            cell.text = known.stabilityLimit <= 0 ? "–" : std::isinf(known.stabilityLimit) ? "∞" : "ν";
            cell.superscript = std::to_string(known.claims.order);
            cell.title = std::string(r.description) + " × " + c.description;
            row.push_back(std::move(cell));
        }
        // Over a rectangle only those that its mesh can have.
        if (isPlane && !std::all_of(row.begin(), row.end(), [&](const ChoiceGrid::Cell& cell) {
                return isFor(cell.discretization, system);
            }))
            continue;
        grid.rows.push_back({r.heading, r.description});
        for (ChoiceGrid::Cell& cell : row) grid.cells.push_back(std::move(cell));
    }
    return grid;
}

DispersionCurve dispersionOf(const System& system, const Discretization& d, double step) {
    const auto problem = problemFor(system, d);
    return dispersionCurve(*problem, ruleIn(d.quadrature, "space", problem->nodes.degree), timeTable(d),
                           step);
}

/// R_0 = 0 of the slab between the two levels, for v.
State startThrough(const System& system, const Discretization& d, double step, const State& first,
                   const State& second) {
    const TimeTable time = timeTable(d);
    if (time.degree() != 1) return first;
    const auto form = spatialForm(d, problemFor(system, d));
    const auto n = static_cast<std::size_t>(form->size());
    std::vector<double> at(n), force(n, 0);
    for (int q = 0; q < time.points(); ++q) {
        for (std::size_t i = 0; i < n; ++i)
            at[i] = time.value(q, 0) * first.x[i] + time.value(q, 1) * second.x[i];
        form->addForce(at.data(), step * time.weight(q) * time.value(q, 0), force.data());
    }
    MassMatrix(*form).solve(force.data());
    State state = first;
    for (std::size_t i = 0; i < n; ++i)
        state.x[n + i] = system.fieldProblem().isFixed(static_cast<int>(i))
                             ? 0
                             : (second.x[i] - first.x[i]) / step - force[i];
    return state;
}

std::unique_ptr<Integrator> makeTent(const System& system, const Discretization& d, double step) {
    if (system.parts.find<PlaneField>()) return makePlaneTent(system, d, step);
    const auto problem = problemFor(system, d);
    const TentDegrees degrees = tentDegrees(d.space);
    if (d.solver.type == "newton")
        return makeSlabStepper(problem, degrees.time, ruleIn(d.quadrature, "space", degrees.space),
                               ruleIn(d.quadrature, "time", degrees.time), step);
    auto form = spatialForm(d, problem);
    const TimeTable time = timeTable(d);
    if (time.isTrapezoid()) return makeExplicitField(std::move(form), step);
    const double most = d.solver.number("max_iterations");
    return makeImplicitField(std::move(form), time, step, d.solver.number("tolerance"),
                             most > 0 ? static_cast<int>(most) : SolverPolicy{}.maxIterations);
}

/// The patch is the middle half of the elements.
std::optional<Measure> measure(std::string_view observable, const System& system, const Discretization& d,
                               double step) {
    if (observable != "multisymplectic" || !system.parts.find<ScalarField>()) return {};
    const auto problem = problemFor(system, d);
    const int N = problem->mesh.elements();
    if (N < 8) return {};
    const TentDegrees degrees = tentDegrees(d.space);
    const PatchForm patch(problem, degrees.time, ruleIn(d.quadrature, "space", degrees.space),
                          ruleIn(d.quadrature, "time", degrees.time), step, N / 4, 3 * N / 4, 1);
    return Measure{"multisymplectic",
                   {{"multisymplectic", "", "Σ Ω / Σ |Ω|", ""}},
                   0,
                   [patch, n = static_cast<std::size_t>(problem->size())](const State& initial) {
                       return [patch = PatchForm(patch), n, last = initial.t, before = initial.x](
                                  double t, const double* x, double* values) mutable {
                           if (t != last) patch.advance(before.data(), x);
                           values[0] = patch.boundary().relative();
                           last = t;
                           before.assign(x, x + 2 * n);
                       };
                   }};
}

WrittenAction written(const Discretization&) {
    return {"u is the sum of nodal values u_j^l times functions of the mesh of space and time.",
            {{"S = Σ_K Σ_i w_i ℒ(u, u_t, u_x) at the nodes i of every cell K",
              "S = \\sum_K \\sum_{i \\in K} w_i\\, \\mathcal{L}(u, u_t, u_x)\\big|_i"}},
            {{"∂S/∂u_j^l = 0 of every node inside", "\\frac{\\partial S}{\\partial u_j^l} = 0"}}};
}

}  // namespace

Family field() {
    Family f;
    f.item = {"field", "field", "Hat functions on a mesh of space and time.", {}, {}, "a field"};
    f.source = "Leok 2004, sec. 2.1";
    f.spaces = {tent()};
    f.takes = Takes::only<ScalarField, PlaneField>();
    f.completeRule = completeTent;
    f.describe = describeTent;
    f.check = checkTent;
    f.choices = choices;
    f.rules = [](const Settings&) { return plainRules(); };
    f.written = written;
    f.make = makeTent;
    f.parts.set(SolverMethods{{"banded", "newton"}});
    f.parts.set(TensorRules{});
    f.parts.set(NodesAlone{});
    f.parts.set(OwnMesh{modelOf});
    f.parts.set(Variant{Takes::only<PlaneField>()});
    f.parts.set(SchemeCondition{mismatchOnPlane});
    f.parts.set(DescribedOnSystem{describeOnPlane});
    f.parts.set(TrustedMesh{referenceMesh, Takes::only<ScalarField>()});
    f.parts.set(RefinedMesh{refinedCells, Takes::only<ScalarField>(), Takes::only<PlaneField>()});
    f.parts.set(LargestStep{largestStep});
    f.parts.set(StartThrough{startThrough});
    f.parts.set(SlowestStep{[](const SchemeCase& scheme) {
        const auto* const plane = scheme.system.parts.find<PlaneField>();
        return 5e-3 * std::max(1.0, plane ? static_cast<double>(plane->problem->size()) / 256
                                          : scheme.system.fieldProblem().size() / 2000.0);
    }});
    f.parts.set(SchemeIdentity{[](const Discretization& a, double, const Discretization& b) {
        return a.space == b.space && a.quadrature == b.quadrature;
    }});
    f.parts.set(Dispersion{dispersionOf});
    f.parts.set(OwnMeasures{measure});
    return f;
}

}  // namespace extremal::family
