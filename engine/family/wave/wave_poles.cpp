// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/wave/wave_poles.hpp"

#include <algorithm>
#include <utility>

namespace extremal {

WavePoles::WavePoles(std::shared_ptr<const Hamiltonian> hamiltonian, double dt, double shift,
                     std::vector<Complex> zeta, double tolerance, int maxIterations)
    : hamiltonian_(std::move(hamiltonian)),
      zeta_(std::move(zeta)),
      tolerance_(tolerance),
      maxIterations_(maxIterations),
      gmres_(static_cast<std::size_t>(hamiltonian_->size())) {
    const Hamiltonian& h = *hamiltonian_;
    const auto size = static_cast<std::size_t>(h.size());
    for (auto* v : {&u_, &scaled_, &psi_}) v->resize(size);
    const auto [low, high] = std::minmax_element(h.potential().begin(), h.potential().end());
    const double middle = (*low + *high) / 2, factor = dt / h.hbar();
    for (const double v : h.potential()) kick_.push_back(factor * (v - middle) / h.size());
    for (const Complex& z : zeta_)
        for (const double T : h.kinetic())
            inverse_.push_back(1.0 / (z + Complex(0, factor * (T + middle - shift))));
}

Outcome WavePoles::solve(std::size_t j, const Complex* v, Complex* w, StepReport& report,
                         const std::stop_token& stop) {
    const std::size_t size = u_.size();
    const Complex* inverse = inverse_.data() + j * size;
    const auto scale = [&](const Complex* u, Complex* out) {
        for (std::size_t i = 0; i < size; ++i) {
            const double ur = u[i].real(), ui = u[i].imag(), pr = inverse[i].real(), pi = inverse[i].imag();
            out[i] = {ur * pr - ui * pi, ur * pi + ui * pr};
        }
    };
    const auto apply = [&](const Complex* u, Complex* out) {
        scale(u, scaled_.data());
        hamiltonian_->fourier().rawToNodes(scaled_.data(), psi_.data());
        for (std::size_t i = 0; i < size; ++i)
            psi_[i] = {-kick_[i] * psi_[i].imag(), kick_[i] * psi_[i].real()};
        hamiltonian_->fourier().rawToCoefficients(psi_.data(), out);
        for (std::size_t i = 0; i < size; ++i) out[i] += u[i];
        ++report.cost.evaluations;
    };
    const Outcome outcome =
        gmres_.solve(apply, v, u_.data(), tolerance_, maxIterations_, report.cost.iterations, stop);
    if (outcome != Outcome::converged) return outcome;
    ++report.cost.linearSolves;
    scale(u_.data(), w);
    return outcome;
}

}  // namespace extremal
