/// Moving meshes: fields whose nodes are unknowns, spatio-temporally adaptive (Leok 2004, sec. 6).
#include "engine/family/family.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/problem.hpp"
#include "engine/core/text.hpp"
#include "engine/family/moving_mesh/moving_mesh.hpp"
#include "engine/family/moving_mesh/placement.hpp"
#include "engine/model/field/field_system.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal::family {
namespace {

SpaceEntry movingMeshSpace() {
    SpaceEntry e;
    FieldInfo nodes = integerField("nodes", "N", 3, 1e6, nullptr,
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
    e.item = {"moving-mesh",
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
                         "taken explicitly, as are those after it; else the run ends there."),
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

bool isMovable(const System& system) {
    if (!isField(system)) return false;
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
    return std::get<ScalarField>(system.kind).problem;
}

/// With alpha as a number.
State startOf(const System& system, Discretization& d, const Settings& initial, double t) {
    const NodeSpace space(problemOf(system));
    const FieldProfile profile = fieldProfile(initial, *space.problem, t);
    if (!profile.at)
        throw InvalidScene("", "a moving mesh places its own nodes, and the initial data are given at nodes",
                           "a profile, or u and u_t as expressions");
    const ProfileTable table(profile, space.problem->mesh, t);
    Monitor monitor = monitorOf(d.space, space.c2);
    for (auto& [key, value] : d.space.keys)
        if (key == "alpha" && !value.isNumber())
            value = monitor.alpha = automaticAlpha(monitor, table.x, table.u);
    State state;
    state.t = t;
    state.x = isHierarchical(d.space) ? startOnDyadicMesh(space, monitor, profile, table, t)
              : isExplicit(d.space)   ? startAtRest(space, monitor, profile, table, t)
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
    p.claims.order = isGiven ? 1 : 2;
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
    options.monitor = monitorOf(d.space, problem->elastic.k);
    options.relaxation = d.space.number("relaxation");
    options.speedLimit = d.space.number("speed_limit");
    options.tolerance = d.solver.number("tolerance");
    const double most = d.solver.number("max_iterations");
    options.maxIterations = most > 0 ? static_cast<int>(most) : SolverPolicy{}.maxIterations;
    return makeMovingMesh(problem, options, step);
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
    f.solverMethods = {"banded"};
    f.hasDenseOutput = false;
    f.applies = isMovable;
    f.mismatch = mismatchOf;
    f.model = modelOf;
    f.start = startOf;
    f.completeRule = [](const Settings&, const Settings&) {
        return Settings{"auto", {}, {}};  // midpoint in time, four Gauss points for the potential
    };
    f.describe = describeMovingMesh;
    f.frequency = [](const Discretization&, const System&, const State&) { return 0.0; };
    f.slowestStep = [](const System& system) {
        return 5e-3 * std::max(1.0, system.fieldProblem().size() / 500.0);
    };
    f.rules = [](const Settings&) { return std::vector<std::string>{"auto"}; };
    f.isSame = [](const Discretization& a, double, const Discretization& b) { return a.space == b.space; };
    f.make = makeIt;
    return f;
}

}  // namespace extremal::family
