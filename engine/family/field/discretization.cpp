#include "engine/family/field/discretization.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/quadrature/tensor.hpp"

namespace extremal {

TentDegrees tentDegrees(const Settings& space) {
    const Value* degree = space.find("degree");
    if (!degree) return {};
    const auto whole = [](const Value* v) {
        return v && v->isNumber() ? static_cast<int>(std::lround(v->asNumber())) : 1;
    };
    if (!degree->isObject()) return {whole(degree), whole(degree)};
    return {whole(degree->find("space")), whole(degree->find("time"))};
}

Settings ruleSettingsIn(const Settings& quadrature, const char* direction) {
    return isTensorRule(quadrature) ? tensorPart(quadrature, direction) : quadrature;
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

double leastMass(int degree, const Rule<double>& rule) {
    const int n = degree + 1;
    const LobattoBasis basis(degree);
    dense::Matrix<double> M = dense::Matrix<double>::Zero(n, n);
    std::vector<double> value(static_cast<std::size_t>(n)), slope(value);
    for (int q = 0; q < rule.size(); ++q) {
        basis.at(rule.c[static_cast<std::size_t>(q)], value.data(), slope.data());
        for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b)
                M(a, b) += rule.b[static_cast<std::size_t>(q)] * value[static_cast<std::size_t>(a)] *
                           value[static_cast<std::size_t>(b)];
    }
    const auto eigen = dense::symmetricEigen<double>(M);
    const double ratio = eigen.values(0) / eigen.values(n - 1);
    return ratio > 1e-12 ? ratio : 0;
}

}  // namespace extremal
