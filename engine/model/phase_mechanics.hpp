// SPDX-License-Identifier: GPL-3.0-or-later
/// A mechanical system that is given by its Hamiltonian H(t, q, p), behind one plain call per node.
///
/// Hamilton's equations q' = H_p, p' = -H_q are all that its schemes need: no Legendre transform is made, and
/// H_pp may be singular (H linear in p). Arrays of length d: q[i], p[i]. Gradients of length 2d: (dH/dq_0..,
/// dH/dp_0..). Hessians 2d x 2d, symmetric, entry (i, j) at i * 2d + j, in the same order.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/model/mechanics.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

struct System;

struct PhaseMechanics {
    static constexpr PartInfo part{"hamiltonian", "a Hamiltonian in coordinates"};

    int dimension = 0;                  ///< of q
    std::shared_ptr<const void> model;  ///< first argument of every call below

    double (*energy)(const void*, double t, const double* q, const double* p) = nullptr;
    void (*gradient)(const void*, double t, const double* q, const double* p, double* gradient) = nullptr;
    void (*hessian)(const void*, double t, const double* q, const double* p, double* hessian) = nullptr;

    /// Gradients at many nodes together, where the system offers it (null else): entry k of node i at
    /// k * nodes + i, likewise q and p; `nodes` is a multiple of 8.
    void (*gradients)(const void*, const double* t, int nodes, const double* q, const double* p,
                      double* gradients) = nullptr;

    /// H = A(t, p) + B(t, q), and the system offers its halves (null else): dA/dp and -dB/dq, each of which
    /// costs less than the gradient.
    void (*velocity)(const void*, double t, const double* p, double* v) = nullptr;
    void (*force)(const void*, double t, const double* q, double* f) = nullptr;
    /// Where the system offers it (null else) and does not know the time: as Mechanics::kicksAndDrifts.
    void (*kicksAndDrifts)(const void*, const KicksAndDrifts<double>&, double* q, double* p,
                           double* force) = nullptr;

    /// H = 1/2 sum_i w_i p_i^2 + V(t, q) with constant w_i: `inverseMasses` are these, else empty.
    std::vector<double> inverseMasses = {};
    /// Of such H, -dH/dq at many nodes together, where the system offers it (null else); as above.
    void (*forces)(const void*, const double* t, int nodes, const double* q, double* f) = nullptr;
    bool isTimeDependent = false;

    bool isSeparable() const { return !inverseMasses.empty(); }
};

/// The same behind the calls of methods for Hamilton's equations (engine/baseline): `flow`, `energy` and
/// `velocity`, which is H_p and never fails; `force` of sums. Where it is separable it is that of a
/// Lagrangian, 1/2 sum_i v_i^2 / w_i - V(t, q), with all calls; else it has no Lagrangian, and `jet` and
/// `gradient` are null.
Mechanics<double> flowOf(const PhaseMechanics& mechanics);
/// The Hamiltonian behind what flowOf() has made; null for a Lagrangian.
const PhaseMechanics* hamiltonianOf(const Mechanics<double>& mechanics);
/// Hamilton's equations of a system that a Lagrangian or a Hamiltonian moves, and the problems that have
/// them.
Mechanics<double> flowOf(const System& system);
inline Takes flowProblems() { return Takes::only<Mechanics<double>, PhaseMechanics>(); }

}  // namespace extremal
