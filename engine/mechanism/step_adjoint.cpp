// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/step_adjoint.hpp"

#include <utility>

namespace extremal {

StepAdjoint::StepAdjoint(const Mechanism& mechanism, SharedCurve curve)
    : mechanism_(mechanism), shared_(std::move(curve)), curve_(*shared_) {
    const int d = curve_.d, m = curve_.unknowns(), n = mechanism_.constraints();
    test_ = pulled_ = Vector::Zero((m + 1) * d);
    solution_ = Vector::Zero(m * (d + n));
    motion_ = eta_ = derivatives_ = Vector::Zero(2 * d);
    byImpulses_ = Vector::Zero(m * n);
    value_ = byTime_ = Vector::Zero(n);
    byPlace_ = Mechanism::Rows::Zero(n, d);
    curvature_ = Mechanism::Rows::Zero(d, d);
    byState_ = Mechanism::Rows::Zero(n - mechanism_.holonomic(), 2 * d);
}

/// The nodes of L, and behind them those of the forces.
StepAdjoint::Place StepAdjoint::placeOf(int node) const {
    const int n = curve_.table.nodes();
    if (node < n) return {curve_.atLagrangian, node, false};
    return {curve_.atForces, node - n, true};
}

NodePull::Node StepAdjoint::nodeAt(const Step& step, int node) {
    const Place at = placeOf(node);
    curve_.motionAt(at.nodes, step.z, at.i, step.h, motion_);
    return {node,
            at.isOfForce,
            step.t + at.nodes.place(at.i) * step.h,
            at.nodes.weight(at.i) * step.h,
            motion_.data(),
            motion_.data() + curve_.d};
}

void StepAdjoint::visit(const Step& step, const std::function<void(const NodePull::Node&)>& to) {
    for (int node = 0; node < nodes(); ++node) to(nodeAt(step, node));
}

/// The derivatives of Phi along test_ by z, into pulled_.
void StepAdjoint::pullBack(const Step& step, NodePull& pull) {
    const int d = curve_.d;
    pulled_.setZero();
    for (int node = 0; node < nodes(); ++node) {
        const Place at = placeOf(node);
        curve_.motionAt(at.nodes, test_, at.i, step.h, eta_);
        derivatives_.setZero();
        pull.add(nodeAt(step, node), eta_.data(), eta_.data() + d, derivatives_.data(),
                 derivatives_.data() + d);
        pulled_.head(d) += derivatives_.head(d);
        for (int a = 0; a < curve_.unknowns(); ++a)
            pulled_.segment((a + 1) * d, d) += at.nodes.at.value(at.i, a) * derivatives_.head(d) +
                                               at.nodes.at.slope(at.i, a) / step.h * derivatives_.tail(d);
    }
    if (mechanism_.constraints() > 0) pullConditions(step);
}

/// derivatives_ by a place, where the functions have the values of a row.
void StepAdjoint::spread(const Eigen::MatrixXd& at, int row) {
    const int d = curve_.d;
    pulled_.head(d) += derivatives_.head(d);
    for (int a = 0; a < curve_.unknowns(); ++a)
        pulled_.segment((a + 1) * d, d) += at(row, a) * derivatives_.head(d);
}

/// Of eta . Gamma at one place, by the impulses and by the place.
template <class Part>
void StepAdjoint::pullImpulses(const Step& step, const Part& part, const Multipliers& of) {
    const int d = curve_.d, first = of.node * mechanism_.constraints() + of.first;
    const double t = step.t + of.place * step.h;
    curve_.placeAt(step.z, of.at, of.node, motion_);
    curve_.placeAt(test_, of.at, of.node, eta_);
    mechanism_.conditions(t, motion_.data(), value_, byPlace_, byTime_);
    byImpulses_.segment(first, of.count).noalias() = byPlace_.middleRows(of.first, of.count) * eta_.head(d);
    curvature_.setZero();
    part.addCurvature(part.model.get(), t, motion_.data(), step.impulses.data() + first, curvature_.data());
    derivatives_.head(d).noalias() = curvature_.transpose() * eta_.head(d);
    spread(of.at, of.node);
}

void StepAdjoint::pullConditions(const Step& step) {
    const int d = curve_.d, m = curve_.unknowns(), n = mechanism_.constraints(), g = mechanism_.holonomic();
    for (int j = 0; j < m; ++j) {
        if (const auto& part = mechanism_.constraint())
            pullImpulses(step, *part, {0, g, j, curve_.place(j), curve_.atPlaces});
        if (const auto& part = mechanism_.rolling()) {
            pullImpulses(step, *part,
                         {g, n - g, j, curve_.rolling.c[static_cast<std::size_t>(j)], curve_.atRolling});
            pullRolling(step, j);
        }
        if (g == 0) continue;
        curve_.placeAt(step.z, curve_.atPlaces, j + 1, motion_);
        mechanism_.conditions(step.t + curve_.place(j + 1) * step.h, motion_.data(), value_, byPlace_,
                              byTime_);
        derivatives_.head(d).noalias() =
            -byPlace_.topRows(g).transpose() * solution_.segment(m * d + j * n, g);
        spread(curve_.atPlaces, j + 1);
    }
}

/// Of -mu . h r at a Gauss node.
void StepAdjoint::pullRolling(const Step& step, int node) {
    const MechanismCurve::Nodes& nodes = curve_.atGauss;
    const Rolling& r = *mechanism_.rolling();
    const int d = curve_.d, m = curve_.unknowns(), n = mechanism_.constraints(), g = mechanism_.holonomic();
    curve_.motionAt(nodes, step.z, node, step.h, motion_);
    r.first(r.model.get(), step.t + nodes.place(node) * step.h, motion_.data(), motion_.data() + d,
            value_.data(), byState_.data(), byTime_.data());
    derivatives_.noalias() = -step.h * byState_.transpose() * solution_.segment(m * d + node * n + g, n - g);
    spread(nodes.at.value, node);
    for (int a = 0; a < m; ++a)
        pulled_.segment((a + 1) * d, d) += nodes.at.slope(node, a) / step.h * derivatives_.tail(d);
}

bool StepAdjoint::apply(const Step& step, const MechanismEquations& equations, NodePull& pull,
                        Eigen::Map<Eigen::MatrixXd> columns) {
    const int d = curve_.d, all = curve_.unknowns() * d, last = all - d;
    for (int column = 0; column < columns.cols(); ++column) {
        auto lq = columns.col(column).head(d), lp = columns.col(column).tail(d);
        const auto w = solution_.head(all);
        solution_.setZero();
        test_.setZero();
        test_.head(d) = lp;
        pull.begin(column);
        pullBack(step, pull);
        solution_.head(all) = pulled_.tail(all);
        solution_.segment(last, d) += lq;
        solution_.tail(byImpulses_.size()) = byImpulses_;
        equations.solveTransposed(solution_);
        test_.head(d) -= w.tail(d);
        test_.segment(d, last) = -w.head(last);
        test_.tail(d) = w.tail(d);
        pull.begin(column);
        pullBack(step, pull);
        lq += pulled_.head(d);
        lp -= w.tail(d);
    }
    return columns.allFinite();
}

}  // namespace extremal
