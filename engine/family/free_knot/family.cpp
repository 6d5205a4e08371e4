// SPDX-License-Identifier: GPL-3.0-or-later
/// Static profiles on knots that are unknowns (Leok 2004, sec. 6).
#include <limits>

#include "engine/core/memo_cache.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/family.hpp"
#include "engine/family/free_knot/free_knots.hpp"
#include "engine/family/parts/meshes.hpp"
#include "engine/family/parts/nodes.hpp"
#include "engine/family/parts/scheme_identity.hpp"
#include "engine/family/parts/starts.hpp"
#include "engine/family/parts/steps.hpp"

namespace extremal::family {
namespace {

constexpr const char* places[] = {"equal", "arclength", "density", "free"};

SpaceEntry knotSpace() {
    SpaceEntry e;
    e.item = {
        "knots",
        "knots",
        "Straight lines between knots, of the least energy.",
        {integerField("elements", "n", 2, 512, 16.0, "Number of straight lines."),
         choiceField("place", "knots", {places[0], places[1], places[2], places[3]},
                     "equal: elements of one length; arclength: of one length of the graph; density: of "
                     "the same share of |u_xx|^p, p = 2/3, or 2/5 without stiffness; free: knots for "
                     "which the energy is stationary.")},
        {},
        "a static profile"};
    return e;
}

Knots knotsOf(const Settings& space) {
    const std::string place = space.text("place");
    for (int i = 0; i < 4; ++i)
        if (place == places[i]) return static_cast<Knots>(i);
    return Knots::equal;
}

const std::shared_ptr<const StaticProblem>& problemOf(const System& system) {
    return system.part<StaticPart>().problem;
}

/// Once for the start, the check and the run.
std::shared_ptr<const KnotProfile> profileOf(const System& system, const Settings& space) {
    using Key = std::pair<Settings, Settings>;
    static MemoCache<Key, std::shared_ptr<const KnotProfile>> known(32);
    static MemoCache<Settings, std::shared_ptr<const KnotProfile>> fineOnes(8);
    const StaticProblem& problem = *problemOf(system);
    return known.get(Key{problem.settings, space}, [&] {
        const int elements = space.integer("elements");
        const Knots knots = knotsOf(space);
        if (knots == Knots::equal)
            return std::make_shared<const KnotProfile>(findProfile(problem, elements, knots));
        const auto fine = fineOnes.get(
            problem.settings, [&] { return std::make_shared<const KnotProfile>(fineProfile(problem)); });
        return std::make_shared<const KnotProfile>(findProfile(problem, elements, knots, *fine));
    });
}

Properties describeKnots(const Discretization& d) {
    Properties p;
    p.claims.order = 2;
    p.claims.isOneStep = false;
    p.curveOrder = 2;
    p.space =
        std::to_string(d.space.integer("elements")) + " straight lines, knots: " + d.space.text("place");
    p.knownAs = d.space.text("place") == "free" ? "free knots" : d.space.text("place") + " knots";
    p.shortName = d.space.text("place");
    p.remark = d.space.text("place") == "free" ? "the energy is stationary in the knots as well"
                                               : "the energy is stationary in the values";
    p.stabilityLimit = std::numeric_limits<double>::infinity();
    return p;
}

ChoiceGrid choices(const System&) {
    ChoiceGrid grid;
    grid.subtitle = "knots × elements";
    for (const char* place : places) {
        grid.rows.push_back({place, {}});
        for (const int elements : {4, 8, 16, 32, 64, 128}) {
            ChoiceGrid::Cell cell;
            cell.discretization.space = {
                "knots", {{"elements", static_cast<double>(elements)}, {"place", place}}, {}};
            cell.discretization.quadrature = {"auto", {}, {}};
            cell.text = std::to_string(elements);
            cell.id = std::string(place) + "." + cell.text;
            cell.title = describe(cell.discretization).space;
            grid.cells.push_back(std::move(cell));
        }
    }
    return grid;
}

WrittenAction written(const Discretization&) {
    return {"u is piecewise linear; values u_i and, where they are free, knots x_i are unknowns.",
            {{"E(u, x) = Σ_i ∫ (u_x² / 2 + W(u)) dx over the cells [x_i, x_{i+1}]",
              "E(u, x) = \\sum_i \\int_{x_i}^{x_{i+1}} \\Bigl( \\tfrac12 u_x^2 + W(u) \\Bigr) dx"}},
            {{"∂E/∂u_i = 0,  of free knots ∂E/∂x_i = 0",
              "\\frac{\\partial E}{\\partial u_i} = 0, \\qquad \\frac{\\partial E}{\\partial x_i} = 0"}}};
}

}  // namespace

Family free_knot() {
    Family f;
    f.item = {"free_knot", "free knots", "Profiles whose knots are unknowns.", {}, {}, "a static profile"};
    f.source = "Leok 2004, sec. 6";
    f.spaces = {knotSpace()};
    f.takes = Takes::only<StaticPart>();
    f.completeRule = [](const Settings&, const Settings&) {
        return Settings{"auto", {}, {}};  // integrals over panels are exact to round-off
    };
    f.describe = describeKnots;
    f.check = [](const SchemeCase& scheme, Findings& findings) {
        const StaticProblem& problem = *problemOf(scheme.system);
        if (scheme.initial.t != problem.left || scheme.end != problem.right)
            findings.error("",
                           "goes along x from " + formatNumber(problem.left) + " to " +
                               formatNumber(problem.right) + ", and the scene does not",
                           "\"time\": { \"start\": " + formatNumber(problem.left) +
                               ", \"end\": " + formatNumber(problem.right) + " }");
    };
    f.choices = choices;
    f.rules = [](const Settings&) { return std::vector<std::string>{"auto"}; };
    f.written = written;
    f.make = [](const System& system, const Discretization& d, double) {
        return makeFreeKnots(profileOf(system, d.space));
    };
    f.parts.set(OwnTimeGrid{[](const Settings&) { return TimeGrid::free; }});
    f.parts.set(
        OwnMesh{[](const Settings&, const Settings& model) -> std::optional<Settings> { return model; }});
    f.parts.set(OwnStart{[](const System& system, Discretization& d, const Settings&, double) {
        return knotStart(*profileOf(system, d.space));
    }});
    f.parts.set(StepOfSpace{[](const Settings& space, const Settings& model,
                               const ParameterValue&) -> std::optional<ImpliedStep> {
        const ModelEntry* const entry = findModel(model.type);
        const auto interval = entry && entry->interval ? entry->interval(model) : std::nullopt;
        if (!interval) return {};
        return ImpliedStep{(interval->second - interval->first) / space.number("elements"), {}, true};
    }});
    f.parts.set(SchemeIdentity{
        [](const Discretization& a, double, const Discretization& b) { return a.space == b.space; }});
    return f;
}

}  // namespace extremal::family
