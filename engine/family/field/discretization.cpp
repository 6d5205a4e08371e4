// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/discretization.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/quadrature/tensor.hpp"

namespace extremal {

TentDegrees tentDegrees(const Settings& space) {
    const Value* degree = space.find("degree");
    if (!degree) return {};
    const auto whole = [](const Value* v) {
        if (!v) return 1;
        const double number = v->isNumber() ? v->asNumber() : 0;
        return std::abs(number) < 1000 && number == std::round(number) ? static_cast<int>(number) : 0;
    };
    if (!degree->isObject()) return {whole(degree), whole(degree)};
    return {whole(degree->find("space")), whole(degree->find("time"))};
}

bool hasOwnFunctions(const Settings& space) {
    return space.find("functions") && space.text("functions") != "lagrange";
}

Settings ruleSettingsIn(const Settings& quadrature, const char* direction) {
    if (!isTensorRule(quadrature)) return quadrature;
    return tensorPart(quadrature, direction == std::string_view(acrossPart) && !quadrature.find(acrossPart)
                                      ? tensorParts[0]
                                      : direction);
}

Rule<double> ruleIn(const Settings& quadrature, const char* direction, int degree) {
    const Settings own = ruleSettingsIn(quadrature, direction);
    if (own.type == "exact") return gauss<double>(degree + 1);
    Rule<double> rule = makeRule<double>(own);
    if (rule.size() > 16)
        throw InvalidScene("/quadrature", "has " + std::to_string(rule.size()) + " nodes in " + direction,
                           "at most 16");
    return rule;
}

std::shared_ptr<const SpatialForm> spatialForm(const Discretization& d,
                                               std::shared_ptr<const FieldProblem> problem) {
    const int degree = problem->nodes.degree;
    return std::make_shared<const SpatialForm>(std::move(problem), ruleIn(d.quadrature, "space", degree));
}

TimeTable timeTable(const Discretization& d) {
    const int degree = tentDegrees(d.space).time;
    return {degree, ruleIn(d.quadrature, "time", degree)};
}

ElementMatrices elementMatrices(int degree, const Rule<double>& rule) {
    const int n = degree + 1;
    const LobattoBasis basis(degree);
    ElementMatrices made{dense::Matrix<double>::Zero(n, n), dense::Matrix<double>::Zero(n, n)};
    std::vector<double> value(static_cast<std::size_t>(n)), slope(value);
    for (int q = 0; q < rule.size(); ++q) {
        basis.at(rule.c[static_cast<std::size_t>(q)], value.data(), slope.data());
        for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b) {
                const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
                const double weight = rule.b[static_cast<std::size_t>(q)];
                made.mass(a, b) += weight * value[i] * value[j];
                made.stiffness(a, b) += weight * slope[i] * slope[j];
            }
    }
    return made;
}

namespace {

dense::SymmetricEigen<double> massModes(int degree, const Rule<double>& rule) {
    return dense::symmetricEigen<double>(elementMatrices(degree, rule).mass);
}

constexpr double noMass = 1e-12;  ///< relative to the largest

}  // namespace

double leastMass(int degree, const Rule<double>& rule) {
    const auto modes = massModes(degree, rule);
    const double ratio = modes.values(0) / modes.values(degree);
    return ratio > noMass ? ratio : 0;
}

bool hasMasslessWave(const FieldProblem& problem, const Rule<double>& rule) {
    const int r = problem.nodes.degree, N = problem.mesh.elements();
    const auto modes = massModes(r, rule);
    const auto isMassless = [&](int k) { return !(modes.values(k) > noMass * modes.values(r)); };
    if (!isMassless(0)) return false;
    if (r > 0 && isMassless(1)) return true;  // one of the combinations is 0 at an end
    // From element to element it goes on by the factor of its values at both ends.
    const double left = modes.vectors(0, 0), right = modes.vectors(r, 0);
    if (std::abs(left) < noMass && std::abs(right) < noMass) return true;
    if (problem.mesh.boundary == Boundary::neumann) return true;
    if (problem.mesh.boundary == Boundary::dirichlet) return false;
    return std::abs(std::pow(right / left, N) - 1) < 1e-6;
}

}  // namespace extremal
