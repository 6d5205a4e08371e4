// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/step_variation.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {
namespace {

/// Of derivatives by time.
double apartInTime(double t) { return 1e-5 * std::max(1.0, std::abs(t)); }

}  // namespace

StepVariation::StepVariation(const Mechanism& mechanism, const MechanismCurve& curve)
    : mechanism_(mechanism), curve_(curve) {
    const int d = curve_.d, n = mechanism_.constraints();
    motion_ = gradient_ = ahead_ = Vector::Zero(2 * d);
    forces_ = Vector::Zero(d);
    value_ = byTime_ = Vector::Zero(n);
    hessian_ = Rows::Zero(2 * d, 2 * d);
    byState_ = Rows::Zero(d, 2 * d);
    byPlace_ = ahead2_ = Rows::Zero(n, d);
    curvature_ = Rows::Zero(d, d);
}

void StepVariation::evaluate(const Step& step, const Directions& along) {
    const int d = curve_.d, m = curve_.unknowns(), n = mechanism_.constraints();
    residual_ = Matrix::Zero(m * (d + n), along.z.cols());
    impulse_ = Matrix::Zero(d, along.z.cols());
    for (int i = 0; i < curve_.table.nodes(); ++i) addLagrangian(step, along, i);
    if (mechanism_.force())
        for (int i = 0; i < curve_.atForces.nodes(); ++i) addForces(step, along, i);
    if (n > 0)
        for (int j = 0; j <= m; ++j) addConditions(step, along, j);
    if (mechanism_.rolling())
        for (int i = 0; i < m; ++i) addRolling(step, along, i);
    // R_{m-1} = p_0 + A - G_{m-1}.
    residual_.middleRows((m - 1) * d, d) = impulse_ - residual_.middleRows((m - 1) * d, d);
}

template <class Value, class Slope>
void StepVariation::moveTo(const Step& step, const Directions& along, double tau, const Value& value,
                           const Slope& slope) {
    const int d = curve_.d;
    motion_.head(d) = step.z.head(d);
    motion_.tail(d).setZero();
    moved_ = Matrix::Zero(2 * d, along.z.cols());
    moved_.topRows(d) = along.z.topRows(d);
    for (int a = 0; a < curve_.unknowns(); ++a) {
        motion_.head(d) += value(a) * step.z.segment((a + 1) * d, d);
        motion_.tail(d) += slope(a) / step.h * step.z.segment((a + 1) * d, d);
        moved_.topRows(d) += value(a) * along.z.middleRows((a + 1) * d, d);
        moved_.bottomRows(d) += slope(a) / step.h * along.z.middleRows((a + 1) * d, d);
    }
    moved_.bottomRows(d) -= motion_.tail(d) / step.h * along.length;
    later_ = along.start + tau * along.length;
}

void StepVariation::addLagrangian(const Step& step, const Directions& along, int node) {
    const Table<double>& table = curve_.table;
    const Mechanics<double>& L = mechanism_.mechanics();
    const int d = curve_.d;
    const double b = table.weight(node), t = step.t + table.node(node) * step.h;
    moveTo(
        step, along, table.node(node), [&](int a) { return table.value(node, a); },
        [&](int a) { return table.derivative(node, a); });
    const double *const q = motion_.data(), *const v = q + d;
    double value = 0;
    L.jet(L.model.get(), t, q, v, &value, gradient_.data(), hessian_.data());
    change_.noalias() = hessian_ * moved_;
    if (L.isTimeDependent && !later_.isZero(0)) {
        const double apart = apartInTime(t);
        L.gradient(L.model.get(), t + apart, q, v, ahead_.data());
        Vector rate = ahead_;
        L.gradient(L.model.get(), t - apart, q, v, ahead_.data());
        change_.noalias() += (rate - ahead_) / (2 * apart) * later_;
    }
    const Matrix kick = b * (step.h * change_.topRows(d) + gradient_.head(d) * along.length);  // of h L_q
    impulse_ += kick;
    for (int a = 0; a < curve_.unknowns(); ++a)
        residual_.middleRows(a * d, d) +=
            table.value(node, a) * kick + b * table.derivative(node, a) * change_.bottomRows(d);
}

void StepVariation::addForces(const Step& step, const Directions& along, int node) {
    const MechanismCurve::Nodes& nodes = curve_.atForces;
    const Force& F = *mechanism_.force();
    const int d = curve_.d;
    const double t = step.t + nodes.place(node) * step.h;
    moveTo(
        step, along, nodes.place(node), [&](int a) { return nodes.at.value(node, a); },
        [&](int a) { return nodes.at.slope(node, a); });
    const double *const q = motion_.data(), *const v = q + d;
    F.first(F.model.get(), t, q, v, forces_.data(), byState_.data());
    change_.noalias() = byState_ * moved_;
    if (F.isTimeDependent && !later_.isZero(0)) {
        const double apart = apartInTime(t);
        Vector after(d), before(d);
        F.value(F.model.get(), t + apart, q, v, after.data());
        F.value(F.model.get(), t - apart, q, v, before.data());
        change_.noalias() += (after - before) / (2 * apart) * later_;
    }
    const Matrix kick = nodes.weight(node) * (step.h * change_ + forces_ * along.length);
    impulse_ += kick;
    for (int a = 0; a < curve_.unknowns(); ++a)
        residual_.middleRows(a * d, d) += nodes.at.value(node, a) * kick;
}

void StepVariation::addConditions(const Step& step, const Directions& along, int node) {
    const int d = curve_.d, m = curve_.unknowns(), n = mechanism_.constraints(), g = mechanism_.holonomic();
    const double t = step.t + curve_.place(node) * step.h;
    const auto none = [](int) { return 0.0; };
    moveTo(
        step, along, curve_.place(node), [&](int a) { return curve_.atPlaces(node, a); }, none);
    const double* const q = motion_.data();
    mechanism_.conditions(t, q, value_, byPlace_, byTime_);
    if (node > 0 && g > 0) {
        auto rows = residual_.middleRows(m * d + (node - 1) * n, g);
        rows.noalias() = byPlace_.topRows(g) * moved_.topRows(d);
        rows.noalias() += byTime_.head(g) * later_;
    }
    if (node == m) return;
    if (const auto& part = mechanism_.constraint())
        addImpulses(step, along, *part, {0, g, node, curve_.place(node), curve_.atPlaces});
    if (const auto& part = mechanism_.rolling())
        addImpulses(step, along, *part,
                    {g, n - g, node, curve_.rolling.c[static_cast<std::size_t>(node)], curve_.atRolling});
}

template <class Part>
void StepVariation::addImpulses(const Step& step, const Directions& along, const Part& part,
                                const Multipliers& of) {
    const int d = curve_.d, first = of.node * mechanism_.constraints() + of.first;
    const double t = step.t + of.place * step.h;
    moveTo(
        step, along, of.place, [&](int a) { return of.at(of.node, a); }, [](int) { return 0.0; });
    const double* const q = motion_.data();
    const auto impulses = step.impulses.segment(first, of.count);
    mechanism_.conditions(t, q, value_, byPlace_, byTime_);
    curvature_.setZero();
    part.addCurvature(part.model.get(), t, q, impulses.data(), curvature_.data());
    change_.noalias() = curvature_ * moved_.topRows(d);
    change_.noalias() +=
        byPlace_.middleRows(of.first, of.count).transpose() * along.impulses.middleRows(first, of.count);
    if (!later_.isZero(0)) {
        const double apart = apartInTime(t);
        mechanism_.conditions(t + apart, q, value_, byPlace_, byTime_);
        mechanism_.conditions(t - apart, q, value_, ahead2_, byTime_);
        const Vector rate =
            (byPlace_ - ahead2_).middleRows(of.first, of.count).transpose() * impulses / (2 * apart);
        change_.noalias() += rate * later_;
    }
    impulse_ += change_;
    for (int a = 0; a < curve_.unknowns(); ++a) residual_.middleRows(a * d, d) += of.at(of.node, a) * change_;
}

void StepVariation::addRolling(const Step& step, const Directions& along, int node) {
    const MechanismCurve::Nodes& nodes = curve_.atGauss;
    const Rolling& r = *mechanism_.rolling();
    const int d = curve_.d, m = curve_.unknowns(), n = mechanism_.constraints(), g = mechanism_.holonomic();
    moveTo(
        step, along, nodes.place(node), [&](int a) { return nodes.at.value(node, a); },
        [&](int a) { return nodes.at.slope(node, a); });
    Vector value(n - g), byTime(n - g);
    Rows byState(n - g, 2 * d);
    r.first(r.model.get(), step.t + nodes.place(node) * step.h, motion_.data(), motion_.data() + d,
            value.data(), byState.data(), byTime.data());
    auto rows = residual_.middleRows(m * d + node * n + g, n - g);
    rows.noalias() = step.h * (byState * moved_);
    rows.noalias() += step.h * byTime * later_ + value * along.length;
}

}  // namespace extremal
