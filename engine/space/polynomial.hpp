// SPDX-License-Identifier: GPL-3.0-or-later
/// Polynomials of degree s on a step, in nodal or modal form: all span the same space, hence give the same
/// step.
///
/// Nodal (Lagrange) bases are cardinal at s + 1 control points d_0 = 0 < ... < d_s = 1: Lobatto, Chebyshev
/// extrema or equally spaced. Modal bases are shifted Legendre polynomials P_a(2 tau - 1) or Chebyshev
/// polynomials T_a(2 tau - 1), a = 0..s; none of these functions is associated with an end point. Source:
/// Leok 2004, sec. 2.1, with s + 1 control points q^0..q^s (the text numbers only s of them).
#pragma once

#include <string_view>

#include "engine/space/space.hpp"

namespace extremal {

enum class PolynomialBasis { lobatto, chebyshev, equispaced, legendre, chebyshevModal };

/// "lobatto", ..., "chebyshev-modal"; anything else is lobatto.
PolynomialBasis polynomialBasis(std::string_view name);

template <class T>
Space<T> polynomialSpace(int degree, PolynomialBasis basis);

}  // namespace extremal
