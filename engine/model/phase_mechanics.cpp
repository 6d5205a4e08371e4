// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/phase_mechanics.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "engine/model/one_form.hpp"
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
    SlopesAt g(of, t, q, p);
    std::copy_n(g.data() + of.dimension, of.dimension, v);
    return true;
}
double energy(const void* model, const double& t, const double* q, const double* p) {
    const PhaseMechanics& of = self(model);
    return of.energy(of.model.get(), t, q, p);
}

void force(const void* model, const double& t, const double* q, double* f) {
    const PhaseMechanics& of = self(model);
    SlopesAt g(of, t, q, q);  // of V, whatever the momenta
    std::transform(g.data(), g.data() + of.dimension, f, [](double slope) { return -slope; });
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
        made.force = force;
        made.masses = model->masses.data();
    }
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
    if (const OneForm* const form = system.parts.find<OneForm>()) return flowOf(*form);
    const PhaseMechanics* const hamiltonian = system.parts.find<PhaseMechanics>();
    return hamiltonian ? flowOf(*hamiltonian) : system.mechanics();
}

}  // namespace extremal
