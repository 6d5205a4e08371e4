// SPDX-License-Identifier: GPL-3.0-or-later
/// Spins: unit vectors s_i with the energy H(s) and weights w_i, which move by w_i s_i' = b_i x s_i, b_i =
/// dH/ds_i.
///
/// The symplectic form of spheres has no potential, so that no Lagrangian in s alone has these equations. It
/// has one on the three-sphere over each: with z = (a + ib, c + id) of length 1,
///     s = (2(ac + bd), 2(ad - bc), a^2 + b^2 - c^2 - d^2),
///     L = sum_i 2 w_i Re(i z_i^+ z_i') - H(s(z)),
/// which up to a total derivative is that of the canonical coordinates
///     q = (a_1, c_1, a_2, c_2, ..),     p = (4 w_1 b_1, 4 w_1 d_1, ..).
/// Since H depends on s alone the phase of each z is a symmetry, and what a step does to s is symplectic on
/// the spheres. |z_i|, and sum w_i s_i where H does not change under rotations, are quadratic in (q, p):
/// Gauss collocation keeps them. Schemes that treat q and p differently do not, and spins are not for them.
#pragma once

#include <memory>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/model/parts.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/model/typed/typed_function.hpp"

namespace extremal {

/// H = sum_bonds f pair(s_i, s_j) + sum_i site(s_i).
struct SpinModel {
    struct Bond {
        int i, j;
        double factor;
    };
    std::vector<double> weights;
    std::vector<Bond> bonds;
    std::shared_ptr<const typed::TypedFunction> pair, site;  ///< of 6 and of 3 variables; null: 0

    int count() const { return static_cast<int>(weights.size()); }
};

/// Beside the Hamiltonian in coordinates (PhaseMechanics) that it is.
struct Spins {
    static constexpr PartInfo part{"spins", "spins"};
    std::shared_ptr<const SpinModel> model;
};

namespace spins {

/// s of all spins, three numbers each, of q and p as above.
void spinsOf(const SpinModel& model, const double* q, const double* p, double* s);
/// x = (q, p) of spins of length 1, with one of the phases.
std::vector<double> stateOf(const SpinModel& model, const double* s);
/// H and, unless null, b = dH/ds.
double energyOf(const SpinModel& model, const double* s, double* b);
/// Where quadratic invariants of spins are kept, their lengths are: quadratic in (q, p). Adds "norm".
void claimLengths(const System& system, Claims& claims);
/// Behind the calls of Hamiltonians.
PhaseMechanics mechanicsOf(std::shared_ptr<const SpinModel> model);

}  // namespace spins
}  // namespace extremal
