// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/collapse.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/text/text.hpp"
#include "engine/model/wave/measures.hpp"

namespace extremal {
namespace {

constexpr double mostTail = 1e-4, mostMove = 1e-2;

double kineticEnergy(const Hamiltonian& h, const Complex* c) {
    double sum = 0;
    for (int i = 0; i < h.size(); ++i) sum += h.kinetic()[static_cast<std::size_t>(i)] * std::norm(c[i]);
    return sum / squaredNorm(c, h.size());
}

double tailOf(const Hamiltonian& h, const Complex* c) {
    const auto [upper, all] = h.fourierBasis().tail(c);
    return all > 0 ? upper / all : 0;
}

}  // namespace

double criticalNorm(const Hamiltonian& h, double g) {
    return 5.85043 * h.hbar() * h.hbar() / (h.mass() * std::abs(g));
}

ValidityLimit collapseLimit(const std::shared_ptr<const Hamiltonian>& h, Coupling coupling) {
    ValidityLimit limit;
    limit.from = [h, coupling](const State& start) -> ValidityLimit::Holds {
        const Complex* const c = coefficients(start.x.data());
        const double tail = std::max(mostTail, 2 * tailOf(*h, c)), E = coupledEnergy(h, coupling, start.t, c),
                     band = mostMove * kineticEnergy(*h, c);
        return [=](double energy, const double* x) {
            return tailOf(*h, coefficients(x)) <= tail && !(std::abs(energy - E) > band);
        };
    };
    limit.why = [h, coupling](const State& start, const State& end) {
        const Complex *const c = coefficients(start.x.data()), *const d = coefficients(end.x.data());
        const double E = coupledEnergy(h, coupling, start.t, c), norm = squaredNorm(c, h->size()),
                     critical = criticalNorm(*h, coupling.g);
        std::string text = "The pulse became finer than the mesh: " + formatNumber(tailOf(*h, d), 2) +
                           " of the norm is in the upper eighth of the modes, and the energy went from " +
                           formatNumber(E, 3) + " to " +
                           formatNumber(coupledEnergy(h, coupling, end.t, d), 3) + ". Its norm is " +
                           formatNumber(norm / critical, 3) + " of the critical one";
        if (const double r2 = meanSquareRadius(*h, c); E < 0)
            text += ", and its energy negative: without a potential and from rest it collapses by t = " +
                    formatNumber(start.t + std::sqrt(-h->mass() * r2 / (2 * E)), 4) + " at the latest";
        return text + ". A finer mesh stops later, not never.";
    };
    return limit;
}

}  // namespace extremal
