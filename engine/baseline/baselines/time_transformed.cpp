// SPDX-License-Identifier: GPL-3.0-or-later
/// The implicit midpoint rule in a fictitious time in which it needs equal steps: a symplectic scheme of
/// variable steps, with the unsigned density of the local action error as its step function.
///
/// With dt = g(z) dtau the motions of energy H_0 are those of K(z) = g(z) (H(z) - H_0), at K = 0, and the
/// midpoint rule with equal steps dtau is symplectic for K (phase/monitored.hpp). Steps go with g =
/// rho^(-1/3), as those of symplectic-energy-momentum schemes of degree 1 do with their density
///     24 density = p' . q'' - q' . p'',
/// but rho is the sum of its terms without their signs (phase/monitor.hpp, "action"): a density that changes
/// its sign on the way, as it does on eccentric orbits, ends those steps, and not these. With the signed
/// density the leading term of the modified Hamiltonian would be constant and the order 4; with the unsigned
/// one it is 2. Sources: Hairer 1997; Reich 1999; Hairer, Lubich, Wanner 2006, VIII.2.1.
#include <cmath>
#include <limits>
#include <utility>

#include "engine/action/table.hpp"
#include "engine/baseline/catalog.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/phase/monitored.hpp"
#include "engine/phase/monitored_step.hpp"
#include "engine/phase/phase_step.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::baselines {
namespace {

bool isTimeless(const System& system) {
    return hasHamiltonian(system) && !hamiltonianFrom(system).isTimeDependent;
}

const Settings density{"action", {}, {}};

std::unique_ptr<Integrator> makeTransformed(const System& system, const BaselineOptions& options) {
    const MonitoredProblem problem = monitoredProblem(system, density, {}, options.step);
    const Table<double> midpoint =
        makeTable(polynomialSpace<double>(1, PolynomialBasis::lobatto), gauss<double>(1));
    auto scheme = makePhaseStep(problem.system.part<PhaseMechanics>(), midpoint, options.step, {});
    return makeMonitored(problem, std::move(scheme), options.step);
}

void checkDensity(const SchemeCase& scheme, Findings& findings) {
    const double* const q = scheme.initial.x.data();
    const double g = (*makeMonitor(density, scheme.system, hamiltonianFrom(scheme.system)))(
        q, q + scheme.system.dimension());
    if (!std::isfinite(g) || !(g > 0))
        findings.warning(
            "",
            "will be refused: the density of the local action error, which its steps follow, is 0 "
            "or not a number at the start",
            "a fixed step, or an adaptive code such as dopri5", {}, "solvability");
}

}  // namespace

BaselineEntry time_transformed() {
    BaselineEntry e;
    e.item = {"time-transformed",
              "time-transformed midpoint",
              "Symplectic with variable steps: the midpoint rule in a time in which the density of the local "
              "action error, every term taken positive, is constant. The step is the first one.",
              {},
              Claims{2, true, true, {"momentum"}, false},
              "a Lagrangian or a Hamiltonian without explicit time"};
    e.grid = TimeGrid::free;
    e.takes = flowProblems();
    e.parts.set(SystemCondition{isTimeless});
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    e.parts.set(StepCheck{checkDensity});
    e.make = makeTransformed;
    return e;
}

}  // namespace extremal::baselines
