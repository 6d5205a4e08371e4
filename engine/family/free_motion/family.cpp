// SPDX-License-Identifier: GPL-3.0-or-later
/// Free motion between kicks of the potential: the explicit schemes of rigid bodies (Leok 2004, sec. 3 for
/// curves on groups; Blanes and Moan 2002 for the knots).
#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/family/family.hpp"
#include "engine/family/free_motion/free_motion.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/parts/variant.hpp"

namespace extremal::family {
namespace {

/// The tables whose knots and weights a space can have.
struct NamedSplitting {
    const char* id;
    const char* shortName;
    Splitting (*make)();
};
constexpr std::array<NamedSplitting, 7> splittings{{{"strang", "F2", strang},
                                                    {"suzuki-4", "F4s", suzuki4},
                                                    {"blanes-moan-s6", "F4b", blanesMoanS6},
                                                    {"srkn-6b", "F4", srkn6b},
                                                    {"blanes-moan-s10", "F6b", blanesMoanS10},
                                                    {"srkn-11b", "F6", srkn11b},
                                                    {"srkn-14a", "F6a", srkn14a}}};

const NamedSplitting& splittingOf(const Settings& space) {
    const std::string id = space.text("knots");
    return *std::find_if(splittings.begin(), splittings.end(),
                         [&](const NamedSplitting& each) { return id == each.id; });
}

SpaceEntry freeMotions() {
    std::vector<std::string> ids;
    for (const NamedSplitting& each : splittings) ids.emplace_back(each.id);
    SpaceEntry e;
    e.item = {
        "free-motion",
        "free motion",
        "Free motions between knots of the step, at which the potential kicks: explicit.",
        {choiceField("knots", "knots", ids,
                     "Where the knots are on the step and what the kicks weigh: strang (order 2), suzuki-4, "
                     "blanes-moan-s6, srkn-6b (4), blanes-moan-s10, srkn-11b, srkn-14a (6).")},
        {},
        "a rigid body with a potential"};
    return e;
}

Properties describeFreeMotion(const Discretization& d) {
    const NamedSplitting& named = splittingOf(d.space);
    const Splitting splitting = named.make();
    const auto kicks = std::count_if(splitting.stages.begin(), splitting.stages.end(),
                                     [](const SplittingStage& s) { return s.isKick; });
    Properties p;
    p.claims = {splitting.order, true, true, {"momentum"}};
    p.curveOrder = std::min(splitting.order, 4);  // cubic Hermite interpolation
    p.space = "free motions with " + std::to_string(kicks) + " kicks";
    p.knownAs = std::string("free motion, ") + named.id;
    p.shortName = named.shortName;
    p.isExplicit = true;
    p.stabilityLimit = std::numeric_limits<double>::infinity();
    return p;
}

std::string mismatchOf(const Discretization&, const System& system) {
    return system.body().isFree() ? "the free motion of a body without a potential is its motion, and "
                                    "nothing is left to discretize"
                                  : std::string();
}

ChoiceGrid choices(const System&) {
    ChoiceGrid grid;
    grid.subtitle = "free motion between kicks";
    grid.rows.push_back({"free motion", {}});
    for (const NamedSplitting& each : splittings) {
        ChoiceGrid::Cell cell;
        cell.discretization.space = {"free-motion", {{"knots", each.id}}, {}};
        cell.discretization.quadrature = {"auto", {}, {}};
        cell.text = each.shortName;
        cell.id = std::string("free-motion.") + each.id;
        cell.title = describe(cell.discretization).knownAs;
        grid.cells.push_back(std::move(cell));
    }
    return grid;
}

WrittenAction written(const Discretization&) {
    return {"The curve is a free motion between knots g_j of the step, whose distances in time are a_j h.",
            {{"S = Σ_j S_T(g_{j−1}, g_j; a_j h) − h Σ_j b_j U(g_j)",
              "S = \\sum_j S_T(g_{j-1}, g_j; a_j h) - h \\sum_j b_j\\, U(g_j)"}},
            {{"Π_j⁺ = Π_j⁻ − b_j h g_j* dU(g_j)  at every knot",
              "\\Pi_j^+ = \\Pi_j^- - b_j h\\, g_j^* dU(g_j) \\quad \\text{at every knot}"}}};
}

}  // namespace

Family free_motion() {
    Family f;
    f.item = {"free_motion",
              "free motion",
              "Free motions between kicks of the potential.",
              {},
              {},
              "a rigid body with a potential"};
    f.source = "Leok 2004, sec. 3";
    f.spaces = {freeMotions()};
    f.takes = Takes::only<Body>();
    f.completeRule = [](const Settings&, const Settings&) {
        return Settings{"auto", {}, {}};  // its nodes are the knots
    };
    f.describe = describeFreeMotion;
    f.check = [](const SchemeCase&, Findings&) {};
    f.choices = choices;
    f.rules = [](const Settings&) { return std::vector<std::string>{"auto"}; };
    f.written = written;
    f.make = [](const System& system, const Discretization& d, double step) {
        if (const std::string problem = mismatchOf(d, system); !problem.empty())
            throw InvalidScene("/space/type", problem, "a scheme on its group");
        return makeFreeMotion(system, splittingOf(d.space).make(), step);
    };
    f.parts.set(SchemeCondition{mismatchOf});
    f.parts.set(Variant{});
    return f;
}

}  // namespace extremal::family
