// SPDX-License-Identifier: GPL-3.0-or-later
/// The elliptic problem with a fast coefficient (Leok 2004, sec. 7.1), (a(x/epsilon) u')' = f, u(0) = u(1) =
/// 0: no motion, but a solution along x, which a scheme gives node by node. State columns u, u_exact at the
/// place x (elliptic.hpp).
#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/core/problem.hpp"
#include "engine/model/boundary_system.hpp"
#include "engine/model/elliptic.hpp"
#include "engine/model/system.hpp"
#include "engine/model/typed/typed_function.hpp"

namespace extremal::systems {
namespace {

/// A formula in one variable. Throws InvalidScene at `pointer`.
std::function<double(double)> formula(const Value& value, const std::string& pointer,
                                      const std::string& variable) {
    if (value.isNumber()) return [c = value.asNumber()](double) { return c; };
    if (!value.isString()) throw InvalidScene(pointer, "must be an expression in " + variable);
    const auto function = std::make_shared<const typed::TypedFunction>(
        value.asString(), pointer, std::vector<std::string>{variable},
        std::vector<std::pair<std::string, double>>{});
    return [function](double x) { return (*function)(&x); };
}

System makeMultiscaleElliptic(const Settings& settings) {
    const EllipticProblem problem{formula(*settings.find("a"), "/a", "s"), settings.number("epsilon"),
                                  formula(*settings.find("f"), "/f", "x")};
    // Positive everywhere, or there is no solution: seen at the places of the quadrature.
    const auto exact = std::make_shared<const EllipticSolution>(problem, 16);
    double size = 0;
    for (int i = 1; i < 200; ++i) size = std::max(size, std::abs(exact->u(i / 200.0)));
    System s = boundarySystem("multiscale-elliptic",
                              {{"u", "solution", "u", ""}, {"u_exact", "exact solution", "u_exact", ""}},
                              "|u - u_exact| / max |u|", size > 0 ? size : 1);
    s.hasSteps = false;  // its elements are equal
    s.parts.set(EllipticPart{std::make_shared<const EllipticProblem>(problem)});
    s.exact = [exact](const State&) -> ExactSolution {
        return [exact](double x, std::span<double> values) { values[0] = values[1] = exact->u(x); };
    };
    return s;
}

}  // namespace

ModelEntry multiscale_elliptic() {
    ModelEntry e;
    FieldInfo epsilon =
        positive("epsilon", "period", "", 0.025, "Size of the fast scale: a depends on s = x/epsilon.");
    e.item = {"multiscale-elliptic",
              "elliptic problem with a fast coefficient",
              "(a(x/epsilon) u')' = f, u(0) = u(1) = 0: finite elements whose functions know the fast "
              "coefficient, and linear ones.",
              {jsonField("a", "a", "a", "10/(1+0.95*sin(2*pi*s))",
                         "The coefficient, an expression in s = x/epsilon; positive."),
               epsilon, jsonField("f", "f", "f", "x^2", "The right-hand side, an expression in x."),
               integerField("elements", "N", 2, 1e5, 10.0,
                            "Number of elements of schemes that do not say theirs.")},
              {},
              ""};
    e.exampleEnd = 1;
    e.exampleStep = 0.1;
    e.make = makeMultiscaleElliptic;
    e.interval = [](const Settings&) { return std::optional(std::pair(0.0, 1.0)); };
    return e;
}

}  // namespace extremal::systems
