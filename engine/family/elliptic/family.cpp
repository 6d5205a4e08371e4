// SPDX-License-Identifier: GPL-3.0-or-later
/// Finite elements of the elliptic problem with functions that know its coefficient (Leok 2004, sec. 7.1).
#include <cmath>
#include <limits>

#include "engine/family/elliptic/elliptic.hpp"
#include "engine/family/family.hpp"
#include "engine/family/parts/scheme_identity.hpp"
#include "engine/family/parts/shape_functions.hpp"
#include "engine/family/parts/steps.hpp"
#include "engine/model/elliptic.hpp"

namespace extremal::family {
namespace {

SpaceEntry ellipticElements() {
    SpaceEntry e;
    const FieldInfo functions =
        choiceField("functions", "functions", {"multiscale", "linear"},
                    "Solutions of (a phi')' = 0 between the nodes, or straight lines.");
    FieldInfo elements = integerField("elements", "N", 2, 1e5, nullptr,
                                      "Number of elements; default: that of the model. The step is 1/N.");
    elements.isOptional = true;
    e.item = {"elliptic-elements",
              "elements",
              "Finite elements of the elliptic problem, with functions that know its coefficient or not.",
              {functions, elements},
              {},
              "the elliptic problem"};
    return e;
}

bool isLinear(const Settings& space) { return space.text("functions") == "linear"; }

Properties describeElements(const Discretization& discretization) {
    const bool linear = isLinear(discretization.space);
    Properties p;
    p.claims.order = linear ? 2 : 0;
    p.curveOrder = 2;
    p.space = std::to_string(discretization.space.integer("elements")) +
              (linear ? " elements with straight lines" : " elements that know the coefficient");
    p.knownAs = linear ? "linear elements" : "multiscale elements";
    p.shortName = linear ? "P1" : "MsFEM";
    p.remark = linear ? "order 2, once they resolve the coefficient" : "exact at the nodes, however few";
    p.stabilityLimit = std::numeric_limits<double>::infinity();
    return p;
}

/// The length of an element follows from their number.
std::optional<ImpliedStep> impliedStep(const Settings& space, const Settings&,
                                       const ParameterValue& parameter) {
    if (const double own = space.number("elements"); own > 0) return ImpliedStep{1 / own, {}, true};
    if (const auto model = parameter("elements")) return ImpliedStep{1 / *model, "1/elements", false};
    return {};
}

bool isSame(const Discretization& a, double stepOfA, const Discretization& b) {
    return isLinear(a.space) == isLinear(b.space) && std::lround(1 / stepOfA) == b.space.integer("elements");
}

/// There is no rule to choose: elements take theirs from the coefficient.
ChoiceGrid choices(const System&) {
    ChoiceGrid grid;
    grid.subtitle = "functions × elements";
    for (const char* functions : {"multiscale", "linear"}) {
        grid.rows.push_back({functions, {}});
        for (const int elements : {5, 10, 20, 40, 80, 160}) {
            ChoiceGrid::Cell cell;
            cell.discretization.space = {
                "elliptic-elements",
                {{"functions", functions}, {"elements", static_cast<double>(elements)}},
                {}};
            cell.discretization.quadrature = {"auto", {}, {}};
            cell.text = std::to_string(elements);
            cell.id = std::string(functions) + "." + cell.text;
            cell.title = describe(cell.discretization).space;
            grid.cells.push_back(std::move(cell));
        }
    }
    return grid;
}

ShapeFunction shapeFunction(const System& system, const Discretization& d, double step, int node) {
    const int elements = static_cast<int>(std::lround(1 / step));
    if (node == 0) node = elements / 2;
    EllipticHat hat = ellipticHat(*system.part<EllipticPart>().problem,
                                  isLinear(d.space) ? EllipticElements::linear : EllipticElements::multiscale,
                                  elements, node);
    return {std::move(hat.x), std::move(hat.phi), node, elements};
}

WrittenAction written(const Discretization&) {
    return {"u is the sum of nodal values u_j times functions φ_j that know the coefficient a(x/ε).",
            {{"S(u) = ∫ (a(x/ε) u_x² / 2 − f u) dx",
              "S(u) = \\int \\Bigl( \\tfrac12 a(x/\\varepsilon)\\, u_x^2 - f u \\Bigr) dx"}},
            {{"Σ_j u_j ∫ a φ_i′ φ_j′ dx = ∫ f φ_i dx",
              "\\sum_j u_j \\int a\\, \\varphi_i' \\varphi_j'\\, dx = \\int f \\varphi_i\\, dx"}}};
}

}  // namespace

Family elliptic() {
    Family f;
    f.item = {"elliptic", "multiscale element",  "Elements of a boundary-value problem.", {},
              {},         "the elliptic problem"};
    f.source = "Leok 2004, sec. 7.1";
    f.spaces = {ellipticElements()};
    f.takes = Takes::only<EllipticPart>();
    f.completeRule = [](const Settings&, const Settings&) {
        return Settings{"auto", {}, {}};  // integrals over elements are exact to round-off
    };
    f.describe = describeElements;
    f.check = [](const SchemeCase& scheme, Findings& findings) {
        if (scheme.initial.t != 0)
            findings.error("", "goes along x from 0 to 1, and the scene starts at another place",
                           "\"time\": { \"start\": 0, \"end\": 1 }");
    };
    f.choices = choices;
    f.rules = [](const Settings&) { return std::vector<std::string>{"auto"}; };
    f.written = written;
    f.make = makeEllipticIntegrator;
    f.parts.set(StepOfSpace{impliedStep});
    f.parts.set(SchemeIdentity{isSame});
    f.parts.set(ShapeFunctions{shapeFunction});
    return f;
}

}  // namespace extremal::family
