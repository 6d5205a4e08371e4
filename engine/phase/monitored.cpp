// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/monitored.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/core/memo_cache.hpp"
#include "engine/core/own_buffers.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/parts/energy_formula.hpp"
#include "engine/model/typed/tape/node_tape.hpp"
#include "engine/phase/flow_jacobian.hpp"
#include "engine/phase/logarithmic.hpp"

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// H(q, p) = p . v - L.
struct LegendreModel {
    Mechanics<double> mechanics;
    long long id;
};
struct LegendreRoom {
    explicit LegendreRoom(const Mechanics<double>& of)
        : jacobian(of), qdot(Vector::Zero(of.dimension)), pdot(qdot) {}
    FlowJacobian jacobian;
    Vector qdot, pdot;
};
const Mechanics<double>& mechanicsOf(const void* model) {
    return static_cast<const LegendreModel*>(model)->mechanics;
}
LegendreRoom& roomOf(const void* model) {
    return ownBuffers<LegendreRoom>(static_cast<const LegendreModel*>(model)->id, mechanicsOf(model));
}

double legendreEnergy(const void* model, double t, const double* q, const double* p) {
    const Mechanics<double>& m = mechanicsOf(model);
    return m.energy(m.model.get(), t, q, p);
}
void legendreGradient(const void* model, double t, const double* q, const double* p, double* gradient) {
    const Mechanics<double>& m = mechanicsOf(model);
    const int d = m.dimension;
    if (!m.flow(m.model.get(), t, q, p, gradient + d, gradient))
        return void(std::fill_n(gradient, 2 * d, std::numeric_limits<double>::quiet_NaN()));
    for (int k = 0; k < d; ++k) gradient[k] = -gradient[k];
}
/// Of a separable Lagrangian, and its velocities.
void legendreForce(const void* model, double t, const double* q, double* f) {
    const Mechanics<double>& m = mechanicsOf(model);
    m.force(m.model.get(), t, q, f);
}
void legendreVelocity(const void* model, double, const double* p, double* v) {
    const Mechanics<double>& m = mechanicsOf(model);
    for (int k = 0; k < m.dimension; ++k) v[k] = p[k] / m.masses[k];
}
void legendreHessian(const void* model, double t, const double* q, const double* p, double* hessian) {
    const Mechanics<double>& m = mechanicsOf(model);
    const int d = m.dimension;
    LegendreRoom& room = roomOf(model);
    Eigen::Map<Matrix> H(hessian, 2 * d, 2 * d);
    if (!m.velocity(m.model.get(), t, q, p, room.qdot.data()))
        return void(H.setConstant(std::numeric_limits<double>::quiet_NaN()));
    const Matrix& slope = room.jacobian.evaluate(t, q, p, room.qdot.data());
    H.bottomRows(d) = slope.topRows(d);
    H.topRows(d) = -slope.bottomRows(d);
}

/// Of a separable Lagrangian.
void legendreGradients(const void* model, const double* t, int nodes, const double* q, const double* p,
                       double* gradients) {
    const Mechanics<double>& m = mechanicsOf(model);
    const int half = m.dimension * nodes;
    m.forces(m.model.get(), t, nodes, q, gradients);
    std::transform(gradients, gradients + half, gradients, [](double force) { return -force; });
    for (int k = 0; k < half; ++k) gradients[half + k] = p[k] / m.masses[k / nodes];
}

struct MonitoredModel {
    PhaseMechanics H;
    typed::NodeTape slopes;  ///< of K, where it is a formula
    std::shared_ptr<const Monitor> monitor;
    long long id;
};
struct MonitoredRoom {
    explicit MonitoredRoom(const MonitoredModel& of)
        : slope(Vector::Zero(2 * of.H.dimension)),
          monitorSlope(slope),
          hessian(Matrix::Zero(slope.size(), slope.size())),
          monitorHessian(hessian) {}
    Vector slope, monitorSlope;
    Matrix hessian, monitorHessian;
};

const MonitoredModel& monitored(const void* model) { return *static_cast<const MonitoredModel*>(model); }
MonitoredRoom& monitoredRoom(const MonitoredModel& m) { return ownBuffers<MonitoredRoom>(m.id, m); }

double monitoredEnergy(const void* model, double, const double* q, const double* p) {
    const MonitoredModel& m = monitored(model);
    return (*m.monitor)(q + 1, p + 1) * (m.H.energy(m.H.model.get(), 0, q + 1, p + 1) + p[0]);
}
void monitoredGradient(const void* model, double, const double* q, const double* p, double* gradient) {
    const MonitoredModel& m = monitored(model);
    const int d = m.H.dimension;
    MonitoredRoom& own = monitoredRoom(m);
    double g = 0;
    m.monitor->evaluate(q + 1, p + 1, &g, own.monitorSlope.data(), nullptr);
    m.H.gradient(m.H.model.get(), 0, q + 1, p + 1, own.slope.data());
    const double off = m.H.energy(m.H.model.get(), 0, q + 1, p + 1) + p[0];
    gradient[0] = 0;
    gradient[d + 1] = g;
    for (int k = 0; k < d; ++k) {
        gradient[1 + k] = g * own.slope(k) + off * own.monitorSlope(k);
        gradient[d + 2 + k] = g * own.slope(d + k) + off * own.monitorSlope(d + k);
    }
}
void monitoredGradients(const void* model, const double*, int nodes, const double* q, const double* p,
                        double* gradients) {
    monitored(model).slopes.evaluate(nodes, q, p, gradients);
}
/// The gradient of K as formulas, in which H and g share what they have in common.
std::optional<typed::NodeTape> slopesOf(const EnergyFormula& energy, const Monitor& monitor, int d) {
    typed::Graph graph;
    std::vector<int> variables;
    for (const int first : {1, d + 2})
        for (int k = 0; k < d; ++k) variables.push_back(graph.symbol(first + k));
    const auto g = monitor.addTo(graph, variables);
    const auto H = g ? energy.addTo(graph, variables) : std::nullopt;
    if (!H) return {};
    const int off = graph.sum(0, {{H->value}, {graph.symbol(d + 1)}});
    std::vector<int> roots;
    for (std::size_t k = 0; k < H->gradient.size(); ++k)
        roots.push_back(graph.sum(0, {{graph.product({{g->value}, {H->gradient[k]}})},
                                      {graph.product({{off}, {g->gradient[k]}})}}));
    roots.insert(roots.begin() + d, g->value);
    roots.insert(roots.begin(), graph.number(0));
    return typed::NodeTape(graph, roots, d + 1);
}
void monitoredHessian(const void* model, double, const double* q, const double* p, double* hessian) {
    const MonitoredModel& m = monitored(model);
    const int d = m.H.dimension;
    MonitoredRoom& own = monitoredRoom(m);
    double g = 0;
    m.monitor->evaluate(q + 1, p + 1, &g, own.monitorSlope.data(), own.monitorHessian.data());
    m.H.gradient(m.H.model.get(), 0, q + 1, p + 1, own.slope.data());
    m.H.hessian(m.H.model.get(), 0, q + 1, p + 1, own.hessian.data());
    const double off = m.H.energy(m.H.model.get(), 0, q + 1, p + 1) + p[0];
    own.hessian *= g;
    own.hessian.noalias() += own.monitorSlope * own.slope.transpose();
    own.hessian.noalias() += own.slope * own.monitorSlope.transpose();
    own.hessian.noalias() += off * own.monitorHessian;
    Eigen::Map<Matrix> K(hessian, 2 * d + 2, 2 * d + 2);
    K.setZero();
    K.block(1, 1, d, d) = own.hessian.topLeftCorner(d, d);
    K.block(1, d + 2, d, d) = own.hessian.topRightCorner(d, d);
    K.block(d + 2, 1, d, d) = own.hessian.bottomLeftCorner(d, d);
    K.block(d + 2, d + 2, d, d) = own.hessian.bottomRightCorner(d, d);
    K.col(d + 1).segment(1, d) = own.monitorSlope.head(d);
    K.col(d + 1).segment(d + 2, d) = own.monitorSlope.tail(d);
    K.row(d + 1) = K.col(d + 1).transpose();
}

/// K = g (H + p_t).
PhaseMechanics scaledMotion(const PhaseMechanics& H, const EnergyFormula* formula,
                            const std::shared_ptr<const Monitor>& g) {
    PhaseMechanics K;
    K.dimension = H.dimension + 1;
    constexpr int few = 16;  // as for gradients of H
    auto slopes = formula && H.dimension <= few ? slopesOf(*formula, *g, H.dimension) : std::nullopt;
    if (slopes) K.gradients = monitoredGradients;
    K.model = std::make_shared<const MonitoredModel>(
        MonitoredModel{H, slopes ? *std::move(slopes) : typed::NodeTape(), g, nextModelId()});
    K.energy = monitoredEnergy;
    K.gradient = monitoredGradient;
    K.hessian = monitoredHessian;
    return K;
}

/// Of the Lagrangian or the Hamiltonian that moves the system.
const std::shared_ptr<const void>& modelOf(const System& system) {
    const auto* const own = system.parts.find<PhaseMechanics>();
    return own ? own->model : system.mechanics().model;
}

/// H, g with its bound, and K, which no start is needed for.
struct Motion {
    PhaseMechanics H, K;
    std::shared_ptr<const Monitor> g;
};
Motion makeMotion(const System& system, const Settings& monitor, double most) {
    Motion made;
    made.H = hamiltonianFrom(system);
    made.g = makeMonitor(monitor, system, made.H);
    if (std::isfinite(most)) made.g = boundedMonitor(std::move(made.g), made.H.dimension, most);
    const auto* const energy = system.parts.find<EnergyFormula>();
    const EnergyFormula* const formula = energy && energy->of == modelOf(system) ? energy : nullptr;
    made.K = isLogarithmic(monitor) ? logarithmicMotion(made.H, formula, 1 / most)
                                    : scaledMotion(made.H, formula, made.g);
    return made;
}
/// The last ones are remembered: their formulas cost as much as a short run.
Motion motionOf(const System& system, const Settings& monitor, double most) {
    using Key = std::tuple<std::shared_ptr<const void>, Settings, double>;
    static MemoCache<Key, Motion> recent(8);
    return recent.get(Key(modelOf(system), monitor, most), [&] { return makeMotion(system, monitor, most); });
}

System withTime(const System& of, PhaseMechanics motion) {
    System s;
    s.id = of.id;
    s.coordinates.push_back({"t", "time", "t", of.timeUnit, ""});
    s.coordinates.insert(s.coordinates.end(), of.coordinates.begin(), of.coordinates.end());
    s.parts.set(std::move(motion));
    return s;
}

[[noreturn]] void refuseValue(double g, const State& start) {
    throw InvalidScene("/monitor",
                       "is " + formatNumber(g, 6) + " at the start, t = " + formatNumber(start.t) +
                           ": steps in proportion to it need a positive finite number",
                       "a function that is positive along the motion, or another start");
}

}  // namespace

bool hasHamiltonian(const System& system) {
    return system.isMovedOnlyBy<Mechanical>() || system.isMovedOnlyBy<PhaseMechanics>();
}

PhaseMechanics hamiltonianFrom(const System& system) {
    if (const PhaseMechanics* const given = system.parts.find<PhaseMechanics>()) return *given;
    const Mechanical& mechanics = system.mechanics();
    PhaseMechanics made;
    made.dimension = mechanics.dimension;
    made.isTimeDependent = mechanics.isTimeDependent;
    made.model = std::make_shared<const LegendreModel>(LegendreModel{mechanics, nextModelId()});
    made.energy = legendreEnergy;
    made.gradient = legendreGradient;
    made.hessian = legendreHessian;
    if (mechanics.isSeparable) {
        for (int k = 0; k < mechanics.dimension; ++k) made.inverseMasses.push_back(1 / mechanics.masses[k]);
        made.force = legendreForce;
        made.velocity = legendreVelocity;
        if (mechanics.forces) made.gradients = legendreGradients;
    }
    return made;
}

System monitoredKind(const System& system, const Settings& monitor) {
    PhaseMechanics motion;
    motion.dimension = system.dimension() + 1;
    if (isLogarithmic(monitor)) motion.force = [](const void*, double, const double*, double*) {};
    return withTime(system, std::move(motion));
}

MonitoredProblem monitoredProblem(const System& system, const Settings& monitor, const State& start,
                                  double first) {
    Motion motion = motionOf(system, monitor, std::numeric_limits<double>::infinity());
    const PhaseMechanics& H = motion.H;
    if (H.isTimeDependent)
        throw InvalidScene("/monitor",
                           "needs a Hamiltonian without explicit time: with its energy at t = " +
                               formatNumber(start.t) + " the steps would follow another motion",
                           "fixed steps, or an adaptive code such as dopri5");
    const int d = H.dimension;
    const bool isKnown = !start.x.empty();
    const double *const q = start.x.data(), *const p = isKnown ? q + d : q;
    const double atStart = isKnown ? (*motion.g)(q, p) : 1;
    if (!(atStart > 0) || !std::isfinite(atStart)) refuseValue(atStart, start);
    if (const double longest = monitor.number("max"); longest > 0) {
        const double ratio = longest / std::abs(first);
        if (!(ratio > 1))
            throw InvalidScene("/monitor/max",
                               "must be longer than the first step, " + formatNumber(std::abs(first)) +
                                   ", got " + formatNumber(longest),
                               "a shorter first step");
        motion = motionOf(system, monitor, atStart * (ratio - 1));
    }
    State of{0, 0, {}, {}};
    if (isKnown) {
        of.x.push_back(start.t);
        of.x.insert(of.x.end(), q, p);
        of.x.push_back(-H.energy(H.model.get(), start.t, q, p));
        of.x.insert(of.x.end(), p, p + d);
    }
    return {withTime(system, std::move(motion.K)), std::move(of), std::move(motion.H), std::move(motion.g)};
}

bool isEven(const Monitor& monitor, const State& at) {
    constexpr double roundOff = 1e-9;
    const std::size_t d = at.x.size() / 2;
    std::vector<double> there(at.x.begin() + static_cast<std::ptrdiff_t>(d), at.x.end()), back(d);
    double size = 0;
    for (const double each : there) size = std::max(size, std::abs(each));
    // Momenta of which none is zero, and which no symmetry of a start hides.
    for (std::size_t k = 0; k < d; ++k) {
        there[k] += (size > 0 ? size : 1) * (0.1 + 0.03 * static_cast<double>(k % 7));
        back[k] = -there[k];
    }
    const double one = monitor(at.x.data(), there.data()), other = monitor(at.x.data(), back.data());
    return !(std::abs(one - other) > roundOff * std::abs(one));
}

}  // namespace extremal
