// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/table_properties.hpp"

#include <algorithm>
#include <string>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/rule_choices.hpp"
#include "engine/integrator/stability.hpp"

namespace extremal {
namespace {

/// Half the trace of the step's map on L = (v^2 - z^2 q^2)/2 with h = 1, whose equations are
/// (stiffness - z^2 mass) Y = rhs.
class HalfTrace {
public:
    explicit HalfTrace(const Table<double>& t) {
        const Eigen::MatrixXd weighted = t.weight.asDiagonal() * t.testValue;
        stiffness_ = t.testDerivative.transpose() * t.weight.asDiagonal() * t.derivative;
        mass_ = weighted.transpose() * t.value;
        load_ = weighted.colwise().sum().transpose();
        impulse_ = t.value.transpose() * t.weight;
    }
    double operator()(double z) const {
        const Eigen::Index m = load_.size();
        // Right-hand sides for (q_0, p_0) = (1, 0) and (0, 1).
        Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(m, 2);
        rhs.col(0) = z * z * load_;
        rhs(m - 1, 1) = -1;
        const Eigen::MatrixXd Y = dense::solve<double>(stiffness_ - z * z * mass_, rhs);
        const double q = 1 + Y(m - 1, 0);
        const double p = 1 - z * z * impulse_.dot(Y.col(1));
        return (q + p) / 2;
    }

private:
    Eigen::MatrixXd stiffness_, mass_;  ///< sum_i b_i psi_a' phi_b' and sum_i b_i psi_a phi_b
    Eigen::VectorXd load_, impulse_;    ///< sum_i b_i psi_a and sum_i b_i phi_b
};

}  // namespace

/// The function of the start is 1 - phi_{m-1}, which is the last test function.
OscillatorAction oscillatorAction(const Table<double>& t) {
    const Eigen::Index m = t.unknowns();
    Eigen::MatrixXd value(t.nodes(), m + 1), slope(t.nodes(), m + 1);
    value << t.testValue.col(m - 1), t.value;
    slope << t.testDerivative.col(m - 1), t.derivative;
    return {slope.transpose() * t.weight.asDiagonal() * slope,
            value.transpose() * t.weight.asDiagonal() * value};
}

double scannedStabilityLimit(const Table<double>& table) {
    const HalfTrace halfTrace(table);
    return firstInstability([&](double z) { return hasBoundedPowers(halfTrace(z), z); }).limit();
}

int OrderBounds::order() const { return std::min({ofSpace, ofRule, ofEquations}); }

std::string OrderBounds::shortfall() const {
    if (order() >= ofSpace) return {};
    const std::string bound = "order " + std::to_string(order()) + ", not the " + std::to_string(ofSpace) +
                              " of the space: the rule is exact to degree " + std::to_string(ofRule - 1);
    return ofRule <= order() ? bound : bound + ", too little for the equations inside the step";
}

OrderBounds orderBounds(const Table<double>& table) {
    return {2 * table.space.degree, table.rule.degree + 1, 2 * table.consistency};
}

double halfTrace(const Table<double>& table, double z) { return HalfTrace(table)(z); }

std::string cautionOf(const Table<double>& table) {
    if (table.weight.minCoeff() >= 0) return table.rule.caution;
    const double least = kineticValues(table)(0);
    const std::string weight = "has the negative weight " + formatNumber(table.weight.minCoeff(), 3);
    if (least > 0) return weight + ": rounding errors are larger than those of positive weights";
    return weight + ", and kinetic energy becomes negative inside the step (K has the eigenvalue " +
           formatNumber(least, 3) + "): the step is solvable, but its action has no minimum";
}

Properties describeTable(const std::function<Table<double>()>& make, const std::function<double()>& limit) {
    Properties p;
    p.claims.isSymplectic = true;
    p.claims.conserves = {"momentum"};
    try {
        const Table<double> table = make();
        const OrderBounds bounds = orderBounds(table);
        p.claims.isSymmetric = table.rule.isSymmetric && table.space.isSymmetric;
        p.claims.order = bounds.order();
        p.curveOrder = std::min({table.space.degree + 1, table.consistency + 1, p.claims.order});
        p.stabilityLimit = limit ? limit() : firstEdge(OscillatorStep(oscillatorAction(table)).intervals());
        p.shortfall = bounds.shortfall();
        p.caution = cautionOf(table);
        if (table.consistency == 0) {
            p.refusal =
                "the rule does not integrate the velocities of the space: not even a free particle would "
                "keep "
                "its speed";
            p.hint = "a rule that is exact for degree " +
                     std::to_string(std::max(0, table.space.degree - 1)) + " between the knots of the space";
        }
    } catch (const InvalidScene& e) {
        refuse(e, p);
    }
    return p;
}

}  // namespace extremal
