// SPDX-License-Identifier: GPL-3.0-or-later
/// Eigenstates of a Hamiltonian that does not depend on time: H v = E v, from the matrix in the coordinates v
/// of Hamiltonian::toReal, which is real and symmetric, all at once. For N up to denseLimit.
///
/// With v_j = sum_n U_jn d_n the motion is d_n(t) = e^{-i E_n t/hbar} d_n(0), exact but for round-off.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/core/state.hpp"
#include "engine/model/exact_solution.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

class Eigenstates {
public:
    static constexpr int denseLimit = 512;

    /// Remembered: asking again for the same operator is cheap. Any thread may ask.
    static std::shared_ptr<const Eigenstates> of(const std::shared_ptr<const Hamiltonian>& hamiltonian);

    explicit Eigenstates(const Hamiltonian& hamiltonian);
    int size() const { return static_cast<int>(energies_.size()); }
    const std::vector<double>& energies() const { return energies_; }  ///< ascending
    /// Column n: v_j of state n; j + n N.
    const std::vector<double>& states() const { return states_; }
    /// Coefficients of state n, of norm 1.
    std::vector<Complex> coefficients(int n) const;

    /// d = U^T v and v = U d. Real and imaginary parts are apart: N numbers, then N.
    void toStates(const double* psi, double* d) const;
    void fromStates(const double* d, double* psi) const;

private:
    Hamiltonian hamiltonian_;
    std::vector<double> energies_, states_;
};

/// The exact motion of the discrete problem from a state.
ExactSolution exactWave(const std::shared_ptr<const Hamiltonian>& hamiltonian, const State& initial);

}  // namespace extremal
