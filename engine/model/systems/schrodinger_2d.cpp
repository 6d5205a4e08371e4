// SPDX-License-Identifier: GPL-3.0-or-later
/// The Schroedinger equation i hbar psi_t = -hbar^2/(2m) (psi_xx + psi_yy) + V(x, y, t) psi on a rectangle,
/// periodic in both directions; with an interaction g |psi|^2 psi and, in a rotating frame, -Omega L_z psi,
/// where V does not depend on t. hbar and m are free; nothing else has a unit.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/model/wave/wave_system.hpp"

namespace extremal::systems {
namespace {

std::shared_ptr<const Hamiltonian> planeHamiltonian(const Settings& settings) {
    const wave::Grid grid{domainOf(settings, "domain"), modesOf(settings, "modes", true),
                          domainOf(settings, "domain_y"), modesOf(settings, "modes_y", true)};
    if (grid.size() > wave::mostPlaces)
        throw InvalidScene("/modes_y",
                           "must make at most " + std::to_string(wave::mostPlaces) +
                               " nodes with /modes, got " + std::to_string(grid.nx) + " x " +
                               std::to_string(grid.ny),
                           "512 x 512 and less");
    wave::Potential V =
        wave::makePotential(*settings.find("potential"), "/potential", grid, constantsOf(settings));
    for (const char* key : {"interaction", "rotation"})
        if (settings.number(key) != 0 && V.isTimeDependent())
            throw InvalidScene("/" + std::string(key), "needs a potential that does not depend on t",
                               "0, or a potential in x and y");
    return std::make_shared<const Hamiltonian>(grid, settings.number("hbar"), settings.number("m"),
                                               std::move(V));
}

std::vector<FieldInfo> planeParameters() {
    std::vector<FieldInfo> all = waveConstants();
    all.push_back(jsonField("potential", "potential", "V", "free",
                            "An expression in x, y, t, hbar and m, or a name: free, harmonic, lattice, "
                            "barrier, double-slit, random."));
    all.push_back(interactionField());
    FieldInfo rotation = numberField(
        "rotation", "rotation", "", 0,
        "Angular velocity Omega of the frame about the middle of the rectangle: - Omega L_z in H.");
    rotation.symbol = "Ω";
    all.push_back(rotation);
    all.push_back(domainField("domain", "domain in x", "Ends of the rectangle in x."));
    all.push_back(domainField("domain_y", "domain in y", "Ends of the rectangle in y."));
    all.push_back(
        integerField("modes", "N", 8, 4096, 64, "Number of Fourier modes and of nodes along x, even."));
    all.push_back(
        integerField("modes_y", "N", 8, 4096, 64, "Number of Fourier modes and of nodes along y, even."));
    all.back().title = "modes in y";
    return all;
}

}  // namespace

ModelEntry schrodinger_2d() {
    ModelEntry e;
    e.item = {"schrodinger-2d",
              "Schrödinger equation in 2-D",
              "A wave function on a periodic rectangle; potential in x, y and t typed or by name.",
              planeParameters(),
              {},
              ""};
    e.initial = waveStartFields("x and y");
    e.exampleInitial = {{"psi", Value::Object{{"packet", "gaussian"}, {"wave_number", 5.0}}},
                        {"normalise", true}};
    e.exampleEnd = 1;
    e.exampleStep = 0.02;
    e.make = [](const Settings& settings) { return makeWaveSystem(settings, planeHamiltonian); };
    return e;
}

}  // namespace extremal::systems
