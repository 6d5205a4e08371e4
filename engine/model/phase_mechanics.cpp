// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/phase_mechanics.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/model/first_order/first_order.hpp"
#include "engine/model/group/group_flow.hpp"
#include "engine/model/system.hpp"

namespace extremal {
namespace {

struct PhaseFlow {
    PhaseMechanics mechanics;
    std::vector<double> masses;  ///< separable
};
const PhaseMechanics& self(const void* p) { return static_cast<const PhaseFlow*>(p)->mechanics; }

/// Room for a gradient: on the stack for few coordinates.
class SlopesAt {
public:
    SlopesAt(const PhaseMechanics& of, double t, const double* q, const double* p)
        : many_(static_cast<std::size_t>(2 * of.dimension) > few_.size()
                    ? static_cast<std::size_t>(2 * of.dimension)
                    : 0) {
        of.gradient(of.model.get(), t, q, p, data());
    }
    double* data() { return many_.empty() ? few_.data() : many_.data(); }

private:
    std::array<double, 128> few_;
    std::vector<double> many_;
};

bool flow(const void* model, const double& t, const double* q, const double* p, double* qdot, double* pdot) {
    const PhaseMechanics& of = self(model);
    SlopesAt g(of, t, q, p);
    const double* const at = g.data();
    std::copy_n(at + of.dimension, of.dimension, qdot);
    std::transform(at, at + of.dimension, pdot, [](double slope) { return -slope; });
    return true;
}
bool velocity(const void* model, const double& t, const double* q, const double* p, double* v) {
    const PhaseMechanics& of = self(model);
    if (of.velocity) {
        of.velocity(of.model.get(), t, p, v);
        return true;
    }
    SlopesAt g(of, t, q, p);
    std::copy_n(g.data() + of.dimension, of.dimension, v);
    return true;
}
double energy(const void* model, const double& t, const double* q, const double* p) {
    const PhaseMechanics& of = self(model);
    return of.energy(of.model.get(), t, q, p);
}

// Of a separable H: L = 1/2 sum_i m_i v_i^2 - V(t, q), V = H(t, q, 0).

const std::vector<double>& massesOf(const void* p) { return static_cast<const PhaseFlow*>(p)->masses; }

void lagrangianGradient(const void* model, const double& t, const double* q, const double* v,
                        double* gradient) {
    const PhaseMechanics& of = self(model);
    of.gradient(of.model.get(), t, q, v, gradient);
    const std::vector<double>& masses = massesOf(model);
    for (std::size_t k = 0; k < masses.size(); ++k) {
        gradient[k] = -gradient[k];
        gradient[masses.size() + k] = masses[k] * v[k];
    }
}
void lagrangianJet(const void* model, const double& t, const double* q, const double* v, double* value,
                   double* gradient, double* hessian) {
    const PhaseMechanics& of = self(model);
    const std::vector<double>& masses = massesOf(model);
    const auto d = static_cast<std::size_t>(of.dimension);
    // H at p = v is V and a kinetic energy with other masses.
    *value = -of.energy(of.model.get(), t, q, v);
    for (std::size_t k = 0; k < d; ++k) *value += (masses[k] + of.inverseMasses[k]) * v[k] * v[k] / 2;
    lagrangianGradient(model, t, q, v, gradient);
    of.hessian(of.model.get(), t, q, v, hessian);
    for (std::size_t i = 0; i < d; ++i)
        for (std::size_t j = 0; j < d; ++j) {
            hessian[i * 2 * d + j] = -hessian[i * 2 * d + j];
            hessian[(d + i) * 2 * d + d + j] = i == j ? masses[i] : 0;
        }
}
void forces(const void* model, const double* t, int nodes, const double* q, double* f) {
    const PhaseMechanics& of = self(model);
    of.forces(of.model.get(), t, nodes, q, f);
}

void force(const void* model, const double& t, const double* q, double* f) {
    const PhaseMechanics& of = self(model);
    if (of.force) return of.force(of.model.get(), t, q, f);
    SlopesAt g(of, t, q, q);  // of V, whatever the momenta
    std::transform(g.data(), g.data() + of.dimension, f, [](double slope) { return -slope; });
}

void kicksAndDrifts(const void* model, const KicksAndDrifts<double>& steps, double* q, double* p,
                    double* force) {
    const PhaseMechanics& of = self(model);
    of.kicksAndDrifts(of.model.get(), steps, q, p, force);
}

}  // namespace

Mechanics<double> flowOf(const PhaseMechanics& mechanics) {
    Mechanics<double> made;
    made.dimension = mechanics.dimension;
    made.isTimeDependent = mechanics.isTimeDependent;
    auto model = std::make_shared<PhaseFlow>(PhaseFlow{mechanics, {}});
    if (mechanics.isSeparable()) {
        for (const double w : mechanics.inverseMasses) model->masses.push_back(1 / w);
        made.isSeparable = true;
        made.masses = model->masses.data();
        made.jet = lagrangianJet;
        made.gradient = lagrangianGradient;
        if (mechanics.forces) made.forces = forces;
    }
    if (mechanics.isSeparable() || mechanics.force) made.force = force;
    if (mechanics.kicksAndDrifts) made.kicksAndDrifts = kicksAndDrifts;
    made.model = model;
    made.velocity = velocity;
    made.energy = energy;
    made.flow = flow;
    return made;
}

const PhaseMechanics* hamiltonianOf(const Mechanics<double>& mechanics) {
    return mechanics.flow == flow ? &self(mechanics.model.get()) : nullptr;
}

Mechanics<double> flowOf(const System& system) {
    if (isFirstOrder(system)) return flowOf(firstOrderOf(system));
    if (isOnGroup(system)) return groupFlowOf(system);
    const PhaseMechanics* const hamiltonian = system.parts.find<PhaseMechanics>();
    return hamiltonian ? flowOf(*hamiltonian) : system.mechanics();
}

}  // namespace extremal
