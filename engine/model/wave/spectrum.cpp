// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/spectrum.hpp"

#include <cmath>

#include "engine/core/text/text.hpp"

namespace extremal {

Complex chebyshevCoefficient(const Hamiltonian& h, const Complex* c, int k) {
    return h.dirichletBasis().chebyshevCoefficient(c, k);
}

double spectrumTail(const Hamiltonian& h, const Complex* c) {
    const auto [upper, all] = h.inBasis([&](const auto& basis) { return basis.tail(c); });
    return all > 0 ? std::sqrt(upper / all) : 0;
}

std::string resolutionCaution(const Hamiltonian& h, const Complex* c) {
    const double tail = spectrumTail(h, c);
    if (!(tail > 1e-4)) return {};
    return "under-resolved: " + formatNumber(tail, 2) +
           " of the wave function is in the upper eighth of its " + std::to_string(h.grid().nx) +
           (h.dimension() == 2 ? " x " + std::to_string(h.grid().ny) : std::string()) + " modes";
}

MeanMomentum meanMomentum(const Hamiltonian& h, const Complex* c) {
    return h.inBasis([&](const auto& basis) { return basis.momentum(c); });
}

NodeMeans nodeMeans(const Hamiltonian& h, const Complex* c, Complex* work) {
    return h.inBasis([&](const auto& basis) { return basis.means(c, work); });
}

double currentInTheMiddle(const Hamiltonian& h, const Complex* c, Complex* work, Complex* slope) {
    return h.inBasis([&](const auto& basis) { return basis.currentInTheMiddle(c, work, slope); });
}

}  // namespace extremal
