#include "engine/family/table_properties.hpp"

#include <algorithm>
#include <string>

#include "engine/core/dense.hpp"
#include "engine/core/problem.hpp"
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

/// The error of L_d over h^(2 degree + 1) from the space, h^(order of the rule + 1) from the rule on the
/// solution, and h^(2 consistency + 1) from the rule in the stationarity conditions, where it counts twice.
int orderOf(const Table<double>& table) {
    return std::min({2 * table.space.degree, table.rule.degree + 1, 2 * table.consistency});
}

/// Which of the three bounds on the order is the rule's doing.
std::string shortfallOf(const Table<double>& table) {
    const int order = orderOf(table), ofSpace = 2 * table.space.degree;
    if (order >= ofSpace) return {};
    const std::string bound =
        "order " + std::to_string(order) + ", not the " + std::to_string(ofSpace) + " of the space: ";
    const std::string exact = "the rule is exact to degree " + std::to_string(table.rule.degree);
    if (table.rule.degree + 1 <= order) return bound + exact;
    return bound + exact + ", too little for the equations inside the step";
}

}  // namespace

Properties describeTable(const std::function<Table<double>()>& make, const Settings& quadrature) {
    Properties p;
    const Rule<double> rule = makeRule<double>(quadrature);
    p.claims.isSymmetric = rule.isSymmetric;
    p.claims.isSymplectic = true;
    p.claims.conserves = {"momentum"};
    try {
        const Table<double> table = make();
        p.claims.order = orderOf(table);
        p.curveOrder = std::min({table.space.degree + 1, table.consistency + 1, p.claims.order});
        p.stabilityLimit = firstInstability(HalfTrace(table));
        p.shortfall = shortfallOf(table);
        if (table.consistency == 0) {
            p.refusal =
                "the rule does not integrate the velocities of the space: not even a free particle would "
                "keep "
                "its speed";
            p.hint = "a rule that is exact for degree " +
                     std::to_string(std::max(0, table.space.degree - 1)) + " between the knots of the space";
        }
    } catch (const InvalidScene& e) {
        p.refusal = e.problems().front().message;
        p.hint = e.problems().front().hint;
    }
    return p;
}

}  // namespace extremal
