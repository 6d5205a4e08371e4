// SPDX-License-Identifier: GPL-3.0-or-later
/// Known motions between kicks: free ones between kicks of the potential, the explicit schemes of energies
/// A(p) + B(q) in coordinates, of rigid bodies, of wave functions and of fields in Fourier modes (Leok 2004,
/// sec. 2, 3 and 8 for the spaces; Blanes and Moan 2002 for the knots), and Kepler arcs between kicks of what
/// planets do to each other (Wisdom and Holman 1991; Laskar and Robutel 2001 and Blanes et al. 2013 for the
/// knots).
#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/family/family.hpp"
#include "engine/family/fourier_space.hpp"
#include "engine/family/free_motion/free_body_motion.hpp"
#include "engine/family/free_motion/kepler_motion.hpp"
#include "engine/family/modal_splitting.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/parts/described_on_system.hpp"
#include "engine/family/parts/meshes.hpp"
#include "engine/family/parts/step_tableau.hpp"
#include "engine/family/parts/variant.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/integrator/oscillator_step.hpp"
#include "engine/model/parts/held_bodies.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/model/wave/interaction.hpp"
#include "engine/step/partitioned.hpp"
#include "engine/step/wave_splitting.hpp"

namespace extremal::family {
namespace {

/// The tables whose knots and weights a space can have.
struct NamedSplitting {
    const char* id;
    const char* shortName;
    const char* knownAs;
    Splitting (*make)();
    bool isInGrid = true;  ///< offered side by side with others
};
/// Kicks in place of drifts, and the other way round: the order of tables for any A and B stays.
Splitting swapped(Splitting splitting) {
    for (SplittingStage& stage : splitting.stages) stage.isKick = !stage.isKick;
    return splitting;
}
/// Nine or seventeen steps of Strang, drift first.
Splitting kahanLi(int order) {
    return swapped(
        strangSteps(order, compositionParts({"kahan-li", {{"order", static_cast<double>(order)}}, {}}, 2)));
}

constexpr std::array<NamedSplitting, 11> freeKnots{
    {{"strang", "F2", "Strang splitting", strang},
     {"suzuki-4", "F4s", "Suzuki 4", suzuki4, false},
     {"blanes-moan-s6", "F4b", "Blanes-Moan S6", blanesMoanS6},
     {"srkn-6b", "F4", "Blanes-Moan SRKN 6b", srkn6b},
     {"blanes-moan-s10", "F6b", "Blanes-Moan S10", blanesMoanS10},
     {"srkn-11b", "F6", "Blanes-Moan SRKN 11b", srkn11b},
     {"srkn-14a", "F6a", "Blanes-Moan SRKN 14a", srkn14a},
     {"kahan-li-6", "F6k", "Kahan-Li 6", [] { return kahanLi(6); }, false},
     {"kahan-li-8", "F8k", "Kahan-Li 8", [] { return kahanLi(8); }, false},
     {"srkn-19a", "F8", "Blanes-Casas SRKN 19a", srkn19a},
     {"srkn-19b", "F8b", "Blanes-Casas SRKN 19b", srkn19b, false}}};
constexpr std::array<NamedSplitting, 11> keplerKnots{
    {{"strang", "K2", "Wisdom-Holman", strang},
     {"lobatto-3", "K2l", "Laskar-Robutel SBAB2", [] { return lobattoKicks(3); }, false},
     {"lobatto-4", "K2m", "Laskar-Robutel SBAB3", [] { return lobattoKicks(4); }},
     {"gauss-2", "K2g", "Laskar-Robutel SABA2", [] { return gaussKicks(2); }, false},
     {"gauss-3", "K2h", "Laskar-Robutel SABA3", [] { return gaussKicks(3); }, false},
     {"aba-10-4", "K4b", "Blanes et al. ABA(10,4)", aba104},
     {"aba-8-6-4", "K4c", "Blanes et al. ABA(8,6,4)", aba864},
     {"aba-10-6-4", "K4", "Blanes et al. ABA(10,6,4)", aba1064},
     {"srkn-6b", "K4d", "Blanes-Moan SRKN 6b", srkn6b, false},
     {"srkn-11b", "K6b", "Blanes-Moan SRKN 11b", srkn11b},
     {"srkn-14a", "K6", "Blanes-Moan SRKN 14a", srkn14a}}};

bool isOfArcs(const Settings& space) { return space.type == "kepler-arcs"; }

std::span<const NamedSplitting> knotsOf(const Settings& space) {
    if (isOfArcs(space)) return keplerKnots;
    return freeKnots;
}
const NamedSplitting& namedIn(const Settings& space) {
    const std::string id = space.text("knots");
    const auto all = knotsOf(space);
    return *std::find_if(all.begin(), all.end(), [&](const NamedSplitting& each) { return id == each.id; });
}
/// As it was published. Made once: it is asked for whenever a scheme is made.
const Splitting& tableOf(const Settings& space) {
    static const std::map<std::string, Splitting, std::less<>> all = [] {
        std::map<std::string, Splitting, std::less<>> made;
        for (const std::span<const NamedSplitting> list :
             {std::span<const NamedSplitting>(freeKnots), std::span<const NamedSplitting>(keplerKnots)})
            for (const NamedSplitting& each : list) made.emplace(each.id, each.make());
        return made;
    }();
    return all.find(space.text("knots"))->second;
}
const char* firstOf(const Splitting& splitting) { return splitting.stages.front().isKick ? "kick" : "drift"; }
/// Whether the space asks for the other order of kicks and drifts.
bool isSwapped(const Settings& space) {
    return space.find("first") && space.text("first") != firstOf(tableOf(space));
}
Splitting splittingOf(const Settings& space) {
    return isSwapped(space) ? swapped(tableOf(space)) : tableOf(space);
}

constexpr const char* needed = "a kinetic energy whose motion is known, and a potential";
constexpr const char* neededOfArcs =
    "two or more bodies that only attract, like 1/r^2, and that the origin holds or one of them that is ten "
    "times as heavy as all others";

SpaceEntry spaceOf(const char* id, const char* title, const char* description, const char* knots,
                   const char* needs) {
    std::vector<std::string> ids;
    for (const NamedSplitting& each : knotsOf({id, {}, {}})) ids.emplace_back(each.id);
    SpaceEntry e;
    e.item = {id, title, description, {choiceField("knots", "knots", ids, knots)}, {}, needs};
    return e;
}
SpaceEntry freeMotions() {
    SpaceEntry e = spaceOf(
        "free-motion", "free motion",
        "Free motions between knots of the step, at which the potential kicks: explicit.",
        "Where the knots are on the step and what the kicks weigh: strang (order 2), suzuki-4, "
        "blanes-moan-s6, srkn-6b (4), blanes-moan-s10, srkn-11b, srkn-14a, kahan-li-6 (6), kahan-li-8, "
        "srkn-19a, srkn-19b (8). Those of the name srkn need kinetic energies p^2/(2m).",
        needed);
    FieldInfo modes =
        integerField("modes", "N", leastModes, mostModes, nullptr,
                     "Of fields over an interval: the number of Fourier modes; default: the cells "
                     "of the model.");
    modes.isOptional = true;
    FieldInfo mass = numberField("mass", "mass term", "", 0,
                                 "Of fields: the w of the free waves, whose frequencies are sqrt(c^2 k^2 + "
                                 "w), and of the kicks, by W - w u^2/2; default: the mean of W'' over |u| <= "
                                 "1.");
    mass.symbol = "w";
    mass.min = 0;
    mass.fallback = nullptr;
    mass.isOptional = true;
    FieldInfo first = choiceField("first", "first", {"kick", "drift"},
                                  "Which begins and ends the step, where the table has its order both ways; "
                                  "default: as it was published, kahan-li-6 and kahan-li-8 with a drift.");
    first.fallback = nullptr;
    first.isOptional = true;
    e.item.parameters.push_back(first);
    e.item.parameters.push_back(modes);
    e.item.parameters.push_back(mass);
    return e;
}
SpaceEntry keplerArcs() {
    return spaceOf("kepler-arcs", "Kepler arcs",
                   "Kepler motions of all bodies about the heavy one between knots of the step, at which the "
                   "other forces kick: explicit.",
                   "Where the knots are on the step and what the kicks weigh: strang, lobatto-3, lobatto-4, "
                   "gauss-2, gauss-3 (order 2), aba-10-4, aba-8-6-4, aba-10-6-4, srkn-6b (4), srkn-11b, "
                   "srkn-14a (6). Where kicks are weak, the nodes of a rule count more than the order.",
                   neededOfArcs);
}

Properties describeFreeMotion(const Discretization& d) {
    const NamedSplitting& named = namedIn(d.space);
    const Splitting splitting = splittingOf(d.space);
    const auto kicks = std::count_if(splitting.stages.begin(), splitting.stages.end(),
                                     [](const SplittingStage& s) { return s.isKick; });
    Properties p;
    p.claims = {splitting.order, true, true, {"momentum"}};
    p.curveOrder = std::min(splitting.order, 4);  // cubic Hermite interpolation
    p.space = (isOfArcs(d.space) ? "Kepler arcs with " : "free motions with ") + std::to_string(kicks) +
              " kicks" + (isSwapped(d.space) ? std::string(", ") + firstOf(splitting) + " first" : "");
    p.knownAs = named.knownAs;
    p.shortName = named.shortName;
    p.isExplicit = true;
    p.stabilityLimit =
        isOfArcs(d.space) ? std::numeric_limits<double>::infinity() : stabilityLimit(splitting);
    return p;
}

bool isField(const System& system) {
    return system.parts.find<ScalarField>() || system.parts.find<PlaneField>();
}

/// Bodies, wave functions and fields have no limit on the harmonic oscillator.
std::optional<Properties> describeOn(const Discretization& d, const System& system) {
    Properties p = describeFreeMotion(d);
    if (system.parts.find<Wave>() || isField(system)) {
        if (!isField(system)) p.claims.conserves = {"norm"};
        p.curveOrder = p.claims.order;  // shorter steps
    } else if (!system.parts.find<Body>()) {
        return p;
    }
    p.stabilityLimit = std::numeric_limits<double>::infinity();
    return p;
}

/// Why the free motions of a system cannot be the curves of a step; empty if they can.
std::string unknownBecause(const System& system) {
    if (system.parts.find<Wave>())
        return system.hamiltonian()->isSplit()
                   ? std::string()
                   : "free waves are exact in a periodic domain with a potential at its nodes alone";
    if (system.parts.find<Body>())
        return system.body().isFree() ? "the free motion of a body without a potential is its motion, and "
                                        "nothing is left to discretize"
                                      : std::string();
    if (isField(system) && !isForModes(system))
        return "free waves are known on meshes at rest, with a linear force between the nodes";
    if (const auto* const field = system.parts.find<ScalarField>()) {
        const auto problem = modesProblem(*field->problem);
        return problem ? problem->message : std::string();
    }
    if (system.parts.find<PlaneField>()) return {};
    return flowOf(system).isSum() ? std::string()
                                  : "free motions are straight lines only where the energy is a function of "
                                    "the momenta and one of the places";
}

/// A(p) + B(q) where A is not quadratic: the third commutator of kicks with A is not zero.
bool isSumOfOthers(const System& system) {
    if (system.parts.find<Wave>() || system.parts.find<Body>() || isField(system)) return false;
    const Mechanics<double> flow = flowOf(system);
    return flow.isSum() && !flow.isSeparable;
}

/// Why a space cannot have the curves of a step; nothing if it can.
std::optional<Problem> problemOf(const Discretization& d, const System& system) {
    if (d.space.find("modes") && !system.parts.find<ScalarField>())
        return Problem{"/space/modes",
                       "modes are for fields over an interval; others have as many as their model says",
                       "leave it out"};
    if (d.space.find("mass") && !isField(system))
        return Problem{"/space/mass",
                       "a mass term is for fields; in other systems all of the potential is in the kicks",
                       "leave it out"};
    if (const Splitting& table = tableOf(d.space); table.isNystrom && isSwapped(d.space))
        return Problem{"/space/first",
                       d.space.text("knots") + " has its order only with a " + firstOf(table) + " first",
                       std::string("leave it out, or blanes-moan-s10")};
    if (!isOfArcs(d.space) && tableOf(d.space).isNystrom && isSumOfOthers(system))
        return Problem{
            "/space/knots",
            d.space.text("knots") + " has its order for kinetic energies p^2/(2m) with constant masses alone",
            "blanes-moan-s10"};
    if (isOfArcs(d.space) && !system.parts.find<HeldBodies>())
        return Problem{"/space/type", "Kepler arcs are for " + std::string(neededOfArcs), "free-motion"};
    return {};
}
std::string mismatchOf(const Discretization& d, const System& system) {
    const auto problem = problemOf(d, system);
    return problem ? problem->message : std::string();
}

std::unique_ptr<Integrator> makeOn(const System& system, const Discretization& d, double step) {
    const Splitting splitting = splittingOf(d.space);
    if (auto problem = problemOf(d, system)) throw InvalidScene({*std::move(problem)});
    if (isOfArcs(d.space)) return makeKeplerMotion(system, system.part<HeldBodies>(), splitting, step);
    if (system.parts.find<Wave>()) return makeWaveSplitting(system, step, splitting);
    if (isField(system)) {
        SpectralDomain domain = spectralDomainOf(system);
        if (d.space.find("mass")) domain.mass = d.space.number("mass");
        return makeModalSplitting(domain, splitting, step);
    }
    if (system.parts.find<Body>()) return makeFreeBodyMotion(system, splitting, step);
    return makePartitioned(flowOf(system), step, partitionedStages(splitting, true));
}

void addRow(ChoiceGrid& grid, const std::string& space, const std::string& title,
            std::span<const NamedSplitting> knots) {
    grid.rows.push_back({title, {}});
    for (const NamedSplitting& each : knots) {
        if (!each.isInGrid) continue;
        ChoiceGrid::Cell cell;
        cell.discretization.space = {space, {{"knots", each.id}}, {}};
        cell.discretization.quadrature = {"auto", {}, {}};
        cell.text = each.shortName;
        cell.id = space + "." + each.id;
        cell.title = title + ", " + each.id;
        grid.cells.push_back(std::move(cell));
    }
}

/// As many of each as fit into a row, those that cost least for their error.
ChoiceGrid choices(const System& system) {
    ChoiceGrid grid;
    grid.subtitle = "free motion between kicks";
    addRow(grid, "free-motion", "free motion", freeKnots);
    if (!system.parts.find<HeldBodies>()) return grid;
    grid.subtitle = "free motion and Kepler arcs between kicks";
    addRow(grid, "kepler-arcs", "Kepler arcs", keplerKnots);
    return grid;
}

WrittenAction written(const Discretization& d) {
    if (isOfArcs(d.space))
        return {
            "The curve is a Kepler motion of each body about those inside it between knots r_j of the step, "
            "in Jacobi coordinates, whose distances in time are a_j h; U is what the potential is besides.",
            {{"S = Σ_j S_K(r_{j−1}, r_j; a_j h) − h Σ_j b_j U(r_j)",
              "S = \\sum_j S_K(r_{j-1}, r_j; a_j h) - h \\sum_j b_j\\, U(r_j)"}},
            {{"p_j⁺ = p_j⁻ − b_j h dU(r_j)  at every knot",
              "p_j^+ = p_j^- - b_j h\\, dU(r_j) \\quad \\text{at every knot}"}}};
    return {"The curve is a free motion between knots x_j of the step, whose distances in time are a_j h.",
            {{"S = Σ_j S_T(x_{j−1}, x_j; a_j h) − h Σ_j b_j U(x_j)",
              "S = \\sum_j S_T(x_{j-1}, x_j; a_j h) - h \\sum_j b_j\\, U(x_j)"}},
            {{"p_j⁺ = p_j⁻ − b_j h dU(x_j)  at every knot",
              "p_j^+ = p_j^- - b_j h\\, dU(x_j) \\quad \\text{at every knot}"}}};
}

}  // namespace

Family free_motion() {
    Family f;
    f.item = {
        "free_motion", "free motion", "Free motions, or Kepler arcs, between kicks of the rest.", {}, {},
        needed};
    f.source = "Leok 2004, sec. 2, 3 and 8";
    f.spaces = {freeMotions(), keplerArcs()};
    f.takes = flowProblems().with<Body, Wave, Interaction, Rotation, ScalarField, PlaneField>();
    f.completeRule = [](const Settings&, const Settings&) {
        return Settings{"auto", {}, {}};  // its nodes are the knots
    };
    f.describe = describeFreeMotion;
    f.check = [](const SchemeCase&, Findings&) {};
    f.choices = choices;
    f.rules = [](const Settings&) { return std::vector<std::string>{"auto"}; };
    f.written = written;
    f.make = makeOn;
    f.parts.set(
        SystemCondition{[](const System& system) { return unknownBecause(system).empty(); }, unknownBecause});
    f.parts.set(SchemeCondition{mismatchOf});
    f.parts.set(DescribedOnSystem{describeOn});
    f.parts.set(StepTableau{[](const Discretization& d, double) {
        if (isOfArcs(d.space))
            throw InvalidScene("", "its steps are Kepler motions between kicks, which no tableau describes",
                               "choose the space free-motion for a tableau of the same knots");
        return tableauOf(splittingOf(d.space).stages, 1e-15);  // printed to 15 digits
    }});
    f.parts.set(OwnMesh{[](const Settings& space, const Settings& model) {
        return isOfArcs(space) ? std::nullopt : trigonometricModel(space, model);
    }});
    f.parts.set(SmallerSpaces{"modes", fewerModes, textOfModes});
    f.parts.set(Variant{});
    return f;
}

}  // namespace extremal::family
