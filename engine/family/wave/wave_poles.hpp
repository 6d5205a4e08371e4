// SPDX-License-Identifier: GPL-3.0-or-later
/// One shifted system after the other: (zeta_j + i dt (H - Ec)/hbar) w = v by GMRES, preconditioned from the
/// right by P = zeta_j + i dt (T + Vmid - Ec)/hbar, which is diagonal in Fourier space:
///     A P^{-1} u = u + i dt/hbar F (V - Vmid) F^{-1} P^{-1} u,
/// two transforms an iteration, whose number does not depend on N. Internal to engine/integrator.
#pragma once

#include <memory>
#include <stop_token>
#include <vector>

#include "engine/core/algebra/gmres.hpp"
#include "engine/core/outcome.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

class WavePoles {
public:
    WavePoles(std::shared_ptr<const Hamiltonian> hamiltonian, double dt, double shift,
              std::vector<Complex> zeta, double tolerance, int maxIterations);

    std::size_t size() const { return zeta_.size(); }
    Complex zeta(std::size_t j) const { return zeta_[j]; }
    /// w may not be v. Iterations, evaluations and solves are added to the report.
    Outcome solve(std::size_t j, const Complex* v, Complex* w, StepReport& report,
                  const std::stop_token& stop);

private:
    std::shared_ptr<const Hamiltonian> hamiltonian_;
    std::vector<Complex> zeta_, inverse_, u_, scaled_, psi_;
    std::vector<double> kick_;
    double tolerance_;
    int maxIterations_;
    Gmres gmres_;
};

}  // namespace extremal
