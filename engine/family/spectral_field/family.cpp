// SPDX-License-Identifier: GPL-3.0-or-later
/// Spectral fields, over an interval or a rectangle: trigonometric polynomials in space, polynomials in time
/// (Leok 2004, sec. 8, for the fields of sec. 2.1).
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/family.hpp"
#include "engine/family/fourier_space.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/parts/meshes.hpp"
#include "engine/family/parts/nodes.hpp"
#include "engine/family/parts/references.hpp"
#include "engine/family/parts/scheme_identity.hpp"
#include "engine/family/parts/smaller_spaces.hpp"
#include "engine/family/parts/steps.hpp"
#include "engine/family/rule_choices.hpp"
#include "engine/family/modal_step.hpp"
#include "engine/model/field/field_system.hpp"
#include "engine/model/plane_field/problem.hpp"
#include "engine/model/plane_field/settings.hpp"

namespace extremal::family {
namespace {

constexpr int mostDegree = 12;

SpaceEntry fourierField() {
    FieldInfo degree =
        integerField("degree", "s", 1, mostDegree, nullptr, "Degree of the polynomials in time on one step.");
    degree.whyLimits =
        "a curve of degree 0 stands still; above 12 more steps are cheaper than a higher degree";
    FieldInfo modes = integerField("modes", "N", leastModes, mostModes, nullptr,
                                   "Number of modes, and of nodes; default: the cells of the model.");
    modes.isOptional = true;
    SpaceEntry e;
    e.item = {"fourier-field",
              "Fourier modes of a field",
              "Periodic fields: trigonometric polynomials in space, polynomials in time. Spectral in space, "
              "order 2s in time, stable for every step.",
              {degree, modes,
               jsonField("nodes", "nodes", "M", Value("same"),
                         "Nodes of the sum for the integral of W(u): same (as many as modes), exact (as many "
                         "as make it exact for the polynomial W, so that momentum is conserved), or a number "
                         "that is not below the modes.")},
              {},
              "a periodic field"};
    return e;
}

/// The degree of W as a polynomial; 0: it is none.
int degreeOf(const System& system) {
    const auto* const plane = system.parts.find<PlaneField>();
    return plane ? plane->problem->potential().degree() : system.fieldProblem().potential.degree();
}

/// M of the key `nodes`, along an axis with these modes; 0: it cannot be.
int nodesOf(const Settings& space, int modes, int degree) {
    const Value* const nodes = space.find("nodes");
    if (!nodes || *nodes == Value("same")) return modes;
    if (*nodes == Value("exact")) return std::max(modes, (degree * modes + 1) / 2);
    const double number = nodes->isNumber() ? nodes->asNumber() : 0;
    const bool isPossible = number >= modes && number <= 8.0 * mostModes && number == std::round(number);
    return isPossible ? static_cast<int>(number) : 0;
}

/// What of the key `nodes` no field can have.
std::string refusalOfNodes(const Settings& space) {
    const Value* const nodes = space.find("nodes");
    if (!nodes || *nodes == Value("same") || *nodes == Value("exact")) return {};
    const double number = nodes->isNumber() ? nodes->asNumber() : 0;
    const double least = std::max(leastModes, space.integer("modes"));
    if (number >= least && number <= 8.0 * mostModes && number == std::round(number)) return {};
    return "nodes must be \"same\", \"exact\" or a whole number from that of the modes to " +
           std::to_string(8 * mostModes);
}

Properties describeSpectral(const Discretization& d) {
    const int s = d.space.integer("degree");
    Properties p;
    p.space = "trigonometric polynomials in space, of degree " + std::to_string(s) + " in time";
    p.claims = {2 * s, true, true, {"momentum"}};
    p.curveOrder = 2 * s;
    p.shortName = "F" + std::to_string(2 * s);
    p.prefix = "Fourier ";
    p.remark = "order " + std::to_string(2 * s) + " in time, spectral in space, stable at every step";
    p.stabilityLimit = std::numeric_limits<double>::infinity();
    if (!isPlainRule(d.quadrature)) {
        refuseRule(d.quadrature, p);
        return p;
    }
    const bool isGauss = d.quadrature.type == "gauss" && d.quadrature.integer("nodes") == s &&
                         d.quadrature.integer("panels") <= 1;
    if (!isGauss) {
        p.refusal = "Fourier modes of degree " + std::to_string(s) + " in time take Gauss with " +
                    std::to_string(s) + (s == 1 ? " node" : " nodes") + " in time";
        p.hint = "quadrature auto";
        return p;
    }
    p.refusal = refusalOfNodes(d.space);
    if (p.refusal.empty()) return p;
    p.place = "/space/nodes";
    p.hint = "\"same\", \"exact\" or twice the number of modes";
    return p;
}

/// Whether W is a polynomial, where `exact` asks for it.
std::optional<Problem> refusalOfExact(const Settings& space, int degree) {
    const Value* const nodes = space.find("nodes");
    if (!nodes || *nodes != Value("exact") || degree > 0) return {};
    return Problem{"/space/nodes",
                   "exact is for W(u) that is a polynomial of degree 12 or less, and that of this model is "
                   "not",
                   "\"same\", or a number of nodes"};
}

/// Fewer nodes than modes.
std::optional<Problem> refusalOfFewNodes(const Settings& space, int modes, int degree) {
    if (nodesOf(space, modes, degree) > 0) return {};
    return Problem{"/space/nodes", "must be at least the number of modes, " + std::to_string(modes),
                   std::to_string(2 * modes)};
}

std::optional<Problem> refusalOf(const Discretization& d, const PlaneFieldProblem& problem) {
    const bool isLine = problem.grid().dimension() == 1;
    if (!isLine && d.space.find("modes") && d.space.integer("modes") > 0)
        return Problem{"/space/modes",
                       "is for the line: over a rectangle the nodes of the model are the modes",
                       "cells and cells_y of the model"};
    if (const Value* nodes = d.space.find("nodes"); !isLine && nodes && nodes->isNumber())
        return Problem{"/space/nodes", "must be \"same\" or \"exact\" over a rectangle", "same"};
    if (const auto refusal = refusalOfExact(d.space, problem.potential().degree())) return refusal;
    return refusalOfFewNodes(d.space, problem.grid().nx, problem.potential().degree());
}

/// Why a field cannot have the modes; nothing where it can.
std::optional<Problem> refusalOf(const Discretization& d, const FieldProblem& problem) {
    if (const auto refusal = modesProblem(problem)) return refusal;
    if (const auto refusal = refusalOfExact(d.space, problem.potential.degree())) return refusal;
    return refusalOfFewNodes(d.space, problem.size(), problem.potential.degree());
}

std::optional<Problem> refusalOf(const Discretization& d, const System& system) {
    if (const auto* const plane = system.parts.find<PlaneField>()) return refusalOf(d, *plane->problem);
    return refusalOf(d, system.fieldProblem());
}

std::string mismatchOf(const Discretization& d, const System& system) {
    const auto refusal = refusalOf(d, system);
    return refusal ? refusal->message : std::string();
}

/// Of fields over rectangles, which have no other trusted scheme: degree 6, with steps that turn the fastest
/// wave of the mesh by two at first.
ReferencePlan trusted(const System& system, const State&, double duration) {
    const auto* const plane = system.parts.find<PlaneField>();
    if (!plane) return {};
    constexpr double mostUpdatesOfNodes = 5e7, fewestSteps = 5;
    Discretization d;
    d.space = {"fourier-field", {{"degree", 6.0}, {"nodes", "same"}}, {}};
    d.quadrature = completePlainRule({}, 6, 1);
    ReferencePlan plan = referenceBy("Fourier modes with Gauss of degree 6", system, d);
    const PlaneFieldProblem& problem = *plane->problem;
    const wave::Grid& grid = problem.grid();
    const double shortest =
        std::numbers::pi * std::hypot(grid.nx / grid.x.length, grid.ny > 1 ? grid.ny / grid.y.length : 0);
    double speed = 0;
    for (std::size_t c = 0; c < problem.components(); ++c) speed = std::max(speed, problem.speed(c));
    plan.firstStep = std::min(duration / fewestSteps, 2 / (speed * shortest));
    plan.mostSteps = mostUpdatesOfNodes / static_cast<double>(problem.size());
    return plan;
}

ChoiceGrid choices(const System& system) {
    ChoiceGrid grid;
    grid.subtitle = "nodes × degree in time";
    const bool isPolynomial = degreeOf(system) > 2;
    for (const int s : {1, 2, 3, 4, 6, 8})
        grid.columns.push_back({"G " + std::to_string(s), "degree " + std::to_string(s) + " in time"});
    for (const char* nodes : {"same", "exact"}) {
        if (std::string(nodes) == "exact" && !isPolynomial) continue;
        grid.rows.push_back({std::string("Fourier, ") + nodes, std::string("nodes: ") + nodes});
        for (const int s : {1, 2, 3, 4, 6, 8}) {
            ChoiceGrid::Cell cell;
            cell.discretization.space = {
                "fourier-field", {{"degree", static_cast<double>(s)}, {"nodes", nodes}}, {}};
            cell.discretization.quadrature = completePlainRule({}, s, 1);
            cell.id = std::string("fourier.") + nodes + "." + std::to_string(s);
            cell.text = "∞";
            cell.superscript = std::to_string(2 * s);
            cell.title = "Fourier modes in space × Gauss " + std::to_string(s) + " in time";
            grid.cells.push_back(std::move(cell));
        }
    }
    return grid;
}

WrittenAction written(const Discretization&) {
    return {"u is a trigonometric polynomial in space whose coefficients are polynomials in time.",
            {{"S = Σ_i b_i h [ ‖u_t‖² / 2 − c² ‖u_x‖² / 2 − Σ_m (L/M) W(u(x_m)) ] at t + c_i h",
              "S = \\sum_i b_i h \\Bigl[ \\tfrac12 \\|u_t\\|^2 - \\tfrac12 c^2 \\|u_x\\|^2 - \\sum_m "
              "\\tfrac{L}{M} W\\bigl(u(x_m)\\bigr) \\Bigr]_{t + c_i h}"}},
            {{"u_i = u + c_i h u_t + h² Σ_j (A²)_ij f_j,  f = c² u_xx − P W′(u)",
              "u_i = u + c_i h\\, u_t + h^2 \\sum_j (A^2)_{ij} f_j, \\quad f = c^2 u_{xx} - P W'(u)"}}};
}

std::unique_ptr<Integrator> makeSpectral(const System& system, const Discretization& d, double step) {
    if (const auto refusal = refusalOf(d, system)) throw InvalidScene({*refusal});
    if (const auto* const field = system.parts.find<ScalarField>(); field && !field->problem->isTrigonometric)
        throw InvalidScene("/space", "Fourier modes are for the models field and field-2d", "another space");
    const SpectralDomain domain = spectralDomainOf(system);
    SpectralScheme scheme;
    scheme.degree = d.space.integer("degree");
    const int degreeOfW = domain.potential.degree();
    scheme.nodes = nodesOf(d.space, domain.nx, degreeOfW);
    scheme.nodesY = nodesOf(d.space, domain.ny, degreeOfW);
    scheme.solver.tolerance = d.solver.number("tolerance");
    scheme.solver.maxIterations = d.solver.integer("max_iterations");
    return makeSpectralField(domain, scheme, step);
}

}  // namespace

Family spectral_field() {
    Family f;
    f.item = {"spectral_field",  "spectral field", "Fourier modes in space, polynomials in time.", {}, {},
              "a periodic field"};
    f.source = "Leok 2004, sec. 8";
    f.spaces = {fourierField()};
    f.takes = Takes::only<ScalarField, PlaneField>();
    f.completeRule = [](const Settings& space, const Settings& quadrature) {
        return completePlainRule(quadrature, space.integer("degree"), 1);
    };
    f.describe = describeSpectral;
    f.check = [](const SchemeCase&, Findings&) {};
    f.choices = choices;
    f.rules = [](const Settings&) { return std::vector<std::string>{"gauss"}; };
    f.written = written;
    f.make = makeSpectral;
    f.parts.set(TrustedScheme{trusted});
    f.parts.set(NodesAlone{});
    f.parts.set(SystemCondition{isForModes});
    f.parts.set(SchemeCondition{mismatchOf});
    f.parts.set(OwnMesh{trigonometricModel});
    f.parts.set(SmallerSpaces{"modes", fewerModes, textOfModes});
    f.parts.set(SlowestStep{[](const SchemeCase& scheme) {
        return 5e-3 *
               std::max(1.0, spectralDomainOf(scheme.system).nx * spectralDomainOf(scheme.system).ny / 256.0);
    }});
    f.parts.set(SchemeIdentity{[](const Discretization& a, double, const Discretization& b) {
        return a.space == b.space && a.quadrature == b.quadrature;
    }});
    return f;
}

}  // namespace extremal::family
