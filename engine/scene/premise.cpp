// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/premise.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/text.hpp"
#include "engine/model/field/exact_premise.hpp"
#include "engine/model/wave/hamiltonian.hpp"
#include "engine/model/wave/packet.hpp"
#include "engine/scene/bind.hpp"

namespace extremal {
namespace {

ExactPremise ofField(const Scene& scene, const System& system, const State& initial) {
    ExactPremise premise;
    const ExactSolution exact = exactSolution(scene, system, initial);
    if (!exact.atPlaces()) return premise;
    const EndViolation ends =
        endViolationOf(exact.atPlaces(), system.fieldProblem(), scene.start.value, scene.end.value);
    premise.error = ends.error;
    premise.isViolated = ends.matters();
    if (premise.isViolated)
        premise.text = "does not hold at x = " + formatNumber(ends.place, 6) + " (" +
                       formatNumber(ends.largest, 2) + " from t = " + formatNumber(ends.from, 2) + " on)";
    return premise;
}

/// psi at the walls, as a part of its largest value. What is given on the nodes or as a state of the mesh
/// vanishes there.
ExactPremise ofWave(const Scene& scene, const std::shared_ptr<const Hamiltonian>& hamiltonian) {
    const Hamiltonian& h = *hamiltonian;
    ExactPremise premise;
    const Value* const psi = scene.initial.given.find("psi");
    if (!psi || h.isPeriodic()) return premise;
    const double left = h.domain().left, right = left + h.domain().length;
    std::vector<double> places{left, right};
    places.insert(places.end(), h.x().begin(), h.x().end());
    const std::vector<Complex> values =
        wave::valuesAt(*psi, "/psi", hamiltonian, {{"hbar", h.hbar()}, {"m", h.mass()}}, places);
    if (values.empty()) return premise;
    double most = 0;
    for (const Complex& v : values) most = std::max(most, std::abs(v));
    const std::size_t worse = std::abs(values[1]) > std::abs(values[0]) ? 1 : 0;
    const double part = std::abs(values[worse]) / most;
    premise.isViolated = part > 1e-6;
    if (premise.isViolated)
        premise.text = "does not hold at x = " + formatNumber(places[worse], 6) + " (" +
                       formatNumber(part, 2) + " of the largest |ψ| at the start, where ψ = 0 is asked for)";
    return premise;
}

}  // namespace

ExactPremise premiseOf(const Scene& scene, const System& system, const State& initial) {
    if (isField(system)) return ofField(scene, system, initial);
    if (isWave(system)) return ofWave(scene, system.hamiltonian());
    return {};
}

bool isComputedInstead(const Scene& scene, const System& system) {
    return isField(system) && system.at && !isBackwards(scene);
}

std::string residualFault(const Scene& scene, const System& system, const State& initial) {
    constexpr double most = 1e-10;
    if (!isField(system) || !scene.initial.given.find("exact")) return {};
    const FieldProblem& problem = system.fieldProblem();
    const FieldProfile profile = fieldProfile(scene.initial.given, problem, initial.t);
    const FieldResidual r = residualOf(profile, problem, scene.start.value, scene.end.value);
    if (!(r.ratio > most)) return {};
    const auto number = [](double x) { return formatNumber(x, 4); };
    return "does not solve the equation of the field: at x = " + number(r.x) + ", t = " + number(r.t) +
           " u_tt = " + number(r.acceleration) + ", -(a φ'(u_x))_x = " + number(r.force) +
           ", W'(u) = " + number(r.slope) + ", and their sum is " + formatNumber(r.ratio, 2) +
           " of their sizes";
}

}  // namespace extremal
