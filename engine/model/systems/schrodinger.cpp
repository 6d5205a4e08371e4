// SPDX-License-Identifier: GPL-3.0-or-later
/// The Schroedinger equation i hbar psi_t = -hbar^2/(2m) psi_xx + V(x, t) psi on a periodic domain, or
/// with psi = 0 at both ends (Dirichlet; V(x) then); with an interaction g |psi|^2 psi on periodic domains.
/// hbar and m are free; nothing else has a unit.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/model/wave/basis/eigen.hpp"
#include "engine/model/wave/wave_system.hpp"

namespace extremal::systems {
namespace {

std::shared_ptr<const Hamiltonian> hamiltonianOf(const Settings& settings) {
    const bool isDirichlet = settings.text("boundary") == "dirichlet",
               isConvolution = settings.text("product") == "convolution";
    if (isDirichlet && isConvolution)
        throw InvalidScene("/product", "convolution requires the boundary periodic",
                           "nodes, or the boundary periodic");
    const int n = modesOf(settings, "modes", !isDirichlet);
    // What needs a full matrix.
    const std::string whole = isDirichlet ? "the boundary is dirichlet" : "the product is a convolution",
                      instead = isDirichlet ? "the boundary periodic" : "the product at the nodes";
    if ((isDirichlet || isConvolution) && n > Eigenstates::denseLimit)
        throw InvalidScene("/modes",
                           "must be at most " + std::to_string(Eigenstates::denseLimit) + " where " + whole +
                               ", got " + std::to_string(n),
                           "fewer modes, or " + instead);
    const wave::Grid grid{domainOf(settings, "domain"), n};
    wave::Potential V =
        wave::makePotential(*settings.find("potential"), "/potential", grid, constantsOf(settings));
    if ((isDirichlet || isConvolution) && V.isTimeDependent())
        throw InvalidScene("/potential", "depends on t, which is not possible where " + whole,
                           "a potential in x, or " + instead);
    if (settings.number("interaction") != 0 && (isDirichlet || isConvolution || V.isTimeDependent()))
        throw InvalidScene("/interaction",
                           "needs a periodic domain, the product at the nodes, and a potential that does not "
                           "depend on t",
                           "0, or the boundary periodic with the product nodes");
    return std::make_shared<const Hamiltonian>(grid, settings.number("hbar"), settings.number("m"),
                                               std::move(V),
                                               isDirichlet     ? WaveBasis::dirichlet
                                               : isConvolution ? WaveBasis::convolution
                                                               : WaveBasis::fourier);
}

std::vector<FieldInfo> parameters() {
    std::vector<FieldInfo> all = waveConstants();
    all.push_back(jsonField("potential", "potential", "V", "free",
                            "An expression in x, t, hbar and m, or a name: free, harmonic, lattice, "
                            "double-well, barrier, morse, random."));
    all.push_back(interactionField());
    all.push_back(domainField("domain", "domain", "Ends of the interval."));
    all.push_back(
        choiceField("boundary", "boundary", {"periodic", "dirichlet"},
                    "What holds at the ends of the interval: periodic, or dirichlet, where psi is zero."));
    all.push_back(choiceField(
        "product", "product V ψ", {"nodes", "convolution"},
        "How the potential acts on a periodic domain: at the nodes, or by the exact convolution of the "
        "coefficients (Galerkin; at most 512 modes)."));
    all.push_back(integerField("modes", "N", 8, 65536, 128,
                               "Number of modes and of nodes: Fourier modes, even; with a Dirichlet boundary "
                               "polynomials, at most 512."));
    return all;
}

}  // namespace

ModelEntry schrodinger() {
    ModelEntry e;
    e.item = {"schrodinger",
              "Schrödinger equation",
              "A wave function in one dimension, periodic or with a Dirichlet boundary; potential typed or "
              "by name.",
              parameters(),
              {},
              ""};
    e.initial = waveStartFields("x");
    e.exampleInitial = {{"psi", Value::Object{{"packet", "gaussian"}, {"wave_number", 5.0}}},
                        {"normalise", true}};
    e.exampleEnd = 2;
    e.exampleStep = 0.01;
    e.make = [](const Settings& settings) { return makeWaveSystem(settings, hamiltonianOf); };
    return e;
}

}  // namespace extremal::systems
