// SPDX-License-Identifier: GPL-3.0-or-later
/// Wave functions: the modes of the model in space, polynomials in time (Leok 2004, sec. 8).
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/family.hpp"
#include "engine/family/parts/advice.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/parts/described_on_system.hpp"
#include "engine/family/parts/meshes.hpp"
#include "engine/family/parts/nodes.hpp"
#include "engine/family/parts/references.hpp"
#include "engine/family/parts/scheme_identity.hpp"
#include "engine/family/parts/smaller_spaces.hpp"
#include "engine/family/parts/solver_methods.hpp"
#include "engine/family/parts/starts.hpp"
#include "engine/family/parts/steps.hpp"
#include "engine/family/rule_choices.hpp"
#include "engine/family/scheme.hpp"
#include "engine/family/wave/chebyshev_series.hpp"
#include "engine/family/wave/wave.hpp"
#include "engine/family/wave/wave_collocation.hpp"
#include "engine/family/wave/wave_three_level.hpp"
#include "engine/model/wave/hamiltonian.hpp"
#include "engine/model/wave/interaction.hpp"
#include "engine/model/wave/start/cloud.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal::family {
namespace {

constexpr int leastModes = 8;

FieldInfo ownModes() {
    FieldInfo modes = integerField("modes", "N", leastModes, 65536, nullptr,
                                   "Number of modes of this scheme alone, even on a periodic domain; over a "
                                   "rectangle along x, along y in proportion; default: those of the model.");
    modes.isOptional = true;
    return modes;
}

/// Fourier in space, polynomials of one degree in time.
SpaceEntry fourier() {
    FieldInfo degree =
        integerField("degree", "s", 1, 16, nullptr, "Degree of the polynomials in time on one step.");
    degree.whyLimits =
        "a curve of degree 0 stands still; above 16 more steps are cheaper than a higher degree";
    SpaceEntry e;
    e.item = {"fourier",
              "Fourier",
              "Wave functions: the modes of the model in space, Fourier or, with Dirichlet boundaries, "
              "Chebyshev, and polynomials in time.",
              {degree,
               jsonField("energy_shift", "energy shift", "Ec", "mean",
                         "Energy counted from here, a choice of gauge: mean (the energy of the start), or a "
                         "number."),
               choiceField("form", "form", {"one-step", "three-level"},
                           "One step with its own momentum, or the three levels of the discrete "
                           "Euler-Lagrange equations (degree 1)."),
               choiceField("start", "start", {"gauss", "variational", "exact"},
                           "First step of the three-level form."),
               ownModes()},
              {},
              "a wave function"};
    return e;
}

/// Fully spectral: polynomials of high degree in time on long slabs.
SpaceEntry spaceTime() {
    FieldInfo degree =
        integerField("degree", "s", 1, 64, nullptr, "Degree of the polynomials in time on one slab.");
    degree.whyLimits =
        "a curve of degree 0 stands still; above 64 more slabs are cheaper than a higher degree";
    SpaceEntry e;
    e.item = {"space-time",
              "space-time",
              "Wave functions, fully spectral: Fourier in space, high degree in time on long slabs.",
              {degree,
               choiceField("time_basis", "time basis", {"legendre", "chebyshev"},
                           "legendre: from the action, at Gauss nodes; chebyshev: collocation at the "
                           "Chebyshev roots."),
               integerField("slabs", "", 1, 1024, 1, "Equal slabs in one step."), ownModes()},
              {},
              "a wave function"};
    return e;
}

bool isThreeLevel(const Settings& space) { return space.text("form") == "three-level"; }

Properties describeThreeLevel(const Settings& space, const Settings& quadrature) {
    Properties p;
    p.space = "lines in time over Fourier modes, in three levels";
    if (space.integer("degree") != 1) {
        p.refusal = "the three-level form has degree 1, got " + std::to_string(space.integer("degree"));
        p.hint = "degree 1, or the one-step form";
        return p;
    }
    if (quadrature.type != "exact" && !isPlainRule(quadrature)) {
        refuseRule(quadrature, p);
        return p;
    }
    const double alpha = threeLevelAlpha(quadrature);
    const bool isExact = alpha == 1.0 / 6,
               isSymmetric = quadrature.type == "exact" || makeRule<double>(quadrature).isSymmetric;
    p.claims = {
        isExact && space.text("start") != "variational" ? 4 : 2, true, true, {"bilinear form"}, false};
    p.curveOrder = p.claims.order;
    p.shortName = "3L" + std::to_string(p.claims.order);
    p.knownAs = isExact ? "Milne-Simpson" : alpha == 0 ? "leapfrog" : "";
    p.isExplicit = alpha == 0;
    p.stabilityLimit = threeLevelLimit(alpha);
    if (!isSymmetric || !(alpha >= 0 && alpha <= 0.25 + 1e-14)) {
        p.refusal =
            "the three-level form takes symmetric rules with a weight of 0 to 1/4 on the outer levels";
        p.hint = "exact, trapezoid or midpoint";
    }
    return p;
}

Properties describeWave(const Discretization& discretization) {
    const auto& [space, quadrature, solver, impact] = discretization;
    if (isThreeLevel(space)) return describeThreeLevel(space, quadrature);
    const int s = space.integer("degree");
    Properties p;
    p.space = "polynomials of degree " + std::to_string(s) + " in time over the modes of the model";
    p.claims = {2 * s, true, true, {"norm", "energy"}};
    p.curveOrder = 2 * s;
    p.shortName = "G" + std::to_string(2 * s);
    p.knownAs = s == 1 ? "Crank-Nicolson" : "";
    p.stabilityLimit = std::numeric_limits<double>::infinity();
    if (space.text("time_basis") == "chebyshev") {
        // The interpolatory rule of s symmetric nodes; as a space it is tested at its own nodes, whatever the
        // rule.
        p.claims = collocationClaims(s);
        p.curveOrder = s;
        p.shortName = "C" + std::to_string(p.claims.order);
    }
    const bool isGauss =
        quadrature.type == "gauss" && quadrature.integer("nodes") == s && quadrature.integer("panels") <= 1;
    if (!isGauss) {
        p.refusal = "the one-step form of degree " + std::to_string(s) + " takes Gauss with " +
                    std::to_string(s) + (s == 1 ? " node" : " nodes");
        p.hint = "quadrature auto";
    }
    return p;
}

Settings completeRule(const Settings& space, const Settings& quadrature) {
    const bool isAutomatic = quadrature.type.empty() || quadrature.type == "auto";
    if (isAutomatic && isThreeLevel(space)) return {"exact", {}, {}};
    return completePlainRule(quadrature, space.integer("degree"), 1);
}

std::string mismatchOf(const Discretization& d, const System& system) {
    if (isThreeLevel(d.space) && hasDirichletBoundary(system))
        return "the three-level form needs a periodic domain";
    return interactionMismatch(system, d);
}

/// Three-level schemes: the limit is known exactly, so a step beyond it is not a doubt but an error.
void checkStep(const SchemeCase& scheme, Findings& findings) {
    if (!isThreeLevel(scheme.discretization.space)) return;
    checkWaveLimit(describe(scheme.discretization).stabilityLimit,
                   waveFrequency(scheme.system, scheme.discretization.space, scheme.initial), scheme.step,
                   scheme.allowsUnstable, findings);
}

/// By Gauss of degree 8; without eigenstates on a rectangle by Chebyshev's series, whose error is the
/// round-off of its products with H: refining steps of an implicit scheme to that would take tens of times as
/// long.
ReferencePlan trusted(const System& system, const State& start, double duration) {
    const Hamiltonian& h = *system.hamiltonian();
    if (h.dimension() == 2 && !h.isTimeDependent() && !isCoupled(system.parts)) {
        ReferencePlan plan;
        constexpr double perStep = 60;
        const double products = duration * (h.highest() - h.lowest()) / (2 * h.hbar());
        plan.step = duration / std::ceil(std::max(1.0, products / perStep));
        plan.expectedError = 1e-15 * (1 + products);
        plan.description = "Chebyshev series";
        plan.make = [hamiltonian = system.hamiltonian()](double step) {
            return makeChebyshevSeries(hamiltonian, step);
        };
        return plan;
    }
    return referenceBy("Gauss of degree 8", system,
                       withShift(*namedScheme("schrodinger-gauss-8"), system, start));
}

/// N even, and at least as many as the model may have.
int evenModes(double modes) { return std::max(leastModes, 2 * static_cast<int>(std::round(modes / 2))); }

/// The model with the modes of the space.
std::optional<Settings> modelOf(const Settings& space, const Settings& model) {
    if (!space.find("modes")) return {};
    const double modes = space.integer("modes"), part = modes / model.integer("modes");
    Settings own = model;
    for (auto& [key, value] : own.keys) {
        if (key == "modes") value = modes;
        if (key == "modes_y") value = static_cast<double>(evenModes(part * model.integer("modes_y")));
    }
    return own;
}

/// The function of the scene at the nodes of the space; a state that belongs to its modes has none.
State ownStart(const System& system, Discretization& d, const Settings& initial, double t) {
    const Value* const psi = initial.find("psi");
    const Value* const name = psi ? psi->find("packet") : nullptr;
    const bool isOfModes =
        psi && (psi->find("values") || wave::isAtRest(*psi) || (name && *name == Value("eigenstate")));
    if (isOfModes && d.space.find("modes"))
        throw InvalidScene("/modes",
                           "the scene starts from a state of its own modes, which is known on no others",
                           "no modes here, or a packet that is a function of x");
    return {t, 0, system.start(initial, t), {}};
}

std::vector<SmallerSpace> fewerModes(const Settings& space, const Settings& model) {
    const int whole = space.find("modes") ? space.integer("modes") : model.integer("modes");
    return thinnedSpaces(space, "modes", whole, leastModes, 2);
}

/// 0: those of the model.
int modesIn(const Settings& space) { return space.find("modes") ? space.integer("modes") : 0; }

ChoiceGrid choices(const System& system) {
    const bool isPeriodic = !hasDirichletBoundary(system);
    const auto row = [&](int degree, const char* form) -> SpaceRow {
        const bool isOneStep = std::string(form) == "one-step";
        const std::string name = !isOneStep ? "3-level" : isPeriodic ? "Fourier" : "modes";
        return {name + " " + std::to_string(degree),
                isOneStep ? "" : "three-level",
                {"fourier",
                 {{"degree", static_cast<double>(degree)},
                  {"energy_shift", "mean"},
                  {"form", form},
                  {"start", "gauss"}},
                 {}}};
    };
    std::vector<SpaceRow> rows;
    for (const int degree : {1, 2, 3, 4, 6, 8, 12}) rows.push_back(row(degree, "one-step"));
    if (isCoupled(system.parts)) return ruleChoices(rows);
    if (isPeriodic) rows.push_back(row(1, "three-level"));
    for (const int degree : {16, 32})
        rows.push_back(
            {"slab " + std::to_string(degree),
             "space-time",
             {"space-time",
              {{"degree", static_cast<double>(degree)}, {"time_basis", "legendre"}, {"slabs", 1.0}},
              {}}});
    return ruleChoices(rows, {"exact"});
}

WrittenAction written(const Discretization&) {
    return {"ψ is a polynomial in time whose coefficients are functions of the modes in space.",
            {{"S = Σ_i b_i Re⟨ψ(c_i), iħ ψ′(c_i) − h H ψ(c_i)⟩",
              "S = \\sum_i b_i \\operatorname{Re} \\bigl\\langle \\psi(c_i),\\; i\\hbar\\, \\psi'(c_i) - h H "
              "\\psi(c_i) \\bigr\\rangle"}},
            {{"Σ_i b_i φ_a(c_i) (iħ ψ′(c_i) − h H ψ(c_i)) = 0;  of Gauss’s rule ψ_1 = R_s(−i h H/ħ) ψ_0, R_s "
              "the diagonal Padé quotient of exp",
              "\\sum_i b_i\\, \\varphi_a(c_i) \\bigl( i\\hbar\\, \\psi'(c_i) - h H \\psi(c_i) \\bigr) = 0"}}};
}

}  // namespace

Family wave() {
    Family f;
    f.item = {"wave", "wave function", "Modes in space, polynomials in time.", {}, {}, "a wave function"};
    f.source = "Leok 2004, sec. 8";
    f.spaces = {fourier(), spaceTime()};
    f.takes = Takes::only<Wave, Interaction, Rotation>();
    f.completeRule = completeRule;
    f.describe = describeWave;
    f.check = checkStep;
    f.choices = choices;
    f.rules = [](const Settings& space) {
        return isThreeLevel(space) ? std::vector<std::string>{"exact", "trapezoid", "midpoint", "lobatto"}
                                   : std::vector<std::string>{"gauss"};
    };
    f.written = written;
    f.make = makeWaveIntegrator;
    f.parts.set(SolverMethods{{"banded", "dense", "krylov"}});
    f.parts.set(NodesAlone{});
    f.parts.set(SchemeCondition{mismatchOf});
    f.parts.set(StartEstimate{withShift});
    f.parts.set(OwnMesh{modelOf});
    f.parts.set(OwnStart{ownStart});
    f.parts.set(SmallerSpaces{"modes", fewerModes, textOfModes});
    f.parts.set(
        DescribedOnSystem{[](const Discretization& d, const System& system) -> std::optional<Properties> {
            if (!isCoupled(system.parts)) return {};
            Properties p = describe(d);
            p.claims.conserves = {"norm"};  // the energy is bounded
            return p;
        }});
    f.parts.set(SlowestStep{[](const SchemeCase& scheme) {
        return 5e-3 * std::max(1.0, scheme.system.hamiltonian()->size() / 1024.0);
    }});
    f.parts.set(Advice{[](Outcome outcome) -> std::string {
        if (outcome != Outcome::notFinite) return {};
        return "Beyond its stability limit a three-level scheme grows without bound. Try a smaller step.";
    }});
    f.parts.set(TrustedScheme{trusted});
    f.parts.set(SchemeIdentity{[](const Discretization& a, double, const Discretization& b) {
        return a.space.type == b.space.type && a.space.integer("degree") == b.space.integer("degree") &&
               a.space.text("form") == b.space.text("form") &&
               a.space.text("time_basis") == b.space.text("time_basis") &&
               a.space.integer("slabs") == b.space.integer("slabs") && modesIn(a.space) == modesIn(b.space) &&
               a.quadrature == b.quadrature;
    }});
    return f;
}

}  // namespace extremal::family
