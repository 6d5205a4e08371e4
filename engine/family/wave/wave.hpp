// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrators of wave functions: the space `fourier` in space and polynomials of degree s in time.
///
/// One-step form: R_s(-i dt (H - Ec)/hbar), see pade.hpp; order 2s, unitary for every step. Ec,
/// the energy shift, is a choice of gauge: the exact motion does not know it, the scheme's error grows with
/// (E - Ec) dt. `mean` takes <H> of the start. The phase e^{-i Ec t/hbar} is put back at every node from t
/// itself, so nothing accumulates.
///
/// Three-level form, degree 1: wave_three_level.hpp.
///
/// With an interaction g |psi|^2 the one-step form solves its stages by a fixed point (wave_interacting.hpp);
/// the other forms, and the solvers below, are for linear equations.
///
/// How the solves are done, whichever is the cheapest by an estimate from N, s and the potential:
///     banded   elimination in Fourier space, in one dimension where V has few harmonics
///     (solve/banded_poles.hpp) dense    the eigenstates of H, once; N <= 512; where H is not split the only
///     one krylov   GMRES with two transforms an iteration, preconditioned by the kinetic part; any V
/// A potential that depends on time couples the stages of the Gauss nodes: it has no factors, and krylov
/// solves for all of them together (wave_collocation.hpp).
#pragma once

#include <memory>
#include <string>

#include "engine/family/family.hpp"

namespace extremal {

enum class WaveSolver { banded, dense, krylov };
constexpr const char* name(WaveSolver s) {
    return s == WaveSolver::banded ? "banded" : s == WaveSolver::dense ? "dense" : "krylov";
}

/// A wave function that vanishes at both ends of its domain.
bool hasDirichletBoundary(const System& system);
/// A wave function whose H is not split (Hamiltonian::isSplit).
bool hasFullMatrix(const System& system);
/// Throws InvalidScene at the pointer unless the domain is periodic: `what` needs it, `hint` does not.
void requirePeriodic(const System& system, const std::string& pointer, const std::string& what,
                     const std::string& hint);

/// Likewise unless H is split.
void requireSplit(const System& system, const std::string& pointer, const std::string& what,
                  const std::string& hint);

/// Why a scheme cannot be used with an interaction; empty where it can, or there is no interaction.
std::string interactionMismatch(const System& system, const Discretization& discretization);

/// What was chosen, and why.
struct WavePlan {
    WaveSolver solver = WaveSolver::krylov;
    bool isForced = false;
    double microseconds = 0;  ///< predicted, a step
};
/// Throws InvalidScene (pointer relative to the scheme) where a forced solver cannot be used.
WavePlan planWave(const System& system, int degree, const Settings& solver, double step);

/// Largest |E - Ec|/hbar: what the stability limit of a three-level scheme counts. By the eigenstates up to
/// 512 modes, else by the bounds of kinetic and potential energy.
double waveFrequency(const System& system, const Settings& space, const State& start);
/// The same with energies counted from `shift`.
double waveFrequency(const System& system, double shift);

/// Gauss(degree) with energies counted from `shift`, solved in the way that costs least.
std::unique_ptr<Integrator> makeGaussWave(const System& system, int degree, double shift, double step);

/// The discretization with the energy shift "mean" as a number, that of the start of a run. Others as they
/// are.
Discretization withShift(const Discretization& discretization, const System& system, const State& start);

std::unique_ptr<Integrator> makeWaveIntegrator(const System& system, const Discretization& discretization,
                                               double step);

/// Findings of a step beyond the limit of a three-level scheme, step * frequency <= limit: it is known
/// exactly, so that this is an error.
void checkWaveLimit(double limit, double frequency, double step, bool allowsUnstable, Findings& findings);

}  // namespace extremal
