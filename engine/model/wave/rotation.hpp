// SPDX-License-Identifier: GPL-3.0-or-later
/// Wave functions seen from a frame that turns with the angular velocity Omega about the middle (x0, y0) of
/// a rectangle:
///
///     i hbar psi_t = H psi - Omega L psi,   L = (x - x0) p_y - (y - y0) p_x.
/// L does not commute with translations, and is Hermitian on the grid: x p_y is diagonal in (x, k_y), y p_x
/// in (k_x, y). A function that does not vanish at the edges meets the cut of the coordinates there.
#pragma once

#include <memory>
#include <vector>

#include "engine/model/parts.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

/// A part that binds: schemes for a kinetic and a potential part do not know L.
struct Rotation {
    static constexpr PartInfo part{"rotation", "a wave function in a rotating frame"};
    double omega = 0;
};

/// L on the grid of a rectangle. Copies have their own buffers.
class AngularMomentum {
public:
    explicit AngularMomentum(std::shared_ptr<const Hamiltonian> h);
    /// psi += factor L psi' at the nodes, for coefficients c of psi'; both without the factor of the
    /// transform (Fourier::rawToNodes). In two transforms.
    void add(const Complex* c, double factor, Complex* psi);
    /// <L>/<1>.
    double mean(const Complex* c);

private:
    std::shared_ptr<const Hamiltonian> h_;
    std::vector<double> fromX_, fromY_;  ///< from the middle
    std::vector<Complex> slope_, values_;
};

/// exp(i angle L/hbar), the rotation of a plane picture by -angle, by three shears: shifts along x by
/// y tan(angle/2), along y by x sin(angle), and along x again, each of which is a phase in (k, y) or (x, k).
/// Unitary, and exact but for what the grid does not resolve. L commutes with the kinetic energy.
class PlaneTurn {
public:
    PlaneTurn(const Hamiltonian& h, double angle);
    /// Of coefficients, in place; six transforms along one axis for each sixth of a turn.
    void apply(Complex* c) const;

private:
    AxisTransforms transforms_;
    int times_ = 1;
    std::vector<Complex> alongX_, alongY_;  ///< in (k_x, y), in (x, k_y)
};

}  // namespace extremal
