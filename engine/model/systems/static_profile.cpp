// SPDX-License-Identifier: GPL-3.0-or-later
/// The profile with the least energy between two places (Leok 2004, sec. 6): no motion, but a solution along
/// x, which a scheme gives knot by knot. State columns: u at the knot, and of the element that ends there the
/// derivative C of its energy by its end and its energy; the energy of the whole (static_problem.hpp).
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <tuple>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/boundary_system.hpp"
#include "engine/model/static_problem.hpp"
#include "engine/model/system.hpp"
#include "engine/model/typed/typed_function.hpp"

namespace extremal::systems {
namespace {

std::optional<std::pair<double, double>> domainOf(const Settings& settings) {
    const Value* const domain = settings.find("domain");
    if (!domain || !domain->isArray() || domain->asArray().size() != 2) return {};
    return std::pair(domain->asArray()[0].asNumber(), domain->asArray()[1].asNumber());
}

/// A profile that is called exact must make the energy stationary: k u_xx = W_u at 400 places, but for what
/// round-off explains, and have the values at the ends that are held.
void checkExact(const StaticProblem& problem, const typed::TypedFunction& exact) {
    constexpr int places = 400;
    constexpr double most = 1e-10;
    std::mt19937 random(1905);
    for (int i = 0; i < places; ++i) {
        const double x = problem.left + problem.length() * static_cast<double>(random()) / 4294967295.0;
        double u = 0, W = 0, u_x = 0, u_xx = 0;
        exact.evaluate(&x, &u, &u_x, &u_xx);
        const std::array<double, 2> at{u, x};
        std::array<double, 2> gradient{};
        std::array<double, 3> hessian{};
        problem.W->evaluate(at.data(), &W, gradient.data(), hessian.data());
        const double elastic = problem.stiffness * u_xx, sum = gradient[0] - elastic,
                     size = std::abs(gradient[0]) + std::abs(elastic),
                     explained = 1e-14 * (std::abs(u) * std::abs(hessian[0]) + size);
        if (std::isfinite(sum) && std::abs(sum) - explained > most * size)
            throw InvalidScene("/exact",
                               "does not make the energy stationary: at x = " + formatNumber(x, 4) +
                                   " k u_xx = " + formatNumber(elastic, 4) +
                                   ", W_u = " + formatNumber(gradient[0], 4),
                               "compare the formula with stiffness and energy, or leave it out");
    }
    if (!problem.isHeld) return;
    for (const bool isRight : {false, true}) {
        const double x = isRight ? problem.right : problem.left, u = exact(&x),
                     given = isRight ? problem.uRight : problem.uLeft;
        if (!(std::abs(u - given) <= 1e-6 * std::max(std::abs(problem.uLeft), std::abs(problem.uRight))))
            throw InvalidScene("/exact",
                               "is " + formatNumber(u, 6) + " at x = " + formatNumber(x, 6) +
                                   ", where the value " + formatNumber(given, 6) + " is held",
                               "the same value in /model/ends");
    }
}

System makeStaticProfile(const Settings& settings) {
    StaticProblem problem;
    std::tie(problem.left, problem.right) = domainOf(settings).value();
    if (!(problem.right > problem.left))
        throw InvalidScene("/domain", "must be two ascending places, got " + formatNumber(problem.left) +
                                          " and " + formatNumber(problem.right));
    // Thousands of elements, and panels in each, have places of their own, and finite sums.
    constexpr double longest = 1e100, shortest = 1e-100, relative = 1e-9;
    const double length = problem.length(), size = std::max(std::abs(problem.left), std::abs(problem.right));
    if (!(length <= longest && length >= shortest && length >= relative * size))
        throw InvalidScene("/domain",
                           "must have a length from " + formatNumber(shortest) + " to " +
                               formatNumber(longest) + ", and at least " + formatNumber(relative) +
                               " of the size of its ends, got " + formatNumber(problem.left) + " to " +
                               formatNumber(problem.right),
                           "another unit of length");
    problem.stiffness = settings.number("stiffness");
    const Value::Array ends = settings.find("ends")->asArray();
    problem.uLeft = ends[0].asNumber();
    problem.uRight = ends[1].asNumber();
    problem.isHeld = settings.text("boundary") == "held";
    if (!settings.find("energy")->isString())
        throw InvalidScene("/energy", "must be an expression in u and x", "\"1-cos(u)\"");
    problem.W = std::make_shared<const typed::TypedFunction>(settings.text("energy"), "/energy",
                                                             std::vector<std::string>{"u", "x"},
                                                             std::vector<std::pair<std::string, double>>{});
    if (const Value* const jumps = settings.find("jumps"); jumps && !jumps->isNull()) {
        if (!jumps->isArray()) throw InvalidScene("/jumps", "must be an array of places", "[0.4]");
        for (const Value& each : jumps->asArray()) {
            if (!each.isNumber()) throw InvalidScene("/jumps", "must be an array of places", "[0.4]");
            problem.jumps.push_back(each.asNumber());
        }
    }
    std::sort(problem.jumps.begin(), problem.jumps.end());
    problem.resolution = settings.number("resolution") * problem.length();
    problem.settings = settings;
    System s = boundarySystem("static-profile",
                              {{"u", "profile", "u", ""},
                               {"element_energy", "horizontal momentum", "∂E/∂x", ""},
                               {"share", "energy of the element", "E_e", ""},
                               {"total", "energy of the profile", "E", ""}},
                              "|u - u_exact|", 1);
    s.parts.set(StaticPart{std::make_shared<const StaticProblem>(problem)});
    if (const Value* const exact = settings.find("exact"); exact && !exact->isNull()) {
        if (!exact->isString()) throw InvalidScene("/exact", "must be an expression in x");
        const auto u = std::make_shared<const typed::TypedFunction>(
            exact->asString(), "/exact", std::vector<std::string>{"x"},
            std::vector<std::pair<std::string, double>>{});
        checkExact(problem, *u);
        s.exact = [u](const State&) -> ExactSolution {
            return [u](double x, std::span<double> values) {
                std::fill(values.begin(), values.end(), 0.0);
                values[0] = (*u)(&x);
            };
        };
    }
    return s;
}

}  // namespace

ModelEntry static_profile() {
    ModelEntry e;
    FieldInfo jumps = optionalJsonField(
                  "jumps", "jumps", "Places where the energy density jumps, for the quadrature to stop at."),
              exact = optionalJsonField("exact", "exact profile",
                                        "The exact profile, an expression in x: for the error at knots.");
    FieldInfo resolution =
        positive("resolution", "resolution", "", 0.005,
                 "Longest panel of the quadrature, eight Gauss points each, as a part of the domain.");
    resolution.min = 1e-4;
    resolution.isMinExcluded = false;
    // In a new scene, a steep profile.
    FieldInfo energy = jsonField("energy", "energy density", "W", "1-cos(u)",
                                 "The density W, an expression in u and x; (u-f(x))^2/2 for the best "
                                 "approximation of f."),
              stiffness = notNegative("stiffness", "stiffness", "", 1, "The factor k of u_x^2/2."),
              ends = numbers("ends", "values at the ends", "", {"left", "right"}, Value::Array{0.0, 1.0},
                             "Values at both ends; where they are free the iteration starts from them."),
              boundary = choiceField("boundary", "boundary", {"held", "free"},
                                     "held: the values at the ends are given; free: they are unknowns.");
    energy.example = "(u-tanh((x-0.3)/0.05))^2/2";
    exact.example = "tanh((x-0.3)/0.05)";
    stiffness.example = 0.0;
    ends.example = Value::Array{-1.0, 1.0};
    boundary.example = "free";
    e.item = {"static-profile",
              "static profile",
              "The function with the least energy, int k u_x^2/2 + W(x, u) dx: a kink at rest, or, without "
              "stiffness, the best approximation of a function by straight lines.",
              {energy, stiffness,
               numbers("domain", "domain", "", {"left", "right"}, Value::Array{0.0, 1.0}, "Both ends."), ends,
               boundary, jumps, exact, resolution},
              {},
              ""};
    e.exampleEnd = 1;
    e.exampleStep = 0.1;
    e.make = makeStaticProfile;
    e.interval = domainOf;
    return e;
}

}  // namespace extremal::systems
