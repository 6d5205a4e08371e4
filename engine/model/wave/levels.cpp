// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/levels.hpp"

#include <algorithm>

#include "engine/model/wave/basis/eigen.hpp"

namespace extremal {

std::string levelsProblem(const Hamiltonian& h) {
    if (h.dimension() == 2) return "Levels are drawn over one dimension";
    if (h.isTimeDependent()) return "A potential that depends on time has no levels";
    if (h.size() > Eigenstates::denseLimit)
        return "Levels are computed up to " + std::to_string(Eigenstates::denseLimit) + " modes";
    return {};
}

std::vector<double> lowestLevels(const std::shared_ptr<const Hamiltonian>& h) {
    constexpr std::size_t mostLevels = 40, fewestLevels = 8;
    const auto& energies = Eigenstates::of(h)->energies();
    const double high = *std::max_element(h->potential().begin(), h->potential().end());
    std::size_t count = 0;
    while (count < std::min(mostLevels, energies.size() / 2) &&
           (count < fewestLevels || energies[count] < high))
        ++count;
    return {energies.begin(), energies.begin() + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace extremal
