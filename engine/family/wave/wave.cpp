// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/wave/wave.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/wave/gauss_waves.hpp"
#include "engine/family/wave/wave_collocation.hpp"
#include "engine/family/wave/wave_interacting.hpp"
#include "engine/family/wave/wave_slabs.hpp"
#include "engine/family/wave/wave_three_level.hpp"
#include "engine/model/wave/basis/eigen.hpp"
#include "engine/model/wave/interaction.hpp"
#include "engine/solve/banded_poles.hpp"
#include "engine/step/wave_step.hpp"

namespace extremal {
namespace {

/// Ec: NaN where it is the mean energy of the start.
double shiftOf(const Settings& space) {
    const Value* shift = space.find("energy_shift");
    if (!shift || (shift->isString() && shift->asString() == "mean"))
        return std::numeric_limits<double>::quiet_NaN();
    if (shift->isNumber() && std::isfinite(shift->asNumber())) return shift->asNumber();
    throw InvalidScene("/space/energy_shift", "must be a number or \"mean\"",
                       "mean: the energy of the start");
}

/// Microseconds of one transform there and back.
double transforms(double n) { return 0.0006 * n * std::log2(n); }

/// What a step costs whatever its size: the turn of the phase, the clock.
constexpr double overhead = 0.2;

/// Measured on one machine at N = 256 and 512; it is the ratios that choose.
double costOf(WaveSolver solver, const Hamiltonian& h, int degree, double step) {
    const double n = h.size(), s = degree, band = std::max(1, h.harmonics());
    if (solver == WaveSolver::banded)
        return overhead + 0.0018 * n * s * (band > 1 ? 1.6 * band : 1) + 0.003 * n;
    if (solver == WaveSolver::dense) return overhead + 0.00035 * n * n + transforms(n);
    // Iterations grow with the part of the potential that the preconditioner does not see.
    const auto [low, high] = std::minmax_element(h.potential().begin(), h.potential().end());
    const double strength = step * (*high - *low) / (2 * h.hbar() * s);
    // Vectors that leave the cache cost more.
    return s * (5 + 8 * std::sqrt(strength)) * (transforms(n) + (n > 20000 ? 0.025 : 0.01) * n);
}

std::string duration(double microseconds) {
    if (microseconds < 1e3) return formatNumber(microseconds, 2) + " µs";
    return microseconds < 1e6 ? formatNumber(microseconds / 1e3, 2) + " ms"
                              : formatNumber(microseconds / 1e6, 2) + " s";
}

void checkSolver(WaveSolver solver, const Hamiltonian& h) {
    if (solver != WaveSolver::dense && !h.isPeriodic())
        throw InvalidScene("/solver/method",
                           std::string(name(solver)) + " needs a periodic domain: it works on Fourier modes",
                           "auto or dense");
    if (solver != WaveSolver::dense && !h.isSplit())
        throw InvalidScene(
            "/solver/method",
            std::string(name(solver)) + " needs a potential that acts at the nodes, not by convolution",
            "auto or dense");
    if (solver == WaveSolver::banded && h.dimension() == 2)
        throw InvalidScene("/solver/method", "banded is for one dimension", "auto or krylov");
    if (solver != WaveSolver::krylov && h.isTimeDependent())
        throw InvalidScene("/solver/method",
                           std::string(name(solver)) + " needs a potential that does not depend on t",
                           "krylov");
    if (solver == WaveSolver::banded && !BandedPoles::isPossible(h.size(), std::max(1, h.harmonics())))
        throw InvalidScene(
            "/solver/method",
            "banded needs a potential of at most 8 harmonics and at least 4 modes for each and 4 more, got " +
                std::to_string(h.harmonics()) + " harmonics and " + std::to_string(h.size()) + " modes",
            "auto, dense or krylov");
    if (solver == WaveSolver::dense && h.size() > Eigenstates::denseLimit)
        throw InvalidScene("/solver/method",
                           "dense takes at most " + std::to_string(Eigenstates::denseLimit) + " modes, got " +
                               std::to_string(h.size()),
                           "auto or krylov");
}

}  // namespace

bool hasDirichletBoundary(const System& system) {
    return system.parts.find<Wave>() && !system.hamiltonian()->isPeriodic();
}

bool hasFullMatrix(const System& system) {
    return system.parts.find<Wave>() && !system.hamiltonian()->isSplit();
}

void requirePeriodic(const System& system, const std::string& pointer, const std::string& what,
                     const std::string& hint) {
    if (hasDirichletBoundary(system))
        throw InvalidScene(
            pointer, what + " needs a periodic domain, and the boundary of this model is dirichlet", hint);
}

void requireSplit(const System& system, const std::string& pointer, const std::string& what,
                  const std::string& hint) {
    requirePeriodic(system, pointer, what, hint);
    if (hasFullMatrix(system))
        throw InvalidScene(
            pointer,
            what + " needs a potential that acts at the nodes, and the product of this model is convolution",
            hint);
}

WavePlan planWave(const System& system, int degree, const Settings& solver, double step) {
    const Hamiltonian& h = *system.hamiltonian();
    WavePlan plan;
    for (const WaveSolver s : {WaveSolver::banded, WaveSolver::dense, WaveSolver::krylov})
        if (solver.type == name(s)) {
            checkSolver(s, h);
            return {s, true, costOf(s, h, degree, step)};
        }
    if (!solver.type.empty() && solver.type != "auto")
        throw InvalidScene("/solver/method",
                           solver.type + " does not solve the linear systems of a wave function",
                           "auto, banded, dense or krylov");
    plan.microseconds = std::numeric_limits<double>::infinity();
    for (const WaveSolver s : {WaveSolver::banded, WaveSolver::dense, WaveSolver::krylov}) {
        try {
            checkSolver(s, h);
        } catch (const InvalidScene&) {
            continue;
        }
        if (const double cost = costOf(s, h, degree, step); cost < plan.microseconds) plan = {s, false, cost};
    }
    return plan;
}

Discretization withShift(const Discretization& discretization, const System& system, const State& start) {
    Discretization known = discretization;
    if (!std::isnan(shiftOf(discretization.space))) return known;
    const double shift = isCoupled(system.parts)
                             ? chemicalPotential(system.hamiltonian(), couplingOf(system.parts), start.t,
                                                 coefficients(start.x.data()))
                             : meanEnergy(*system.hamiltonian(), start);
    for (auto& [key, value] : known.space.keys)
        if (key == "energy_shift") {
            value = shift;
            return known;
        }
    known.space.keys.emplace_back("energy_shift", shift);
    return known;
}

double waveFrequency(const System& system, const Settings& space, const State& start) {
    const double shift = shiftOf(space);
    if (!std::isnan(shift)) return waveFrequency(system, shift);
    return waveFrequency(system, system.hamiltonian()->energy(start.t, coefficients(start.x.data())));
}

double waveFrequency(const System& system, double shift) {
    const Hamiltonian& h = *system.hamiltonian();
    double low = h.lowest(), high = h.highest();
    if (h.size() <= Eigenstates::denseLimit && !h.isTimeDependent()) {
        const auto& energies = Eigenstates::of(system.hamiltonian())->energies();
        low = energies.front();
        high = energies.back();
    }
    return std::max(std::abs(low - shift), std::abs(high - shift)) / h.hbar();
}

namespace {

std::unique_ptr<WaveStep> makeWave(const System& system, const Discretization& discretization, double step,
                                   WaveSolver solver) {
    const int degree = discretization.space.integer("degree");
    const double shift = shiftOf(discretization.space), given = discretization.solver.number("tolerance");
    if (system.hamiltonian()->isTimeDependent() && discretization.space.text("form") == "three-level")
        throw InvalidScene("/space/form", "three-level needs a potential that does not depend on t",
                           "one-step");
    if (discretization.space.text("form") == "three-level")
        requirePeriodic(system, "/space/form", "three-level", "one-step");
    const int iterations = discretization.solver.integer("max_iterations") > 0
                               ? discretization.solver.integer("max_iterations")
                               : 600;
    const double tolerance = given > 0 ? given : 1e-14;
    if (discretization.space.text("form") == "three-level") {
        const std::string start = discretization.space.text("start");
        return makeThreeLevelWave(system.hamiltonian(), step, shift,
                                  {threeLevelAlpha(discretization.quadrature),
                                   start == "variational" ? WaveStart::variational
                                   : start == "exact"     ? WaveStart::exact
                                                          : WaveStart::gauss,
                                   solver, tolerance, iterations});
    }
    // A potential that depends on time has no factors: its stages are solved together.
    if (system.hamiltonian()->isTimeDependent())
        return makeCollocationWave(system.hamiltonian(), step, shift, gauss<double>(degree), tolerance,
                                   iterations);
    switch (solver) {
        case WaveSolver::banded:
            // Pairs keep the norm to round-off; fours are faster, and good to 1e-11 or so.
            return makeBandedWave(system.hamiltonian(), step, shift, degree, given >= 1e-11 ? 4 : 2);
        case WaveSolver::dense:
            return makeDenseWave(system.hamiltonian(), step, shift, degree);
        case WaveSolver::krylov:
            break;
    }
    return makeKrylovWave(system.hamiltonian(), step, shift, degree, tolerance, iterations);
}

}  // namespace

std::string interactionMismatch(const System& system, const Discretization& discretization) {
    if (!isCoupled(system.parts)) return {};
    if (discretization.space.text("form") == "three-level")
        return "the three-level form is for linear wave functions, without an interaction or a rotation";
    if (discretization.space.find("slabs"))
        return "polynomials on long slabs are for linear wave functions, without an interaction or a "
               "rotation";
    return {};
}

std::unique_ptr<Integrator> makeWaveIntegrator(const System& system, const Discretization& discretization,
                                               double h) {
    if (isCoupled(system.parts)) {
        const std::string mismatch = interactionMismatch(system, discretization);
        if (!mismatch.empty()) throw InvalidScene("/space", mismatch, "schrodinger-gauss-4, or strang");
        const std::string& method = discretization.solver.type;
        if (!method.empty() && method != "auto")
            throw InvalidScene("/solver/method",
                               method + " solves linear equations, without an interaction or a rotation",
                               "auto");
        return makeInteractingWave(system.hamiltonian(), couplingOf(system.parts), h,
                                   shiftOf(discretization.space), discretization.space.integer("degree"),
                                   discretization.solver.number("tolerance"),
                                   discretization.solver.integer("max_iterations"));
    }
    const int slabs = std::max(1, discretization.space.integer("slabs"));
    if (discretization.space.text("time_basis") == "chebyshev")
        requireSplit(system, "/space/time_basis", "chebyshev", "legendre");
    const WavePlan plan =
        planWave(system, discretization.space.integer("degree"), discretization.solver, h / slabs);
    const double step = h / slabs;
    const bool isChebyshev = discretization.space.text("time_basis") == "chebyshev";
    auto made = isChebyshev
                    ? makeCollocationWave(system.hamiltonian(), step, shiftOf(discretization.space),
                                          chebyshevRoots(discretization.space.integer("degree")), 1e-13, 600)
                    : makeWave(system, discretization, step, plan.solver);
    made->setAbout(isChebyshev ? "all stages together by GMRES"
                               : std::string(name(plan.solver)) +
                                     (plan.isForced ? " as wanted, about " : ", about ") +
                                     duration(slabs * plan.microseconds) + " per step");
    if (slabs == 1) return made;
    return makeSlabs(std::move(made), slabs, h);
}

std::unique_ptr<Integrator> makeGaussWave(const System& system, int degree, double shift, double step) {
    const Settings space{"fourier", {{"degree", static_cast<double>(degree)}, {"energy_shift", shift}}, {}};
    return makeWaveIntegrator(system, {space, completeQuadrature(space, {}), {}}, step);
}

void checkWaveLimit(double limit, double frequency, double h, bool allowsUnstable, Findings& findings) {
    const double longest = limit / frequency;
    if (!std::isfinite(limit) || !(limit > 0) || !(h > longest)) return;
    const std::string message = formatNumber(h) + " is beyond the stability limit " +
                                formatNumber(longest, 6) + ": the phase of the largest energy advances by " +
                                formatNumber(h * frequency, 4) + " per step, the limit is " +
                                formatNumber(limit, 4);
    if (allowsUnstable)
        findings.warning("/step", message, {}, {}, "three-levels");
    else
        findings.error("/step", message,
                       "a smaller step, fewer modes, the one-step form, or \"allow_unstable\": true",
                       "three-levels");
}

}  // namespace extremal
