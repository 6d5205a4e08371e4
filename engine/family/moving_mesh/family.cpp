// SPDX-License-Identifier: GPL-3.0-or-later
/// Moving meshes: fields whose nodes are unknowns, spatio-temporally adaptive (Leok 2004, sec. 6).
#include "engine/family/family.hpp"
#include "engine/family/parts/advice.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/parts/meshes.hpp"
#include "engine/family/parts/nodes.hpp"
#include "engine/family/parts/scheme_identity.hpp"
#include "engine/family/parts/smaller_spaces.hpp"
#include "engine/family/parts/solver_methods.hpp"
#include "engine/family/parts/starts.hpp"
#include "engine/family/parts/steps.hpp"
#include "engine/family/parts/variant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/moving_mesh/moving_mesh.hpp"
#include "engine/family/moving_mesh/multiplier_step.hpp"
#include "engine/family/moving_mesh/placement.hpp"
#include "engine/model/field/field_system.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal::family {
namespace {

/// With more, round-off in the places of the nodes, eps |X| / h, is no longer small beside the accuracy to
/// which the constraint is solved, and a scene is no longer checked at once.
constexpr int mostNodes = 100000, fewestNodes = 3;

SpaceEntry movingMeshSpace() {
    SpaceEntry e;
    FieldInfo nodes = integerField("nodes", "N", fewestNodes, mostNodes, nullptr,
                                   "Number of nodes that move, between the two ends; default: one less than "
                                   "the cells of the model.");
    nodes.isOptional = true;
    FieldInfo alpha = jsonField("alpha", "alpha", "α", Value("auto"),
                                "Weight of the monitor, a positive number, or auto: so that about 40 % of "
                                "the nodes stand where u varies much.");
    FieldInfo beta = notNegative("beta", "beta", "", 1,
                                 "Weight of u_t² beside u_x² in the arclength of the explicit method.");
    beta.symbol = "β";
    FieldInfo relaxation =
        positive("relaxation", "relaxation", "", 0.1,
                 "Time in which the mesh of the explicit method follows its monitor: a quarter of the time "
                 "in which a front passes.");
    relaxation.symbol = "τ";
    FieldInfo speedLimit = positive(
        "speed_limit", "speed limit", "", 1,
        "Largest speed of the nodes of the explicit method, in wave speeds; beyond 1 it may be unstable.");
    e.item = {
        "moving-mesh",
        "moving mesh",
        "Linear elements whose nodes move with the solution: equidistribution as a constraint on the "
        "action in values and places, or a mesh that follows a monitor.",
        {nodes,
         choiceField("monitor", "monitor", {"arclength", "curvature", "action-error"},
                     "Density of the nodes, of which all elements have the same share."),
         alpha,
         choiceField("method", "method", {"multiplier", "explicit", "hierarchical", "free"},
                     "multiplier: equidistribution as a constraint, by multipliers; explicit: the mesh "
                     "follows the monitor with a lag; hierarchical: dyadic elements, refined and "
                     "coarsened between steps; free: nodes without a constraint, an experiment."),
         beta, relaxation, speedLimit,
         flagField("fallback", true,
                   "A multiplier step without a solution, or with nodes faster than 1.5 waves, is "
                   "taken explicitly, as are those after it; so is a run from the start whose u may become "
                   "flat, as more than half of its variation is not held by the ends. Else the run ends "
                   "where it fails."),
         choiceField("times", "times", {"fixed", "energy"},
                     "fixed: steps of one length; energy: the step of all nodes is an unknown of the "
                     "multiplier method, and keeps the discrete energy."),
         notNegative("mesh_mass", "mesh mass", "", 0,
                     "Mass that free nodes have besides that of the field; without it their equations "
                     "are singular.")},
        {},
        "a field between two ends"};
    return e;
}

bool isExplicit(const Settings& space) { return space.text("method") == "explicit"; }
bool isFree(const Settings& space) { return space.text("method") == "free"; }
bool isHierarchical(const Settings& space) { return space.text("method") == "hierarchical"; }
bool isConstrained(const Settings& space) { return space.text("method") == "multiplier"; }
bool hasEnergyTimes(const Settings& space) { return space.text("times") == "energy"; }

bool isMovable(const System& system) {
    if (!system.parts.find<ScalarField>()) return false;
    const FieldProblem& problem = system.fieldProblem();
    return !problem.isBody && !problem.coefficient && problem.elastic.isLinear();
}

std::string mismatchOf(const Discretization&, const System& system) {
    if (system.fieldProblem().mesh.isPeriodic())
        return "moving meshes need two ends: the boundary dirichlet or neumann";
    return {};
}

std::optional<Settings> modelOf(const Settings& space, const Settings& model) {
    Settings own = model;
    const int nodes = space.find("nodes") ? space.integer("nodes") : model.integer("cells") - 1;
    own.keys.emplace_back(movingNodesKey, static_cast<double>(std::max(nodes, 1)));
    return own;
}

const std::shared_ptr<const FieldProblem>& problemOf(const System& system) {
    return system.part<ScalarField>().problem;
}

/// Which start a run has. That of the explicit method where equidistribution of u alone is going to fail: a
/// mesh off its constraint stays with that method (moving_mesh.hpp).
bool startsExplicitly(const Settings& space, const ProfileTable& table) {
    constexpr double leastHeld = 0.5;
    return isExplicit(space) ||
           (isConstrained(space) && space.flag("fallback") && heldVariation(table) < leastHeld);
}

/// With alpha as a number.
State startOf(const System& system, Discretization& d, const Settings& initial, double t) {
    const NodeSpace space(problemOf(system));
    if (space.n > mostNodes + 2)
        throw InvalidScene("/cells",
                           "a moving mesh has at most " + std::to_string(mostNodes) +
                               " nodes, and as many as the model has cells if it does not say how many",
                           "\"nodes\" in the space, or fewer cells");
    const FieldProfile profile = fieldProfile(initial, *space.problem, t);
    if (!profile.at)
        throw InvalidScene("", "a moving mesh places its own nodes, and the initial data are given at nodes",
                           "a profile, or u and u_t as expressions");
    const ProfileTable table(profile, space.problem->mesh, t);
    Monitor monitor = monitorOf(d.space, space.c2);
    const bool isGiven = startsExplicitly(d.space, table);
    if (!isGiven && !isHierarchical(d.space)) monitor.beta = 0;  // the constraint knows u alone
    for (auto& [key, value] : d.space.keys)
        if (key == "alpha" && !value.isNumber())
            value = monitor.alpha = automaticAlpha(monitor, table.x, table.u, table.u_t);
    State state;
    state.t = t;
    state.x = isHierarchical(d.space) ? startOnDyadicMesh(space, monitor, profile, table, t)
              : isGiven               ? startAtRest(space, monitor, profile, table, t)
                                      : startOnConstraint(space, monitor, profile, table, t);
    for (const double value : state.x)
        if (!std::isfinite(value)) throw InvalidScene("", "the initial data are not finite everywhere");
    return state;
}

Properties describeMovingMesh(const Discretization& d) {
    Properties p;
    const bool isGiven = isExplicit(d.space) || isHierarchical(d.space);
    p.space = "linear elements with moving nodes";
    const Value* alpha = d.space.find("alpha");
    if (alpha && !(alpha->isNumber() && alpha->asNumber() > 0) &&
        !(alpha->isString() && alpha->asString() == "auto")) {
        p.refusal = "alpha is neither auto nor a positive number";
        p.hint = "\"alpha\": \"auto\"";
        return p;
    }
    if (hasEnergyTimes(d.space) && !isConstrained(d.space)) {
        p.refusal = "the energy of a mesh that is prescribed is not constant, and cannot choose the steps";
        p.hint = "the method multiplier, or \"times\": \"fixed\"";
        return p;
    }
    if (!d.quadrature.type.empty() && d.quadrature.type != "auto") {
        p.refusal = "moving meshes have the midpoint rule in time and four Gauss points in space";
        p.hint = "\"quadrature\": \"auto\"";
        return p;
    }
    p.claims.order = isGiven ? 1 : 2;
    if (hasEnergyTimes(d.space)) {
        p.claims.conserves.push_back("discrete energy");
        p.claims.isOneStep = false;
        p.prefix = "SEM ";
    }
    p.claims.isSymmetric = isFree(d.space) || (!isGiven && !d.space.flag("fallback"));
    if (isFree(d.space))
        p.caution = d.space.number("mesh_mass") > 0
                        ? "is an experiment: free nodes tangle, and the run ends there"
                        : "is an experiment: the equations of free nodes are singular";
    p.claims.isSymplectic = p.claims.isSymmetric;
    p.curveOrder = 2;
    p.shortName = isHierarchical(d.space) ? "hier" : isGiven ? "expl" : isFree(d.space) ? "free" : "mult";
    p.knownAs = std::string("moving mesh, ") + d.space.text("method");
    p.stabilityLimit = std::numeric_limits<double>::infinity();
    p.remark = isGiven ? "order 1 in time, does not keep energy, never tangles"
                       : "order 2 in time, symplectic while it needs no fallback";
    return p;
}

/// Nodes and their rates at the start, as the steps take them.
std::vector<double> nodesOf(const State& state) {
    const std::size_t n = state.x.size() / 4;
    std::vector<double> z(2 * n);
    for (std::size_t i = 0; i < n; ++i) {
        z[2 * i] = state.x[i];
        z[2 * i + 1] = state.x[2 * n + i];
    }
    return z;
}

void checkConstraint(const SchemeCase& scheme, Findings& findings) {
    constexpr double onConstraint = 1e-8, leastMass = 3e-4;
    const Settings& space = scheme.discretization.space;
    if (!isConstrained(space)) return;
    const NodeSpace nodes(problemOf(scheme.system));
    if (scheme.initial.x.size() != 4 * nodes.n) return;  // there is no start
    const Monitor monitor = monitorOf(space, nodes.c2);
    const std::vector<double> z = nodesOf(scheme.initial);
    MultiplierStep step(nodes, monitor, 0, 1);
    if (step.constraint().residual(z.data()) > onConstraint) {
        if (space.flag("fallback"))
            findings.warning(
                "/space",
                "takes all its steps explicitly, each marked as mesh-fallback: its start is not on the "
                "constraint. Either less than half of the variation of u is held by the values at the ends, "
                "so that u may become flat, and a mesh that equidistributes it would have to become uniform "
                "at once; or no mesh was found that equidistributes it",
                "\"method\": \"explicit\", or \"fallback\": false for the constraint all the same", {},
                "equidistribution");
        return;
    }
    if (monitor.kind == Monitor::Kind::arclength || scheme.allowsUnstable) return;
    if (const double mass = step.smallestMass(z); mass < leastMass)
        findings.error(
            "/space/monitor",
            "leaves the nodes nearly free: there is a motion of the mesh that keeps it equidistributed, "
            "with a mass of " +
                formatNumber(mass, 2) +
                " of that of a mean element (arclength: 0.1), and nothing holds it; the limit is 0.0003",
            "arclength, fewer nodes, the method explicit, or \"allow_unstable\": true", "equidistribution");
}

std::string adviceFor(Outcome outcome) {
    if (outcome == Outcome::lost)
        return "The mesh no longer follows the solution: an element has more than three times its share of "
               "the monitor, or nodes met. Try more nodes, shorter steps or a smaller alpha.";
    if (outcome == Outcome::singular)
        return "Nothing says where the nodes are to stand. Try the method multiplier.";
    return {};
}

/// The rule in time is the midpoint one, whatever the column; the others say so.
ChoiceGrid choicesOf(const System&) {
    struct Row {
        const char *heading, *method, *times;
    };
    static constexpr Row rows[] = {{"moving", "multiplier", "fixed"},
                                   {"SEM", "multiplier", "energy"},
                                   {"follows", "explicit", "fixed"},
                                   {"refines", "hierarchical", "fixed"}};
    ChoiceGrid grid;
    for (const char* rule : {"trapezoid", "exact", "auto", "gauss", "gauss"})
        grid.columns.push_back({rule, {}});
    for (const Row& row : rows) {
        std::string description;
        for (std::size_t column = 0; column < grid.columns.size(); ++column) {
            ChoiceGrid::Cell cell;
            cell.discretization.space = {"moving-mesh",
                                         {{"monitor", "arclength"},
                                          {"alpha", "auto"},
                                          {"method", row.method},
                                          {"beta", 1.0},
                                          {"relaxation", 0.1},
                                          {"speed_limit", 1.0},
                                          {"fallback", true},
                                          {"times", row.times},
                                          {"mesh_mass", 0.0}},
                                         {}};
            cell.discretization.quadrature = {grid.columns[column].text, {}, {}};
            const Properties known = describe(cell.discretization);
            cell.id = std::string(row.method) + "." + row.times + "." + std::to_string(column);
            cell.text = known.refusal.empty() ? "∞" : "–";
            if (known.refusal.empty()) cell.superscript = std::to_string(known.claims.order);
            cell.title = std::string("moving mesh, ") + row.method + ", times: " + row.times;
            description = cell.title;
            grid.cells.push_back(std::move(cell));
        }
        grid.rows.push_back({row.heading, description});
    }
    return grid;
}

std::unique_ptr<Integrator> makeIt(const System& system, const Discretization& d, double step) {
    const auto& problem = problemOf(system);
    if (const std::string reason = mismatchOf(d, system); !reason.empty())
        throw InvalidScene("/space", reason, "another boundary, or a mesh at rest");
    if (!problem->hasMovingNodes)
        throw InvalidScene("/space", "the nodes of this field do not move", "a scheme on a mesh of its own");
    MovingMeshOptions options;
    using Method = MovingMeshOptions::Method;
    options.method = isExplicit(d.space)       ? Method::explicitMesh
                     : isHierarchical(d.space) ? Method::hierarchical
                     : isFree(d.space)         ? Method::free
                                               : Method::multiplier;
    options.meshMass = d.space.number("mesh_mass");
    options.hasFallback = d.space.flag("fallback");
    options.hasEnergyTimes = hasEnergyTimes(d.space);
    options.monitor = monitorOf(d.space, problem->elastic.k);
    options.relaxation = d.space.number("relaxation");
    options.speedLimit = d.space.number("speed_limit");
    options.tolerance = d.solver.number("tolerance");
    const double most = d.solver.number("max_iterations");
    options.maxIterations = most > 0 ? static_cast<int>(most) : SolverPolicy{}.maxIterations;
    return makeMovingMesh(problem, options, step);
}

WrittenAction written(const Discretization&) {
    return {
        "u is piecewise linear on nodes X_i that move: values u_i and places X_i are unknowns.",
        {{"S = Σ over slabs of h Σ_i w_i ℒ(u, u_t − u_x X_t, u_x) of the mesh",
          "S = \\sum_{\\text{slabs}} h \\sum_i w_i\\, \\mathcal{L}(u, u_t - u_x X_t, u_x)\\big|_i"}},
        {{"∂S/∂u_i = 0, and the places follow the equation of the mesh, or ∂S/∂X_i = 0 under its constraint",
          "\\frac{\\partial S}{\\partial u_i} = 0, \\qquad \\frac{\\partial S}{\\partial X_i} = "
          "\\text{multiplier of the equation of the mesh}"}}};
}

}  // namespace

Family moving_mesh() {
    Family f;
    f.item = {"moving_mesh",
              "moving mesh",
              "Fields whose nodes move with the solution.",
              {},
              {},
              "a field between two ends"};
    f.source = "Leok 2004, sec. 6";
    f.spaces = {movingMeshSpace()};
    f.takes = Takes::only<ScalarField>();
    f.completeRule = [](const Settings&, const Settings&) {
        return Settings{"auto", {}, {}};  // midpoint in time, four Gauss points for the potential
    };
    f.describe = describeMovingMesh;
    f.check = checkConstraint;
    f.choices = choicesOf;
    f.rules = [](const Settings&) { return std::vector<std::string>{"auto"}; };
    f.written = written;
    f.make = makeIt;
    f.parts.set(SolverMethods{{"banded"}});
    f.parts.set(NodesAlone{});
    f.parts.set(SystemCondition{isMovable});
    f.parts.set(SchemeCondition{mismatchOf});
    f.parts.set(OwnMesh{modelOf});
    f.parts.set(OwnStart{startOf});
    f.parts.set(SmallerSpaces{
        "mesh-nodes",
        [](const Settings& space, const Settings& model) {
            const int whole = space.find("nodes") ? space.integer("nodes") : model.integer("cells") - 1;
            return thinnedSpaces(space, "nodes", whole, fewestNodes, 1);
        },
        [](const Settings& space) { return std::to_string(space.integer("nodes")) + " moving nodes"; }});
    f.parts.set(Variant{});
    f.parts.set(OwnTimeGrid{
        [](const Settings& space) { return hasEnergyTimes(space) ? TimeGrid::free : TimeGrid::fixed; }});
    f.parts.set(Advice{adviceFor});
    f.parts.set(SlowestStep{[](const SchemeCase& scheme) {
        return 5e-3 * std::max(1.0, scheme.system.fieldProblem().size() / 500.0);
    }});
    f.parts.set(SchemeIdentity{
        [](const Discretization& a, double, const Discretization& b) { return a.space == b.space; }});
    return f;
}

}  // namespace extremal::family
