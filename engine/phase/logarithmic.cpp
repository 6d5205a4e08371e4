// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/logarithmic.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/own_buffers.hpp"
#include "engine/model/typed/graph.hpp"
#include "engine/model/typed/tape/tape.hpp"
#include "engine/model/typed/tape/tape_registers.hpp"

namespace extremal {
namespace {

struct LogarithmicModel {
    PhaseMechanics H;
    double c;
    typed::Tape kick;  ///< -V'/(c - V); without outputs where the formula of V is not known
    long long id;
};
struct LogarithmicRoom {
    explicit LogarithmicRoom(const LogarithmicModel& of)
        : rest(Eigen::VectorXd::Zero(of.H.dimension)),
          slope(Eigen::VectorXd::Zero(2 * of.H.dimension)),
          hessian(Eigen::MatrixXd::Zero(slope.size(), slope.size())) {}
    Eigen::VectorXd rest;  ///< no momenta: H is V
    Eigen::VectorXd slope;
    Eigen::MatrixXd hessian;
};

const LogarithmicModel& self(const void* model) { return *static_cast<const LogarithmicModel*>(model); }
LogarithmicRoom& roomOf(const LogarithmicModel& m) { return ownBuffers<LogarithmicRoom>(m.id, m); }

/// T + p_t + c at (p_t, p).
double forward(const LogarithmicModel& m, const double* p) {
    double twice = 0;
    for (std::size_t k = 0; k < m.H.inverseMasses.size(); ++k)
        twice += m.H.inverseMasses[k] * p[1 + k] * p[1 + k];
    return twice / 2 + p[0] + m.c;
}
/// c - V at (t, q).
double depth(const LogarithmicModel& m, const double* q) {
    return m.c - m.H.energy(m.H.model.get(), q[0], q + 1, roomOf(m).rest.data());
}

double energy(const void* model, double, const double* q, const double* p) {
    const LogarithmicModel& m = self(model);
    return std::log(forward(m, p)) - std::log(depth(m, q));
}
void velocity(const void* model, double, const double* p, double* v) {
    const LogarithmicModel& m = self(model);
    v[0] = 1 / forward(m, p);
    for (std::size_t k = 0; k < m.H.inverseMasses.size(); ++k)
        v[1 + k] = m.H.inverseMasses[k] * p[1 + k] * v[0];
}
void force(const void* model, double, const double* q, double* f) {
    const LogarithmicModel& m = self(model);
    const auto d = static_cast<std::size_t>(m.H.dimension);
    f[0] = 0;
    if (m.kick.outputs() > 0)
        return typed::TapeRegisters(m.kick, [&](double* r) { std::copy_n(q + 1, d, r); }).copy(0, d, f + 1);
    m.H.force(m.H.model.get(), q[0], q + 1, f + 1);
    const double perDepth = 1 / depth(m, q);
    for (std::size_t k = 1; k <= d; ++k) f[k] *= perDepth;
}
/// Places are at `x`, from where `evaluate` makes the force.
template <class Evaluate>
void takeAll(const LogarithmicModel& m, std::span<const KickAndDrift<double>> pairs, bool isForceKnown,
             double& t, double* x, double* p, double* f, const Evaluate& evaluate) {
    const std::size_t d = m.H.inverseMasses.size();
    const double* const w = m.H.inverseMasses.data();
    for (const KickAndDrift<double>& pair : pairs) {
        if (!isForceKnown) evaluate();
        isForceKnown = false;
        for (std::size_t k = 0; k <= d; ++k) p[k] += pair.kick * f[k];
        if (pair.drift == 0) continue;
        const double rate = 1 / forward(m, p);
        t += pair.drift * rate;
        for (std::size_t k = 0; k < d; ++k) x[k] += pair.drift * (w[k] * p[1 + k] * rate);
    }
}
void kicksAndDrifts(const void* model, std::span<const KickAndDrift<double>> pairs, const double*,
                    bool isForceKnown, double* q, double* p, double* f) {
    const LogarithmicModel& m = self(model);
    const std::size_t d = m.H.inverseMasses.size();
    if (m.kick.outputs() == 0)
        return takeAll(m, pairs, isForceKnown, q[0], q + 1, p, f, [&] { force(model, 0, q, f); });
    // Places stay in the registers of the formula.
    typed::TapeRoom room(m.kick.registers());
    double* const r = room.data();
    for (std::size_t k = 0; k < d; ++k) r[k] = q[1 + k];
    takeAll(m, pairs, isForceKnown, q[0], r, p, f, [&] {
        m.kick.run(r);
        f[0] = 0;
        for (std::size_t k = 0; k < d; ++k) f[1 + k] = m.kick.output(k, r);
    });
    for (std::size_t k = 0; k < d; ++k) q[1 + k] = r[k];
}
void gradient(const void* model, double t, const double* q, const double* p, double* g) {
    const int n = self(model).H.dimension + 1;
    force(model, t, q, g);
    std::transform(g, g + n, g, [](double f) { return -f; });
    velocity(model, t, p, g + n);
}
void hessian(const void* model, double, const double* q, const double* p, double* h) {
    const LogarithmicModel& m = self(model);
    LogarithmicRoom& own = roomOf(m);
    const Eigen::Index d = m.H.dimension;
    const double perDepth = 1 / depth(m, q), perForward = 1 / forward(m, p);
    m.H.gradient(m.H.model.get(), q[0], q + 1, own.rest.data(), own.slope.data());
    m.H.hessian(m.H.model.get(), q[0], q + 1, own.rest.data(), own.hessian.data());
    const auto slope = own.slope.head(d) * perDepth;
    Eigen::Map<Eigen::MatrixXd> K(h, 2 * d + 2, 2 * d + 2);
    K.setZero();
    K.block(1, 1, d, d) = own.hessian.topLeftCorner(d, d) * perDepth;
    K.block(1, 1, d, d).noalias() += slope * slope.transpose();
    K(d + 1, d + 1) = -perForward * perForward;
    for (Eigen::Index k = 0; k < d; ++k) {
        const double w = m.H.inverseMasses[static_cast<std::size_t>(k)], v = w * p[1 + k] * perForward;
        K(d + 2 + k, d + 2 + k) = w * perForward;
        K(d + 1, d + 2 + k) = K(d + 2 + k, d + 1) = -v * perForward;
        own.slope(d + k) = v;
    }
    K.block(d + 2, d + 2, d, d).noalias() -= own.slope.tail(d) * own.slope.tail(d).transpose();
}

/// -V'/(c - V) as formulas in q.
typed::Tape kickOf(const EnergyFormula& formula, int d, double c) {
    typed::Graph graph;
    std::vector<int> places;
    for (int k = 0; k < d; ++k) places.push_back(graph.symbol(k));
    std::vector<int> variables = places;
    variables.resize(static_cast<std::size_t>(2 * d), graph.number(0));
    const auto V = formula.addTo(graph, variables);
    if (!V) return {};
    const int depth = graph.sum(c, {{V->value, -1}});
    std::vector<int> roots;
    for (std::size_t k = 0; k < places.size(); ++k)
        roots.push_back(graph.scaled(graph.product({{V->gradient[k]}, {depth, -1}}), -1));
    return typed::Tape::of(graph, roots, d);
}

}  // namespace

PhaseMechanics logarithmicMotion(const PhaseMechanics& H, const EnergyFormula* formula, double c) {
    PhaseMechanics K;
    K.dimension = H.dimension + 1;
    K.energy = energy;
    K.gradient = gradient;
    K.hessian = hessian;
    K.velocity = velocity;
    K.force = force;
    K.kicksAndDrifts = kicksAndDrifts;
    K.model = std::make_shared<const LogarithmicModel>(
        LogarithmicModel{H, c, formula ? kickOf(*formula, H.dimension, c) : typed::Tape(), nextModelId()});
    return K;
}

}  // namespace extremal
