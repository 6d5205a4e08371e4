// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/start/cloud.hpp"

#include <cmath>
#include <memory>
#include <utility>

#include "engine/core/memo_cache.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/wave/collapse.hpp"
#include "engine/model/wave/spectrum.hpp"
#include "engine/model/wave/start/eigenstate.hpp"
#include "engine/model/wave/start/ground_state.hpp"

namespace extremal::wave {
namespace {

constexpr const char *atRest = "ground-state", *withoutKinetic = "thomas-fermi";

std::string nameOf(const Value& psi) {
    const Value* const name = psi.isObject() ? psi.find("packet") : nullptr;
    return name && name->isString() ? name->asString() : std::string();
}

/// Why there is no such state; refuses.
[[noreturn]] void refuseState(const std::string& pointer, const Hamiltonian& h, double g, double norm) {
    const double share = norm / criticalNorm(h, g);
    if (g < 0 && h.dimension() == 2 && share >= 1)
        throw InvalidScene(pointer,
                           "has no state of least energy: its norm is " + formatNumber(share, 3) +
                               " of the critical one, and the energy falls without a bound as it collapses",
                           "a norm below " + formatNumber(norm / share, 4) + ", or a weaker interaction");
    throw InvalidScene(pointer,
                       "has no state of least energy on this grid, whose nodes are too far apart for it",
                       "more modes, a smaller domain, or another packet");
}

/// Remembered: a scene is read more than once.
std::vector<Complex> groundStateOf(const std::shared_ptr<const Hamiltonian>& h, double g, double norm,
                                   const std::string& pointer) {
    if (g == 0) return eigenstateOf(h, 0, pointer);
    static MemoCache<std::pair<std::shared_ptr<const Hamiltonian>, double>, StationaryState> recent(4);
    StationaryState state = recent.get({h, g * norm}, [&] { return groundState(*h, g * norm); });
    if (!state.isConverged || spectrumTail(*h, state.c.data()) > 1e-2) refuseState(pointer, *h, g, norm);
    return std::move(state.c);
}

std::vector<Complex> thomasFermiOf(const Hamiltonian& h, double g, double norm, const std::string& pointer) {
    if (!(g > 0))
        throw InvalidScene(
            pointer,
            std::string(withoutKinetic) + " needs repulsion, and has the interaction " + formatNumber(g, 4),
            "\"interaction\": 1 of the model, or another packet");
    std::vector<Complex> psi, c(static_cast<std::size_t>(h.size()));
    for (const double each : thomasFermi(h, g * norm).density) psi.emplace_back(std::sqrt(each));
    h.toCoefficients(psi.data(), c.data());
    return c;
}

}  // namespace

std::vector<CatalogItem> cloudPackets() {
    const FieldInfo norm = positive("norm", "norm", "", 1, "The integral of |psi|^2; not scaled to 1.");
    return {{atRest,
             "ground state",
             "The state of least energy, with an interaction by Newton's method; it rests.",
             {norm},
             {},
             "a wave function in a potential that does not depend on time"},
            {withoutKinetic,
             "Thomas-Fermi cloud",
             "sqrt(max(0, mu - V)/g): at rest but for its kinetic energy.",
             {norm},
             {},
             "a wave function with repulsion"}};
}

bool isAtRest(const Value& psi) { return nameOf(psi) == atRest; }

std::optional<std::vector<Complex>> cloudOf(const Value& psi, const std::string& pointer,
                                            const std::shared_ptr<const Hamiltonian>& h, Coupling coupling,
                                            const Constants& constants) {
    const std::string name = nameOf(psi);
    if (name != atRest && name != withoutKinetic) return {};
    const double norm = parametersOf(psi, pointer, {{"norm", 1, false, true}}, {"packet"}, constants).front();
    if (name == atRest && coupling.omega != 0)
        throw InvalidScene(pointer + "/packet",
                           "ground-state is for frames that rest: in one that turns psi is not real, and it "
                           "may have vortices",
                           "thomas-fermi, vortices, or \"rotation\": 0 of the model");
    std::vector<Complex> c = name == withoutKinetic ? thomasFermiOf(*h, coupling.g, norm, pointer + "/packet")
                                                    : groundStateOf(h, coupling.g, norm, pointer + "/packet");
    for (Complex& each : c) each *= std::sqrt(norm);
    return c;
}

}  // namespace extremal::wave
