/// Generalized Galerkin variational integrators of systems with coordinates: a space that is a table and a
/// plain rule (Leok 2004, sec. 2).
#include <algorithm>
#include <string>
#include <utility>

#include "engine/action/table.hpp"
#include "engine/family/family.hpp"
#include "engine/family/rule_choices.hpp"
#include "engine/family/scheme.hpp"
#include "engine/family/table_of.hpp"
#include "engine/family/table_properties.hpp"
#include "engine/integrator/condensed.hpp"
#include "engine/quadrature/catalog.hpp"

namespace extremal::family {
namespace {

std::string ordinal(const char* prefix, int order) { return prefix + std::to_string(order); }

/// Name by which the field knows the discretization; degree s, rule with n nodes.
void nameOf(const Settings& space, const Settings& rule, int n, Properties& p) {
    const int s = space.integer("degree");
    if (space.type != "polynomial") {
        p.shortName = ordinal(space.type == "spline" ? "S" : "VI", p.claims.order);
        return;
    }
    if (rule.integer("panels") > 1) {
        p.shortName = ordinal("VI", p.claims.order);
        return;
    }
    const bool isTrapezoid = (rule.type == "trapezoid" && n == 2) || (rule.type == "lobatto" && n == 2) ||
                             (rule.type == "clenshaw-curtis" && n == 2);
    const bool isMidpoint = n == 1 && rule.type != "radau";
    p.isExplicit = s == 1 && (isTrapezoid || (rule.type == "radau" && n == 1));
    if (s == 1 && isMidpoint) {
        p.knownAs = "implicit midpoint";
        p.shortName = "mid";
    } else if (s == 1 && isTrapezoid) {
        p.knownAs = "Störmer-Verlet";
        p.shortName = "SV";
    } else if (s == 1 && rule.type == "radau" && n == 1) {
        p.knownAs = "symplectic Euler";
        p.shortName = "SE";
    } else if (rule.type == "gauss" && n == s) {
        p.knownAs = "Gauss collocation";
        p.shortName = ordinal("G", p.claims.order);
    } else if (rule.type == "lobatto" && n == s + 1) {
        p.knownAs = "Lobatto IIIA-IIIB";
        p.shortName = ordinal("L", p.claims.order);
    } else if (rule.type == "clenshaw-curtis") {
        p.knownAs = "spectral variational";
        p.shortName = ordinal("CC", p.claims.order);
    } else {
        p.shortName = ordinal(rule.type == "radau" ? "R" : "VI", p.claims.order);
    }
}

std::string spaceText(const Settings& space) {
    const std::string degree = std::to_string(space.integer("degree"));
    if (space.find("cells"))
        return "splines of degree " + degree + " with " + std::to_string(space.integer("cells")) + " cells";
    return space.find("degree") ? "polynomials of degree " + degree : space.type;
}

Properties describeGalerkin(const Discretization& discretization) {
    const auto& [space, quadrature, solver] = discretization;
    Properties p;
    if (isPlainRule(quadrature)) {
        p = describeTable([&] { return tableOf(space, quadrature); }, quadrature);
        nameOf(space, quadrature, makeRule<double>(quadrature).size(), p);
        if (p.knownAs == "Gauss collocation" || p.knownAs == "implicit midpoint")
            p.claims.conserves.push_back("quadratic invariants");
    } else {
        refuseRule(quadrature, p);
    }
    p.space = spaceText(space);
    return p;
}

ReferencePlan trusted(const System& system, const State&, double) {
    return referenceBy("Gauss collocation of degree 12", system, *namedScheme("gauss-collocation-12"));
}

ChoiceGrid choices(const System&) {
    std::vector<SpaceRow> rows;
    for (const int degree : {1, 2, 3, 4, 6, 8})
        rows.push_back({"poly " + std::to_string(degree),
                        "",
                        {"polynomial", {{"degree", static_cast<double>(degree)}, {"basis", "lobatto"}}, {}}});
    for (const int degree : {2, 3})
        rows.push_back({"spline " + std::to_string(degree),
                        "spline",
                        {"spline", {{"degree", static_cast<double>(degree)}, {"cells", 2.0}}, {}}});
    return ruleChoices(rows);
}

}  // namespace

Family galerkin() {
    Family f;
    f.item = {"galerkin", "Galerkin", "Space x quadrature as one table.", {}, {}, "coordinates"};
    f.source = "Leok 2004, sec. 2";
    f.spaces = tableSpaces();
    f.solverMethods = {"newton", "fixed-point"};
    f.applies = isMechanical;
    f.completeRule = [](const Settings& space, const Settings& quadrature) {
        return completePlainRule(quadrature, space.integer("degree"), std::max(1, space.integer("cells")));
    };
    f.describe = describeGalerkin;
    f.reference = trusted;
    f.choices = choices;
    f.rules = [](const Settings&) { return plainRules(); };
    f.table = [](const Settings& space, const Settings& quadrature) {
        return makeTable(makeSpace(space), makeRule<double>(quadrature));
    };
    f.make = [](const System& system, const Discretization& d, double step) {
        return makeCondensed(
            system, [table = tableOf(d.space, d.quadrature)](double) { return std::vector{table}; }, step,
            solverPolicy(d.solver, system));
    };
    return f;
}

}  // namespace extremal::family
