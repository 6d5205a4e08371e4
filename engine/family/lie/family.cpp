// SPDX-License-Identifier: GPL-3.0-or-later
/// Lie group variational integrators of rigid bodies: curves g_0 exp(xi), xi a polynomial in the algebra
/// (Leok 2004, sec. 3 and 4).
#include <array>
#include <cmath>
#include <limits>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/family.hpp"
#include "engine/family/lie/lie.hpp"
#include "engine/family/lie/quaternion_step.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/parts/references.hpp"
#include "engine/family/parts/solver_methods.hpp"
#include "engine/family/rule_choices.hpp"
#include "engine/family/scheme.hpp"
#include "engine/family/table_properties.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/model/group/spheres.hpp"

namespace extremal::family {
namespace {

SpaceEntry liePolynomial() {
    SpaceEntry e;
    FieldInfo base = numberField("base", "base point", "", 0,
                                 "Where on the step the curve meets the base point of the chart, in steps "
                                 "from its start on: in the middle the scheme is symmetric.");
    base.symbol = "ν";
    base.min = 0;
    base.max = 1;
    base.whyLimits = "0 is the start of the step, 0.5 its middle, 1 its end";
    e.item = {
        "lie-polynomial",
        "Lie polynomial",
        "Polynomials in the algebra of a Lie group, carried to the group by exp in the chart at a point of "
        "each step.",
        {integerField("degree", "s", 1, 8, nullptr, "Degree of the polynomials in the algebra on one step."),
         flagField("symmetric", false,
                   "Half a step of the adjoint scheme first: self-adjoint at every degree."),
         base,
         flagField("reduced", true,
                   "Free bodies: leave the attitude out of the equations (discrete Euler-Poincaré).")},
        {},
        "a rigid body, a Lie group or points on spheres"};
    return e;
}

bool isInQuaternions(const Settings& space) { return space.type == "quaternion-polynomial"; }

SpaceEntry quaternionPolynomial() {
    SpaceEntry e;
    e.item = {
        "quaternion-polynomial",
        "quaternion polynomial",
        "Polynomials in the quaternion of a free body, whose momentum is constant: first order, and many "
        "times cheaper a step.",
        {integerField("degree", "s", 1, 8, nullptr, "Degree of the quaternion on one step.")},
        {},
        "a free rigid body"};
    return e;
}

Properties describeQuaternions(const Discretization& d) {
    const int s = d.space.integer("degree");
    Properties p;
    if (d.quadrature.type != "gauss" || d.quadrature.integer("nodes") != s ||
        d.quadrature.integer("panels") > 1) {
        p.refusal = "polynomials of degree " + std::to_string(s) + " in the quaternion take Gauss with " +
                    std::to_string(s) + (s == 1 ? " node" : " nodes") +
                    ": no other rule keeps its length and the form";
        p.hint = "gauss with nodes " + std::to_string(s);
    } else {
        p = describeTable([&] { return lieTable(d.space, d.quadrature); });
        p.stabilityLimit = std::numeric_limits<double>::infinity();
    }
    p.space = "polynomials of degree " + std::to_string(s) + " in the quaternion";
    p.prefix = "quaternion ";
    p.shortName = p.refusal.empty() ? "Q" + std::to_string(p.claims.order) : "-";
    return p;
}

/// Order, exactness and refusals are those of the polynomials that xi is made of.
Properties describeLie(const Discretization& discretization) {
    const auto& [space, quadrature, solver, impact] = discretization;
    if (isInQuaternions(space)) return describeQuaternions(discretization);
    Properties p;
    if (isPlainRule(quadrature)) {
        p = describeTable([&d = discretization] { return lieTable(d.space, d.quadrature); });
    } else {
        refuseRule(quadrature, p);
    }
    p.space = "polynomials of degree " + std::to_string(space.integer("degree")) + " in the algebra";
    p.prefix = "Lie ";
    // A limit of the oscillator says nothing of a rotating body.
    if (p.stabilityLimit > 0) p.stabilityLimit = std::numeric_limits<double>::infinity();
    if (space.flag("symmetric")) {
        // A step after its adjoint is its own adjoint, whatever the rule; and then the order is even.
        p.claims.isSymmetric = true;
        p.claims.order += p.claims.order % 2;
    } else {
        // A chart that is not in the middle of the step is seen from one side; but a curve of degree 1 has
        // the same charts everywhere.
        p.claims.isSymmetric =
            p.claims.isSymmetric && (space.integer("degree") == 1 || space.number("base") == middleOfStep);
    }
    p.shortName = p.refusal.empty() ? "Lie" + std::to_string(p.claims.order) : "-";
    return p;
}

/// A left-invariant Lagrangian that is typed says itself that g is not in the equations.
std::string mismatchOf(const Discretization& d, const System& system) {
    if (isInQuaternions(d.space)) {
        if (d.solver.type == "newton")
            return "equations in the quaternion are solved by fixed-point iteration: leave \"method\" out";
        return quaternionProblem(system);
    }
    if (d.space.flag("reduced") || system.parts.find<Body>()) return {};
    return "g is in the equations of a typed Lagrangian where it occurs in its formula, and nowhere else: "
           "leave \"reduced\" out";
}

/// Steps of a body that rotate it so far that the attitude may lose a thousandth of what it rotates. Measured
/// over 60 rad on free bodies and a top with Gauss(s): 1e-3 is reached between 1.25 and 1.5 at degree 2, 2.25
/// and 2.5 at 3, 3 and 3.5 at 4. Newton's method goes on finding solutions up to about 4. A symmetric scheme
/// takes two half steps.
void checkRotation(const SchemeCase& scheme, Findings& findings) {
    constexpr std::array<double, 3> farthest = {1.25, 2.25, 3};  // of degrees 2, 3, 4
    const Settings& space = scheme.discretization.space;
    const int degree = space.integer("degree");
    if (!scheme.system.parts.find<Body>() || isInQuaternions(space)) return;
    if (scheme.isComposed || degree < 2 || degree > 4) return;
    const std::vector<double>& x = scheme.initial.x;
    double rate = 0;
    for (std::size_t i = 0; i < 3; ++i) rate = std::hypot(rate, x[4 + i] / scheme.system.body().inertia[i]);
    const double limit = farthest[static_cast<std::size_t>(degree - 2)] * (space.flag("symmetric") ? 2 : 1),
                 h = scheme.step;
    if (!(h * rate > limit) || !std::isfinite(h * rate)) return;
    const double perUnit = std::pow(10, 1 - std::floor(std::log10(limit / rate)));  // two digits
    const double usual = std::floor(limit / rate * perUnit) / perUnit;
    findings.warning("/step",
                     formatNumber(h) + " rotates the body by " + formatNumber(h * rate, 3) +
                         " rad per step initially: beyond " + formatNumber(limit, 3) +
                         " rad a scheme of degree " + std::to_string(degree) +
                         " may have a relative error of a thousandth or more",
                     "a higher degree, or the step " + formatNumber(usual, 2), usual, "body-step");
}

ReferencePlan trusted(const System& system, const State&, double) {
    return referenceBy("Lie group Gauss of degree 8", system, *namedScheme("lie-8"));
}

ChoiceGrid choices(const System& system) {
    std::vector<SpaceRow> rows;
    for (const int degree : {1, 2, 3, 4, 6, 8})
        rows.push_back({"Lie " + std::to_string(degree), "", lieSpace(degree)});
    for (const int degree : {2, 3, 4})
        rows.push_back(
            {"Lie " + std::to_string(degree) + ", centred", "c", lieSpace(degree, false, middleOfStep)});
    if (quaternionProblem(system).empty())
        for (const int degree : {2, 3, 4, 6, 8})
            rows.push_back({"quaternion " + std::to_string(degree),
                            "q",
                            {"quaternion-polynomial", {{"degree", static_cast<double>(degree)}}, {}}});
    return ruleChoices(rows);
}

WrittenAction written(const Discretization& d) {
    if (isInQuaternions(d.space))
        return {
            "q(τ) is a polynomial of degree s in the quaternions with q(0) = q_0; π, the momentum in space, "
            "is "
            "constant, and μ = q* π q is that in the body.",
            {{"S = h Σ_i b_i [2 Re(i z_i⁺ z_i′) − H(μ_i)],  H(μ) = μ·I⁻¹μ / 2,  z the spinor of q",
              "S = h \\sum_i b_i \\bigl[ 2 \\operatorname{Re}(i z_i^+ z_i') - H(\\mu_i) \\bigr], \\qquad "
              "H(\\mu) = "
              "\\tfrac12 \\mu \\cdot I^{-1} \\mu"}},
            {{"q_i′ = q_i (0, I⁻¹ μ_i) / 2 at the nodes",
              "q_i' = \\tfrac12\\, q_i\\, (0, I^{-1} \\mu_i) \\quad \\text{at the nodes}"}}};
    const bool isAtStart = d.space.number("base") == 0;
    return {
        isAtStart ? "The curve is g(τ) = g_0 exp(ξ(τ)), ξ a polynomial in the Lie algebra with ξ(0) = 0; its "
                    "coefficients are the unknowns."
                  : "The curve is g(τ) = g_ν exp(ξ(τ)), ξ a polynomial in the Lie algebra with ξ(ν) = 0; its "
                    "coefficients are the unknowns, and g_ν = g_0 exp(ξ(0))⁻¹.",
        {{"S = h Σ_i b_i L(g(c_i), Ω(c_i)),  Ω = dexp_{−ξ}(ξ′) / h",
          "S = h \\sum_i b_i\\, L\\bigl(g(c_i), \\Omega(c_i)\\bigr), \\qquad \\Omega = \\tfrac1h "
          "\\operatorname{dexp}_{-\\xi}(\\xi')"}},
        {{isAtStart ? "Σ_i b_i (h φ_a(c_i) ∂L/∂ξ + φ_a′(c_i) ∂L/∂ξ′) = 0 of interior φ_a, and the momentum "
                      "at both ends for the last"
                    : "Σ_i b_i (h φ_a(c_i) ∂L/∂ξ + φ_a′(c_i) ∂L/∂ξ′) = [φ_a p] at the ends, for φ_a that are "
                      "0 at ν",
          isAtStart
              ? "\\sum_i b_i \\Bigl( h\\, \\varphi_a(c_i) \\frac{\\partial L}{\\partial \\xi} + "
                "\\varphi_a'(c_i) \\frac{\\partial L}{\\partial \\xi'} \\Bigr) = 0 \\quad (a < m), \\qquad "
                "p_1 = "
                "\\frac{\\partial S}{\\partial g_1}"
              : "\\sum_i b_i \\Bigl( h\\, \\varphi_a(c_i) \\frac{\\partial L}{\\partial \\xi} + "
                "\\varphi_a'(c_i) \\frac{\\partial L}{\\partial \\xi'} \\Bigr) = \\bigl[ \\varphi_a\\, p "
                "\\bigr]_0^1, \\qquad \\varphi_a(\\nu) = 0"}}};
}

/// What a discretization cannot do on a system is refused where its steps are made, whoever asks for them.
std::unique_ptr<Integrator> makeChecked(const System& system, const Discretization& d, double step) {
    if (const std::string problem = mismatchOf(d, system); !problem.empty()) {
        if (!isInQuaternions(d.space)) throw InvalidScene("/space/reduced", problem, "leave it out");
        if (d.solver.type == "newton") throw InvalidScene("/solver/method", problem, "auto");
        throw InvalidScene("/space/type", problem, "lie-polynomial");
    }
    return makeLieIntegrator(system, d, step);
}

}  // namespace

Family lie() {
    Family f;
    f.item = {
        "lie", "Lie group", "Curves on Lie groups: SO(3), SE(3), or any given by a basis; and on spheres.",
        {},    {},          "a rigid body, a Lie group or points on spheres"};
    f.source = "Leok 2004, sec. 3 and 4";
    f.spaces = {liePolynomial(), quaternionPolynomial()};
    f.takes = Takes::only<Body, LieGroup, Spheres>();
    f.completeRule = [](const Settings& space, const Settings& quadrature) {
        return completePlainRule(quadrature, space.integer("degree"), 1);
    };
    f.describe = describeLie;
    f.check = checkRotation;
    f.choices = choices;
    f.rules = [](const Settings& space) {
        return isInQuaternions(space) ? std::vector<std::string>{"gauss"} : plainRules();
    };
    f.written = written;
    f.make = makeChecked;
    f.parts.set(SolverMethods{{"newton"}});
    f.parts.set(TrustedScheme{trusted});
    f.parts.set(SchemeCondition{mismatchOf});
    return f;
}

}  // namespace extremal::family
