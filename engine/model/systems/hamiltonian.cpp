// SPDX-License-Identifier: GPL-3.0-or-later
/// Any system, given by its Hamiltonian as a text: H(t, q, p) with named coordinates and parameters.
///
/// The momentum of a coordinate x is p_x. H need not be convex in p, nor depend on it twice: systems without
/// a Lagrangian are welcome. Units are the user's own.
#include <cmath>
#include <string>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/model/orbit/held_bodies.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/model/system.hpp"
#include "engine/model/typed/phase/typed_hamiltonian.hpp"
#include "engine/model/typed/typed_energy.hpp"
#include "engine/model/typed/typed_picture.hpp"
#include "engine/model/typed/typeset.hpp"

namespace extremal::systems {
namespace {

/// The largest frequency of Hamilton's equations, linearised at a state; 0 where it only grows or decays.
double fastest(const PhaseMechanics& m, double t, const double* x) {
    constexpr int most = 100;
    const int d = m.dimension;
    if (d > most) return 0;
    Eigen::MatrixXd hessian(2 * d, 2 * d), slope(2 * d, 2 * d);
    m.hessian(m.model.get(), t, x, x + d, hessian.data());
    if (!hessian.allFinite()) return 0;
    slope << hessian.bottomRows(d), -hessian.topRows(d);
    return dense::eigenvalues(slope).imag().cwiseAbs().maxCoeff();
}

void setMotion(System& s, const PhaseMechanics& m) {
    const int d = m.dimension;
    s.energy = [m, d](double t, const double* x) { return m.energy(m.model.get(), t, x, x + d); };
    s.rate = [flow = flowOf(m), d](double t, const double* x, double* dx) {
        return flow.flow(flow.model.get(), t, x, x + d, dx, dx + d);
    };
    s.kineticEnergy = [flow = flowOf(m), d, v = std::vector<double>(static_cast<std::size_t>(d))](
                          double t, const double* x) mutable {
        flow.velocity(flow.model.get(), t, x, x + d, v.data());
        double sum = 0;
        for (int i = 0; i < d; ++i) sum += x[d + i] * v[static_cast<std::size_t>(i)];
        return sum / 2;
    };
    s.frequency = [m](double t, const double* x) { return fastest(m, t, x); };
    s.parts.set(m);
}

System makeHamiltonian(const Settings& settings) {
    const typed::Formula formula = typed::phaseFormulaOf(settings),
                         coordinates = typed::coordinatesOf(formula);
    const typed::TypedHamiltonian made = typed::hamiltonianOf(formula);
    System s;
    s.id = "hamiltonian";
    for (const std::string& name : coordinates.coordinates)
        s.coordinates.push_back({name, name, typed::symbolOf(name), "", ""});
    setMotion(s, made.mechanics);
    s.parts.set(typed::energyOfHamiltonian(formula, made.mechanics.model));
    if (auto held = heldBodiesIn(flowOf(made.mechanics))) s.parts.set(*std::move(held));
    for (const int i : made.cyclic) {
        const auto k = static_cast<std::size_t>(i);
        s.momenta.push_back({coordinates.coordinates[k], "p_" + s.coordinates[k].symbol, "",
                             [k](const double*, const double* p) { return p[k]; }});
    }
    const typed::Picture picture = typed::pictureOf(coordinates);
    s.draw = picture.draw;
    s.isSpatial = picture.isSpatial;
    const std::string& first = coordinates.coordinates[0];
    s.phaseX = "q." + first;
    s.phaseY = "p." + first;
    s.hasPlanarTrajectory = picture.planeX == 0 && picture.planeY == 1;
    s.trajectoryX = s.hasPlanarTrajectory ? "q." + first : "t";
    s.trajectoryY = "q." + (s.hasPlanarTrajectory ? coordinates.coordinates[1] : first);
    return s;
}

void checkHamiltonian(const Settings&, const System& system, const State& initial) {
    const auto fault = typed::hamiltonianFaultAt(system.part<PhaseMechanics>(), initial.t, initial.x.data(),
                                                 initial.x.data() + system.dimension());
    if (fault) throw InvalidScene("/hamiltonian", *fault);
}

std::vector<FieldInfo> hamiltonianFields() {
    const FieldInfo coordinates = namesField(
        "coordinates", {"x"},
        "Names of the coordinates, at most 1000; the momentum of x is p_x. x[1..n] stands for x1, x2, ..");
    const FieldInfo parameters = parametersField({{"m", 1}, {"k", 1}});
    const FieldInfo hamiltonian = termsField(
        "hamiltonian", "Hamiltonian", "p_x^2/(2*m) + k/2*x^2",
        "H as an expression in coordinates, momenta, parameters and the time t; or an object of such terms "
        "by name, which are summed.");
    FieldInfo controls =
        textField("controls", "", nullptr,
                  "Functions of time by name, for use in the Hamiltonian: a formula in t and parameters, or "
                  "{\"table\": [[t, value], ...], \"interpolation\": \"linear\" or \"cubic\"}.");
    controls.type = FieldType::json;
    controls.isOptional = true;
    return {coordinates, parameters, hamiltonian, controls};
}

}  // namespace

ModelEntry hamiltonian() {
    ModelEntry e;
    e.item = {"hamiltonian",
              "typed Hamiltonian",
              "Any system by its Hamiltonian, typed as a formula in coordinates and momenta; it need not "
              "have a Lagrangian.",
              hamiltonianFields(),
              {},
              ""};
    e.exampleQ = {1};
    e.exampleP = {0};
    e.exampleEnd = 10;
    e.exampleStep = 0.05;
    e.make = makeHamiltonian;
    e.checkInitial = checkHamiltonian;
    return e;
}

}  // namespace extremal::systems
