// SPDX-License-Identifier: GPL-3.0-or-later
/// Mean values of a wave function, and whether its spectrum is resolved.
#pragma once

#include <string>

#include "engine/model/wave/hamiltonian.hpp"
#include "engine/model/wave/means.hpp"

namespace extremal {

/// With a Dirichlet boundary: coefficient k of psi as a series of Chebyshev polynomials, k = 0 .. size() + 1.
Complex chebyshevCoefficient(const Hamiltonian& h, const Complex* c, int k);

/// Share of the norm in the upper eighth of the wave numbers, |a| > 7N/16: sqrt(sum |c_a|^2/sum of all
/// |c_a|^2). On a rectangle in that of either direction; with a Dirichlet boundary the same of the Chebyshev
/// coefficients, by their degree.
double spectrumTail(const Hamiltonian& h, const Complex* c);

/// What to say of a wave function that its grid does not resolve (a tail above 1e-4); empty where it does.
std::string resolutionCaution(const Hamiltonian& h, const Complex* c);

MeanMomentum meanMomentum(const Hamiltonian& h, const Complex* c);
NodeMeans nodeMeans(const Hamiltonian& h, const Complex* c, Complex* work);

/// The probability current (hbar/m) Im(conj(psi) psi_x) at the node next to the middle of the domain, with
/// a Dirichlet boundary in the middle itself, and on a rectangle along x, summed over the line there; the
/// printed one has the other sign. d/dt |psi|^2 + d/dx j = 0.
double currentInTheMiddle(const Hamiltonian& h, const Complex* c, Complex* work, Complex* slope);

}  // namespace extremal
