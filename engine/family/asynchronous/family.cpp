// SPDX-License-Identifier: GPL-3.0-or-later
/// Asynchronous variational integrators: each element of a bar or a membrane has its own step (Leok 2004,
/// sec. 2.1).
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/asynchronous/steps.hpp"
#include "engine/family/family.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/parts/element_steps.hpp"
#include "engine/family/parts/nodes.hpp"
#include "engine/family/parts/scheme_identity.hpp"
#include "engine/family/parts/steps.hpp"

namespace extremal::family {
namespace {

SpaceEntry asynchronousSpace() {
    SpaceEntry e;
    FieldInfo courant = positive("courant", "Courant number", "", 0.5,
                                 "Step of an element over its critical step, at most 1.");
    courant.symbol = "C";
    courant.max = 1;
    courant.whyLimits = "beyond 1 an element alone is unstable";
    e.item = {
        "asynchronous",
        "asynchronous",
        "Linear elements with steps of their own, by dyadic levels or real numbers.",
        {choiceField("levels", "levels", {"dyadic", "real", "synchronous"},
                     "dyadic: steps are a power of two times the smallest; real: proportional to the size "
                     "of the element, which resonates; synchronous: the smallest for all."),
         courant, flagField("balance", true, "No element has more than twice the step of a neighbour.")},
        {},
        "an elastic bar or a membrane"};
    return e;
}

bool isReal(const Settings& space) { return space.text("levels") == "real"; }
bool isSynchronous(const Settings& space) { return space.text("levels") == "synchronous"; }

/// use(elements) with those of the system.
template <class Use>
auto withElements(const System& system, Use&& use) {
    if (const Membrane* const membrane = system.parts.find<Membrane>())
        return use(MembraneElements(membrane->problem));
    return use(BarElements(system.part<ScalarField>().problem));
}

bool hasElements(const System& system) {
    if (system.parts.find<Membrane>()) return true;
    const ScalarField* const field = system.parts.find<ScalarField>();
    return field && field->problem->isBody;
}

Levels levelsOf(const System& system, const Settings& space) {
    Levels levels = withElements(system, [&](const auto& elements) {
        return elements.levels(space.number("courant"), space.flag("balance"));
    });
    // States are as far from each other as those of dyadic levels.
    if (isSynchronous(space)) std::fill(levels.level.begin(), levels.level.end(), 0);
    return levels;
}

Properties describeAsynchronous(const Discretization& d) {
    Properties p;
    const bool real = isReal(d.space);
    p.space = "linear elements with steps of their own";
    p.claims = {2, !real, true, {"momentum"}, !real};
    p.curveOrder = 2;
    p.shortName = real ? "real" : isSynchronous(d.space) ? "LF" : "2:1";
    p.knownAs = std::string("asynchronous, ") + (real                      ? "real steps"
                                                 : d.space.flag("balance") ? "dyadic 2:1"
                                                                           : "dyadic");
    if (isSynchronous(d.space)) p.knownAs = "leapfrog";
    p.stabilityLimit = std::numeric_limits<double>::infinity();
    if (real)
        p.caution = "has real-valued steps, which resonate with each other: its energy grows over long times";
    p.remark = real                     ? "steps beat with each other; a warning example"
               : isSynchronous(d.space) ? "order 2, the smallest step for all elements"
                                        : "order 2, steps by powers of two";
    return p;
}

/// Of dyadic levels the largest step, after which all elements are at one time; of real steps the same for
/// comparison.
std::optional<ImpliedStep> impliedStep(const Settings& space, const Settings& model, const ParameterValue&) {
    const ModelEntry* entry = findModel(model.type);
    if (!entry) return {};
    const System system = entry->make(model);
    if (!system.parts.find<ScalarField>() && !system.parts.find<Membrane>()) return {};
    return ImpliedStep{levelsOf(system, space).largest(), {}, !isReal(space)};
}

/// How often elements are updated in one step of this length.
double updatesIn(const Levels& levels, double step) {
    double updates = 0;
    for (std::size_t e = 0; e < levels.level.size(); ++e)
        updates += std::abs(step) / levels.step(static_cast<int>(e));
    return updates;
}

/// A step of the scheme is one row, and is computed as a whole.
void checkUpdates(const SchemeCase& scheme, Findings& findings) {
    constexpr double most = 1e7;
    const double updates = updatesIn(levelsOf(scheme.system, scheme.discretization.space), scheme.step);
    if (updates <= most) return;
    findings.error("/space",
                   "one step of all elements takes " + formatNumber(updates, 2) + " updates of elements, " +
                       formatNumber(most, 2) + " at most",
                   "elements of more equal sizes (a smaller ratio), or a shorter step");
}

void checkAsynchronous(const SchemeCase& scheme, Findings& findings) {
    checkUpdates(scheme, findings);
    const double courant = scheme.discretization.space.number("courant"),
                 most = withElements(scheme.system, [&](const auto&elements) {
                     return elements.stiffening(scheme.initial.x.data());
                 });
    if (!scheme.allowsUnstable && courant * most > 1 + 1e-12)
        findings.error("/space/courant",
                       formatNumber(courant) +
                           " is beyond the critical step of an element: the strain at the "
                           "start makes it stiffer by a factor of " +
                           formatNumber(most, 3) + " in its frequency",
                       "at most " + formatNumber(1 / most, 3) + ", or \"allow_unstable\": true");
}

ElementClocks elementsOf(const System& system, const Discretization& d, double, double duration,
                         const double* x) {
    const Levels levels = levelsOf(system, d.space);
    return withElements(system, [&](const auto& elements) {
        ElementClocks clocks;
        for (int e = 0; e < elements.elements(); ++e) {
            const double h =
                isReal(d.space) ? d.space.number("courant") * elements.criticalStep(e) : levels.step(e);
            clocks.x.push_back(elements.place(e));
            clocks.step.push_back(h);
            clocks.updates.push_back(std::floor(duration / h * (1 + 1e-12) + 0.5));
            clocks.energy.push_back(elements.energy(e, x, x + elements.nodes()));
        }
        return clocks;
    });
}

ChoiceGrid choices(const System&) {
    ChoiceGrid grid;
    grid.subtitle = "levels × Courant number";
    for (const char* C : {"0.2", "0.4", "0.5", "0.8"}) grid.columns.push_back({std::string("C ") + C, {}});
    for (const char* levels : {"dyadic", "real", "synchronous"}) {
        grid.rows.push_back({levels, {}});
        for (const double C : {0.2, 0.4, 0.5, 0.8}) {
            ChoiceGrid::Cell cell;
            cell.discretization.space = {
                "asynchronous", {{"levels", levels}, {"courant", C}, {"balance", true}}, {}};
            cell.discretization.quadrature = {"auto", {}, {}};
            cell.id = std::string(levels) + "." + formatNumber(C);
            cell.text = formatNumber(C);
            cell.title = describe(cell.discretization).knownAs + ", C = " + formatNumber(C);
            grid.cells.push_back(std::move(cell));
        }
    }
    return grid;
}

std::unique_ptr<Integrator> makeAsynchronous(const System& system, const Discretization& d, double step) {
    if (const ScalarField* const bar = system.parts.find<ScalarField>();
        bar && bar->problem->nodes.degree != 1)
        throw InvalidScene("/space", "asynchronous elements are linear", "elements of degree 1");
    return withElements(system, [&](const auto& elements) {
        return isReal(d.space) ? makeRealSteps(elements, d.space.number("courant"), step)
                               : makeDyadicSteps(elements, levelsOf(system, d.space), step);
    });
}

WrittenAction written(const Discretization&) {
    return {"Every element K has times t_K^j of its own, h_K apart; nodes move freely between them.",
            {{"S = Σ_a ∫ m_a |x_a′|² / 2 dt − Σ_K Σ_j h_K V_K(x(t_K^j))",
              "S = \\sum_a \\int \\tfrac12 m_a |\\dot x_a|^2\\, dt - \\sum_K \\sum_j h_K "
              "V_K\\bigl(x(t_K^j)\\bigr)"}},
            {{"p_a(t_K^j +) − p_a(t_K^j −) = −h_K ∂V_K/∂x_a",
              "p_a(t_K^{j+}) - p_a(t_K^{j-}) = -h_K \\frac{\\partial V_K}{\\partial x_a}"}}};
}

}  // namespace

Family asynchronous() {
    Family f;
    f.item = {"asynchronous",
              "asynchronous",
              "Elements with steps of their own.",
              {},
              {},
              "an elastic bar or a membrane"};
    f.source = "Leok 2004, sec. 2.1";
    f.spaces = {asynchronousSpace()};
    f.takes = Takes::only<ScalarField, Membrane>();
    f.completeRule = [](const Settings&, const Settings&) {
        return Settings{"auto", {}, {}};  // one node in time for each element
    };
    f.describe = describeAsynchronous;
    f.check = checkAsynchronous;
    f.choices = choices;
    f.rules = [](const Settings&) { return std::vector<std::string>{"auto"}; };
    f.written = written;
    f.make = makeAsynchronous;
    f.parts.set(NodesAlone{});
    f.parts.set(SlowestStep{[](const SchemeCase& scheme) {
        constexpr double perUpdate = 1e-7;
        const Levels levels = levelsOf(scheme.system, scheme.discretization.space);
        return std::max(5e-3, perUpdate * updatesIn(levels, scheme.step));
    }});
    f.parts.set(SystemCondition{hasElements});
    f.parts.set(StepOfSpace{impliedStep, "courant"});
    f.parts.set(ElementSteps{elementsOf});
    f.parts.set(SchemeIdentity{
        [](const Discretization& a, double, const Discretization& b) { return a.space == b.space; }});
    return f;
}

}  // namespace extremal::family
