// SPDX-License-Identifier: GPL-3.0-or-later
/// Wave functions on another mesh of the same domain: the coefficients there of the function with the same
/// values at its nodes. On a finer mesh it is the same function; of what a coarser one does not hold each
/// mode a appears as a modulo N (aliasing), so that it is not lost from a distance between two of them.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

class WaveResampling {
public:
    /// Both periodic, or both with a Dirichlet boundary.
    WaveResampling(const Hamiltonian& from, const Hamiltonian& to);
    std::vector<Complex> operator()(const Complex* c) const {
        std::vector<Complex> all(size_);
        write(c, all.data());
        return all;
    }
    /// c has as many numbers as `from`, `other` as `to`.
    void write(const Complex* c, Complex* other) const;

private:
    std::size_t size_;
    std::vector<std::size_t> place_;  ///< of each Fourier coefficient; empty with a Dirichlet boundary
    Eigen::MatrixXd matrix_;
};

}  // namespace extremal
