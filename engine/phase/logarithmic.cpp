// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/logarithmic.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "engine/core/own_buffers.hpp"
#include "engine/model/typed/graph.hpp"
#include "engine/model/typed/tape/tape.hpp"
#include "engine/model/typed/tape/tape_kicks.hpp"
#include "engine/model/typed/tape/tape_registers.hpp"

namespace extremal {
namespace {

struct LogarithmicModel {
    PhaseMechanics H;
    double c;
    typed::Tape kick, drift;  ///< -V'/(c - V) and K_p; without outputs where V has no formula
    typed::KickTape pair;     ///< of both
    long long id;
};
struct LogarithmicRoom {
    explicit LogarithmicRoom(const LogarithmicModel& of)
        : rest(Eigen::VectorXd::Zero(of.H.dimension)),
          slope(Eigen::VectorXd::Zero(2 * of.H.dimension)),
          hessian(Eigen::MatrixXd::Zero(slope.size(), slope.size())),
          rates(Eigen::VectorXd::Zero(rest.size() + 1)) {}
    Eigen::VectorXd rest;  ///< no momenta: H is V
    Eigen::VectorXd slope;
    Eigen::MatrixXd hessian;
    Eigen::VectorXd rates;
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
    const auto n = static_cast<std::size_t>(m.H.dimension + 1);
    if (m.drift.outputs() > 0)
        return typed::TapeRegisters(m.drift, [&](double* r) { std::copy_n(p, n, r + n); }).copy(0, n, v);
    v[0] = 1 / forward(m, p);
    for (std::size_t k = 0; k < m.H.inverseMasses.size(); ++k)
        v[1 + k] = m.H.inverseMasses[k] * p[1 + k] * v[0];
}
void force(const void* model, double, const double* q, double* f) {
    const LogarithmicModel& m = self(model);
    const auto d = static_cast<std::size_t>(m.H.dimension);
    if (m.kick.outputs() > 0)
        return typed::TapeRegisters(m.kick, [&](double* r) { std::copy_n(q, d + 1, r); }).copy(0, d + 1, f);
    f[0] = 0;
    m.H.force(m.H.model.get(), q[0], q + 1, f + 1);
    const double perDepth = 1 / depth(m, q);
    for (std::size_t k = 1; k <= d; ++k) f[k] *= perDepth;
}
void kicksAndDrifts(const void* model, const KicksAndDrifts<double>& steps, double* q, double* p, double* f) {
    const LogarithmicModel& m = self(model);
    if (m.kick.outputs() > 0) return m.pair.take(steps, q, p, f);
    const int n = m.H.dimension + 1;
    Eigen::VectorXd& v = roomOf(m).rates;
    const auto drift = [&](double s) {
        velocity(model, 0, p, v.data());
        for (int k = 0; k < n; ++k) q[k] += s * v(k);
    };
    steps.take(
        drift,
        [&](const KickAndDrift<double>& by, bool isForceKnown) {
            if (!isForceKnown) force(model, 0, q, f);
            for (int k = 0; k < n; ++k) p[k] += by.kick * f[k];
            drift(by.drift);
        },
        [&](long long step) {
            if (!steps.nodes) return;
            double* const node = steps.nodes + static_cast<std::size_t>(step) * steps.stride;
            std::copy_n(p, n, std::copy_n(q, n, node));
        });
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

/// K_p and -K_q = -V'/(c - V) as formulas in (t, q; p_t, p).
void addFormulas(LogarithmicModel& m, const EnergyFormula& formula) {
    const int n = m.H.dimension + 1;
    typed::Graph graph;
    std::vector<int> places, kicks{graph.number(0)};
    for (int k = 1; k < n; ++k) places.push_back(graph.symbol(k));
    std::vector<int> variables = places;
    variables.resize(static_cast<std::size_t>(2 * (n - 1)), graph.number(0));
    const auto V = formula.addTo(graph, variables);
    if (!V) return;
    const int depth = graph.sum(m.c, {{V->value, -1}});
    for (std::size_t k = 0; k < places.size(); ++k)
        kicks.push_back(graph.scaled(graph.product({{V->gradient[k]}, {depth, -1}}), -1));
    std::vector<typed::Graph::Operand> energies{{graph.symbol(n), 1}};
    for (int k = 1; k < n; ++k)
        energies.push_back({graph.product({{graph.symbol(n + k), 2}}),
                            m.H.inverseMasses[static_cast<std::size_t>(k - 1)] / 2});
    const int rate = graph.product({{graph.sum(m.c, energies), -1}});
    std::vector<int> velocities{rate};
    for (int k = 1; k < n; ++k)
        velocities.push_back(graph.scaled(graph.product({{graph.symbol(n + k)}, {rate}}),
                                          m.H.inverseMasses[static_cast<std::size_t>(k - 1)]));
    m.kick = typed::Tape::of(graph, kicks, n);
    m.drift = typed::Tape::of(graph, velocities, 2 * n);
    m.pair = typed::KickTape::ofSum(graph, kicks, velocities);
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
    auto model = std::make_shared<LogarithmicModel>(LogarithmicModel{H, c, {}, {}, {}, nextModelId()});
    if (formula) addFormulas(*model, *formula);
    K.kicksAndDrifts = kicksAndDrifts;
    K.model = std::move(model);
    return K;
}

}  // namespace extremal
