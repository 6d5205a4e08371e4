// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/mechanism_curve.hpp"

#include <string>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/quadrature/known_rules.hpp"

namespace extremal {

MechanismCurve::MechanismCurve(const Table<double>& ofStep, const MechanismRules& rules, int dimension)
    : table(ofStep), d(dimension), isRollingAtGauss(rules.isRollingAtGauss) {
    const int m = unknowns();
    const Rule<double>& nodes = knownLobatto(m + 1);
    places = nodes.c;
    weights = nodes.b;
    atPlaces = samples(places).value;
    const Eigen::MatrixXd ends = atPlaces.bottomRows(m);
    if (!(dense::Lu<double>(ends).pivotRatio() > 1e-10))
        throw InvalidScene("/space",
                           "has functions that " + std::to_string(m + 1) +
                               " Lobatto nodes do not tell apart, where constraints hold",
                           "polynomials");
    endSlope = samples({1.0}).slope;
    fit = dense::inverse<double>(ends);
    atGauss = {knownGauss(m), {}};
    if (isRollingAtGauss) {
        rolling = atGauss.rule;
    } else {
        rolling.c.assign(places.begin(), places.end() - 1);
        rolling.b.assign(weights.begin(), weights.end() - 1);
    }
    atRolling = samples(rolling.c).value;
    for (int i = 0; i < table.nodes(); ++i) {
        atLagrangian.rule.c.push_back(table.node(i));
        atLagrangian.rule.b.push_back(table.weight(i));
    }
    atLagrangian.at = {table.value, table.derivative};
    atForces = atLagrangian;
    if (rules.forces) atForces = {*rules.forces, samples(rules.forces->c)};
    atGauss.at = samples(atGauss.rule.c);
}

MechanismCurve::Samples MechanismCurve::samples(const std::vector<double>& at) const {
    using Vector = Eigen::VectorXd;
    const auto rows = static_cast<Eigen::Index>(at.size());
    Samples s{Eigen::MatrixXd(rows, unknowns()), Eigen::MatrixXd(rows, unknowns())};
    std::vector<double> value(static_cast<std::size_t>(table.space.size)), slope(value.size());
    for (Eigen::Index j = 0; j < rows; ++j) {
        table.space.evaluate(at[static_cast<std::size_t>(j)], value, slope);
        s.value.row(j) = Eigen::Map<const Vector>(value.data(), table.space.size).transpose() * table.change;
        s.slope.row(j) = Eigen::Map<const Vector>(slope.data(), table.space.size).transpose() * table.change;
    }
    return s;
}

MechanismCurve::Samples MechanismCurve::atParts() const {
    const int count = partsPerFunction * unknowns();
    std::vector<double> parts;
    for (int k = 0; k <= count; ++k) parts.push_back(static_cast<double>(k) / count);
    return samples(parts);
}

void MechanismCurve::placeAt(const Eigen::VectorXd& z, const Eigen::MatrixXd& at, int j,
                             Eigen::VectorXd& node) const {
    node.head(d) = z.head(d);
    for (int a = 0; a < unknowns(); ++a) node.head(d) += at(j, a) * z.segment((a + 1) * d, d);
}

void MechanismCurve::motionAt(const Samples& at, int i, const Eigen::VectorXd& z, double h,
                              Eigen::VectorXd& node) const {
    auto q = node.head(d), v = node.tail(d);
    q = z.head(d);
    v.setZero();
    for (int a = 0; a < unknowns(); ++a) {
        q += at.value(i, a) * z.segment((a + 1) * d, d);
        v += at.slope(i, a) / h * z.segment((a + 1) * d, d);
    }
}

}  // namespace extremal
