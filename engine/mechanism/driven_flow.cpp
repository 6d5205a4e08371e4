// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/driven_flow.hpp"

#include <memory>

#include "engine/core/own_buffers.hpp"
#include "engine/mechanism/mechanism.hpp"

namespace extremal {
namespace {

/// The calls of the Lagrangian take the model of the original, which is in front.
struct Driven {
    Mechanics<double> lagrangian;
    Mechanism prototype;
    long long id;
};
const Driven& driven(const void* p) { return *static_cast<const Driven*>(p); }

/// A Mechanism has buffers.
Mechanism& ownMechanism(const Driven& of) { return ownBuffers<Mechanism>(of.id, of.prototype); }

void jet(const void* p, const double& t, const double* q, const double* v, double* value, double* gradient,
         double* hessian) {
    const Mechanics<double>& L = driven(p).lagrangian;
    L.jet(L.model.get(), t, q, v, value, gradient, hessian);
}
void gradient(const void* p, const double& t, const double* q, const double* v, double* gradient) {
    const Mechanics<double>& L = driven(p).lagrangian;
    L.gradient(L.model.get(), t, q, v, gradient);
}
bool velocity(const void* p, const double& t, const double* q, const double* momentum, double* v) {
    const Mechanics<double>& L = driven(p).lagrangian;
    return L.velocity(L.model.get(), t, q, momentum, v);
}
double energy(const void* p, const double& t, const double* q, const double* momentum) {
    const Mechanics<double>& L = driven(p).lagrangian;
    return L.energy(L.model.get(), t, q, momentum);
}
bool flow(const void* p, const double& t, const double* q, const double* momentum, double* qdot,
          double* pdot) {
    return ownMechanism(driven(p)).flow(t, q, momentum, qdot, pdot);
}

}  // namespace

bool isDriven(const Mechanics<double>& mechanics) { return mechanics.flow == flow; }

Mechanics<double> drivenMechanics(const System& system) {
    if (!Mechanism::isOne(system.parts)) return flowOf(system);
    const Mechanics<double>& L = system.mechanics();
    Mechanics<double> made;
    made.dimension = L.dimension;
    made.isTimeDependent = L.isTimeDependent;
    made.model = std::make_shared<const Driven>(Driven{L, Mechanism(system.parts), nextModelId()});
    made.jet = jet;
    made.gradient = gradient;
    made.velocity = velocity;
    made.energy = energy;
    made.flow = flow;
    return made;
}

}  // namespace extremal
